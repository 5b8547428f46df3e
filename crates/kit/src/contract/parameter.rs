//! Types of fields, arguments and results of methods, and their conversion from and to script values.

use std::any::Any;
use std::borrow::Cow;
use std::sync::Arc;

use glam::DVec3;

use crate::{Field, Object, Table, TableKey, Value};
use burgeon_base::Stop;
use burgeon_base::error::{Error, Result};
use burgeon_rewriting::ColumnValue;

/// Number of list items that are read between two checks for cancellation.
const STRETCH: usize = 4096;

/// Description of an expected value, such as "a positive whole number".
#[derive(Debug, Clone)]
pub struct Expectation {
    what: String,
    /// Description of the wrong part, if only a part of the value is wrong.
    found: Option<String>,
}

impl Expectation {
    /// Creates an expectation of `what`, which includes the article.
    pub fn new(what: impl Into<String>) -> Self {
        Self { what: what.into(), found: None }
    }

    /// Sets `found` as the wrong part of the value, unless it is already set.
    #[must_use]
    pub fn found(self, found: &Value) -> Self {
        Self { found: self.found.or_else(|| Some(shown(found).into_owned())), ..self }
    }

    /// Sets the text that describes the found value.
    #[must_use]
    pub fn but_was(self, found: impl Into<String>) -> Self {
        Self { found: Some(found.into()), ..self }
    }

    /// Returns the message for item `number` of a list.
    pub fn item(&self, number: usize) -> String {
        match &self.found {
            Some(found) => format!("item {number} must be {}, not {found}", self.what),
            None => format!("item {number} must be {}", self.what),
        }
    }

    /// Returns the error that `name` of `owner` is not as expected. It counts as an error of the data, because the
    /// value can be valid for another feature.
    pub fn refuse(&self, owner: &str, name: &str, value: &Value) -> Error {
        let found = self.found.as_deref().map_or_else(|| shown(value), Cow::Borrowed);
        Error::argument(format!("{owner}: {name} must be {}, not {found}", self.what)).of_data()
    }
}

/// Formats a value for a message.
fn shown(value: &Value) -> Cow<'static, str> {
    /// Maximum length of a shown value (bytes).
    const LONGEST: usize = 40;
    Cow::Owned(match value {
        Value::Number(number) if number.is_nan() => return Cow::Borrowed("NaN"),
        Value::Number(number) if number.is_infinite() => return Cow::Borrowed("infinity"),
        Value::Text(text) if text.len() > 2 * LONGEST => {
            format!("{:?}...", text.chars().take(LONGEST).collect::<String>())
        }
        Value::Number(_) | Value::Text(_) | Value::Boolean(_) => value.to_string(),
        Value::Table(table) if table.entries.len() <= 4 => {
            let text = value.to_string();
            if text.len() > LONGEST {
                return Cow::Borrowed(value.describe());
            }
            text
        }
        Value::Object(object) => object.kind().with_article(),
        other => return Cow::Borrowed(other.describe()),
    })
}

/// A type of fields and arguments.
pub trait Parameter: Sized {
    /// Set if a column of numbers can store the value itself, so calls can be recorded.
    const IS_NUMBER: bool = false;

    /// Returns the type in Luau syntax.
    fn luau() -> String;

    /// Returns the fields, if the type is a table of named fields or a list of such tables.
    fn fields() -> Vec<Field> {
        Vec::new()
    }

    /// Converts a script's value.
    fn from_value(value: Value) -> Result<Self, Expectation>;

    /// Converts a script's value that stays with the caller.
    fn read_value(value: &Value) -> Result<Self, Expectation> {
        Self::from_value(value.clone())
    }

    /// Converts a column's number; `None` if [`Parameter::from_value`] must refuse it.
    fn from_number(_: f64) -> Option<Self> {
        None
    }

    /// Converts to a script's value.
    fn into_value(self) -> Value;

    /// Formats the value as written in a script.
    fn written(self) -> String {
        self.into_value().to_string()
    }
}

/// A result type of methods.
pub trait Answer {
    /// Returns the type in Luau syntax; empty if the method returns the object itself.
    fn luau() -> String;

    /// Converts to a script's value.
    fn answer(self) -> Result<Value>;
}

impl Answer for () {
    fn luau() -> String {
        String::new()
    }

    #[inline]
    fn answer(self) -> Result<Value> {
        Ok(Value::Nil)
    }
}

impl<T: Answer> Answer for Result<T> {
    fn luau() -> String {
        T::luau()
    }

    #[inline]
    fn answer(self) -> Result<Value> {
        self?.answer()
    }
}

macro_rules! answers {
    ($($type:ty),*) => {$(
        impl Answer for $type {
            fn luau() -> String {
                <$type as Parameter>::luau()
            }

            fn answer(self) -> Result<Value> {
                Ok(self.into_value())
            }
        }
    )*};
}

answers!(f64, u32, bool, String, DVec3, Value);

impl<T: Parameter> Answer for Vec<T> {
    fn luau() -> String {
        <Self as Parameter>::luau()
    }

    fn answer(self) -> Result<Value> {
        Ok(self.into_value())
    }
}

impl<T: Answer> Answer for Option<T> {
    fn luau() -> String {
        format!("{}?", T::luau())
    }

    fn answer(self) -> Result<Value> {
        self.map_or(Ok(Value::Nil), T::answer)
    }
}

