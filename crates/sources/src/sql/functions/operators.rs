//! Operators and casts with the meaning of PostgreSQL, for rewritten statements: strings are not implicitly converted
//! to numbers, numbers are rounded, and a division by zero is an error.

use rusqlite::Connection;
use rusqlite::functions::{Context, FunctionFlags};
use rusqlite::types::{Value, ValueRef};

use super::decimals::{as_numeric, float_text, round_decimal};
use super::texts::{lower, wrong_argument};

/// The body of an operator, which is called with arguments that are not null.
type OperatorBody = fn(&Context<'_>) -> Result<Value, String>;

/// Operators, with the number of their arguments.
const OPERATORS: [(&str, i32, OperatorBody); 15] = [
    ("abs", 1, |context| {
        Ok(match whole_or_real(context, 0)? {
            OperandNumber::Whole(number) => {
                Value::Integer(number.checked_abs().ok_or("integer out of range")?)
            }
            OperandNumber::Real(number) => Value::Real(number.abs()),
        })
    }),
    ("burgeon_divide", 2, |context| {
        Ok(match (whole_or_real(context, 0)?, whole_or_real(context, 1)?) {
            (OperandNumber::Whole(_), OperandNumber::Whole(0)) => return Err("division by zero".into()),
            (OperandNumber::Whole(a), OperandNumber::Whole(b)) => {
                Value::Integer(a.checked_div(b).ok_or("integer out of range")?)
            }
            (a, b) => quotient(a.real(), b.real())?,
        })
    }),
    ("burgeon_quotient", 2, |context| {
        quotient(whole_or_real(context, 0)?.real(), whole_or_real(context, 1)?.real())
    }),
    ("burgeon_modulo", 2, modulo),
    ("mod", 2, modulo),
    ("burgeon_whole", 1, |context| whole(context, f64::round_ties_even)),
    ("burgeon_whole_decimal", 1, |context| whole(context, f64::round)),
    ("burgeon_number", 1, |context| {
        Ok(Value::Real(match context.get_raw(0) {
            ValueRef::Text(text) => parse(text, "double precision")?,
            _ => whole_or_real(context, 0)?.real(),
        }))
    }),
    ("burgeon_decimal", 1, |context| {
        Ok(match context.get_raw(0) {
            ValueRef::Text(text) => Value::Real(parse(text, "numeric")?),
            ValueRef::Real(number) => Value::Real(as_numeric(number)),
            _ => Value::Real(whole_or_real(context, 0)?.real()),
        })
    }),
    ("burgeon_round", 1, |context| Ok(Value::Real(whole_or_real(context, 0)?.real().round_ties_even()))),
    ("burgeon_round_decimal", 2, |context| {
        let decimals = whole_or_real(context, 1)?.real();
        #[allow(clippy::cast_possible_truncation, reason = "it saturates")]
        let decimals = decimals as i32;
        Ok(Value::Real(round_decimal(as_numeric(whole_or_real(context, 0)?.real()), decimals)))
    }),
    ("burgeon_boolean", 1, |context| {
        Ok(Value::Integer(match context.get_raw(0) {
            ValueRef::Integer(number) => i64::from(number != 0),
            ValueRef::Real(number) => i64::from(number != 0.0),
            ValueRef::Text(text) => {
                let text = String::from_utf8_lossy(text).trim().to_ascii_lowercase();
                match text.as_str() {
                    "t" | "tr" | "tru" | "true" | "y" | "ye" | "yes" | "on" | "1" => 1,
                    "f" | "fa" | "fal" | "fals" | "false" | "n" | "no" | "of" | "off" | "0" => 0,
                    _ => return Err(format!("invalid input syntax for type boolean: {text:?}")),
                }
            }
            other => return Err(wrong_argument(0, "true or false", other)),
        }))
    }),
    ("burgeon_text", 1, |context| {
        Ok(Value::Text(match context.get_raw(0) {
            ValueRef::Integer(number) => number.to_string(),
            ValueRef::Real(number) => float_text(number),
            ValueRef::Text(text) => String::from_utf8_lossy(text).into_owned(),
            other => return Err(format!("{}; take ST_AsText(geometry)", wrong_argument(0, "a text", other))),
        }))
    }),
    ("burgeon_truth", 1, |context| {
        let truth = matches!(whole_or_real(context, 0)?, OperandNumber::Whole(1..));
        Ok(Value::Text(truth.to_string()))
    }),
    ("sign", 1, |context| {
        let number = whole_or_real(context, 0)?.real();
        Ok(Value::Real(if number == 0.0 { 0.0 } else { number.signum() }))
    }),
];

/// Returns the names of the functions that rewritten statements use.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    OPERATORS.iter().map(|(name, ..)| *name).chain(["burgeon_like", "burgeon_ilike"])
}

