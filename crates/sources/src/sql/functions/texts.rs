//! Functions of strings like PostgreSQL's: Unicode characters, positions counted from 1, and no implicit conversion to
//! strings.

use rusqlite::Connection;
use rusqlite::functions::{Context, FunctionFlags};
use rusqlite::types::{Value, ValueRef};

use super::decimals::float_text;

/// The body of a function, which returns a value or the reason for a failure.
type TextFunction = fn(&TextCall<'_>) -> Result<Value, String>;

/// Functions, with the minimum and the maximum number of their arguments.
const FUNCTIONS: [(&str, i32, i32, TextFunction); 25] = [
    ("ascii", 1, 1, |call| {
        Ok(Value::Integer(call.text(0)?.chars().next().map_or(0, |letter| i64::from(u32::from(letter)))))
    }),
    ("btrim", 1, 2, |call| trim(call, true, true)),
    ("char_length", 1, 1, length),
    ("character_length", 1, 1, length),
    ("chr", 1, 1, |call| {
        let letter = u32::try_from(call.whole(0)?).ok().filter(|code| *code > 0).and_then(char::from_u32);
        letter.map(|letter| Value::Text(letter.into())).ok_or_else(|| "there is no such character".into())
    }),
    ("initcap", 1, 1, |call| {
        let mut begins = true;
        let capital = |letter: char| {
            let made = if begins { upper(letter) } else { lower(letter) };
            begins = !letter.is_alphanumeric();
            made
        };
        Ok(Value::Text(call.text(0)?.chars().map(capital).collect()))
    }),
    ("left", 2, 2, |call| {
        let (text, most) = (call.text(0)?, call.whole(1)?);
        let count = kept_length(text, most);
        Ok(Value::Text(text.chars().take(count).collect()))
    }),
    ("length", 1, 1, length),
    ("lower", 1, 1, |call| Ok(Value::Text(call.text(0)?.chars().map(lower).collect()))),
    ("lpad", 2, 3, |call| pad(call, true)),
    ("ltrim", 1, 2, |call| trim(call, true, false)),
    ("repeat", 2, 2, |call| {
        let (text, count) = (call.text(0)?, usize::try_from(call.whole(1)?).unwrap_or(0));
        let length = text.len().checked_mul(count).filter(|length| *length <= LONGEST);
        length.map(|_| Value::Text(text.repeat(count))).ok_or_else(too_long)
    }),
    ("reverse", 1, 1, |call| Ok(Value::Text(call.text(0)?.chars().rev().collect()))),
    ("right", 2, 2, |call| {
        let (text, most) = (call.text(0)?, call.whole(1)?);
        let count = kept_length(text, most);
        let first = text.chars().count() - count;
        Ok(Value::Text(text.chars().skip(first).collect()))
    }),
    ("rpad", 2, 3, |call| pad(call, false)),
    ("rtrim", 1, 2, |call| trim(call, false, true)),
    ("split_part", 3, 3, |call| {
        let (text, at, number) = (call.text(0)?, call.text(1)?, call.whole(2)?);
        if number == 0 {
            return Err("field position must not be zero".into());
        }
        let parts: Vec<&str> = if at.is_empty() { vec![text] } else { text.split(at).collect() };
        let index = match usize::try_from(number.unsigned_abs()) {
            Ok(number) if call.whole(2)? < 0 => parts.len().checked_sub(number),
            Ok(number) => number.checked_sub(1),
            Err(_) => None,
        };
        Ok(Value::Text(index.and_then(|index| parts.get(index)).copied().unwrap_or("").to_owned()))
    }),
    ("starts_with", 2, 2, |call| Ok(Value::Integer(i64::from(call.text(0)?.starts_with(call.text(1)?))))),
    ("strpos", 2, 2, |call| {
        let text = call.text(0)?;
        let found = text.find(call.text(1)?).map_or(0, |at| text[..at].chars().count() + 1);
        Ok(Value::Integer(i64::try_from(found).unwrap_or(i64::MAX)))
    }),
    // The parser treats the other two as one expression.
    ("burgeon_substr", 2, 3, part),
    ("substr", 2, 3, part),
    ("substring", 2, 3, part),
    ("translate", 3, 3, |call| {
        let (from, to): (Vec<char>, Vec<char>) =
            (call.text(1)?.chars().collect(), call.text(2)?.chars().collect());
        let changed = |letter: char| match from.iter().position(|known| *known == letter) {
            Some(index) => to.get(index).copied(),
            None => Some(letter),
        };
        Ok(Value::Text(call.text(0)?.chars().filter_map(changed).collect()))
    }),
    ("trim", 1, 2, |call| trim(call, true, true)),
    ("upper", 1, 1, |call| Ok(Value::Text(call.text(0)?.chars().map(upper).collect()))),
];

/// Maximum length (bytes) of a result.
const LONGEST: usize = 100_000_000;

/// Returns the names of the functions that statements may call.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    FUNCTIONS.iter().map(|(name, ..)| *name).chain(["concat", "concat_ws"])
}

