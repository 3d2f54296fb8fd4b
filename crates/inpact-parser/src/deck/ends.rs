//! Well-ordered tables, of which the checks need only the first and last row of each group.
//!
//! A deck that is only checked may be a hundred megabytes of tables in which nothing is wrong.
//! Where the rows of a block are plain numbers in the required ascending order, with the same abscissae in every group and values that
//! are monotone, whatever holds at the first and the last row of each group holds between them.
//! Those rows are read once, while their text is in memory; the text and numbers of the rows between are then dropped.
//! Any table for which that is not certain is kept whole.

use super::KeywordLine;
use super::lines::next_line;
use super::plain_row::{MAX_CELLS, plain_row};
use crate::grammar::{Definition, RowShape};
use crate::span::{SourceId, Span};
use std::ops::Range;

/// Tables of fewer rows are kept whole.
const LEAST_ROWS: usize = 16;

/// The rows at both ends of a table whose lines are kept: the first and the last, and those that an excerpt shows beside them.
const ROWS_KEPT: usize = 3;

/// The initial capacity for abscissae of a group.
const MANY_ROWS: usize = 128;

/// The first and the last row of each group of a table, and the range of its other rows.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RowEnds {
    /// The rows of their block.
    pub(super) block: Span,
    /// The number of cells of a row.
    pub(crate) width: usize,
    /// Their numbers, row by row.
    pub(crate) values: Box<[f64]>,
    /// Their places, without blanks around them.
    pub(crate) places: Box<[Span]>,
}

/// The rows of a block, split into kept and dropped ones.
#[derive(Debug, PartialEq)]
pub(super) struct Thinned {
    /// The bytes of the dropped rows, which must not be used.
    pub(super) lost: Range<usize>,
    /// Those whose text is dropped; the rest of the dropped rows is kept for excerpts of neighbouring lines.
    pub(super) dropped: Range<usize>,
    pub(super) ends: RowEnds,
}

/// The trend of the values along the first abscissa that triggers no rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Trend {
    /// Non-increasing: a conductance against clearance.
    Falling,
    /// Non-decreasing: a conductance against pressure.
    Rising,
    /// Any.
    Any,
}

impl Trend {
    fn allows(self, before: f64, value: f64) -> bool {
        match self {
            Self::Falling => value <= before,
            Self::Rising => before <= value,
            Self::Any => true,
        }
    }
}

/// The required trend of the table of an option; `None` for other rows.
pub(super) fn trend_of(definition: &Definition, keyword: &KeywordLine) -> Option<Trend> {
    if definition.rows() != RowShape::Table {
        return None;
    }
    let mut columns = definition
        .data
        .columns_for(|name| keyword.given(name, definition).is_some())
        .map(|column| column.name.as_str());
    match (columns.next()?, columns.next()?) {
        ("conductance", "clearance") => Some(Trend::Falling),
        ("conductance", "pressure") => Some(Trend::Rising),
        _ => Some(Trend::Any),
    }
}

/// Splits the rows of a block, which begin at `start` of a file, if they are a well-ordered table.
pub(super) fn thin(text: &[u8], start: u64, source: SourceId, trend: Trend) -> Option<Thinned> {
    let mut table = Groups::new(trend);
    // The lines of the first rows, and of the last.
    let mut first = [0; ROWS_KEPT];
    let mut last = [0; ROWS_KEPT];
    let mut cells = [0.0; MAX_CELLS];
    let (mut at, mut count) = (0, 0);
    while at < text.len() {
        if text[at..].starts_with(b"**") {
            at = next_line(text, at);
            continue;
        }
        let row = plain_row(text, at, &mut cells)?;
        if let Some(first) = first.get_mut(count) {
            *first = if count + 1 == ROWS_KEPT { row.next } else { row.content.end };
        }
        last.rotate_left(1);
        last[ROWS_KEPT - 1] = at;
        table.push(&cells[..row.width], row.content)?;
        count += 1;
        at = row.next;
    }
    let Groups { width, values, places, .. } = table.finish()?;
    let is_worth_it = LEAST_ROWS <= count && 2 * places.len() <= count;
    let span = |range: Range<usize>| Span::new(source, start + range.start as u64, start + range.end as u64);
    is_worth_it.then(|| Thinned {
        lost: first[0]..last[ROWS_KEPT - 1],
        dropped: first[ROWS_KEPT - 1]..last[0],
        ends: RowEnds {
            block: span(0..text.len()),
            width,
            values: values.into(),
            places: places.into_iter().map(span).collect(),
        },
    })
}