enum OperandNumber {
    Whole(i64),
    Real(f64),
}

impl OperandNumber {
    fn real(&self) -> f64 {
        match self {
            #[allow(clippy::cast_precision_loss, reason = "PostgreSQL does the same")]
            Self::Whole(number) => *number as f64,
            Self::Real(number) => *number,
        }
    }
}

fn whole_or_real(context: &Context<'_>, index: usize) -> Result<OperandNumber, String> {
    match context.get_raw(index) {
        ValueRef::Integer(number) => Ok(OperandNumber::Whole(number)),
        ValueRef::Real(number) => Ok(OperandNumber::Real(number)),
        other => Err(wrong_argument(index, "a number", other)),
    }
}

fn quotient(a: f64, b: f64) -> Result<Value, String> {
    if b == 0.0 {
        return Err("division by zero".into());
    }
    let made = a / b;
    if made.is_infinite() && a.is_finite() {
        Err("value out of range: overflow".into())
    } else {
        Ok(Value::Real(made))
    }
}

fn modulo(context: &Context<'_>) -> Result<Value, String> {
    Ok(match (whole_or_real(context, 0)?, whole_or_real(context, 1)?) {
        (OperandNumber::Whole(_), OperandNumber::Whole(0)) => return Err("division by zero".into()),
        (OperandNumber::Whole(a), OperandNumber::Whole(b)) => Value::Integer(a.checked_rem(b).unwrap_or(0)),
        (a, b) => {
            if b.real() == 0.0 {
                return Err("division by zero".into());
            }
            Value::Real(a.real() % b.real())
        }
    })
}

fn parse(text: &[u8], kind: &str) -> Result<f64, String> {
    let text = String::from_utf8_lossy(text);
    let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| format!("invalid input syntax for type {kind}: {text:?}"))
}

/// Converts an argument to an integer: a string must be an integer, and other numbers are rounded with `round`.
fn whole(context: &Context<'_>, round: fn(f64) -> f64) -> Result<Value, String> {
    let number = match context.get_raw(0) {
        ValueRef::Integer(number) => return Ok(Value::Integer(number)),
        ValueRef::Real(number) => round(number),
        ValueRef::Text(text) => {
            let text = String::from_utf8_lossy(text);
            let number = text.trim().parse::<i64>();
            return number
                .map(Value::Integer)
                .map_err(|_| format!("invalid input syntax for type integer: {text:?}"));
        }
        other => return Err(wrong_argument(0, "a number", other)),
    };
    #[allow(clippy::cast_possible_truncation, reason = "the range is checked")]
    if number.abs() < 9.2e18 { Ok(Value::Integer(number as i64)) } else { Err("integer out of range".into()) }
}

