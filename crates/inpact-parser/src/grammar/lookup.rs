//! Lookup of a written name: blanks and case removed, exact or abbreviated (S-11 to S-13).
//!
//! The same for keywords, parameters and enumerated values. Works on bytes; allocates only to list the candidates of an ambiguous name.

/// Result of looking up a written name among a set of names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Lookup<T> {
    /// The name in full.
    Exact(T),
    /// A unique prefix of one name.
    Abbreviated(T),
    /// A prefix of several names, in their order.
    Ambiguous(Vec<T>),
    /// A prefix of no name.
    Unknown,
}

impl<T> Lookup<T> {
    /// The thing found, when it is one.
    pub fn found(self) -> Option<T> {
        match self {
            Self::Exact(found) | Self::Abbreviated(found) => Some(found),
            Self::Ambiguous(_) | Self::Unknown => None,
        }
    }
}

/// Looks up a written name among `names`; returns its index in the list (S-13).
///
/// For parameters and enumerated values only; numbers and file names cannot be abbreviated.
pub fn lookup_name<'name>(written: &[u8], names: impl IntoIterator<Item = &'name str>) -> Lookup<usize> {
    let indexed = names.into_iter().enumerate();
    lookup_among(written, indexed)
}

/// Looks up a written name among named items.
pub(super) fn lookup_among<'name, T>(written: &[u8], named: impl IntoIterator<Item = (T, &'name str)>) -> Lookup<T> {
    match Folded::new(written) {
        Some(folded) => decide(folded.as_bytes(), named),
        None => Lookup::Unknown,
    }
}

/// Selects the exact name, else the only one with this prefix.
pub(super) fn decide<'name, T>(folded: &[u8], named: impl IntoIterator<Item = (T, &'name str)>) -> Lookup<T> {
    let mut only = None;
    let mut others = Vec::new();
    for (thing, name) in named {
        match begins_with(name, folded) {
            Match::Exact => return Lookup::Exact(thing),
            Match::Prefix if only.is_none() => only = Some(thing),
            Match::Prefix => others.push(thing),
            Match::No => {}
        }
    }
    match only {
        None => Lookup::Unknown,
        Some(only) if others.is_empty() => Lookup::Abbreviated(only),
        Some(first) => {
            others.insert(0, first);
            Lookup::Ambiguous(others)
        }
    }
}

enum Match {
    Exact,
    Prefix,
    No,
}

/// Whether a name, ignoring blanks, begins with the folded text. Names are upper case.
fn begins_with(name: &str, folded: &[u8]) -> Match {
    let mut letters = name.bytes().filter(|byte| *byte != b' ');
    if !folded.iter().all(|byte| letters.next() == Some(*byte)) {
        return Match::No;
    }
    if letters.next().is_none() { Match::Exact } else { Match::Prefix }
}

/// Whether a written name is that name in full.
pub(super) fn is_name(written: &[u8], name: &str) -> bool {
    fold(written).eq(fold(name.as_bytes()))
}

/// Whether a written name is that name in full, with or without letters after it.
pub(super) fn begins_with_name(written: &[u8], name: &str) -> bool {
    let mut letters = fold(written);
    fold(name.as_bytes()).all(|letter| letters.next() == Some(letter))
}

/// A written word without blanks and tabs, in upper case (S-07, S-11, S-12).
#[derive(Debug, Clone, Copy)]
pub(super) struct Folded {
    bytes: [u8; Self::LONGEST],
    length: usize,
}

impl Folded {
    /// More than any name has, which a test verifies.
    pub(super) const LONGEST: usize = 64;

    /// `None` when it is blank, or longer than any name.
    pub(super) fn new(written: &[u8]) -> Option<Self> {
        let mut folded = Self { bytes: [0; Self::LONGEST], length: 0 };
        for byte in fold(written) {
            *folded.bytes.get_mut(folded.length)? = byte;
            folded.length += 1;
        }
        (folded.length > 0).then_some(folded)
    }

    pub(super) fn as_bytes(&self) -> &[u8] {
        &self.bytes[..self.length]
    }
}

/// The significant bytes, in upper case. Line ends are not: a keyword line may continue after one (S-19).
pub(super) fn fold(written: &[u8]) -> impl Iterator<Item = u8> {
    written.iter().filter(|byte| !byte.is_ascii_whitespace()).map(u8::to_ascii_uppercase)
}
