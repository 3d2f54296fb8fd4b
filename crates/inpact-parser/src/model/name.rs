//! Names of interactions, surfaces and sets, and when two of them are the same (S-40, S-41).

use crate::grammar::Dialect;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

/// A label as the deck writes it, compared the way Abaqus compares labels.
///
/// Unquoted, case and blanks carry no meaning: `SteelGap`, `STEEL GAP` and `steelgap` are one name.
/// Quoted, both are kept: `"Steel Gap"` differs from each of them, while `"STEELGAP"` is the same as they.
///
/// Short names are stored inline, and copies of long ones are shared: a deck may consist of names only.
#[derive(Debug, Clone)]
pub struct Name {
    forms: Forms,
}

/// The canonical form, then the written one where that differs.
#[derive(Debug, Clone)]
enum Forms {
    Short { canonical: u8, written: u8, bytes: [u8; SHORT] },
    Long { both: Arc<str>, canonical: u32 },
}

/// The maximum total length of both forms of a name stored inline.
const SHORT: usize = 21;

impl Name {
    /// The name that `text` writes; quotes around it make it a quoted one.
    ///
    /// In a dotted name (S-44) each quoted component keeps its blanks and its case.
    pub fn new(text: &str) -> Self {
        let text = text.trim();
        let mut canonical = String::with_capacity(text.len());
        let mut quoted = false;
        for character in text.chars() {
            match character {
                '"' => quoted = !quoted,
                _ if quoted => canonical.push(character),
                ' ' | '\t' => {}
                _ => canonical.push(character.to_ascii_uppercase()),
            }
        }
        Self::of(text, &canonical)
    }

    fn of(written: &str, canonical: &str) -> Self {
        let written = Some(written).filter(|written| *written != canonical);
        Self { forms: Forms::short(written, canonical).unwrap_or_else(|| Forms::long(written, canonical)) }
    }

    /// The name that `text` writes in a deck of a dialect: for CalculiX quotes are ordinary characters, and case and blanks are always ignored (CX-02).
    pub fn in_dialect(text: &str, dialect: Dialect) -> Self {
        match dialect {
            Dialect::Abaqus => Self::new(text),
            Dialect::Calculix => {
                let kept = text.chars().filter(|character| !matches!(character, ' ' | '\t'));
                let canonical: String = kept.map(|character| character.to_ascii_uppercase()).collect();
                Self::of(text.trim(), &canonical)
            }
        }
    }

    /// The name as written, including quotes.
    pub fn written(&self) -> &str {
        self.forms.written()
    }

    /// The form that is compared: upper case without blanks, or the text between the quotes.
    pub fn canonical(&self) -> &str {
        self.forms.canonical()
    }

    /// Whether any part of it is quoted.
    pub fn is_quoted(&self) -> bool {
        self.written().contains('"')
    }

    /// Whether two names differ, but only by case or blanks that a quote protects on one side (S-41).
    pub fn differs_by_quotes_only(&self, other: &Self) -> bool {
        let folded = |name: &Self| {
            let kept =
                name.canonical().chars().filter(|character| !character.is_ascii_whitespace() && *character != '"');
            kept.map(|character| character.to_ascii_uppercase()).collect::<String>()
        };
        self != other && self.is_quoted() != other.is_quoted() && folded(self) == folded(other)
    }
}

impl Forms {
    fn short(written: Option<&str>, canonical: &str) -> Option<Self> {
        let written = written.unwrap_or("");
        let mut bytes = [0; SHORT];
        let (first, rest) = bytes.split_at_mut_checked(canonical.len())?;
        first.copy_from_slice(canonical.as_bytes());
        rest.get_mut(..written.len())?.copy_from_slice(written.as_bytes());
        let length = |text: &str| u8::try_from(text.len()).ok();
        Some(Self::Short { canonical: length(canonical)?, written: length(written)?, bytes })
    }

    fn long(written: Option<&str>, canonical: &str) -> Self {
        let both = written.map_or_else(|| canonical.into(), |written| format!("{canonical}{written}").into());
        // The length of any line of a deck fits.
        Self::Long { both, canonical: u32::try_from(canonical.len()).unwrap_or(u32::MAX) }
    }

    /// Both forms; the written one is empty where it equals the canonical one.
    fn both(&self) -> (&str, &str) {
        match self {
            Self::Short { canonical, written, bytes } => {
                let (canonical, rest) = bytes.split_at(usize::from(*canonical));
                (text(canonical), text(&rest[..usize::from(*written)]))
            }
            Self::Long { both, canonical } => both.split_at_checked(*canonical as usize).unwrap_or((both, "")),
        }
    }

    fn canonical(&self) -> &str {
        self.both().0
    }

    fn written(&self) -> &str {
        match self.both() {
            (canonical, "") => canonical,
            (_, written) => written,
        }
    }
}

/// The text of bytes that came from a text.
fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap_or_default()
}

impl PartialEq for Name {
    fn eq(&self, other: &Self) -> bool {
        self.canonical() == other.canonical()
    }
}

impl Eq for Name {}

impl Hash for Name {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.canonical().hash(state);
    }
}

impl fmt::Display for Name {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.written())
    }
}

#[cfg(test)]
mod tests {
    use super::{Dialect, Name};

    #[test]
    fn a_05_equal_names() {
        let same = ["SteelGap", "STEEL GAP", "steelgap", " steel gap ", "\"STEELGAP\""].map(Name::new);
        assert!(same.iter().all(|name| *name == same[0]));
        let quoted = Name::new("\"Steel Gap\"");
        assert!(same.iter().all(|name| *name != quoted));
        assert!(quoted.differs_by_quotes_only(&same[0]));
        assert!(!same[1].differs_by_quotes_only(&same[0]));
        assert_eq!(quoted.canonical(), "Steel Gap");
        assert_eq!(quoted.to_string(), "\"Steel Gap\"");
    }

    /// Measured with ccx 2.20: a pair finds `"s i"` under `"S I"` and not under `SI`.
    #[test]
    fn cx_02_names_of_calculix() {
        let name = |text| Name::in_dialect(text, Dialect::Calculix);
        assert_eq!(name("\"s i\""), name("\"S I\""));
        assert_eq!(name("s\tI"), name("SI"));
        assert_ne!(name("\"SI\""), name("SI"));
        assert!(name("\"SI\"").differs_by_quotes_only(&name("SI")));
    }

    #[test]
    fn names_of_any_length_come_back() {
        assert_eq!((size_of::<Name>(), size_of::<Option<Name>>()), (24, 24));
        for length in 0..30 {
            let upper = "A".repeat(length);
            let lower = format!("{}é", "b".repeat(length));
            let quoted = format!("\"{} c\"", "d".repeat(length));
            for (written, canonical) in [
                (&upper, upper.clone()),
                (&lower, format!("{}é", "B".repeat(length))),
                (&quoted, quoted.replace('"', "")),
            ] {
                let name = Name::new(written);
                assert_eq!((name.written(), name.canonical()), (&written[..], &canonical[..]));
                assert_eq!(name, name.clone());
            }
        }
        assert_eq!((Name::new("\"\"").written(), Name::new("\"\"").canonical()), ("\"\"", ""));
    }

    #[test]
    fn dotted_names_keep_quoted_components() {
        assert_eq!(Name::new("Hinge. Flange-1.\"Set 1\"").canonical(), "HINGE.FLANGE-1.Set 1");
    }
}