/// The arguments of a call.
struct TextCall<'a>(&'a Context<'a>);

impl TextCall<'_> {
    fn text(&self, index: usize) -> Result<&str, String> {
        match self.0.get_raw(index) {
            ValueRef::Text(text) => std::str::from_utf8(text).map_err(|_| "a text is no UTF-8".into()),
            other => Err(wrong_argument(index, "a text", other)),
        }
    }

    fn whole(&self, index: usize) -> Result<i64, String> {
        match self.0.get_raw(index) {
            ValueRef::Integer(number) => Ok(number),
            #[allow(clippy::cast_possible_truncation, reason = "it has no fraction, and saturates")]
            ValueRef::Real(number) if number.fract() == 0.0 => Ok(number as i64),
            other => Err(wrong_argument(index, "a whole number", other)),
        }
    }
}

/// Returns the error message for an argument of another type.
pub(super) fn wrong_argument(index: usize, wanted: &str, found: ValueRef<'_>) -> String {
    let found = match found {
        ValueRef::Null => "NULL",
        ValueRef::Integer(_) | ValueRef::Real(_) => "a number",
        ValueRef::Text(_) => "a text",
        ValueRef::Blob(_) => "a geometry",
    };
    format!("argument {} must be {wanted}, not {found}", index + 1)
}

fn too_long() -> String {
    format!("the text would have more than {} MB", LONGEST / 1_000_000)
}

fn length(call: &TextCall<'_>) -> Result<Value, String> {
    Ok(Value::Integer(i64::try_from(call.text(0)?.chars().count()).unwrap_or(i64::MAX)))
}

/// Returns the number of characters to keep: `most`, or all except the absolute value of `most` if it is negative.
fn kept_length(text: &str, most: i64) -> usize {
    let count = text.chars().count();
    let least = usize::try_from(most.unsigned_abs()).unwrap_or(usize::MAX);
    if most < 0 { count.saturating_sub(least) } else { least.min(count) }
}

fn pad(call: &TextCall<'_>, before: bool) -> Result<Value, String> {
    let text = call.text(0)?;
    let length = usize::try_from(call.whole(1)?).unwrap_or(0);
    let filling = if call.0.len() > 2 { call.text(2)? } else { " " };
    if length > LONGEST / 4 {
        return Err(too_long());
    }
    let count = text.chars().count();
    if count >= length || filling.is_empty() {
        return Ok(Value::Text(text.chars().take(length).collect()));
    }
    let filling: String = filling.chars().cycle().take(length - count).collect();
    Ok(Value::Text(if before { filling + text } else { text.to_owned() + &filling }))
}

fn trim(call: &TextCall<'_>, begin: bool, end: bool) -> Result<Value, String> {
    let mut text = call.text(0)?;
    let letters: Vec<char> = if call.0.len() > 1 { call.text(1)?.chars().collect() } else { vec![' '] };
    if begin {
        text = text.trim_start_matches(|letter| letters.contains(&letter));
    }
    if end {
        text = text.trim_end_matches(|letter| letters.contains(&letter));
    }
    Ok(Value::Text(text.to_owned()))
}

