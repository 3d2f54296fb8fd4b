//! A visitor for the Thrift compact protocol, in which Parquet writes its footer and page headers.
//!
//! Nothing is built from the input; numbers are passed to a visitor: a list or a text longer than the remaining bytes is rejected
//! before memory is allocated for it.

/// The maximum nesting of structures; Parquet's own have five levels.
const DEEPEST: usize = 16;

/// Reasons why a walk fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stop {
    /// The bytes end too early, or are invalid in the protocol.
    Broken,
    /// Structures or lists are nested too deeply.
    TooDeep,
}

impl Stop {
    /// The reason, with `broken` for the general case.
    pub(super) fn reason(self, broken: &str) -> String {
        match self {
            Self::Broken => broken.to_owned(),
            Self::TooDeep => {
                format!(
                    "structures lie more than {DEEPEST} deep in one another, and those of Parquet do not: write it again"
                )
            }
        }
    }
}

/// Events of a walk; the path are the numbers of the fields from the outermost structure inwards.
pub(super) trait Visitor {
    /// An integer, or a field that is true (1) or false (0).
    fn integer(&mut self, path: &[i16], value: i64);
    /// A structure begins: the element of a list, or a field.
    fn structure(&mut self, _path: &[i16]) {}
}

/// The walk over bytes.
struct Walk<'a, V> {
    bytes: &'a [u8],
    at: usize,
    path: Vec<i16>,
    visitor: &'a mut V,
    is_too_deep: bool,
}

/// Walks over a structure; returns its length in bytes.
///
/// # Errors
/// See [`Stop`].
pub(super) fn walk<V: Visitor>(bytes: &[u8], visitor: &mut V) -> Result<usize, Stop> {
    let mut walk = Walk { bytes, at: 0, path: Vec::new(), visitor, is_too_deep: false };
    match walk.structure() {
        Some(()) => Ok(walk.at),
        None if walk.is_too_deep => Err(Stop::TooDeep),
        None => Err(Stop::Broken),
    }
}

impl<V: Visitor> Walk<'_, V> {
    fn structure(&mut self) -> Option<()> {
        self.go_deeper(self.path.len())?;
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
        self.go_deeper(depth)?;
        // Every element takes at least one byte.
        if count > self.left() {
            return None;
        }
        for _ in 0..count {
            kinds.iter().try_for_each(|kind| self.value(*kind, depth + 1))?;
        }
        Some(())
    }

    fn go_deeper(&mut self, depth: usize) -> Option<()> {
        self.is_too_deep |= DEEPEST < depth;
        (!self.is_too_deep).then_some(())
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

    /// A zigzag-encoded integer.
    fn integer(&mut self) -> Option<i64> {
        let value = self.unsigned()?;
        Some((value >> 1).cast_signed() ^ -(value & 1).cast_signed())
    }
}

#[cfg(test)]
mod tests {
    use super::{Stop, Visitor, walk};

    struct Nothing;

    impl Visitor for Nothing {
        fn integer(&mut self, _path: &[i16], _value: i64) {}
    }

    #[test]
    fn structures_and_lists_go_so_deep_and_no_deeper() {
        // Field 1 is a structure, whose field 1 is one; then the end of each.
        let structures = |depth: usize| [vec![0x1C; depth], vec![0; depth + 1]].concat();
        // Field 1 is a list of one list of one list …, the innermost of no integers.
        let lists = |depth: usize| [vec![0x19], vec![0x19; depth], vec![0x05, 0]].concat();
        for sound in [structures(16), lists(15)] {
            assert_eq!(walk(&sound, &mut Nothing), Ok(sound.len()));
            let cut = &sound[..sound.len() - 1];
            assert_eq!(walk(cut, &mut Nothing), Err(Stop::Broken));
        }
        for deep in [structures(17), structures(100_000), lists(17), lists(100_000)] {
            assert_eq!(walk(&deep, &mut Nothing), Err(Stop::TooDeep));
        }
        let said = "structures lie more than 16 deep in one another, and those of Parquet do not: write it again";
        assert_eq!(Stop::TooDeep.reason("it is broken"), said);
    }
}
