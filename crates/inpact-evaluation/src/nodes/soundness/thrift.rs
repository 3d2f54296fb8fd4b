//! A walk over the compact protocol of Thrift, in which Parquet writes its footer and the headers of its pages.
//!
//! Nothing is made of what is read but numbers handed to a visitor: a list or a text that is longer than what is left is refused
//! before anybody makes room for it.

/// How deep structures may lie in one another; Parquet's own go to five.
const DEEPEST: usize = 16;

/// Events of a walk; the path are the numbers of the fields from the outermost structure inwards.
pub(super) trait Visitor {
    /// An integer, or a field that is true (1) or false (0).
    fn integer(&mut self, path: &[i16], value: i64);
    /// A structure begins: the element of a list, or a field.
    fn structure(&mut self, _path: &[i16]) {}
}

/// Bytes that are being walked over.
struct Walk<'a, V> {
    bytes: &'a [u8],
    at: usize,
    path: Vec<i16>,
    visitor: &'a mut V,
}

/// Walks over a structure; gives how many bytes it takes.
///
/// # Errors
/// `None` where the bytes end too early, or hold what the protocol does not have.
pub(super) fn walk<V: Visitor>(bytes: &[u8], visitor: &mut V) -> Option<usize> {
    let mut walk = Walk { bytes, at: 0, path: Vec::new(), visitor };
    walk.structure()?;
    Some(walk.at)
}

impl<V: Visitor> Walk<'_, V> {
    fn structure(&mut self) -> Option<()> {
        if self.path.len() > DEEPEST {
            return None;
        }
        self.visitor.structure(&self.path);
        let mut field: i16 = 0;
        loop {
            let head = self.byte()?;
            let kind = head & 0x0F;
            if kind == 0 {
                return Some(());
            }
            field = match head >> 4 {
                0 => i16::try_from(self.integer()?).ok()?,
                step => field.checked_add(i16::from(step))?,
            };
            self.path.push(field);
            match kind {
                // True and false are the type itself.
                1 | 2 => self.visitor.integer(&self.path, i64::from(kind == 1)),
                kind => self.value(kind, 0)?,
            }
            self.path.pop();
        }
    }

    fn value(&mut self, kind: u8, depth: usize) -> Option<()> {
        match kind {
            1..=3 => self.skip(1),
            4..=6 => {
                let value = self.integer()?;
                self.visitor.integer(&self.path, value);
                Some(())
            }
            7 => self.skip(8),
            8 => {
                let length = self.unsigned()?;
                self.skip(length)
            }
            9 | 10 => self.list(depth),
            11 => self.map(depth),
            12 => self.structure(),
            _ => None,
        }
    }

    fn list(&mut self, depth: usize) -> Option<()> {
        let head = self.byte()?;
        let count = match head >> 4 {
            15 => self.unsigned()?,
            count => u64::from(count),
        };
        self.elements(count, &[head & 0x0F], depth)
    }

    fn map(&mut self, depth: usize) -> Option<()> {
        let count = self.unsigned()?;
        if count == 0 {
            return Some(());
        }
        let kinds = self.byte()?;
        self.elements(count, &[kinds >> 4, kinds & 0x0F], depth)
    }

    fn elements(&mut self, count: u64, kinds: &[u8], depth: usize) -> Option<()> {
        // Every element takes a byte at least.
        if depth > DEEPEST || count > self.left() {
            return None;
        }
        for _ in 0..count {
            kinds.iter().try_for_each(|kind| self.value(*kind, depth + 1))?;
        }
        Some(())
    }

    fn byte(&mut self) -> Option<u8> {
        let byte = *self.bytes.get(self.at)?;
        self.at += 1;
        Some(byte)
    }

    fn left(&self) -> u64 {
        (self.bytes.len() - self.at) as u64
    }

    fn skip(&mut self, count: u64) -> Option<()> {
        if count > self.left() {
            return None;
        }
        self.at += usize::try_from(count).ok()?;
        Some(())
    }

    fn unsigned(&mut self) -> Option<u64> {
        let mut value = 0_u64;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            value |= u64::from(byte & 0x7F) << shift;
            if byte & 0x80 == 0 {
                return Some(value);
            }
        }
        None
    }

    /// A number in zigzag.
    fn integer(&mut self) -> Option<i64> {
        let value = self.unsigned()?;
        Some((value >> 1).cast_signed() ^ -(value & 1).cast_signed())
    }
}
