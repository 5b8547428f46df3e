//! FlatBuffers tables in a byte slice.

/// Description of the damage in bytes.
pub(super) type BufferDamage = &'static str;

const ENDS: BufferDamage = "points beyond its end";

/// Table whose fields are located through a list of offsets.
#[derive(Clone, Copy)]
pub(super) struct BufferTable<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Offsets of the fields, two bytes each.
    fields: &'a [u8],
}

/// Returns a fixed number of bytes at a position.
fn bytes_at<const N: usize>(bytes: &[u8], at: usize) -> Result<[u8; N], BufferDamage> {
    let found = bytes.get(at..).and_then(<[u8]>::first_chunk::<N>);
    found.copied().ok_or(ENDS)
}

/// Returns the target of the offset at `at`.
fn follow(bytes: &[u8], at: usize) -> Result<usize, BufferDamage> {
    let offset = u32::from_le_bytes(bytes_at(bytes, at)?) as usize;
    at.checked_add(offset).filter(|to| *to < bytes.len()).ok_or(ENDS)
}

impl<'a> BufferTable<'a> {
    /// Returns the root table of `bytes`.
    pub(super) fn root(bytes: &'a [u8]) -> Result<Self, BufferDamage> {
        Self::new(bytes, follow(bytes, 0)?)
    }

    fn new(bytes: &'a [u8], at: usize) -> Result<Self, BufferDamage> {
        let back = i32::from_le_bytes(bytes_at(bytes, at)?);
        let list = i64::try_from(at).ok().map(|at| at - i64::from(back));
        let list = list.and_then(|list| usize::try_from(list).ok()).ok_or(ENDS)?;
        let size = usize::from(u16::from_le_bytes(bytes_at(bytes, list)?));
        let fields = list.checked_add(size).and_then(|end| bytes.get(list + 4..end)).ok_or(ENDS)?;
        Ok(Self { bytes, at, fields })
    }

    /// Returns the position of a field, if it is present.
    fn field(&self, number: usize) -> Option<usize> {
        let offset = u16::from_le_bytes(bytes_at(self.fields, number * 2).ok()?);
        (offset > 0).then_some(self.at + usize::from(offset))
    }

    /// Returns a field with a fixed number of bytes, if it is present.
    pub(super) fn field_bytes<const N: usize>(&self, number: usize) -> Result<Option<[u8; N]>, BufferDamage> {
        self.field(number).map(|at| bytes_at(self.bytes, at)).transpose()
    }

    /// Returns the table in a field, if it is present.
    pub(super) fn table(&self, number: usize) -> Result<Option<Self>, BufferDamage> {
        self.field(number).map(|at| Self::new(self.bytes, follow(self.bytes, at)?)).transpose()
    }

    /// Returns the bytes of a list of items of `size` bytes; empty if it is absent.
    pub(super) fn list(&self, number: usize, size: usize) -> Result<&'a [u8], BufferDamage> {
        let Some(at) = self.field(number) else { return Ok(&[]) };
        let at = follow(self.bytes, at)?;
        let count = u32::from_le_bytes(bytes_at(self.bytes, at)?) as usize;
        let begin = at + 4;
        let end = count.checked_mul(size).and_then(|length| begin.checked_add(length));
        end.and_then(|end| self.bytes.get(begin..end)).ok_or(ENDS)
    }

    /// Returns the text in a field, if it is present.
    pub(super) fn text(&self, number: usize) -> Result<Option<String>, BufferDamage> {
        let text = self.list(number, 1)?;
        Ok(self.field(number).map(|_| String::from_utf8_lossy(text).into_owned()))
    }

    /// Returns the tables in a list.
    pub(super) fn tables(
        &self,
        number: usize,
    ) -> Result<impl Iterator<Item = Result<Self, BufferDamage>> + use<'a>, BufferDamage> {
        let (bytes, count) = (self.bytes, self.list(number, 4)?.len() / 4);
        // The items begin after the count.
        let begin = match self.field(number) {
            Some(at) => follow(bytes, at)? + 4,
            None => 0,
        };
        let places = (0..count).map(move |index| begin + index * 4);
        Ok(places.map(move |at| Self::new(bytes, follow(bytes, at)?)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_bytes_are_a_table_or_refused() {
        // A table with one field, a list of two bytes.
        let good = [12, 0, 0, 0, 6, 0, 8, 0, 4, 0, 0, 0, 8, 0, 0, 0, 4, 0, 0, 0, 2, 0, 0, 0, 7, 9];
        let read =
            |bytes: &[u8]| BufferTable::root(bytes).and_then(|table| table.list(0, 1).map(<[u8]>::to_vec));
        assert_eq!(read(&good), Ok(vec![7, 9]));
        for at in 0..good.len() {
            for byte in [0, 1, 2, 5, 127, 128, 255] {
                let mut bytes = good;
                bytes[at] = byte;
                let _ = read(&bytes);
                let _ = BufferTable::root(&bytes).and_then(|table| Ok(table.tables(0)?.count()));
            }
            assert!(read(&good[..at]).is_err());
        }
    }
}
