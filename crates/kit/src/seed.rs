//! Seeds from scripts.

use super::{Expectation, Parameter, Value};
use burgeon_base::ModuleKey;

/// Seed of random numbers: 64 bits, as a number or a string.
///
/// A string of 16 hexadecimal digits, as other objects return it, is used as these bits. Any other string is hashed.
///
/// ```
/// use burgeon_kit::{Parameter, Seed, Value};
///
/// let read = |value| Seed::from_value(value).ok();
/// assert_eq!(read(Value::Number(12.0)), Some(Seed(12)));
/// assert_eq!(read(Value::Text("00000000000000ff".into())), Some(Seed(255)));
/// assert_ne!(read(Value::Text("oak".into())), read(Value::Text("elm".into())));
/// assert_eq!(read(Value::Number(0.5)), None);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Seed(pub u64);

impl Parameter for Seed {
    fn luau() -> String {
        "number | string".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        match value {
            #[allow(clippy::cast_possible_truncation, reason = "the number is whole and below 2^53")]
            Value::Number(number) if number.fract() == 0.0 && number.abs() < 9_007_199_254_740_992.0 => {
                Ok(Self((number as i64).cast_unsigned()))
            }
            Value::Text(text) if text.len() == 16 && text.bytes().all(|byte| byte.is_ascii_hexdigit()) => {
                u64::from_str_radix(&text, 16).map(Self).map_err(|_| Expectation::new("a seed"))
            }
            Value::Text(text) => Ok(Self(ModuleKey::default().feature(&text).0)),
            _ => Err(Expectation::new("an integer below 2^53, or a string")),
        }
    }

    fn into_value(self) -> Value {
        Value::Text(format!("{:016x}", self.0).into())
    }

    fn written(self) -> String {
        // A number is only exact below 2^53.
        if self.0 < 1 << 53 { self.0.to_string() } else { self.into_value().to_string() }
    }
}
