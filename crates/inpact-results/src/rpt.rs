//! Reports of Abaqus/Viewer, `.rpt`: field output and XY data, several in one file, since the Viewer appends.
//!
//! Source: Abaqus/CAE User's Guide, "Generating tabular data reports"; read from real files.
//! A field report gives the step time; a row of XY data has the time of its `X`, which the Viewer counts from the
//! beginning of the analysis unless the user chose otherwise.
//! Numbers are in columns of equal width, in fixed, scientific or engineering form (`644.116E-06`, `125.E-03`, `0.`).

mod names;
mod table;

use crate::collect::{self, PassedOver, Row};
use crate::error::{Read, ended};
use crate::format::Format;
use crate::lines::{Line, LineEnd, Lines};
use crate::number;
use crate::problem::{Problem, shown};
use crate::results::{Column, Field, Frame, Name, Region, Results, Rows};
use names::Variable;
use std::collections::HashMap;
use table::Table;

/// Reads reports of Abaqus/Viewer.
///
/// Tables at nodes and XY data are read.
/// A column of XY data belongs to a node where its name says so: `CPRESS_n12`, `CPRESS PI: PART-1-1 N: 12` or
/// `Contact pressure: CPRESS ASSEMBLY_S/ASSEMBLY_M PI: PART-1-1 Node 12`; others have one row, under their name.
///
/// # Errors
/// A row has other columns than its table, or the file may be truncated: a table has no blank line after its last
/// row, or the last line has no end.
pub fn read_rpt(bytes: &[u8]) -> Read {
    let mut reader = Reader {
        results: Results::new(Format::Rpt),
        frame: Frame::default(),
        set: None,
        fresh: true,
        passed_over: PassedOver::default(),
    };
    let outcome = reader.lines(&mut Lines::new(bytes));
    reader.results.not_read = reader.passed_over.list();
    ended(reader.results, outcome)
}

/// The maximum number of header lines above a table; more would cost their height times their width.
const MAX_HEAD_LINES: usize = 16;

struct Reader {
    results: Results,
    /// Step, increment and time from the preceding lines.
    frame: Frame,
    set: Option<Name>,
    /// Whether there was no table of `frame` yet.
    fresh: bool,
    passed_over: PassedOver,
}

impl Reader {
    fn lines(&mut self, lines: &mut Lines<'_>) -> Result<(), Problem> {
        // The lines since the last blank one, which may be the head of a table.
        let mut before: Vec<Line<'_>> = Vec::new();
        while let Some(line) = lines.next() {
            if line.end == LineEnd::File {
                return Err(Problem::new(line.place, "the last line has no end", table::CUT));
            }
            if is_rule(line.text) {
                let from = before.len().saturating_sub(MAX_HEAD_LINES);
                self.field(lines, &before[from..])?;
                before.clear();
            } else if line.is_blank() {
                let begins_table =
                    before.first().is_some_and(|line| line.cells().next().is_some_and(|(_, cell)| cell == b"X"));
                if begins_table && before.len() <= MAX_HEAD_LINES {
                    self.history(lines, &before)?;
                }
                before.clear();
            } else {
                self.context(&line);
                before.push(line);
            }
        }
        if self.results.frames.is_empty() {
            let help = "write a field report at nodes (unique nodal) or XY data; what else is there, is not read";
            return Err(Problem::new(lines.place(), "the report has no table of nodes and no XY data", help));
        }
        Ok(())
    }

    /// Updates the context of the next tables from a line.
    fn context(&mut self, line: &Line<'_>) {
        let text = String::from_utf8_lossy(line.text);
        let text = text.trim();
        if text.starts_with("****") {
            (self.frame, self.set, self.fresh) = (Frame::default(), None, true);
        } else if let Some(name) = text.strip_prefix("Step:") {
            self.frame.step_name = Some(name.trim().into());
            self.fresh = true;
        } else if let Some(frame) = text.strip_prefix("Frame:") {
            let after = |mark: &str| frame.split_once(mark).map(|(_, rest)| rest.trim());
            let increment = after("Increment").and_then(|rest| rest.split(':').next());
            self.frame.increment = increment.and_then(|number| number::integer(number.trim().as_bytes()));
            self.frame.step_time = after("Step Time =").and_then(|time| number::real(time.as_bytes()));
            self.fresh = true;
        } else if text.starts_with("Field Output reported at") {
            self.set = text.rsplit_once(": ").map(|(_, name)| name.trim().into());
        }
    }

