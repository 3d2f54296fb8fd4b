//! Elements: from the rows of *ELEMENT to the faces that surfaces select.

use super::layout::Entry;
use super::reader::Reader;
use super::rows::data_lines;
use super::selected::Selection;
use super::selection::unsigned;
use crate::span::Span;
use inpact_geometry::{ElementShape, ElementSpace, ElementType, FaceLabel, FaceShape, FreeFaces, MAX_NODES, NodeId};
use std::io;

/// The faces selected by a row of *SURFACE in one instance.
#[derive(Debug, Clone)]
pub(super) struct Pick {
    /// Its surface.
    pub(super) surface: usize,
    pub(super) instance: usize,
    pub(super) elements: Selection,
    /// The face; `None` for the free ones.
    pub(super) face: Option<FaceLabel>,
    /// The row.
    pub(super) span: Span,
}

/// A selected face, by the numbers of its nodes.
#[derive(Debug, Clone)]
pub(super) struct RawFace {
    pub(super) surface: usize,
    pub(super) instance: usize,
    pub(super) element: u32,
    pub(super) label: FaceLabel,
    pub(super) kind: ElementType,
    pub(super) shape: FaceShape,
    nodes: [u32; MAX_NODES],
    /// The *ELEMENT option.
    pub(super) option: Span,
}

impl RawFace {
    pub(super) fn nodes(&self) -> &[u32] {
        &self.nodes[..self.shape.nodes()]
    }

    /// Whether its area or its position depends on a section.
    pub(super) fn needs_section(&self) -> bool {
        self.kind.shape.is_sheet() || self.kind.space == ElementSpace::Plane
    }
}

impl Reader<'_, '_> {
    /// Finds the selected faces; free faces take a second pass over their elements.
    pub(super) fn faces(&mut self, picks: &[Pick]) -> io::Result<Vec<RawFace>> {
        let mut faces = Vec::new();
        let free = self.sweep(picks, &mut faces)?;
        if !free.is_empty() {
            self.sweep(&free, &mut faces)?;
        }
        faces.sort_by_key(|face| (face.surface, face.instance, face.element, face.label));
        faces.dedup_by_key(|face| (face.surface, face.instance, face.element, face.label));
        Ok(faces)
    }

    /// One pass over all elements: adds the faces selected by label, and returns selections of the free faces by label.
    fn sweep(&mut self, picks: &[Pick], faces: &mut Vec<RawFace>) -> io::Result<Vec<Pick>> {
        let mut named = Vec::new();
        for instance in 0..self.instances.len() {
            let here: Vec<&Pick> = picks.iter().filter(|pick| pick.instance == instance).collect();
            if here.is_empty() {
                continue;
            }
            // Free faces do not depend on the selection: one map serves all selections.
            let mut free = here.iter().any(|pick| pick.face.is_none()).then(Free::default);
            for option in self.entries_of(instance, |definitions| &definitions.elements) {
                self.rows_of(option, &here, &mut free, faces)?;
            }
            named.extend(free.into_iter().flat_map(|free| free.picks(&here)));
        }
        Ok(named)
    }

    fn rows_of(
        &mut self,
        option: Entry<'_>,
        picks: &[&Pick],
        free: &mut Option<Free>,
        faces: &mut Vec<RawFace>,
    ) -> io::Result<()> {
        let key = option.keyword.span;
        let touched = picks.iter().any(|pick| pick.elements.may_touch(key));
        if !touched && free.is_none() {
            return Ok(());
        }
        if option.parameter("INPUT").is_some() {
            self.note(option.span(), "the elements in a file of their own (INPUT) are not read".to_owned());
        }
        let name = option.parameter("TYPE").unwrap_or("");
        let Some(kind) = ElementType::named(name) else {
            return self.unknown_rows(option, name, picks);
        };
        // Most rows are not selected: one comparison rejects them.
        let mut any = Selection::default();
        picks.iter().filter(|pick| pick.elements.may_touch(key)).for_each(|pick| any.add_all(&pick.elements));
        any.labels.sort();
        let mut both_sides = false;
        let mut without_face: Vec<(Span, String)> = Vec::new();
        let mut rows = ElementRows::new(kind.shape, name);
        if let Some(free) = free {
            free.options.push(key);
        }
        let needs_all = free.is_some();
        data_lines(&mut *self.rows, option.block, &mut |line, span| {
            // For an unselected row on one line only the element number is parsed.
            if !needs_all && rows.is_between() && is_passed_over(line, kind.shape, &any, key) {
                return;
            }
            let Some((element, nodes)) = rows.take(line, span) else { return };
            let picked = any.contains(element, key);
            for pick in picks.iter().filter(|pick| picked && pick.elements.contains(element, key)) {
                let Some(label) = pick.face else {
                    both_sides |= kind.shape.is_sheet();
                    continue;
                };
                match kind.shape.face(label) {
                    None => {
                        without_face.push((pick.span, format!("element {element} of type {name} has no face {label}")));
                    }
                    Some(face) => {
                        let mut of_face = [0; MAX_NODES];
                        for (node, local) in of_face.iter_mut().zip(face.nodes) {
                            *node = nodes[usize::from(*local)];
                        }
                        let (surface, instance) = (pick.surface, pick.instance);
                        faces.push(RawFace {
                            surface,
                            instance,
                            element,
                            label,
                            kind,
                            shape: face.shape,
                            nodes: of_face,
                            option: key,
                        });
                    }
                }
            }
            if let Some(free) = free {
                free.meet(element, picked && is_wanted(picks, element, key), kind.shape, nodes);
            }
        })?;
        self.note_rows(rows, option.span());
        self.note_first(without_face, "and was left out");
        if both_sides {
            self.note(
                option.span(),
                format!(
                    "elements of type {name} are in a surface without SPOS or SNEG; both sides at once are not read"
                ),
            );
        }
        Ok(())
    }