/// Returns the object of type `T` in a value. Otherwise fails with the expectation `what`.
pub fn object<T: Object>(value: Value, what: &str) -> Result<Arc<T>, Expectation> {
    let Value::Object(object) = value else { return Err(Expectation::new(what)) };
    let any: Arc<dyn Any + Send + Sync> = object;
    any.downcast().map_err(|_| Expectation::new(what))
}

/// An object type for fields and arguments. The objects are shared and immutable.
pub trait ObjectParameter: Object {
    /// Type in Luau syntax.
    const LUAU: &str;
    /// Expected value for messages, with its article.
    const EXPECTED: &str;
}

impl<T: ObjectParameter> Parameter for Arc<T> {
    fn luau() -> String {
        T::LUAU.into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        object(value, T::EXPECTED)
    }

    fn into_value(self) -> Value {
        Value::Object(self)
    }
}

impl Parameter for f64 {
    const IS_NUMBER: bool = true;

    fn luau() -> String {
        "number".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        match value {
            Value::Number(number) if number.is_finite() => Ok(number),
            Value::Number(_) => Err(Expectation::new("a finite number")),
            _ => Err(Expectation::new("a number")),
        }
    }

    #[inline]
    fn from_number(number: f64) -> Option<Self> {
        number.is_finite().then_some(number)
    }

    fn into_value(self) -> Value {
        Value::Number(self)
    }
}

impl Parameter for u32 {
    const IS_NUMBER: bool = true;

    fn luau() -> String {
        "number".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        match value {
            Value::Number(number) => {
                Self::from_number(number).ok_or_else(|| Expectation::new("an integer of at least 0"))
            }
            _ => Err(Expectation::new("an integer of at least 0")),
        }
    }

    #[inline]
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
    fn from_number(number: f64) -> Option<Self> {
        (number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number)).then_some(number as u32)
    }

    fn into_value(self) -> Value {
        Value::Number(f64::from(self))
    }
}

impl Parameter for bool {
    const IS_NUMBER: bool = true;

    fn luau() -> String {
        "boolean".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        match value {
            Value::Boolean(value) => Ok(value),
            _ => Err(Expectation::new("true or false")),
        }
    }

    #[inline]
    fn from_number(number: f64) -> Option<Self> {
        match ColumnValue::unpack(number) {
            ColumnValue::Boolean(value) => Some(value),
            _ => None,
        }
    }

    fn into_value(self) -> Value {
        Value::Boolean(self)
    }
}

impl<T: Parameter> Parameter for Option<T> {
    const IS_NUMBER: bool = T::IS_NUMBER;

    fn luau() -> String {
        format!("{}?", T::luau())
    }

    fn fields() -> Vec<Field> {
        T::fields()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        match value {
            Value::Nil => Ok(None),
            value => T::from_value(value).map(Some),
        }
    }

    #[inline]
    fn from_number(number: f64) -> Option<Self> {
        match T::from_number(number) {
            Some(value) => Some(Some(value)),
            None => matches!(ColumnValue::unpack(number), ColumnValue::Nil).then_some(None),
        }
    }

    fn into_value(self) -> Value {
        self.map_or(Value::Nil, T::into_value)
    }
}

impl Parameter for String {
    fn luau() -> String {
        "string".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        match value {
            Value::Text(text) => Ok(text.to_string()),
            _ => Err(Expectation::new("a string")),
        }
    }

    fn into_value(self) -> Value {
        Value::Text(self.into())
    }
}

impl Parameter for Value {
    fn luau() -> String {
        "any".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        Ok(value)
    }

    fn into_value(self) -> Value {
        self
    }
}

impl Parameter for Arc<Table> {
    fn luau() -> String {
        "{ [string]: any }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        match value {
            Value::Table(table) => Ok(table),
            _ => Err(Expectation::new("a table of named fields")),
        }
    }

    fn into_value(self) -> Value {
        Value::Table(self)
    }
}

impl<T: Parameter> Parameter for Vec<T> {
    fn luau() -> String {
        format!("{{ {} }}", T::luau())
    }

    fn fields() -> Vec<Field> {
        T::fields()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = || Expectation::new("a list");
        match value {
            Value::Table(table) => {
                let list = table.list();
                if list.len() != table.entries.len() {
                    return Err(what());
                }
                list.into_iter()
                    .enumerate()
                    .map(|(index, value)| {
                        // The run reports the reason of the cancellation instead of this error.
                        if index % STRETCH == STRETCH - 1 && Stop::check_current().is_err() {
                            return Err(what());
                        }
                        T::read_value(value).map_err(|inner| {
                            let what = format!("a list whose item {} is {}", index + 1, inner.what);
                            Expectation { what, ..inner }.found(value)
                        })
                    })
                    .collect()
            }
            _ => Err(what()),
        }
    }

    fn into_value(self) -> Value {
        list(self.into_iter().map(T::into_value))
    }

    fn written(self) -> String {
        let items: Vec<String> = self.into_iter().map(T::written).collect();
        if items.is_empty() { "{}".to_owned() } else { format!("{{ {} }}", items.join(", ")) }
    }
}

fn list(values: impl Iterator<Item = Value>) -> Value {
    let entries = (1..).map(TableKey::Index).zip(values).collect();
    Value::Table(Arc::new(Table { class: None, entries }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_optional_number_may_be_left_out_of_a_column() {
        assert_eq!(Option::<f64>::from_number(ColumnValue::Nil.pack()), Some(None));
        assert_eq!(Option::<f64>::from_number(2.0), Some(Some(2.0)));
        assert_eq!(Option::<f64>::from_number(f64::NAN), None);
    }
}