    /// A table of a field report; `head` is the names of columns and what is under them.
    fn field(&mut self, lines: &mut Lines<'_>, head: &[Line<'_>]) -> Result<(), Problem> {
        let begins_with = |line: &Line<'_>, word: &[u8]| line.cells().next().is_some_and(|(_, cell)| cell == word);
        let Some(from) = head.iter().position(|line| begins_with(line, b"Node")) else {
            // There is also a rule below the number of a source.
            if let Some(line) = head.first().filter(|line| !begins_with(line, b"Source")) {
                self.passed_over.count(&format!("table `{}`", shown(line.text.trim_ascii())));
            }
            return Ok(());
        };
        // Below the column names is their source; long names continue on the next line.
        let head = &head[from..];
        let to = head.iter().position(|line| begins_with(line, b"Label")).unwrap_or(head.len());
        let mut table = Table::default();
        let outcome = table.rows(lines);
        let names = table.names(&head[..to]);
        let mut nodes = Vec::with_capacity(table.labels().len());
        for (value, place) in table.labels() {
            match whole(*value) {
                Some(node) => nodes.push(node),
                None => return Err(Problem::new(*place, format!("`{value}` is no label of a node"), table::DAMAGED)),
            }
        }
        if self.fresh {
            self.results.frames.push(self.frame.clone());
            self.fresh = false;
        }
        let Some(frame) = self.results.frames.last_mut() else { return Ok(()) };
        let begin = frame.fields.len();
        for (name, values) in names.into_iter().zip(table.into_columns()).skip(1) {
            let variable = names::of_field(&name);
            let region = Region { set: self.set.clone(), ..variable.region };
            let column = Column { name: variable.component, values };
            match frame.fields[begin..].last_mut() {
                Some(last) if last.name == variable.name && last.region == region => last.columns.push(column),
                _ => {
                    let rows = Rows::Nodes(nodes.clone());
                    frame.fields.push(Field { name: variable.name, region, rows, columns: vec![column] });
                }
            }
        }
        outcome
    }

    /// A table of XY data: one frame per row.
    fn history(&mut self, lines: &mut Lines<'_>, head: &[Line<'_>]) -> Result<(), Problem> {
        let mut table = Table::default();
        let outcome = table.rows(lines);
        let names = table.names(head);
        // The columns of each variable and region, as one field.
        let mut fields: Vec<(Variable, Vec<(usize, Row)>)> = Vec::new();
        let mut places: HashMap<(Name, Region), usize> = HashMap::new();
        for (at, name) in names.iter().enumerate().skip(1) {
            let (variable, node) = names::of_history(name);
            let row = node.map_or(Row::Whole, Row::Node);
            let place = match places.get(&(variable.name.clone(), variable.region.clone())) {
                Some(place) if node.is_some() => *place,
                _ => {
                    if node.is_some() {
                        places.insert((variable.name.clone(), variable.region.clone()), fields.len());
                    }
                    fields.push((variable, Vec::new()));
                    fields.len() - 1
                }
            };
            fields[place].1.push((at, row));
        }
        let columns = table.into_columns();
        for (row, time) in columns.first().into_iter().flatten().enumerate() {
            let of_row = fields.iter().map(|(variable, sources)| {
                let names = [variable.component.clone()];
                let kind = sources.first().map_or(Row::Whole, |(_, kind)| *kind);
                let mut field = collect::field(variable.name.clone(), variable.region.clone(), kind, names);
                for (at, kind) in sources {
                    collect::push(&mut field, *kind, &[columns[*at][row]]);
                }
                field
            });
            let fields = of_row.collect();
            self.results.frames.push(Frame { total_time: Some(*time), fields, ..Frame::default() });
        }
        self.fresh = true;
        outcome
    }
}

fn is_rule(text: &[u8]) -> bool {
    let text = text.trim_ascii();
    3 <= text.len() && text.iter().all(|byte| *byte == b'-')
}

/// A label that was read with the other numbers of its row.
fn whole(value: f64) -> Option<i64> {
    #[expect(clippy::cast_possible_truncation, reason = "the range is checked")]
    (value.fract() == 0.0 && value.abs() < 9.0e15).then_some(value as i64)
}
