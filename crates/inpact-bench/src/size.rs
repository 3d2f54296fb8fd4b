//! Counting bytes: those written to a writer, and those that a text would take.

use std::io::{self, Write};

/// A writer that counts the bytes it passes on.
#[derive(Debug)]
pub struct Counted<W> {
    inner: W,
    bytes: u64,
}

impl<W: Write> Counted<W> {
    /// Counts the bytes written to `inner`.
    pub fn new(inner: W) -> Self {
        Self { inner, bytes: 0 }
    }

    /// The bytes passed on so far.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }
}

impl<W: Write> Write for Counted<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.inner.write(bytes)?;
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

/// The number of bytes that `write` would write.
///
/// # Errors
/// Those of `write`.
pub fn measure(write: impl FnOnce(&mut Counted<io::Sink>) -> io::Result<()>) -> io::Result<u64> {
    let mut counted = Counted::new(io::sink());
    write(&mut counted)?;
    Ok(counted.bytes())
}