/// Reports whether a string matches a pattern, in which `%` stands for any characters and `_` for one character.
fn is_like(text: &[char], pattern: &[char], escape: Option<char>) -> Result<bool, String> {
    /// A part of a pattern.
    enum PatternPart {
        Any,
        One,
        Letter(char),
    }
    let mut parts = Vec::with_capacity(pattern.len());
    let mut letters = pattern.iter();
    while let Some(letter) = letters.next() {
        parts.push(match letter {
            letter if Some(*letter) == escape => match letters.next() {
                Some(letter) => PatternPart::Letter(*letter),
                None => return Err("LIKE pattern must not end with escape character".into()),
            },
            '%' => PatternPart::Any,
            '_' => PatternPart::One,
            letter => PatternPart::Letter(*letter),
        });
    }
    // The part after the last `%`, and the position in the text at which it was tried.
    let (mut at, mut part, mut last) = (0, 0, None);
    while at < text.len() {
        match parts.get(part) {
            Some(PatternPart::Any) => {
                last = Some((part, at));
                part += 1;
            }
            Some(PatternPart::One) => {
                at += 1;
                part += 1;
            }
            Some(PatternPart::Letter(letter)) if *letter == text[at] => {
                at += 1;
                part += 1;
            }
            _ => {
                let Some((any, tried)) = last else { return Ok(false) };
                last = Some((any, tried + 1));
                (part, at) = (any + 1, tried + 1);
            }
        }
    }
    Ok(parts[part..].iter().all(|part| matches!(part, PatternPart::Any)))
}

fn like(context: &Context<'_>, any_case: bool) -> Result<Value, String> {
    let text = |index: usize| -> Result<Vec<char>, String> {
        match context.get_raw(index) {
            ValueRef::Text(text) => {
                let text = String::from_utf8_lossy(text);
                Ok(if any_case { text.chars().map(lower).collect() } else { text.chars().collect() })
            }
            other => Err(wrong_argument(index, "a text", other)),
        }
    };
    let escape = if context.len() > 2 { text(2)?.first().copied() } else { Some('\\') };
    Ok(Value::Integer(i64::from(is_like(&text(0)?, &text(1)?, escape)?)))
}

/// Registers the functions with a connection.
pub(super) fn register(connection: &Connection) -> rusqlite::Result<()> {
    let flags = FunctionFlags::SQLITE_UTF8 | FunctionFlags::SQLITE_DETERMINISTIC;
    let called = |context: &Context<'_>, name: &str, run: &dyn Fn() -> Result<Value, String>| {
        if (0..context.len()).any(|index| matches!(context.get_raw(index), ValueRef::Null)) {
            return Ok(Value::Null);
        }
        let own = name.starts_with("burgeon_");
        run().map_err(|why| {
            rusqlite::Error::UserFunctionError(if own { why } else { format!("{name}: {why}") }.into())
        })
    };
    for (name, count, run) in OPERATORS {
        connection.create_scalar_function(name, count, flags, move |context| {
            called(context, name, &|| run(context))
        })?;
    }
    for (name, any_case) in [("burgeon_like", false), ("burgeon_ilike", true)] {
        for count in 2..=3 {
            connection.create_scalar_function(name, count, flags, move |context| {
                called(context, name, &|| like(context, any_case))
            })?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_those_of_postgresql() {
        let like = |text: &str, pattern: &str| {
            is_like(&text.chars().collect::<Vec<_>>(), &pattern.chars().collect::<Vec<_>>(), Some('\\'))
        };
        for (text, pattern) in [
            ("abc", "a%"),
            ("abc", "%c"),
            ("abc", "_b_"),
            ("a%", r"a\%"),
            ("", "%"),
            ("aXbXc", "%X%c"),
            ("a", "a%%"),
        ] {
            assert_eq!(like(text, pattern), Ok(true), "{text} {pattern}");
        }
        for (text, pattern) in [("abc", "b%"), ("abc", "_"), ("abc", r"a\_c"), ("", "_"), ("ab", "%a")] {
            assert_eq!(like(text, pattern), Ok(false), "{text} {pattern}");
        }
        assert!(like("a", "b\\").is_ok() || like("a", "a\\").is_err());
        // A search by trying every combination would take too long here.
        assert_eq!(like(&"a".repeat(3000), &format!("{}b", "%a".repeat(200))), Ok(false));
    }
}