    /// Notes the rows of an option that were not read.
    pub(super) fn note_rows(&mut self, mut rows: ElementRows<'_>, option: Span) {
        if let Some((span, message)) = rows.wrong.take() {
            self.note(span, format!("{message}; the row was not read"));
        }
        if !rows.row.is_empty() && !rows.is_whole {
            rows.incomplete.push((option, rows.too_few()));
        }
        self.note_first(rows.incomplete, "and was not read");
    }

    /// Notes where a surface selects elements of an unknown type.
    fn unknown_rows(&mut self, option: Entry<'_>, name: &str, picks: &[&Pick]) -> io::Result<()> {
        let key = option.keyword.span;
        let mut found = 0_u64;
        data_lines(&mut *self.rows, option.block, &mut |line, _| {
            let mut row = Vec::new();
            integers(line, &mut row);
            let picked =
                row.first().is_some_and(|element| picks.iter().any(|pick| pick.elements.contains(*element, key)));
            found += u64::from(picked);
        })?;
        if 0 < found {
            self.note(
                option.span(),
                format!(
                    "the faces of elements of type `{name}` are not known here; {found} rows of them were left out"
                ),
            );
        }
        Ok(())
    }
}

/// The maximum number of nodes of a known element.
const MAX_ELEMENT_NODES: usize = 20;

/// The free faces of an instance.
#[derive(Default)]
struct Free {
    faces: FreeFaces,
    /// The *ELEMENT options so far.
    options: Vec<Span>,
}

impl Free {
    /// Adds an element of the last option.
    fn meet(&mut self, element: u32, is_wanted: bool, shape: ElementShape, numbers: &[u32]) {
        let mut nodes = [NodeId(0); MAX_ELEMENT_NODES];
        for (node, number) in nodes.iter_mut().zip(numbers) {
            *node = NodeId(*number);
        }
        let nodes = &nodes[..numbers.len().min(MAX_ELEMENT_NODES)];
        if is_wanted {
            let option = self.options.len().saturating_sub(1) as u64;
            self.faces.add(option << 32 | u64::from(element), shape, nodes);
        } else {
            self.faces.cover(shape, nodes);
        }
    }

    /// The free faces of each pick, as picks by name.
    fn picks(self, picks: &[&Pick]) -> Vec<Pick> {
        let mut found: Vec<(usize, Pick)> = Vec::new();
        for (number, label) in self.faces.finish() {
            #[expect(clippy::cast_possible_truncation, reason = "the lower half is the number of the element")]
            let element = number as u32;
            let option = usize::try_from(number >> 32).ok().and_then(|option| self.options.get(option));
            let Some(option) = option else { continue };
            let wanted = picks.iter().enumerate().filter(|(_, pick)| pick.face.is_none());
            for (at, pick) in wanted.filter(|(_, pick)| pick.elements.contains(element, *option)) {
                let known = found.iter().position(|(of, other)| *of == at && other.face == Some(label));
                let place = known.unwrap_or_else(|| {
                    let Pick { surface, instance, span, .. } = **pick;
                    found.push((
                        at,
                        Pick { surface, instance, elements: Selection::default(), face: Some(label), span },
                    ));
                    found.len() - 1
                });
                found[place].1.elements.labels.add(element);
            }
        }
        let sorted = |(_, mut pick): (usize, Pick)| {
            pick.elements.labels.sort();
            pick
        };
        found.into_iter().map(sorted).collect()
    }
}

