//! Fields of object types that a script declares, with the checks of their values.

use std::borrow::Cow;
use std::sync::Arc;

use crate::{Expectation, Field, Parameter, Table, TableKey, Value};
use burgeon_base::error::{Error, Result};

/// Keys of a field's declaration.
const PARTS: [&str; 7] = ["default", "type", "min", "max", "choices", "unit", "doc"];

/// A field of a constructor's table.
#[derive(Debug, Clone)]
pub struct ScriptField {
    /// Name of the field.
    pub name: Arc<str>,
    /// Value of an omitted field. Without a default, the field is required.
    pub default: Option<Value>,
    sort: ValueSort,
    min: Option<f64>,
    max: Option<f64>,
    choices: Vec<Arc<str>>,
    unit: Option<Arc<str>>,
    doc: Arc<str>,
}

/// Type of a field's values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ValueSort {
    Number,
    Boolean,
    Text,
    Table,
    Object,
    Any,
}

impl ValueSort {
    const ALL: [(&str, Self); 6] = [
        ("number", Self::Number),
        ("boolean", Self::Boolean),
        ("string", Self::Text),
        ("table", Self::Table),
        ("object", Self::Object),
        ("any", Self::Any),
    ];

    fn of(value: &Value) -> Self {
        match value {
            Value::Nil => Self::Any,
            Value::Boolean(_) => Self::Boolean,
            Value::Number(_) => Self::Number,
            Value::Text(_) => Self::Text,
            Value::Table(_) => Self::Table,
            Value::Object(_) => Self::Object,
        }
    }

    fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, sort)| *sort == self).map_or("any", |(name, _)| name)
    }

    fn article(self) -> &'static str {
        match self {
            Self::Number => "a finite number",
            Self::Boolean => "true or false",
            Self::Text => "a string",
            Self::Table => "a table",
            Self::Object => "an object",
            Self::Any => "a value",
        }
    }
}

impl ScriptField {
    /// Reads the declaration of the field `name` of the type `of`: a table, or only the default.
    pub fn declare(of: &str, name: &str, declared: &Value) -> Result<Self> {
        let owner = format!("{of}.{name}");
        let bare = Table { class: None, entries: vec![(TableKey::Name("default".into()), declared.clone())] };
        let table = match declared {
            Value::Table(table) if table.class.is_none() => &**table,
            _ => &bare,
        };
        for (key, _) in &table.entries {
            let key = match key {
                TableKey::Name(key) => key.to_string(),
                TableKey::Index(index) => index.to_string(),
            };
            if !PARTS.contains(&key.as_str()) {
                let message = format!("field {owner}: unknown key `{key}`");
                return Err(Error::not_found("field", &key, PARTS, message).help(format!(
                    "the allowed keys are {}; for a table as the default, write {{ default = {{ ... }} }}",
                    PARTS.join(", ")
                )));
            }
        }
        let default = table.get("default").cloned();
        let sort = match (read::<String>(&owner, table, "type")?, &default) {
            (None, Some(default)) => ValueSort::of(default),
            (None, None) => {
                return Err(Error::argument(format!("field {owner}: missing default or type"))
                    .help("write { default = ... }, or { type = \"number\" } for a required field"));
            }
            (Some(name), _) => {
                let known = ValueSort::ALL.iter().find(|(known, _)| *known == name);
                known.map(|(_, sort)| *sort).ok_or_else(|| {
                    let names = ValueSort::ALL.map(|(name, _)| name);
                    let message = format!("field {owner}: unknown type `{name}`");
                    Error::not_found("type", &name, names, message)
                        .help(format!("the allowed types are {}", names.join(", ")))
                })?
            }
        };
        let (min, max) = (read(&owner, table, "min")?, read(&owner, table, "max")?);
        let choices: Vec<String> = read(&owner, table, "choices")?.unwrap_or_default();
        if sort != ValueSort::Number && (min.is_some() || max.is_some()) {
            return Err(Error::argument(format!(
                "field {owner} is not a number, so it cannot have min or max"
            )));
        }
        if sort != ValueSort::Text && table.get("choices").is_some() {
            return Err(Error::argument(format!("field {owner} is not a string, so it cannot have choices")));
        }
        let text = |part: &str| read::<String>(&owner, table, part);
        let (unit, doc) = (text("unit")?, text("doc")?.unwrap_or_default());
        let field = Self {
            name: name.into(),
            default: None,
            sort,
            min,
            max,
            choices: choices.into_iter().map(Into::into).collect(),
            unit: unit.map(Into::into),
            doc: doc.into(),
        };
        let default = default.map(|default| field.read(of, default)).transpose()?;
        Ok(Self { default, ..field })
    }

