//! Nodes: from the rows of *NODE to points of the assembly (SYSTEM, translation and rotation of instances).

use super::layout::Entry;
use super::placement::Placement;
use super::reader::Reader;
use super::rows::{data_lines, number_rows};
use super::selected::Selection;
use super::selection::unsigned;
use crate::number::read_float;
use crate::span::Span;
use inpact_geometry::Point;
use std::io;

/// The requested nodes of one instance, and those found.
#[derive(Debug, Clone, Default)]
pub(super) struct Wanted {
    /// Ascending, each once.
    pub(super) labels: Vec<u32>,
    /// In the same order: coordinates, and the keyword line of the *NODE option; `None` where none has the number.
    pub(super) points: Vec<Option<(Point, Span)>>,
}

impl Wanted {
    pub(super) fn new(mut labels: Vec<u32>) -> Self {
        labels.sort_unstable();
        labels.dedup();
        Self { points: vec![None; labels.len()], labels }
    }
}

/// Meanings of the three numbers of a node.
#[derive(Debug, Clone, Copy)]
enum System {
    Rectangular,
    Cylindrical,
    Spherical,
}

impl System {
    fn point(self, [a, b, c]: Point) -> Point {
        match self {
            Self::Rectangular => [a, b, c],
            Self::Cylindrical => {
                let (sin, cos) = b.to_radians().sin_cos();
                [a * cos, a * sin, c]
            }
            Self::Spherical => {
                let ((sin, cos), (rise, flat)) = (b.to_radians().sin_cos(), c.to_radians().sin_cos());
                [a * flat * cos, a * flat * sin, a * rise]
            }
        }
    }
}

impl Reader<'_, '_> {
    /// Reads the rows of *INSTANCE: a translation, then an axis and an angle.
    pub(super) fn placement(&mut self, instance: Entry<'_>) -> io::Result<Placement> {
        let mut placement = Placement::NONE;
        for (number, (row, span)) in number_rows(&mut *self.rows, instance.block)?.into_iter().enumerate() {
            match (number, row.as_deref()) {
                (0, Some(row)) if row.len() <= 4 => placement.translation = [0, 1, 2].map(|k| row.get(k).copied().unwrap_or(0.0)),
                (1, Some(&[ax, ay, az, bx, by, bz, angle])) if [ax, ay, az] != [bx, by, bz] => {
                    placement.rotation = Some(([ax, ay, az], [bx, by, bz], angle));
                }
                _ => self.note(span, "expected a translation (3 numbers), then two points of an axis and an angle (7 numbers); the row was not read".to_owned()),
            }
        }
        Ok(placement)
    }

    /// Finds the requested nodes of an instance. Returns, for each selection, the numbers of its nodes.
    pub(super) fn read_nodes(
        &mut self,
        instance: usize,
        wanted: &mut Wanted,
        selections: &[&Selection],
    ) -> io::Result<Vec<Vec<u32>>> {
        let mut selected: Vec<Vec<u32>> = vec![Vec::new(); selections.len()];
        let mut extra: Vec<(u32, (Point, Span))> = Vec::new();
        if wanted.labels.is_empty() && selections.is_empty() {
            return Ok(selected);
        }
        let placement = self.instances[instance].placement;
        for option in self.entries_of(instance, |definitions| &definitions.nodes) {
            let key = option.keyword.span;
            if option.parameter("INPUT").is_some() {
                self.note(option.span(), "the nodes in a file of their own (INPUT) are not read".to_owned());
            }
            let system = match option.parameter("SYSTEM").map(str::to_ascii_uppercase).as_deref() {
                Some("C") => System::Cylindrical,
                Some("S") => System::Spherical,
                _ => System::Rectangular,
            };
            let mut wrong: Option<(Span, String)> = None;
            // Rows mostly ascend: the next requested node is mostly the next one found.
            let mut next = 0;
            data_lines(&mut *self.rows, option.block, &mut |line, span| {
                let end = memchr::memchr(b',', line).unwrap_or(line.len());
                let label = unsigned(line[..end].trim_ascii());
                let at = label.and_then(|label| place_of(&wanted.labels, label, next));
                let in_selection = |selection: &&Selection| label.is_some_and(|label| selection.contains(label, key));
                if label.is_some() && at.is_none() && !selections.iter().any(in_selection) {
                    return;
                }
                let (Some(label), Some(point)) = (label, coordinates(line, end)) else {
                    wrong.get_or_insert_with(|| (span, String::from_utf8_lossy(line).trim().to_owned()));
                    return;
                };
                let point = (placement.put(system.point(point)), key);
                match at {
                    Some(at) => {
                        wanted.points[at] = Some(point);
                        next = at + 1;
                    }
                    None => extra.push((label, point)),
                }
                for (selection, selected) in selections.iter().zip(&mut selected) {
                    if selection.contains(label, key) {
                        selected.push(label);
                    }
                }
            })?;
            if let Some((span, row)) = wrong {
                self.note(
                    span,
                    format!("expected the number of a node and its coordinates, found `{row}`; the node was not read"),
                );
            }
        }
        // Nodes of node sets were not known before.
        let known = std::mem::take(wanted);
        let mut all: Vec<(u32, Option<(Point, Span)>)> = known.labels.into_iter().zip(known.points).collect();
        all.extend(extra.into_iter().map(|(label, point)| (label, Some(point))));
        // Of duplicate definitions of a number the last one applies; the sort is stable.
        all.sort_by_key(|(label, _)| *label);
        for (label, point) in all {
            if wanted.labels.last() == Some(&label) {
                wanted.points.pop();
                wanted.labels.pop();
            }
            wanted.labels.push(label);
            wanted.points.push(point);
        }
        Ok(selected)
    }
}

/// The index of a number among the requested ones.
fn place_of(wanted: &[u32], label: u32, next: usize) -> Option<usize> {
    if wanted.get(next) == Some(&label) { Some(next) } else { wanted.binary_search(&label).ok() }
}

/// The coordinates after the number; those that are left out are 0.
fn coordinates(line: &[u8], end: usize) -> Option<Point> {
    let mut point = [0.0; 3];
    let rest = line.get(end + 1..).unwrap_or(&[]);
    for (coordinate, item) in point.iter_mut().zip(rest.split(|byte| *byte == b',')) {
        let item = item.trim_ascii();
        if !item.is_empty() {
            *coordinate = read_float(item).ok()?;
        }
    }
    Some(point)
}
