//! Script values that Rust owns: parameters of modules, arguments and results of methods.

use std::fmt;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

use crate::{Object, ObjectContent};

/// A number, a boolean, a string, a frozen table or an object.
///
/// ```
/// use burgeon_kit::{Table, TableKey, Value};
/// use std::sync::Arc;
///
/// let entries = vec![
///     (TableKey::Index(1), Value::Number(2.0)),
///     (TableKey::Name("name".into()), Value::Text("mill".into())),
/// ];
/// let table = Table { class: None, entries };
/// assert_eq!((table.list().len(), table.get("name")), (1, Some(&Value::Text("mill".into()))));
/// assert_eq!(Value::Table(Arc::new(table)).to_string(), r#"{2,name="mill"}"#);
/// ```
#[derive(Clone)]
pub enum Value {
    /// No value, or an omitted optional value.
    Nil,
    /// `true` or `false`.
    Boolean(bool),
    /// A number.
    Number(f64),
    /// A string.
    Text(Arc<str>),
    /// A frozen table.
    Table(Arc<Table>),
    /// A geometry or another object, shared and immutable.
    Object(Arc<dyn Object>),
}

/// A frozen table of values.
#[derive(Debug, Clone, Default, PartialEq, Eq, Hash)]
pub struct Table {
    /// Class that gives the table operators in scripts, such as the vectors of the standard library.
    pub class: Option<Arc<str>>,
    /// Entries, in the order of their keys.
    pub entries: Vec<(TableKey, Value)>,
}

/// Key of a table entry.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum TableKey {
    /// A position, from 1.
    Index(i64),
    /// A name.
    Name(Arc<str>),
}

impl PartialEq for Value {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Nil, Self::Nil) => true,
            (Self::Boolean(a), Self::Boolean(b)) => a == b,
            (Self::Number(a), Self::Number(b)) => a.to_bits() == b.to_bits(),
            (Self::Text(a), Self::Text(b)) => a == b,
            (Self::Table(a), Self::Table(b)) => a == b,
            (Self::Object(a), Self::Object(b)) => are_equal(a, b),
            _ => false,
        }
    }
}

impl Eq for Value {}

/// Returns true if two objects are the same, or have equal contents.
pub fn are_equal(a: &Arc<dyn Object>, b: &Arc<dyn Object>) -> bool {
    Arc::ptr_eq(a, b) || a.capability::<dyn ObjectContent>().is_some_and(|content| content.equals(&**b))
}

impl Hash for Value {
    fn hash<H: Hasher>(&self, state: &mut H) {
        std::mem::discriminant(self).hash(state);
        match self {
            Self::Nil => {}
            Self::Boolean(value) => value.hash(state),
            Self::Number(value) => value.to_bits().hash(state),
            Self::Text(value) => value.hash(state),
            Self::Table(value) => value.hash(state),
            Self::Object(value) => match value.capability::<dyn ObjectContent>() {
                Some(content) => content.hash(state),
                None => Arc::as_ptr(value).cast::<()>().hash(state),
            },
        }
    }
}

impl Value {
    /// Returns the type for messages: "a number", "a table".
    pub fn describe(&self) -> &'static str {
        match self {
            Self::Nil => "nothing",
            Self::Boolean(_) => "a boolean",
            Self::Number(_) => "a number",
            Self::Text(_) => "a string",
            Self::Table(_) => "a table",
            Self::Object(_) => "an object",
        }
    }
}

impl Table {
    /// Returns the value of the entry called `name`.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.entries
            .iter()
            .find(|(key, _)| matches!(key, TableKey::Name(known) if **known == *name))
            .map(|(_, value)| value)
    }

    /// Returns the entries 1, 2, 3 and so on, up to the first missing index.
    pub fn list(&self) -> Vec<&Value> {
        let mut list = Vec::new();
        for (key, value) in &self.entries {
            if matches!(key, TableKey::Index(index) if usize::try_from(*index) == Ok(list.len() + 1)) {
                list.push(value);
            }
        }
        list
    }
}