    /// Checks a `value` for the field, passed to a constructor of `of`. Fails if the field does not allow it.
    ///
    /// ```
    /// use burgeon_kit::{ScriptField, Table, TableKey, Value};
    /// use std::sync::Arc;
    ///
    /// let declaration = [("default", 4.0), ("min", 1.0), ("max", 9.0)];
    /// let entries = declaration.map(|(key, number)| (TableKey::Name(key.into()), Value::Number(number)));
    /// let declared = Value::Table(Arc::new(Table { class: None, entries: entries.to_vec() }));
    /// let floors = ScriptField::declare("tower", "floors", &declared)?;
    /// assert!(floors.read("tower", Value::Number(9.0)).is_ok());
    /// assert!(floors.read("tower", Value::Number(10.0)).is_err());
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn read(&self, of: &str, value: Value) -> Result<Value> {
        match self.expected(&value) {
            None => Ok(value),
            Some(what) => Err(Expectation::new(what).refuse(of, &self.name, &value)),
        }
    }

    /// Returns a description of the allowed values, if `value` is not allowed.
    fn expected(&self, value: &Value) -> Option<Cow<'static, str>> {
        let fits = match value {
            Value::Number(number) => number.is_finite(),
            _ => true,
        };
        if !fits || (self.sort != ValueSort::Any && ValueSort::of(value) != self.sort) {
            return Some(Cow::Borrowed(self.sort.article()));
        }
        match value {
            Value::Number(number) => {
                let outside =
                    self.min.is_some_and(|min| *number < min) || self.max.is_some_and(|max| *number > max);
                let (min, max) = (self.min.map(Value::Number), self.max.map(Value::Number));
                outside.then(|| match (min, max) {
                    (Some(min), Some(max)) => Cow::Owned(format!("from {min} to {max}")),
                    (Some(min), None) => Cow::Owned(format!("{min} or more")),
                    (_, Some(max)) => Cow::Owned(format!("{max} or less")),
                    (None, None) => Cow::Borrowed(""),
                })
            }
            Value::Text(text) if !self.choices.is_empty() && !self.choices.contains(text) => {
                let choices: Vec<String> = self.choices.iter().map(|choice| format!("{choice:?}")).collect();
                Some(Cow::Owned(format!("one of {}", choices.join(", "))))
            }
            _ => None,
        }
    }

    /// Describes the field for the API reference.
    pub fn describe(&self) -> Field {
        Field {
            name: Cow::Owned(self.name.to_string()),
            doc: Cow::Owned(self.doc.to_string()),
            luau: if self.choices.is_empty() {
                self.sort.name().to_owned()
            } else {
                let choices: Vec<String> = self.choices.iter().map(|choice| format!("{choice:?}")).collect();
                choices.join(" | ")
            },
            unit: self.unit.as_ref().map(|unit| Cow::Owned(unit.to_string())),
            fields: Vec::new(),
            default: self.default.as_ref().map_or_else(String::new, Value::to_string),
            former: Vec::new(),
        }
    }
}

/// Reads the entry `part` of a declaration.
fn read<T: Parameter>(owner: &str, table: &Table, part: &str) -> Result<Option<T>> {
    let Some(value) = table.get(part) else { return Ok(None) };
    T::read_value(value).map(Some).map_err(|expected| expected.refuse(owner, part, value))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(entries: &[(&str, Value)]) -> Value {
        let entries = entries.iter().map(|(name, value)| (TableKey::Name((*name).into()), value.clone()));
        Value::Table(Arc::new(Table { class: None, entries: entries.collect() }))
    }

    #[test]
    fn a_number_stays_within_its_bounds() {
        let declared = table(&[
            ("default", Value::Number(4.0)),
            ("min", Value::Number(1.0)),
            ("max", Value::Number(12.0)),
        ]);
        let field = ScriptField::declare("lantern", "height", &declared).unwrap();
        assert_eq!(field.default, Some(Value::Number(4.0)));
        for (given, refused) in [
            (Value::Number(1.0), None),
            (Value::Number(12.0), None),
            (Value::Number(0.9), Some("lantern: height must be from 1 to 12, not 0.9")),
            (Value::Number(f64::NAN), Some("lantern: height must be a finite number, not NaN")),
            (Value::Text("4".into()), Some("lantern: height must be a finite number, not \"4\"")),
        ] {
            let read = field.read("lantern", given);
            assert_eq!(read.err().map(|error| error.message().to_owned()).as_deref(), refused);
        }
    }

    #[test]
    fn a_declaration_that_means_nothing_is_refused() {
        let number = Value::Number(4.0);
        for (declared, message) in [
            (table(&[]), "field lantern.height: missing default or type"),
            (table(&[("defualt", number.clone())]), "field lantern.height: unknown key `defualt`"),
            (
                table(&[("default", number.clone()), ("min", Value::Number(5.0))]),
                "lantern: height must be 5 or more, not 4",
            ),
            (table(&[("type", Value::Text("numbr".into()))]), "field lantern.height: unknown type `numbr`"),
            (
                table(&[("default", Value::Boolean(true)), ("min", number.clone())]),
                "field lantern.height is not a number, so it cannot have min or max",
            ),
            (
                table(&[("default", number), ("choices", table(&[]))]),
                "field lantern.height is not a string, so it cannot have choices",
            ),
        ] {
            let error = ScriptField::declare("lantern", "height", &declared).expect_err(message);
            assert_eq!(error.message(), message);
        }
    }
}
