//! Encoding of values in a column of f64: a number as itself, any other value as a NaN with a payload.

/// Decoded f64 of a column: a number, or another value from the payload of a NaN.
///
/// The upper 16 bits of such a NaN are `0xFFFC`, which no arithmetic produces; the next 16 bits are the type, the lower
/// 32 the value.
///
/// ```
/// use burgeon_rewriting::ColumnValue;
///
/// assert_eq!(ColumnValue::Number(2.5).pack(), 2.5);
/// for value in [ColumnValue::Nil, ColumnValue::Boolean(true), ColumnValue::Handle(7)] {
///     assert!(value.pack().is_nan());
///     assert_eq!(ColumnValue::unpack(value.pack()), value);
/// }
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ColumnValue {
    /// A number.
    Number(f64),
    /// An omitted optional parameter.
    Nil,
    /// `true` or `false`.
    Boolean(bool),
    /// Index of the value in a table of values.
    Handle(u32),
}

const MARK: u64 = 0xFFFC_0000_0000_0000;
const NIL: u64 = MARK;
const BOOLEAN: u64 = MARK | 1 << 32;
const HANDLE: u64 = MARK | 2 << 32;
const KIND: u64 = 0xFFFF_FFFF_0000_0000;

impl ColumnValue {
    /// Returns the f64 to store.
    pub fn pack(self) -> f64 {
        match self {
            // All NaN numbers become the same NaN, because other payloads represent other values.
            Self::Number(value) if value.is_nan() => f64::NAN,
            Self::Number(value) => value,
            Self::Nil => f64::from_bits(NIL),
            Self::Boolean(value) => f64::from_bits(BOOLEAN | u64::from(value)),
            Self::Handle(handle) => f64::from_bits(HANDLE | u64::from(handle)),
        }
    }

    /// Decodes a stored f64.
    #[inline]
    pub fn unpack(stored: f64) -> Self {
        let bits = stored.to_bits();
        let low = u32::try_from(bits & 0xFFFF_FFFF).unwrap_or(0);
        match bits & KIND {
            NIL => Self::Nil,
            BOOLEAN => Self::Boolean(low != 0),
            HANDLE => Self::Handle(low),
            _ => Self::Number(stored),
        }
    }
}