impl fmt::Debug for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl fmt::Display for dyn Object {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.capability::<dyn ObjectContent>() {
            Some(content) => f.write_str(&content.text()),
            None => f.write_str(&self.kind().name),
        }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nil => f.write_str("nil"),
            Self::Boolean(value) => write!(f, "{value}"),
            Self::Number(value) => write_number(*value, f),
            Self::Text(value) => write!(f, "{value:?}"),
            Self::Object(value) => write!(f, "{value}"),
            Self::Table(table) => {
                f.write_str(table.class.as_deref().unwrap_or_default())?;
                f.write_str("{")?;
                let mut listed = 0;
                for (i, (key, value)) in table.entries.iter().enumerate() {
                    f.write_str(if i > 0 { "," } else { "" })?;
                    match key {
                        TableKey::Index(index) if *index == listed + 1 => listed += 1,
                        TableKey::Index(index) => write!(f, "[{index}]=")?,
                        TableKey::Name(name) if is_field(name) => write!(f, "{name}=")?,
                        TableKey::Name(name) => write!(f, "[{name:?}]=")?,
                    }
                    write!(f, "{value}")?;
                }
                f.write_str("}")
            }
        }
    }
}

/// Returns true if `name` is a keyword of Lua.
///
/// ```
/// use burgeon_kit::is_keyword;
///
/// assert!(is_keyword("end") && !is_keyword("End"));
/// ```
pub fn is_keyword(name: &str) -> bool {
    const KEYWORDS: [&str; 21] = [
        "and", "break", "do", "else", "elseif", "end", "false", "for", "function", "if", "in", "local",
        "nil", "not", "or", "repeat", "return", "then", "true", "until", "while",
    ];
    KEYWORDS.contains(&name)
}

/// Returns true if Lua accepts `name` as a field name without quotation marks.
fn is_field(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        && !is_keyword(name)
}

/// Writes the shortest decimal that parses as the same number.
fn write_number(value: f64, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    if value.is_nan() {
        f.write_str("nan")
    } else if value == 0.0 {
        f.write_str(if value.is_sign_negative() { "-0" } else { "0" })
    } else if value.is_finite() && !(1e-7..1e21).contains(&value.abs()) {
        write!(f, "{value:e}")
    } else {
        write!(f, "{value}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_that_differ_are_written_differently() {
        let text = |text: &str| Value::Text(text.into());
        let table = |class: Option<&str>, entries: Vec<(TableKey, Value)>| {
            Value::Table(Arc::new(Table { class: class.map(Into::into), entries })).to_string()
        };
        let index = |index: i64, value: &str| (TableKey::Index(index), text(value));
        let name = |name: &str, value: &str| (TableKey::Name(name.into()), text(value));
        for (written, expected) in [
            (table(None, vec![index(1, "b")]), r#"{"b"}"#),
            (table(None, vec![index(2, "b")]), r#"{[2]="b"}"#),
            (table(None, vec![index(0, "a"), index(1, "b"), index(2, "c")]), r#"{[0]="a","b","c"}"#),
            (table(None, vec![index(1, "a"), index(3, "c")]), r#"{"a",[3]="c"}"#),
            (table(None, vec![index(-1, "a")]), r#"{[-1]="a"}"#),
            (table(None, vec![name("1", "a")]), r#"{["1"]="a"}"#),
            (table(None, vec![name("end", "a"), name("of", "b")]), r#"{["end"]="a",of="b"}"#),
            (table(None, vec![name("a=1,b", "a")]), r#"{["a=1,b"]="a"}"#),
            (table(None, vec![name("x", "1")]), r#"{x="1"}"#),
            (table(Some("vec"), vec![name("x", "1")]), r#"vec{x="1"}"#),
            (table(None, Vec::new()), "{}"),
        ] {
            assert_eq!(written, expected);
        }
    }

    #[test]
    fn numbers_are_written_as_the_shortest_decimal() {
        for (number, text) in [
            (24.0, "24"),
            (0.1, "0.1"),
            (1.0 / 3.0, "0.3333333333333333"),
            (1e300, "1e300"),
            (-2.5e-9, "-2.5e-9"),
        ] {
            assert_eq!(Value::Number(number).to_string(), text);
            assert!((text.parse::<f64>().unwrap() - number).abs() == 0.0);
        }
    }
}
