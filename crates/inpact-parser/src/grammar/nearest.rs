//! Names with a spelling close to a word, for the help of a message.
//!
//! Bounded work for any input: only the first [`Folded::LONGEST`] characters of a word are looked at.

use super::lookup::{Folded, fold};

/// The shortest length for a significant prefix match.
const TELLING: usize = 4;

/// The names similar to a word, the nearest first.
pub fn nearest<'name>(written: &[u8], names: impl IntoIterator<Item = &'name str>, at_most: usize) -> Vec<&'name str> {
    let word: Vec<u8> = fold(written).take(Folded::LONGEST).collect();
    if word.is_empty() {
        return Vec::new();
    }
    let mut folded = Vec::new();
    let near = names.into_iter().filter_map(|name| {
        folded.clear();
        folded.extend(fold(name.as_bytes()));
        Some((nearness(&word, &folded)?, name))
    });
    let mut near: Vec<(usize, &str)> = near.collect();
    near.sort_unstable();
    near.into_iter().take(at_most).map(|(_, name)| name).collect()
}

/// The edit distance of a name from a word; `None` when it is too large.
fn nearness(word: &[u8], name: &[u8]) -> Option<usize> {
    let shorter = word.len().min(name.len());
    let common = word.iter().zip(name).take_while(|(a, b)| a == b).count();
    let extends = shorter >= TELLING && common == shorter;
    let allowed = ((word.len() + 2) / 4).clamp(1, 6);
    let edits = edit_distance(word, name, allowed);
    // A name of which the word is a prefix, or vice versa, counts as one wrong letter.
    edits.or(extends.then_some(allowed))
}

/// The Damerau–Levenshtein distance (insertions, deletions, substitutions, transpositions); `None` when more than `most`.
fn edit_distance(a: &[u8], b: &[u8], most: usize) -> Option<usize> {
    if a.len().abs_diff(b.len()) > most {
        return None;
    }
    let mut before_last = vec![0; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).collect();
    let mut row = vec![0; b.len() + 1];
    for i in 1..=a.len() {
        row[0] = i;
        for j in 1..=b.len() {
            let replaced = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            row[j] = replaced.min(last[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before_last[j - 2] + 1);
            }
        }
        if row.iter().min().is_some_and(|least| *least > most) {
            return None;
        }
        std::mem::swap(&mut before_last, &mut last);
        std::mem::swap(&mut last, &mut row);
    }
    Some(last[b.len()]).filter(|distance| *distance <= most)
}

#[cfg(test)]
mod tests {
    use super::edit_distance;

    #[test]
    fn counts_edits_and_swaps() {
        assert_eq!(edit_distance(b"SOILS", b"SOILS", 2), Some(0));
        assert_eq!(edit_distance(b"SOLIS", b"SOILS", 2), Some(1));
        assert_eq!(edit_distance(b"BEHAVIOUR", b"BEHAVIOR", 2), Some(1));
        assert_eq!(edit_distance(b"GAPCONDUCTANS", b"GAPCONDUCTANCE", 3), Some(2));
        assert_eq!(edit_distance(b"STEP", b"FIELD", 2), None);
    }
}