/// The groups of a table, row by row.
struct Groups {
    trend: Trend,
    width: usize,
    /// The row before.
    before: [f64; MAX_CELLS],
    place_before: Range<usize>,
    /// The abscissae of the first group, which all others must have as well.
    abscissae: Vec<f64>,
    is_first_group: bool,
    /// The rows of this group so far.
    rows: usize,
    /// The ends of the groups.
    values: Vec<f64>,
    places: Vec<Range<usize>>,
}

impl Groups {
    fn new(trend: Trend) -> Self {
        Self {
            trend,
            width: 0,
            before: [0.0; MAX_CELLS],
            place_before: 0..0,
            abscissae: Vec::with_capacity(MANY_ROWS),
            is_first_group: true,
            rows: 0,
            values: Vec::new(),
            places: Vec::new(),
        }
    }

    /// Adds the next row; `None` if the table is not in order.
    fn push(&mut self, row: &[f64], place: Range<usize>) -> Option<()> {
        let [value, abscissa, outer @ ..] = row else { return None };
        if self.rows == 0 {
            self.width = row.len();
            self.begin_group(row, place.clone())?;
        } else if row.len() != self.width {
            return None;
        } else if outer == &self.before[2..self.width] {
            let is_next = if self.is_first_group {
                self.abscissae.push(*abscissa);
                self.before[1] < *abscissa
            } else {
                self.abscissae.get(self.rows) == Some(abscissa)
            };
            if !is_next || !self.trend.allows(self.before[0], *value) {
                return None;
            }
        } else {
            // The slowest variable that differs must increase (T-09).
            let differing = (2..self.width).rev().find(|column| row[*column] != self.before[*column])?;
            if row[differing] < self.before[differing] {
                return None;
            }
            self.end_group()?;
            self.begin_group(row, place.clone())?;
        }
        if *value < 0.0 {
            return None;
        }
        self.rows += 1;
        self.before[..self.width].copy_from_slice(row);
        self.place_before = place;
        Some(())
    }

    /// Begins a group with a row, which must be at contact.
    fn begin_group(&mut self, row: &[f64], place: Range<usize>) -> Option<()> {
        if self.is_first_group {
            self.abscissae.push(row[1]);
        }
        self.values.extend_from_slice(row);
        self.places.push(place);
        (row[1] == 0.0).then_some(())
    }

    /// Ends a group, which must have two rows or more, with the previous row.
    fn end_group(&mut self) -> Option<()> {
        let is_whole = 2 <= self.rows && self.rows == self.abscissae.len();
        self.values.extend_from_slice(&self.before[..self.width]);
        self.places.push(self.place_before.clone());
        (self.is_first_group, self.rows) = (false, 0);
        is_whole.then_some(())
    }

