//! Luau buffers, for methods that take many numbers at once.

use std::sync::Arc;

use super::{Expectation, Object, Value};
use burgeon_base::MemoryOwner;
use burgeon_macros::{methods, object};

/// A copy of a buffer's bytes, made when the buffer was passed.
///
/// Methods can take it as an argument; in scripts it is a Luau buffer.
#[object("buffer", given)]
pub struct BufferBytes(pub Arc<[u8]>);

#[methods("buffer")]
impl BufferBytes {}

impl BufferBytes {
    /// Returns the bytes of a value, if it is a buffer.
    pub fn of(value: &Value) -> Option<&[u8]> {
        let Value::Object(object) = value else { return None };
        let any: &dyn std::any::Any = &**object as &dyn Object;
        any.downcast_ref::<Self>().map(|bytes| &*bytes.0)
    }

    /// Reads rows of `N` 32-bit floating-point numbers, as `buffer.writef32` writes them. Fails if the last row is
    /// incomplete or a number is not finite. `rows` names the content of one row for the message, such as "point".
    pub fn numbers<const N: usize>(bytes: &[u8], rows: &str) -> Result<Vec<[f32; N]>, Expectation> {
        // The result takes as much memory as the bytes; callers convert it to 64-bit numbers, which take twice as much.
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

    /// Reads rows of `N` 32-bit unsigned integers, as `buffer.writeu32` writes them. Fails if the last row is
    /// incomplete.
    pub fn indices<const N: usize>(bytes: &[u8], rows: &str) -> Result<Vec<[u32; N]>, Expectation> {
        Ok(whole::<N>(bytes, rows)?.iter().map(|row| row.map(u32::from_le_bytes)).collect())
    }
}

/// Splits `bytes` into rows of `N` numbers of four bytes each. Fails if bytes remain.
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

/// Returns the fault of a row that has a number that is not finite.
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
