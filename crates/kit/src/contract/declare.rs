//! Helpers with which object types declare their scripting API in their own files.

use std::any::Any;

pub use super::argument::unit;
use crate::{Object, Parameter, Table, TableKey, Value};
use burgeon_base::error::{Error, Result};
use burgeon_rewriting::ColumnValue;

/// Refuses entries of `table` that are missing in `fields`.
///
/// ```
/// use burgeon_kit::declare::refuse_unknown;
/// use burgeon_kit::{Table, TableKey, Value};
///
/// let table = Table { class: None, entries: vec![(TableKey::Name("heigth".into()), Value::Number(2.0))] };
/// let error = refuse_unknown("tower", &["height", "width"], &table).expect_err("a misspelt field");
/// assert_eq!(error.remedy(), Some("did you mean height?"));
/// ```
pub fn refuse_unknown(kind: &str, fields: &[&str], table: &Table) -> Result<()> {
    for (key, value) in &table.entries {
        let TableKey::Name(name) = key else {
            return Err(Error::argument(format!("{kind} needs named fields, but {value} has no name"))
                .help(format!("write {kind} {{ {} = {value} }}", fields.first().unwrap_or(&"name")))
                .of_script());
        };
        if !fields.contains(&&**name) {
            let message = format!("unknown field `{name}` in {kind}");
            return Err(Error::not_found("field", name, fields.iter().copied(), message)
                .help(format!("it has {}", fields.join(", ")))
                .of_script());
        }
    }
    Ok(())
}

/// Arguments of a call, read in order. For the attribute `methods`.
///
/// ```
/// use burgeon_kit::Value;
/// use burgeon_kit::declare::Arguments;
///
/// let values = [Value::Number(3.0), Value::Text("oak".into())];
/// let mut arguments = Arguments::new("fence", "add", &values);
/// assert_eq!(arguments.next::<f64>("length")?, 3.0);
/// let error = arguments.next::<bool>("gate").expect_err("a string");
/// assert_eq!(error.message(), "fence:add: gate must be true or false, not \"oak\"");
/// # Ok::<(), burgeon_base::Error>(())
/// ```
pub struct Arguments<'a> {
    kind: &'static str,
    method: &'static str,
    values: &'a [Value],
    taken: usize,
}

impl<'a> Arguments<'a> {
    /// Wraps the `values` that a script passes to `method` of type `kind`.
    pub fn new(kind: &'static str, method: &'static str, values: &'a [Value]) -> Self {
        Self { kind, method, values, taken: 0 }
    }

    /// Reads the next argument, called `name` in messages.
    pub fn next<T: Parameter>(&mut self, name: &str) -> Result<T> {
        let value = self.values.get(self.taken).unwrap_or(&Value::Nil);
        self.taken += 1;
        T::read_value(value).map_err(|expected| {
            let error = expected.refuse(&format!("{}:{}", self.kind, self.method), name, value);
            match self.numbers_for_vector::<T>() {
                Some(numbers) => error.help(format!("give `{name}` as one vector: vec({numbers})")),
                None => error,
            }
        })
    }

    /// Returns the text of the two or three numbers from the last argument on, if a script passes them for one vector.
    #[cold]
    fn numbers_for_vector<T: Parameter>(&self) -> Option<String> {
        let is_number = |value: &&Value| matches!(value, Value::Number(_));
        let rest = self.values.get(self.taken - 1..)?;
        let numbers: Vec<String> = rest.iter().take_while(is_number).take(3).map(Value::to_string).collect();
        (numbers.len() > 1 && T::luau().trim_end_matches('?') == "Vector").then(|| numbers.join(", "))
    }

    /// Fails if arguments remain.
    pub fn end(&self) -> Result<()> {
        if self.values.len() > self.taken {
            return Err(Error::argument(format!(
                "{}:{} takes {} arguments, not {}",
                self.kind,
                self.method,
                self.taken,
                self.values.len()
            ))
            .of_script());
        }
        Ok(())
    }
}

/// Arguments of a call that takes only numbers.
pub struct Numbers<'a> {
    kind: &'static str,
    method: &'static str,
    numbers: &'a [f64],
    taken: usize,
}

impl<'a> Numbers<'a> {
    /// Wraps the `numbers` that a script passes to `method` of type `kind`.
    #[inline]
    pub fn new(kind: &'static str, method: &'static str, numbers: &'a [f64]) -> Self {
        Self { kind, method, numbers, taken: 0 }
    }

    /// Reads the next argument, called `name` in messages.
    #[inline]
    pub fn next<T: Parameter>(&mut self, name: &str) -> Result<T> {
        let number = self.numbers.get(self.taken).copied().unwrap_or(f64::NAN);
        self.taken += 1;
        match T::from_number(number) {
            Some(value) => Ok(value),
            None => self.refuse::<T>(name, number),
        }
    }

    #[cold]
    fn refuse<T: Parameter>(&self, name: &str, number: f64) -> Result<T> {
        let value = match ColumnValue::unpack(number) {
            ColumnValue::Number(number) => Value::Number(number),
            ColumnValue::Boolean(value) => Value::Boolean(value),
            ColumnValue::Nil => Value::Nil,
            ColumnValue::Handle(_) => Value::Table(std::sync::Arc::default()),
        };
        T::read_value(&value)
            .map_err(|expected| expected.refuse(&format!("{}:{}", self.kind, self.method), name, &value))
    }

    /// Ends the reading of arguments. Does nothing, because the caller has checked their number.
    #[inline]
    #[allow(clippy::unused_self, reason = "mirrors Arguments::end")]
    pub fn end(&self) {}
}

/// Returns the object of type `T` that a method is called for: `object` itself or its base object. Fails if neither is
/// a `T`.
#[inline]
pub fn downcast_ref<T: Object>(object: &dyn Object) -> Result<&T> {
    as_ref(object).ok_or_else(wrong_type)
}

/// Returns the object of type `T` that a write method is called for: `object` itself or its base object. Fails if
/// neither is a `T`.
#[inline]
pub fn downcast_mut<T: Object>(object: &mut dyn Object) -> Result<&mut T> {
    as_mut(object).ok_or_else(wrong_type)
}

/// Returns `object` as a `T`, or its nearest base object that is a `T`.
#[inline]
pub fn as_ref<T: Object>(object: &dyn Object) -> Option<&T> {
    let any: &dyn Any = object;
    match any.downcast_ref() {
        Some(found) => Some(found),
        None => object.base().and_then(as_ref),
    }
}

/// Returns `object` as a `T` for changes, or its nearest base object that is a `T`.
#[inline]
pub fn as_mut<T: Object>(object: &mut dyn Object) -> Option<&mut T> {
    let is_one = (object as &dyn Any).is::<T>();
    if is_one {
        let any: &mut dyn Any = object;
        #[allow(unsafe_code, reason = "to ask for the type once more costs as much as a small method")]
        // SAFETY: `is` above has checked that `any` is a `T`.
        return Some(unsafe { &mut *std::ptr::from_mut(any).cast::<T>() });
    }
    object.base_mut().and_then(as_mut)
}

#[cold]
fn wrong_type() -> Error {
    Error::script("the method belongs to another object type")
        .help("call it with a colon: this:method()")
        .of_script()
}
