//! *AMPLITUDE: the time variation of a condition, where it is tabular.

use super::reader::Reader;
use super::rows::data_lines;
use crate::deck::items;
use crate::model::Name;
use crate::number::read_float;
use crate::span::Span;
use std::io;

/// An amplitude of the deck.
#[derive(Debug, Clone, PartialEq)]
pub struct Amplitude {
    /// NAME.
    pub name: Name,
    /// The keyword line.
    pub span: Span,
    /// Its points of time (T) and value, linear between them and constant before and after; or the reason why it is not read.
    pub points: Result<Vec<[f64; 2]>, String>,
    /// TIME.
    pub time: AmplitudeTime,
    /// VALUE.
    pub value: AmplitudeValue,
}

/// The time base of an amplitude.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AmplitudeTime {
    /// Since the start of the step.
    Step,
    /// Since the start of the analysis.
    Total,
}

/// The kind of the values of an amplitude.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AmplitudeValue {
    /// Factors of the magnitude.
    Relative,
    /// The values themselves.
    Absolute,
}

impl Reader<'_, '_> {
    /// All amplitudes of the deck.
    pub(super) fn amplitudes(&mut self) -> io::Result<Vec<Amplitude>> {
        let mut read = Vec::new();
        for entry in std::mem::take(&mut self.layout.amplitudes) {
            let Some(name) = entry.named("NAME") else { continue };
            let mut numbers = Vec::new();
            let mut wrong = None;
            data_lines(&mut *self.rows, entry.block, &mut |line, _| {
                let cells = items(line).map(|item| &line[item]).filter(|cell| !cell.is_empty());
                for cell in cells {
                    match read_float(cell) {
                        Ok(number) => numbers.push(number),
                        Err(_) => {
                            let text = String::from_utf8_lossy(cell).into_owned();
                            wrong.get_or_insert(format!("expected a number, found `{text}`"));
                        }
                    }
                }
            })?;
            let definition = entry.choice("DEFINITION").filter(|definition| definition != "TABULAR");
            let elsewhere = ["INPUT", "FILE", "USER", "SHIFTX", "SHIFTY", "FIXEDINTERVAL", "SMOOTH"];
            let elsewhere = elsewhere.into_iter().find(|name| entry.parameter(name).is_some());
            let points: Vec<[f64; 2]> = numbers.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect();
            let ascends = points.windows(2).all(|pair| pair[0][0] < pair[1][0]);
            let points = match (wrong, definition, elsewhere) {
                (_, Some(definition), _) => Err(format!("its DEFINITION is {definition}, and only TABULAR is read")),
                (_, None, Some(parameter)) => Err(format!("{parameter} is not read")),
                (Some(wrong), None, None) => Err(wrong),
                (None, None, None) if points.is_empty() || 2 * points.len() != numbers.len() => {
                    Err("expected pairs of time and value".to_owned())
                }
                (None, None, None) if !ascends => Err("its times do not ascend".to_owned()),
                (None, None, None) => Ok(points),
            };
            let time = match entry.choice("TIME").as_deref() {
                Some("TOTALTIME") => AmplitudeTime::Total,
                _ => AmplitudeTime::Step,
            };
            let value = match entry.choice("VALUE").as_deref() {
                Some("ABSOLUTE") => AmplitudeValue::Absolute,
                _ => AmplitudeValue::Relative,
            };
            read.push(Amplitude { name, span: entry.span(), points, time, value });
        }
        Ok(read)
    }
}