/// Returns the part of a string from a position, which is counted from 1 and may be before the start.
fn part(call: &TextCall<'_>) -> Result<Value, String> {
    let (text, from) = (call.text(0)?, call.whole(1)?);
    let end = match call.0.len() > 2 {
        true => {
            let length = call.whole(2)?;
            if length < 0 {
                return Err("negative substring length not allowed".into());
            }
            from.saturating_add(length)
        }
        false => i64::MAX,
    };
    let begin = usize::try_from(from - 1).unwrap_or(0);
    let end = usize::try_from(end.saturating_sub(1)).unwrap_or(0);
    Ok(Value::Text(text.chars().skip(begin).take(end.saturating_sub(begin)).collect()))
}

/// Returns a character in lower case, if that is a single character.
pub(super) fn lower(letter: char) -> char {
    if letter == '\u{130}' {
        return 'i';
    }
    let mut small = letter.to_lowercase();
    match (small.next(), small.next()) {
        (Some(only), None) => only,
        _ => letter,
    }
}

/// Returns a character in upper case, if that is a single character.
fn upper(letter: char) -> char {
    let code = u32::from(letter);
    // Greek letters with iota subscript have a single title-case character.
    let titled = match code {
        0x1f80..=0x1f87 | 0x1f90..=0x1f97 | 0x1fa0..=0x1fa7 => char::from_u32(code + 8),
        0x1fb3 | 0x1fc3 | 0x1ff3 => char::from_u32(code + 9),
        _ => None,
    };
    let mut large = letter.to_uppercase();
    match (titled, large.next(), large.next()) {
        (Some(titled), ..) => titled,
        (None, Some(only), None) => only,
        _ => letter,
    }
}

/// Converts a value to a string for concatenation.
fn concat_text(value: ValueRef<'_>) -> Result<Option<String>, String> {
    Ok(match value {
        ValueRef::Null => None,
        ValueRef::Integer(number) => Some(number.to_string()),
        ValueRef::Real(number) => Some(float_text(number)),
        ValueRef::Text(text) => Some(String::from_utf8_lossy(text).into_owned()),
        ValueRef::Blob(_) => return Err("geometries are joined as ST_AsText(geometry)".into()),
    })
}

/// Registers the functions with a connection.
pub(super) fn register(connection: &Connection) -> rusqlite::Result<()> {
    let flags = FunctionFlags::SQLITE_UTF8 | FunctionFlags::SQLITE_DETERMINISTIC;
    let failed = |name: &str, why: String| {
        rusqlite::Error::UserFunctionError(format!("{}: {why}", name.trim_start_matches("burgeon_")).into())
    };
    for (name, least, most, run) in FUNCTIONS {
        for count in least..=most {
            connection.create_scalar_function(name, count, flags, move |context| {
                if (0..context.len()).any(|index| matches!(context.get_raw(index), ValueRef::Null)) {
                    return Ok(Value::Null);
                }
                run(&TextCall(context)).map_err(|why| failed(name, why))
            })?;
        }
    }
    connection.create_scalar_function("concat", -1, flags, move |context| {
        let parts = (0..context.len()).map(|index| concat_text(context.get_raw(index)));
        let parts: Result<Vec<Option<String>>, String> = parts.collect();
        Ok(Value::Text(parts.map_err(|why| failed("concat", why))?.into_iter().flatten().collect()))
    })?;
    connection.create_scalar_function("concat_ws", -1, flags, move |context| {
        let parts = (0..context.len()).map(|index| concat_text(context.get_raw(index)));
        let parts: Result<Vec<Option<String>>, String> = parts.collect();
        let mut parts = parts.map_err(|why| failed("concat_ws", why))?.into_iter();
        let Some(Some(between)) = parts.next() else { return Ok(Value::Null) };
        Ok(Value::Text(parts.flatten().collect::<Vec<_>>().join(&between)))
    })
}
