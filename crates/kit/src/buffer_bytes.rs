//! Buffers of Luau, for methods that take many numbers at once.

use std::sync::Arc;

use super::{Expectation, Object, Value};
use burgeon_base::MemoryOwner;
use burgeon_macros::{methods, object};

/// A buffer as it was when it was given.
///
/// A method may take it; a script holds it as Luau's own buffer.
#[object("buffer", given)]
pub struct BufferBytes(pub Arc<[u8]>);

#[methods("buffer")]
impl BufferBytes {}

impl BufferBytes {
    /// The bytes of a value, if it is a buffer.
    pub fn of(value: &Value) -> Option<&[u8]> {
        let Value::Object(object) = value else { return None };
        let any: &dyn std::any::Any = &**object as &dyn Object;
        any.downcast_ref::<Self>().map(|bytes| &*bytes.0)
    }

    /// The 32-bit numbers in `bytes`, `N` in a row, as `buffer.writef32` writes them. Fails where a row is not whole or a
    /// number is not finite; `rows` says what there is one of in each.
    pub fn numbers<const N: usize>(bytes: &[u8], rows: &str) -> Result<Vec<[f32; N]>, Expectation> {
        // Callers make numbers of 64 bits of them.
        if !MemoryOwner::current().demand(3 * bytes.len()) {
            return Err(Expectation::new("a buffer that fits into the memory limit"));
        }
        let read = whole::<N>(bytes, rows)?.iter();
        let read: Vec<[f32; N]> = read.map(|row| row.map(f32::from_le_bytes)).collect();
        match read.iter().position(|row| row.iter().any(|number| !number.is_finite())) {
            None => Ok(read),
            Some(index) => Err(Expectation::new(format!("a buffer of finite numbers for each {rows}"))
                .but_was(format!("one with {} at byte {}", odd(&read[index]), index * N * 4))),
        }
    }

    /// The 32-bit whole numbers in `bytes`, `N` in a row, as `buffer.writeu32` writes them. Fails where a row is not whole.
    pub fn indices<const N: usize>(bytes: &[u8], rows: &str) -> Result<Vec<[u32; N]>, Expectation> {
        Ok(whole::<N>(bytes, rows)?.iter().map(|row| row.map(u32::from_le_bytes)).collect())
    }
}

/// The rows of `N` numbers in `bytes`, each number as its four bytes.
fn whole<'a, const N: usize>(bytes: &'a [u8], rows: &str) -> Result<&'a [[[u8; 4]; N]], Expectation> {
    let (numbers, rest) = bytes.as_chunks::<4>();
    let (found, more) = numbers.as_chunks::<N>();
    if !rest.is_empty() || !more.is_empty() {
        let (size, length) = (N * 4, bytes.len());
        let what = format!("a buffer of {size} bytes for each {rows}");
        return Err(Expectation::new(what).but_was(format!("one of {length} bytes")));
    }
    Ok(found)
}

/// What is wrong with a row.
fn odd(row: &[f32]) -> &'static str {
    if row.iter().any(|number| number.is_nan()) { "NaN" } else { "infinity" }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_buffer_is_rows_of_numbers_or_is_refused() {
        let bytes: Vec<u8> = [1.0_f32, -2.5, 3.0].iter().flat_map(|number| number.to_le_bytes()).collect();
        assert_eq!(BufferBytes::numbers::<3>(&bytes, "point").ok(), Some(vec![[1.0, -2.5, 3.0]]));
        assert_eq!(BufferBytes::indices::<1>(&[2, 1, 0, 0], "face").ok(), Some(vec![[258]]));
        assert_eq!(BufferBytes::numbers::<3>(&[], "point").ok(), Some(Vec::new()));
        let said =
            |refused: Expectation| refused.refuse("turtle:mesh", "points", &Value::Nil).message().to_owned();
        for length in [1, 4, 11, 13, 16] {
            let refused = BufferBytes::numbers::<3>(&vec![0; length], "point").expect_err("no whole rows");
            let expected = format!(
                "turtle:mesh: points must be a buffer of 12 bytes for each point, not one of {length} bytes"
            );
            assert_eq!(said(refused), expected);
        }
        let infinite = [0.0_f32, 0.0, 0.0, f32::INFINITY].map(f32::to_le_bytes).concat();
        let refused = BufferBytes::numbers::<2>(&infinite, "place").expect_err("infinity");
        let expected = "turtle:mesh: points must be a buffer of finite numbers for each place, not one with infinity at byte 8";
        assert_eq!(said(refused), expected);
    }
}
