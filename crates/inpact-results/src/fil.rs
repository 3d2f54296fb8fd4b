//! Results files of Abaqus in ASCII, `.fil` (`*FILE FORMAT, ASCII` with `*NODE FILE` and `*CONTACT FILE`).
//!
//! Source: Abaqus Output Reference, "Results file output format".
//! The solver renumbers nodes where a model has parts and instances; record 1901 gives their coordinates.

mod quantities;
mod records;

use crate::collect::{self, PassedOver, Row};
use crate::error::Read;
use crate::format::Format;
use crate::lines::LineStream;
use crate::problem::{Place, Problem};
use crate::results::{Field, Frame, Name, Region, Results, Surface, SurfaceFace};
use crate::taker::{TakeFrame, Taker, read_whole};
use quantities::{Kind, Quantity, quantity};
use records::{CUT, Record, Records, Word};
use std::collections::HashMap;

/// Reads an ASCII results file of Abaqus.
///
/// Nodal records, contact records 1511 to 1578 and surfaces are read; all other records are counted by key.
/// Components of vectors are named by the active degrees of freedom (record 1902).
///
/// # Errors
/// The stream of words is truncated or malformed; the part before is returned with the error.
/// An increment without its end, record 2001, counts as truncated, and so does a file without increments.
pub fn read_fil(bytes: &[u8]) -> Read {
    read_whole(bytes, frames)
}

/// The same state by state.
pub(crate) fn frames(lines: &mut LineStream<'_>, take: &mut TakeFrame<'_>) -> (Results, Result<(), Problem>) {
    let mut reader = Reader::new(take);
    let outcome = reader.records(&mut Records::new(lines));
    reader.end_increment();
    reader.results.not_read = reader.passed_over.list();
    (reader.results, outcome)
}

/// A field under construction: its subject and number of components.
type FieldKey = (i64, usize, usize);

struct Reader<'a, 'b> {
    results: Results,
    taker: Taker<'a, 'b>,
    /// The number of increments so far.
    frames: usize,
    frame: Option<Frame>,
    /// The fields of the frame, by record key, region and number of components.
    fields: HashMap<FieldKey, usize>,
    /// The regions so far, and their numbers.
    regions: Vec<Region>,
    region_numbers: HashMap<Region, usize>,
    set: usize,
    pair: usize,
    node: Option<i64>,
    freedoms: Vec<usize>,
    /// Names longer than a word, by their numbers.
    labels: HashMap<i64, Name>,
    passed_over: PassedOver,
    /// The values of the record that is being read.
    values: Vec<f64>,
}

impl<'a, 'b> Reader<'a, 'b> {
    fn new(take: &'a mut TakeFrame<'b>) -> Self {
        Self {
            results: Results::new(Format::Fil),
            taker: Taker::new(take),
            frames: 0,
            frame: None,
            fields: HashMap::new(),
            regions: vec![Region::default()],
            region_numbers: HashMap::from([(Region::default(), 0)]),
            set: 0,
            pair: 0,
            node: None,
            freedoms: Vec::new(),
            labels: HashMap::new(),
            passed_over: PassedOver::default(),
            values: Vec::new(),
        }
    }

    fn records(&mut self, records: &mut Records<'_, '_>) -> Result<(), Problem> {
        while let Some(record) = records.next()? {
            self.record(&record)?;
            if self.taker.is_over {
                return Ok(());
            }
        }
        match &self.frame {
            Some(frame) => {
                let increment = frame.increment.unwrap_or_default();
                let step = frame.step.unwrap_or_default();
                let message = format!("increment {increment} of step {step} has no end, record 2001");
                Err(Problem::new(records.place(), message, CUT))
            }
            None if self.frames == 0 => {
                let help = "ask for `*CONTACT FILE` or `*NODE FILE` in a step, or let the job run on";
                Err(Problem::new(records.place(), "the file has no increment", help))
            }
            None => Ok(()),
        }
    }

    fn record(&mut self, record: &Record<'_>) -> Result<(), Problem> {
        if let Some(quantity) = quantity(record.key) {
            return self.values(record, quantity);
        }
        match record.key {
            1501 => {
                let name = text(record, 0)?;
                self.results.surfaces.push(Surface { name, faces: Vec::new() });
            }
            1502 => {
                let nodes = record.attributes.iter().skip(3).filter_map(|word| word.integer()).collect();
                let face = SurfaceFace { element: integer(record, 0)?, face: integer(record, 1)?, nodes };
                match self.results.surfaces.last_mut() {
                    Some(surface) => surface.faces.push(face),
                    None => return Err(misplaced(record, "the header of a surface, record 1501")),
                }
            }
            1503 => {
                let (slave, master) = (text(record, 1)?, text(record, 2)?);
                let set = record.attributes.get(3).and_then(|word| word.text()).map(|name| trimmed(&name));
                let region = Region { slave: named(slave), master: named(master), set: set.and_then(named) };
                self.pair = self.number(region);
                self.node = None;
            }
            1504 => self.node = Some(integer(record, 0)?),
            1901 => self.coordinates(record)?,
            1902 => {
                let mut placed: Vec<(i64, usize)> = (1..)
                    .zip(record.attributes)
                    .filter_map(|(freedom, word)| word.integer().map(|location| (location, freedom)))
                    .filter(|(location, freedom)| 0 < *location && *freedom <= 7)
                    .collect();
                placed.sort_unstable();
                self.freedoms = placed.into_iter().map(|(_, freedom)| freedom).collect();
            }
            1911 => {
                let region = match record.attributes.get(1).and_then(|word| word.text()) {
                    Some(name) => Region { set: named(trimmed(&name)), ..Region::default() },
                    None => Region::default(),
                };
                self.set = self.number(region);
            }
            1940 => {
                let pieces = record.attributes.iter().skip(1).filter_map(|word| word.text());
                self.labels.insert(integer(record, 0)?, Name::from(pieces.collect::<String>().trim()));
            }
            2000 => self.begin_increment(record)?,
            2001 => self.end_increment(),
            other => self.passed_over.count(&format!("record {other}")),
        }
        Ok(())
    }

