//! Bytes that an encoder has written and that are not in the file yet.

use std::cell::RefCell;
use std::io::{self, Write};
use std::rc::Rc;

/// Bytes on their way from an encoder, which owns a copy, to the file.
#[derive(Clone, Default)]
pub(super) struct EncodedBytes(Rc<RefCell<Vec<u8>>>);

impl EncodedBytes {
    /// Moves all bytes to `out`.
    pub(super) fn move_to(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut bytes = self.0.borrow_mut();
        out.write_all(&bytes)?;
        bytes.clear();
        Ok(())
    }
}

impl Write for EncodedBytes {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
