//! How a value stands in a column of f64: as itself, or as a NaN that names it.

/// What a column's f64 holds: a number, or a NaN whose payload says what else.
///
/// The upper 16 bits are `0xFFFC`, which no arithmetic gives; the next 16 tell the kind, the lower 32 the value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ColumnValue {
    /// A number.
    Number(f64),
    /// An optional parameter that was left out.
    Nil,
    /// `true` or `false`.
    Boolean(bool),
    /// Place of the value in a table of values.
    Handle(u32),
}

const MARK: u64 = 0xFFFC_0000_0000_0000;
const NIL: u64 = MARK;
const BOOLEAN: u64 = MARK | 1 << 32;
const HANDLE: u64 = MARK | 2 << 32;
const KIND: u64 = 0xFFFF_FFFF_0000_0000;

impl ColumnValue {
    /// The f64 to store.
    pub fn pack(self) -> f64 {
        match self {
            // One NaN for all, since the others mean something else.
            Self::Number(value) if value.is_nan() => f64::NAN,
            Self::Number(value) => value,
            Self::Nil => f64::from_bits(NIL),
            Self::Boolean(value) => f64::from_bits(BOOLEAN | u64::from(value)),
            Self::Handle(handle) => f64::from_bits(HANDLE | u64::from(handle)),
        }
    }

    /// What a stored f64 holds.
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