    fn finish(mut self) -> Option<Self> {
        self.end_group()?;
        Some(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deck::{Keep, ScanOptions, Scanner, Source};
    use crate::grammar::Grammar;

    fn thinned(text: &str, trend: Trend) -> Option<Thinned> {
        thin(text.as_bytes(), 1000, SourceId(2), trend)
    }

    /// A table of that many groups of ten rows, of which each line is changed.
    fn table(groups: usize, change: impl Fn(usize, String) -> String) -> String {
        let line = |index: usize| {
            let (group, point) = (index / 10, index % 10);
            change(index, format!(" {}.5, {point}e-3,\t{}.\n", 20 - point, 300 + 100 * group))
        };
        (0..10 * groups).map(line).collect()
    }

    #[test]
    fn the_ends_of_groups_stay() {
        let text = table(3, |index, line| if index == 12 { format!("** why\r\n{line}") } else { line });
        let found = thinned(&text, Trend::Falling).expect("in order");
        assert_eq!(found.ends.width, 3);
        let rows: Vec<&[f64]> = found.ends.values.chunks(3).collect();
        let expected = [
            [20.5, 0.0, 300.0],
            [11.5, 9e-3, 300.0],
            [20.5, 0.0, 400.0],
            [11.5, 9e-3, 400.0],
            [20.5, 0.0, 500.0],
            [11.5, 9e-3, 500.0],
        ];
        assert_eq!(rows, expected);
        let offset = |place: u64| usize::try_from(place - 1000).expect("in the text");
        let at = |place: &Span| &text[offset(place.start())..offset(place.end())];
        let places: Vec<&str> = found.ends.places.iter().map(at).collect();
        assert_eq!(places[..2], ["20.5, 0e-3,\t300.", "11.5, 9e-3,\t300."]);
        assert!(text[..found.dropped.start].ends_with("18.5, 2e-3,\t300.\n"));
        assert!(text[found.dropped.end..].starts_with(" 13.5, 7e-3,\t500.\n"));
        assert_eq!(&text[found.lost.end..], " 11.5, 9e-3,\t500.\n");
        assert!(text[..found.lost.start].ends_with("20.5, 0e-3,\t300."));
        assert_eq!(
            thinned(&text.replace("\r\n", "\n").replace('\n', "\r\n"), Trend::Falling).map(|found| found.ends.values),
            Some(found.ends.values)
        );
    }

    #[test]
    fn whatever_a_rule_may_find_is_kept_whole() {
        let in_line = |line: usize, from: &'static str, to: &'static str| {
            table(3, move |index, text| if index == line { text.replace(from, to) } else { text })
        };
        assert!(thinned(&in_line(0, "x", "y"), Trend::Falling).is_some());
        assert_eq!(thinned(&in_line(0, "x", "y"), Trend::Rising), None);
        assert!(thinned(&in_line(0, "x", "y"), Trend::Any).is_some());
        for (line, from, to) in [
            // Falls (T001, T003), repeats (T002), has its own abscissae (T015), begins elsewhere (T004, T005).
            (4, "4e-3", "2e-3"),
            (12, "400.", "200."),
            (4, "4e-3", "3e-3"),
            (14, "4e-3", "4.1e-3"),
            (0, "0e-3", "1e-4"),
            (10, "0e-3", "1e-4"),
            // A group of one row, or of fewer than the first (T012, T015).
            (20, "500.", "450."),
            (29, "500.", "600."),
            // Negative (P001), rises (P005).
            (29, "11.5", "-1"),
            (7, "13.5", "15."),
            // Not plain rows: other items, surplus ones, a comma at the end, long numbers, blank lines, other line ends.
            (5, "15.5", "<a>"),
            (5, "15.5", "nan"),
            (5, "15.5", ""),
            (5, "15.5", "\"15.5\""),
            (5, "300.", "300., 1."),
            (5, ",\t300.", ""),
            (5, "300.", "300.,"),
            (5, "15.5", "15.500000000000000000"),
            (5, "\n", "\n\n"),
            (5, "\n", "\r"),
            (5, "\n", " *\n"),
            (5, " 15.5", " ** 15.5"),
            (5, "15.5", "1.55-3"),
        ] {
            assert_eq!(thinned(&in_line(line, from, to), Trend::Falling), None, "{from} as {to}");
        }
        // Few rows, and groups of few.
        assert_eq!(thinned(&table(1, |_, line| line), Trend::Falling), None);
        let pairs: String = (0..20).map(|row| format!("1., {}., {}.\n", row % 2, row / 2)).collect();
        assert_eq!(thinned(&pairs, Trend::Falling), None);
        assert_eq!(thinned("", Trend::Any), None);
        // An exponent after a D is read as well, and the last line may have no end.
        assert!(thinned(in_line(5, "15.5", "1.55D1").trim_end(), Trend::Falling).is_some());
    }

    #[test]
    fn a_deck_of_tables_in_order_keeps_a_seventh_of_its_bytes() {
        let rows: String = (0..100).map(|row| format!("{}., {row}e-3\n", 99 - row)).collect();
        let interaction = |number| format!("*SURFACE INTERACTION, NAME=A{number}\n*GAP ELECTRICAL CONDUCTANCE\n{rows}");
        let text: String = (0..100).map(interaction).collect();
        let kept = |keep| {
            let mut scanner = Scanner::new("deck.inp", ScanOptions { grammar: Grammar::builtin(), keep });
            text.as_bytes().chunks(4096).for_each(|piece| scanner.push(piece));
            let deck = scanner.finish();
            let blocks = deck.blocks().iter().filter_map(|block| deck.ends_of(block));
            let cells: usize = blocks.map(|ends| ends.values.len()).sum();
            let bytes: usize = deck.sources().iter().map(Source::kept_bytes).sum();
            (bytes, cells)
        };
        assert_eq!(kept(Keep::Interpreted), (text.len(), 0));
        let (bytes, cells) = kept(Keep::Ends);
        assert_eq!(cells, 100 * 2 * 2);
        assert!(bytes < text.len() / 7, "{bytes} of {}", text.len());
    }
}
