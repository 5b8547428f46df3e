//! Protocol Buffers decoding: numbered fields, and packed numbers.
//!
//! Source: Protocol Buffers, "Encoding".

/// Description of the damage in bytes.
pub(super) type WireDamage = &'static str;

const ENDS: WireDamage = "ends too early";

/// Content of a field.
#[derive(Clone, Copy)]
pub(super) enum WireField<'a> {
    /// Number.
    Number(u64),
    /// Text, message, or packed numbers.
    Bytes(&'a [u8]),
}

impl<'a> WireField<'a> {
    /// Returns the bytes; fails if the field is a number.
    pub(super) fn bytes(self) -> Result<&'a [u8], WireDamage> {
        match self {
            Self::Bytes(bytes) => Ok(bytes),
            Self::Number(_) => Err("has a number instead of a message"),
        }
    }

    /// Returns the number; fails if the field is something else.
    pub(super) fn number(self) -> Result<u64, WireDamage> {
        match self {
            Self::Number(number) => Ok(number),
            Self::Bytes(_) => Err("has a message instead of a number"),
        }
    }
}

/// Fields of a message, each with its number.
pub(super) struct WireFields<'a>(pub(super) &'a [u8]);

impl<'a> Iterator for WireFields<'a> {
    type Item = Result<(u64, WireField<'a>), WireDamage>;

    fn next(&mut self) -> Option<Self::Item> {
        (!self.0.is_empty()).then(|| {
            let field = self.field();
            if field.is_err() {
                self.0 = &[];
            }
            field
        })
    }
}

impl<'a> WireFields<'a> {
    fn field(&mut self) -> Result<(u64, WireField<'a>), WireDamage> {
        let key = varint(&mut self.0)?;
        let field = match key & 7 {
            0 => WireField::Number(varint(&mut self.0)?),
            1 => WireField::Bytes(self.take(8)?),
            2 => {
                let length = varint(&mut self.0)?;
                WireField::Bytes(self.take(length)?)
            }
            5 => WireField::Bytes(self.take(4)?),
            _ => return Err("has a field of unknown type"),
        };
        Ok((key >> 3, field))
    }

    fn take(&mut self, length: u64) -> Result<&'a [u8], WireDamage> {
        let length = usize::try_from(length).map_err(|_| ENDS)?;
        let (taken, rest) = self.0.split_at_checked(length).ok_or(ENDS)?;
        self.0 = rest;
        Ok(taken)
    }
}

/// Removes a number from the front of bytes.
#[inline]
fn varint(bytes: &mut &[u8]) -> Result<u64, WireDamage> {
    let mut number = 0;
    for (at, byte) in bytes.iter().enumerate().take(10) {
        number |= u64::from(byte & 0x7f) << (7 * at);
        if byte & 0x80 == 0 {
            *bytes = &bytes[at + 1..];
            return Ok(number);
        }
    }
    Err(if bytes.len() < 10 { ENDS } else { "has a number of more than ten bytes" })
}

/// Decodes a zigzag-encoded number.
#[inline]
pub(super) fn to_signed(number: u64) -> i64 {
    (number >> 1).cast_signed() ^ -(number & 1).cast_signed()
}

/// Packed numbers.
#[derive(Clone, Copy, Default)]
pub(super) struct Varints<'a>(pub(super) &'a [u8]);

impl Varints<'_> {
    /// Returns the next number, if any.
    #[inline]
    pub(super) fn next(&mut self) -> Result<Option<u64>, WireDamage> {
        if self.0.is_empty() { Ok(None) } else { varint(&mut self.0).map(Some) }
    }
}

/// Delta-encoded numbers.
#[derive(Clone, Copy, Default)]
pub(super) struct Deltas<'a> {
    numbers: Varints<'a>,
    last: i64,
}

impl<'a> Deltas<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { numbers: Varints(bytes), last: 0 }
    }

    /// Returns the next number, if any.
    #[inline]
    pub(super) fn next(&mut self) -> Result<Option<i64>, WireDamage> {
        let Some(step) = self.numbers.next()? else { return Ok(None) };
        self.last = self.last.wrapping_add(to_signed(step));
        Ok(Some(self.last))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_to_their_ends_and_never_beyond() {
        let mut bytes = &[0x96, 0x01, 0x03][..];
        assert_eq!((varint(&mut bytes), varint(&mut bytes), varint(&mut bytes)), (Ok(150), Ok(3), Err(ENDS)));
        assert_eq!(varint(&mut &[0xff; 9][..]), Err(ENDS));
        assert!(varint(&mut &[0xff; 11][..]).is_err());
        assert_eq!([0, 1, 2, 3, u64::MAX].map(to_signed), [0, -1, 1, -2, i64::MIN]);
        let mut deltas = Deltas::new(&[2, 2, 1]);
        let all: Vec<_> = std::iter::from_fn(|| deltas.next().unwrap()).collect();
        assert_eq!(all, [1, 2, 1]);
    }

    #[test]
    fn a_field_that_claims_more_than_there_is_ends_the_message() {
        for bytes in [&[0x0a, 0x05, 1, 2][..], &[0x08], &[0x0b, 0], &[0x0a, 0xff, 0xff, 0xff, 0xff, 0xff]] {
            let mut fields = WireFields(bytes);
            assert!(matches!(fields.next(), Some(Err(_))), "{bytes:?}");
            assert!(fields.next().is_none());
        }
    }
}