    fn begin_increment(&mut self, record: &Record<'_>) -> Result<(), Problem> {
        self.end_increment();
        self.node = None;
        self.frame = Some(Frame {
            total_time: Some(real(record, 0)?),
            step_time: Some(real(record, 1)?),
            step: Some(integer(record, 5)?),
            increment: Some(integer(record, 6)?),
            ..Frame::default()
        });
        Ok(())
    }

    /// Passes on the increment, with names resolved by the records 1940 before its end.
    fn end_increment(&mut self) {
        self.fields.clear();
        let Some(mut frame) = self.frame.take() else { return };
        for surface in &mut self.results.surfaces {
            surface.name = resolved(&surface.name, &self.labels);
        }
        for field in &mut frame.fields {
            for name in [&mut field.region.slave, &mut field.region.master, &mut field.region.set].into_iter().flatten()
            {
                *name = resolved(name, &self.labels);
            }
        }
        self.frames += 1;
        self.taker.take(&self.results, Some(frame));
    }

    fn coordinates(&mut self, record: &Record<'_>) -> Result<(), Problem> {
        let node = integer(record, 0)?;
        let mut values = [f64::NAN; 3];
        for (value, word) in values.iter_mut().zip(&record.attributes[1..]) {
            *value = word.real().ok_or_else(|| misplaced(record, "coordinates"))?;
        }
        let coordinates = self.results.coordinates.get_or_insert_with(|| {
            let count = record.attributes.len().saturating_sub(1).min(3);
            collect::field("COORD", Region::default(), Row::Node(0), (1..=count).map(|at| format!("COOR{at}")))
        });
        collect::push(coordinates, Row::Node(node), &values);
        Ok(())
    }

    /// The values of a node, a slave node or a pair.
    fn values(&mut self, record: &Record<'_>, quantity: Quantity) -> Result<(), Problem> {
        let (row, first, region) = match quantity.kind {
            Kind::Nodal => (Row::Node(integer(record, 0)?), 1, self.set),
            Kind::Contact => match self.node {
                Some(node) => (Row::Node(node), 0, self.pair),
                None => return Err(misplaced(record, "the header of a node, record 1504, before it")),
            },
            Kind::Pair => (Row::Whole, 0, self.pair),
        };
        let Some(frame) = &mut self.frame else {
            return Err(misplaced(record, "the begin of an increment, record 2000, before it"));
        };
        self.values.clear();
        for word in &record.attributes[first..] {
            self.values.push(word.real().ok_or_else(|| misplaced(record, "values"))?);
        }
        let values = self.values.as_slice();
        let key = (record.key, region, values.len());
        let at = match self.fields.get(&key) {
            // Duplicate records of a pair are kept.
            Some(at) if !matches!(row, Row::Whole) => *at,
            _ => {
                let columns = quantity.columns(values.len(), &self.freedoms);
                frame.fields.push(collect::field(quantity.name, self.regions[region].clone(), row, columns));
                self.fields.insert(key, frame.fields.len() - 1);
                frame.fields.len() - 1
            }
        };
        let field: &mut Field = &mut frame.fields[at];
        collect::push(field, row, values);
        Ok(())
    }

    fn number(&mut self, region: Region) -> usize {
        let next = self.regions.len();
        let number = *self.region_numbers.entry(region.clone()).or_insert(next);
        if number == next {
            self.regions.push(region);
        }
        number
    }
}

fn named(name: Name) -> Option<Name> {
    (!name.is_empty()).then_some(name)
}

fn trimmed(name: &str) -> Name {
    name.trim().into()
}

/// The name of a number, or the name itself.
fn resolved(name: &Name, labels: &HashMap<i64, Name>) -> Name {
    name.parse().ok().and_then(|number: i64| labels.get(&number)).unwrap_or(name).clone()
}

fn attribute<T>(record: &Record<'_>, at: usize, what: &str, of: impl Fn(Word) -> Option<T>) -> Result<T, Problem> {
    record
        .attributes
        .get(at)
        .and_then(|word| of(*word))
        .ok_or_else(|| misplaced(record, &format!("{what} as attribute {} of {}", at + 1, record.attributes.len())))
}

fn integer(record: &Record<'_>, at: usize) -> Result<i64, Problem> {
    attribute(record, at, "an integer", Word::integer)
}

fn real(record: &Record<'_>, at: usize) -> Result<f64, Problem> {
    attribute(record, at, "a number", Word::real)
}

/// A name; long names are given by numbers.
fn text(record: &Record<'_>, at: usize) -> Result<Name, Problem> {
    let name = |word: Word| word.text().or_else(|| word.integer().map(|number| number.to_string()));
    attribute(record, at, "a name", name).map(|name| trimmed(&name))
}

fn misplaced(record: &Record<'_>, expected: &str) -> Problem {
    let place: Place = record.place;
    let message = format!("record {}: expected {expected}", record.key);
    Problem::new(place, message, "the file is damaged here; the part before is read")
}