/// Whether the free faces of an element are selected.
fn is_wanted(picks: &[&Pick], element: u32, option: Span) -> bool {
    picks.iter().any(|pick| pick.face.is_none() && pick.elements.contains(element, option))
}

/// Whether a line is a whole row by itself, of an element that is in no pick.
fn is_passed_over(line: &[u8], shape: ElementShape, any: &Selection, option: Span) -> bool {
    let end = memchr::memchr(b',', line).unwrap_or(line.len());
    let element = unsigned(line[..end].trim_ascii());
    element.is_some_and(|element| !any.contains(element, option))
        && memchr::memchr_iter(b',', line).count() == shape.nodes()
        && !goes_on(line)
}

/// Whether the row of an element continues after this line: it ends in a comma, or has the 16 items that a line may have.
fn goes_on(line: &[u8]) -> bool {
    line.trim_ascii_end().ends_with(b",") || 15 <= memchr::memchr_iter(b',', line).count()
}

/// Puts the rows of elements together from the lines they are written on.
pub(super) struct ElementRows<'a> {
    shape: ElementShape,
    /// The name of the type.
    name: &'a str,
    row: Vec<u32>,
    is_whole: bool,
    /// The first line with anything other than numbers.
    wrong: Option<(Span, String)>,
    incomplete: Vec<(Span, String)>,
}

impl<'a> ElementRows<'a> {
    pub(super) fn new(shape: ElementShape, name: &'a str) -> Self {
        let row = Vec::with_capacity(1 + shape.nodes());
        Self { shape, name, row, is_whole: true, wrong: None, incomplete: Vec::new() }
    }

    /// Whether the next line begins an element.
    fn is_between(&self) -> bool {
        self.is_whole || self.row.is_empty()
    }

    /// Adds a line; returns the number of the element and its nodes, where it completes one.
    pub(super) fn take(&mut self, line: &[u8], span: Span) -> Option<(u32, &[u32])> {
        if self.is_whole {
            self.row.clear();
        }
        self.is_whole = false;
        if !integers(line, &mut self.row) {
            self.wrong.get_or_insert_with(|| {
                let found = String::from_utf8_lossy(line);
                (span, format!("expected numbers of an element and its nodes, found `{}`", found.trim()))
            });
            self.row.clear();
            return None;
        }
        if self.row.len() <= self.shape.nodes() {
            if !goes_on(line) {
                self.incomplete.push((span, self.too_few()));
                self.row.clear();
            }
            return None;
        }
        self.is_whole = true;
        Some((self.row[0], &self.row[1..=self.shape.nodes()]))
    }

    fn too_few(&self) -> String {
        let (element, found) = (self.row.first().unwrap_or(&0), self.row.len().saturating_sub(1));
        let (name, expected) = (self.name, self.shape.nodes());
        format!("element {element} of type {name} has {found} nodes where {expected} are due")
    }
}

/// Adds the numbers of a line to a row; false where something is not a number.
///
/// In one pass: this is the hot path for free faces.
fn integers(line: &[u8], row: &mut Vec<u32>) -> bool {
    let mut rest = line;
    loop {
        rest = rest.trim_ascii_start();
        let mut value: u64 = 0;
        let mut digits = 0;
        while let Some(digit) = rest.get(digits).map(|byte| byte.wrapping_sub(b'0')).filter(|digit| *digit <= 9) {
            // A number that is too large stays too large.
            value = (10 * value + u64::from(digit)).min(1 << 40);
            digits += 1;
        }
        if 0 < digits {
            let Ok(value) = u32::try_from(value) else { return false };
            row.push(value);
        }
        rest = &rest[digits..];
        match rest {
            [b',', behind @ ..] => rest = behind,
            [] => return true,
            _ => match rest.trim_ascii_start() {
                [b',', behind @ ..] => rest = behind,
                [] => return true,
                _ => return false,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::integers;

    #[test]
    fn rows_of_integers() {
        let read = |line: &[u8]| {
            let mut row = Vec::new();
            integers(line, &mut row).then_some(row)
        };
        assert_eq!(read(b"  7, 12,3 ,\t4294967295"), Some(vec![7, 12, 3, u32::MAX]));
        assert_eq!(read(b"007,,8,"), Some(vec![7, 8]));
        assert_eq!(read(b" "), Some(vec![]));
        for line in [&b"4294967296"[..], b"99999999999999999999999", b"1 2", b"1, x", b"-1", b"1.", b"1,2*", b"\xA0"] {
            assert_eq!(read(line), None, "{}", line.escape_ascii());
        }
    }
}
