//! The tables beside a scene file: nodes, links and interfaces as comma-separated values, links as a Matrix Market file.
//!
//! | table | columns |
//! |---|---|
//! | nodes | `node`; `potential_fixed`, `potential_source`; `temperature_fixed`, `temperature_source`, `temperature_capacity`, `temperature_initial`; the same with `pore_pressure_` |
//! | links | `node_1`, `node_2`; `electrical`, `thermal`, `hydraulic`; `joule_heat_fraction` |
//! | interfaces | `slave`, `master` (or `secondary`, `main`), `interaction`; and of a node table `area`, `clearance`, `pressure`, `closed`, `fv1` …, `temp` (or `temperature`), `mass_flow`, `shear`, `slip_rate`, `clearance_rate`, `char_length`, `perm_s`, `perm_m` |
//!
//! A Matrix Market file is `matrix coordinate real symmetric`. Its entries beside the diagonal are conductances between the nodes of row and column, or all of them the negative of those,
//! as an assembled conductance matrix has them; the rows of such a matrix add up to zero.

use super::course::Course;
use super::diagnostic::UNUSABLE_NUMBER;
use super::read::CheckedCondition;
use super::usable::{Unusable, unusable_numbers};
use super::{Field, SceneInterface};
use csv::StringRecord;
use inpact_evaluation::nodes::{
    Column, DUPLICATE_COLUMN, DataRule, Findings, MALFORMED_CELL, MISSING_COLUMN, Part, Place,
};
use inpact_parser::model::Name;
use std::fmt;

/// A row's refusal: the rule and the words.
type Refusal = (&'static DataRule, String);

const NODE_COLUMNS: &str = "a table of nodes has `node`, and of each field `potential_fixed`, `potential_source`, `temperature_fixed`, `temperature_source`, \
                            `temperature_capacity`, `temperature_initial`, or the same with `pore_pressure_`";

const LINK_COLUMNS: &str =
    "a table of links has `node_1`, `node_2`, `electrical`, `thermal`, `hydraulic` and `joule_heat_fraction`";

const INTERFACE_COLUMNS: &str = "a table of interfaces has `slave`, `master`, `interaction`, `area`, `clearance`, `pressure`, `closed`, `fv1` and so on, `temp`, \
                                 `mass_flow`, `shear`, `slip_rate`, `clearance_rate`, `char_length`, `perm_s` and `perm_m`";

/// A row of a table of nodes.
pub(super) struct NodeRow {
    pub(super) name: String,
    pub(super) conditions: [CheckedCondition; 3],
}

/// A row of a table of links.
pub(super) struct LinkRow {
    pub(super) nodes: [String; 2],
    pub(super) conductances: [f64; 3],
    pub(super) joule_heat_fraction: Option<f64>,
}

/// A row of a table of interfaces; slave and master are still names.
pub(super) struct InterfaceRow {
    pub(super) slave: String,
    pub(super) master: String,
    pub(super) interface: SceneInterface,
}

/// A column of a table of nodes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum NodeColumn {
    Name,
    Of(Field, Quantity),
}

/// What a column says of a field.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Quantity {
    Fixed,
    Source,
    Capacity,
    Initial,
}

/// A column of a table of links.
#[derive(Clone, Copy, PartialEq, Eq)]
enum LinkColumn {
    Node(usize),
    Conductance(Field),
    JouleHeatFraction,
}

/// A column of a table of interfaces.
#[derive(Clone, Copy, PartialEq, Eq)]
enum InterfaceColumn {
    Slave,
    Master,
    Interaction,
    Of(Column),
}

/// Reads a table of nodes.
pub(super) fn nodes(bytes: &[u8], findings: &mut Findings, take: &mut dyn FnMut(NodeRow) -> Result<(), Refusal>) {
    let named = |header: &str| {
        if header == "node" {
            return Some(NodeColumn::Name);
        }
        let field = Field::ALL.into_iter().find(|field| header.starts_with(&format!("{}_", field.key())))?;
        let quantity = match &header[field.key().len() + 1..] {
            "fixed" => Quantity::Fixed,
            "source" => Quantity::Source,
            "capacity" if field != Field::Potential => Quantity::Capacity,
            "initial" if field != Field::Potential => Quantity::Initial,
            _ => return None,
        };
        Some(NodeColumn::Of(field, quantity))
    };
    let needed = [(NodeColumn::Name, "node")];
    each_row(bytes, findings, (NODE_COLUMNS, named), &needed, |row| {
        let mut conditions: [CheckedCondition; 3] = std::array::from_fn(|_| CheckedCondition::default());
        for &(place, column) in row.columns {
            let NodeColumn::Of(field, quantity) = column else { continue };
            let Some(value) = row.number(place)? else { continue };
            let is_usable = value.is_finite() && (quantity != Quantity::Capacity || value >= 0.0);
            if !is_usable {
                return Err(row.unusable(place, value));
            }
            let condition = &mut conditions[field.index()];
            match quantity {
                Quantity::Fixed => condition.fixed = Some(Course::constant(value)),
                Quantity::Source => condition.source = Some(Course::constant(value)),
                Quantity::Capacity => condition.capacity = Some(value),
                Quantity::Initial => condition.initial = Some(value),
            }
        }
        take(NodeRow { name: row.text(NodeColumn::Name).to_owned(), conditions })
    });
}

/// Reads a table of links.
pub(super) fn links(bytes: &[u8], findings: &mut Findings, take: &mut dyn FnMut(LinkRow)) {
    let named = |header: &str| match header {
        "node_1" => Some(LinkColumn::Node(0)),
        "node_2" => Some(LinkColumn::Node(1)),
        "joule_heat_fraction" => Some(LinkColumn::JouleHeatFraction),
        _ => {
            let field = Field::ALL.into_iter().find(|field| field.conductance_key() == header)?;
            Some(LinkColumn::Conductance(field))
        }
    };
    let needed = [(LinkColumn::Node(0), "node_1"), (LinkColumn::Node(1), "node_2")];
    each_row(bytes, findings, (LINK_COLUMNS, named), &needed, |row| {
        let mut link = LinkRow {
            nodes: [0, 1].map(|end| row.text(LinkColumn::Node(end)).to_owned()),
            conductances: [0.0; 3],
            joule_heat_fraction: None,
        };
        for &(place, column) in row.columns {
            if matches!(column, LinkColumn::Node(_)) {
                continue;
            }
            let Some(value) = row.number(place)? else { continue };
            let may_be_infinite = column != LinkColumn::JouleHeatFraction;
            let is_usable = value >= 0.0 && (value.is_finite() || may_be_infinite);
            if !is_usable {
                return Err(row.unusable(place, value));
            }
            match column {
                LinkColumn::Conductance(field) => link.conductances[field.index()] = value,
                _ => link.joule_heat_fraction = Some(value),
            }
        }
        if link.nodes[0] == link.nodes[1] {
            return Err((&UNUSABLE_NUMBER, format!("row {} joins `{}` to itself", row.number, link.nodes[0])));
        }
        take(link);
        Ok(())
    });
}

/// Reads a table of interfaces.
pub(super) fn interfaces(
    bytes: &[u8],
    findings: &mut Findings,
    take: &mut dyn FnMut(InterfaceRow, u64) -> Result<(), Refusal>,
) {
    let named = |header: &str| match header {
        "slave" | "secondary" => Some(InterfaceColumn::Slave),
        "master" | "main" => Some(InterfaceColumn::Master),
        "interaction" => Some(InterfaceColumn::Interaction),
        _ => {
            // As the scene file calls it.
            let column = Column::named(if header == "temperature" { "temp" } else { header })?;
            let is_of_interface = matches!(
                column,
                Column::Area
                    | Column::Clearance
                    | Column::Pressure
                    | Column::Closed
                    | Column::FieldVariable(_, Part::Both)
                    | Column::Temperature(Part::Both)
                    | Column::MassFlow(Part::Both)
                    | Column::Shear
                    | Column::SlipRate
                    | Column::ClearanceRate
                    | Column::CharacteristicLength
                    | Column::BulkPermeability(_)
            );
            is_of_interface.then_some(InterfaceColumn::Of(column))
        }
    };
    let needed = [
        (InterfaceColumn::Slave, "slave"),
        (InterfaceColumn::Master, "master"),
        (InterfaceColumn::Of(Column::Area), "area"),
    ];
    each_row(bytes, findings, (INTERFACE_COLUMNS, named), &needed, |row| {
        let interface = interface_of(row)?;
        if let Some(unusable) = unusable_numbers(&interface).first() {
            let Unusable { key, value, .. } = unusable;
            let message = format!("`{key}` of row {} is {value:?}: {}", row.number, unusable.help());
            return Err((&UNUSABLE_NUMBER, message));
        }
        let [slave, master] =
            [InterfaceColumn::Slave, InterfaceColumn::Master].map(|column| row.text(column).to_owned());
        take(InterfaceRow { slave, master, interface }, row.line)
    });
}

fn interface_of(row: &Row<'_, InterfaceColumn>) -> Result<SceneInterface, Refusal> {
    let mut interface = SceneInterface {
        interaction: None,
        slave: 0,
        master: 0,
        area: f64::NAN,
        clearance: None,
        pressure: None,
        closed: None,
        field_variables: Vec::new(),
        temperature: None,
        mass_flow: None,
        shear: None,
        slip_rate: None,
        clearance_rate: None,
        characteristic_length: None,
        bulk_permeabilities: [None; 2],
        place: (row.line, None),
    };
    let name = row.text(InterfaceColumn::Interaction);
    interface.interaction = (!name.is_empty()).then(|| Name::new(name));
    for &(place, column) in row.columns {
        let InterfaceColumn::Of(column) = column else { continue };
        let Some(value) = row.number(place)? else { continue };
        match column {
            Column::Area => interface.area = value,
            Column::Clearance => interface.clearance = Some(Course::constant(value)),
            Column::Pressure => interface.pressure = Some(Course::constant(value)),
            Column::Closed => interface.closed = Some(value != 0.0),
            Column::FieldVariable(number, _) => {
                let number = number as usize;
                if interface.field_variables.len() < number {
                    interface.field_variables.resize(number, 0.0);
                }
                interface.field_variables[number - 1] = value;
            }
            Column::Temperature(_) => interface.temperature = Some(value),
            Column::MassFlow(_) => interface.mass_flow = Some(value),
            Column::Shear => interface.shear = Some(value),
            Column::SlipRate => interface.slip_rate = Some(value),
            Column::ClearanceRate => interface.clearance_rate = Some(value),
            Column::CharacteristicLength => interface.characteristic_length = Some(value),
            Column::BulkPermeability(Part::Slave) => interface.bulk_permeabilities[0] = Some(value),
            Column::BulkPermeability(_) => interface.bulk_permeabilities[1] = Some(value),
            _ => {}
        }
    }
    Ok(interface)
}

/// A row of a table whose columns mean `C`.
struct Row<'a, C> {
    record: &'a StringRecord,
    columns: &'a [(usize, C)],
    headers: &'a StringRecord,
    /// Counted from 1 below the header.
    number: u64,
    line: u64,
}

impl<C: Copy + PartialEq> Row<'_, C> {
    /// The text of a column; empty where there is none.
    fn text(&self, column: C) -> &str {
        let place = self.columns.iter().find(|(_, of)| *of == column).map(|(place, _)| *place);
        place.and_then(|place| self.record.get(place)).unwrap_or_default()
    }

    /// The number in a cell; `None` where it is empty.
    fn number(&self, place: usize) -> Result<Option<f64>, Refusal> {
        let text = self.record.get(place).unwrap_or_default();
        if text.is_empty() {
            return Ok(None);
        }
        text.parse().map(Some).map_err(|_| {
            let header = &self.headers[place];
            (&MALFORMED_CELL as &DataRule, format!("`{header}` of row {} is `{text}`, which is no number", self.number))
        })
    }

    fn unusable(&self, place: usize, value: f64) -> Refusal {
        (&UNUSABLE_NUMBER, format!("`{}` of row {} is {value:?}", &self.headers[place], self.number))
    }
}

/// Reads a table row by row, whose columns are named and listed for a person; reports what is wrong with it, and the rows that `take` refuses.
fn each_row<C: Copy + PartialEq>(
    bytes: &[u8],
    findings: &mut Findings,
    (all_columns, named): (&str, impl Fn(&str) -> Option<C>),
    needed: &[(C, &str)],
    mut take: impl FnMut(&Row<'_, C>) -> Result<(), Refusal>,
) {
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(bytes);
    let headers = match reader.headers() {
        Ok(headers) => headers.clone(),
        Err(error) => return report_csv(&error, findings),
    };
    let mut columns: Vec<(usize, C)> = Vec::new();
    for (place, header) in headers.iter().enumerate() {
        let at = Place { line: Some(1), column: Some(header.to_owned()), ..Place::default() };
        match named(&header.to_ascii_lowercase()) {
            None => findings.report(&MALFORMED_CELL, at, format!("such a table has no column `{header}`"), all_columns),
            Some(column) if columns.iter().any(|(_, other)| *other == column) => {
                findings.report(&DUPLICATE_COLUMN, at, format!("a second header means what `{header}` does"), "");
            }
            Some(column) => columns.push((place, column)),
        }
    }
    for (column, name) in needed {
        if !columns.iter().any(|(_, other)| other == column) {
            let at = Place { line: Some(1), ..Place::default() };
            findings.report(&MISSING_COLUMN, at, format!("column `{name}` is missing"), all_columns);
        }
    }
    if findings.has_errors() {
        return;
    }
    for (record, number) in reader.records().zip(1..) {
        let record = match record {
            Ok(record) => record,
            Err(error) => return report_csv(&error, findings),
        };
        let line = record.position().map_or(0, csv::Position::line);
        let row = Row { record: &record, columns: &columns, headers: &headers, number, line };
        if let Err((rule, message)) = take(&row) {
            findings.report(rule, Place { row: Some(number), line: Some(line), column: None }, message, "");
        }
    }
}

fn report_csv(error: &csv::Error, findings: &mut Findings) {
    let line = error.position().map(csv::Position::line);
    let message = match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("the row has {len} cells where the header has {expected_len}")
        }
        csv::ErrorKind::Utf8 { .. } => "the row is not UTF-8".to_owned(),
        _ => error.to_string(),
    };
    findings.report(&MALFORMED_CELL, Place { line, ..Place::default() }, message, "");
}

/// Reads a Matrix Market file of conductances; the nodes of a link are the numbers of row and column, from 1.
pub(super) fn matrix(
    bytes: &[u8],
    conducts: Option<Field>,
    findings: &mut Findings,
    take: &mut dyn FnMut([u32; 2], [f64; 3]),
) {
    let mut report = |line: usize, message: &dyn fmt::Display, help: &str| {
        let place = Place { line: Some(line as u64), ..Place::default() };
        findings.report(&MALFORMED_CELL, place, message.to_string(), help);
    };
    let Some(field) = conducts else {
        let help = "add conducts = \"electrical\", \"thermal\" or \"hydraulic\" to [[link_file]]";
        return report(1, &"a Matrix Market file does not say what it conducts", help);
    };
    match read_matrix(bytes) {
        Err((line, message, help)) => report(line, &message, help),
        Ok(Entries { sign, entries }) => {
            for (ends, value) in entries {
                let mut conductances = [0.0; 3];
                conductances[field.index()] = sign * value;
                take(ends, conductances);
            }
        }
    }
}

/// The entries beside the diagonal, and by what they are multiplied to be conductances.
struct Entries {
    sign: f64,
    entries: Vec<([u32; 2], f64)>,
}

/// A message with its line, and what to do.
type Wrong = (usize, String, &'static str);

/// Beyond this share of its diagonal the sum of a row is not zero.
const ROW_SUM: f64 = 1e-9;

fn read_matrix(bytes: &[u8]) -> Result<Entries, Wrong> {
    let text = std::str::from_utf8(bytes).map_err(|_| (1, "the file is not UTF-8".to_owned(), ""))?;
    let mut lines = text.lines().enumerate().map(|(number, line)| (number + 1, line.trim()));
    let banner = lines.next().map(|(_, line)| line.to_ascii_lowercase()).unwrap_or_default();
    let words: Vec<&str> = banner.split_whitespace().collect();
    if !matches!(words[..], ["%%matrixmarket", "matrix", "coordinate", "real" | "integer", "symmetric"]) {
        let help = "the first line must be `%%MatrixMarket matrix coordinate real symmetric`";
        return Err((1, "the file is no symmetric Matrix Market file of real numbers".to_owned(), help));
    }
    let mut lines = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('%'));
    let (line, size) = lines.next().ok_or_else(|| (1, "the size of the matrix is missing".to_owned(), ""))?;
    let size: Vec<u32> = size.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let [rows, columns, count] = size[..] else {
        return Err((line, "the size of the matrix is not three whole numbers".to_owned(), ""));
    };
    if rows != columns {
        return Err((line, format!("a matrix of {rows} rows and {columns} columns is not symmetric"), ""));
    }
    let (mut entries, mut sums, mut diagonals) = (Vec::new(), vec![0.0; rows as usize], vec![0.0; rows as usize]);
    let (mut first_positive, mut first_negative) = (None, None);
    let mut found = 0;
    for (line, text) in lines {
        found += 1;
        let entry = parse_entry(text).filter(|(ends, _)| ends.iter().all(|end| (1..=rows).contains(end)));
        let Some((ends, value)) = entry else {
            return Err((
                line,
                format!("`{text}` is no entry of a matrix of {rows} rows"),
                "write row, column and value",
            ));
        };
        let [row, column] = ends.map(|end| end as usize - 1);
        sums[row] += value;
        if row == column {
            diagonals[row] += value;
            continue;
        }
        sums[column] += value;
        let first = if value < 0.0 { &mut first_negative } else { &mut first_positive };
        *first = first.or((value != 0.0).then_some(line));
        entries.push((ends, value));
    }
    if found != count {
        return Err((line, format!("the file says {count} entries and has {found}"), ""));
    }
    let sign = match (first_positive, first_negative) {
        (Some(positive), Some(negative)) => {
            let message = format!("entries beside the diagonal have both signs, in lines {positive} and {negative}");
            let help = "give conductances, or an assembled matrix in which all of them are negative";
            return Err((positive.max(negative), message, help));
        }
        (None, Some(_)) => -1.0,
        _ => 1.0,
    };
    if sign > 0.0 && diagonals.iter().any(|diagonal| *diagonal != 0.0) {
        let help = "leave the diagonal out, or give an assembled matrix, whose other entries are negative";
        return Err((line, "a list of conductances has a diagonal".to_owned(), help));
    }
    let off = |(sum, diagonal): (&f64, &f64)| sign < 0.0 && sum.abs() > ROW_SUM * diagonal.abs();
    if let Some(row) = sums.iter().zip(&diagonals).position(off) {
        let message = format!("row {} does not add up to zero: it conducts to something outside the matrix", row + 1);
        return Err((line, message, "make what is outside a node, and give the conductances to it as links"));
    }
    Ok(Entries { sign, entries })
}

fn parse_entry(text: &str) -> Option<([u32; 2], f64)> {
    let mut words = text.split_whitespace();
    let ends = [words.next()?.parse().ok()?, words.next()?.parse().ok()?];
    let value: f64 = words.next()?.parse().ok()?;
    (words.next().is_none() && value.is_finite()).then_some((ends, value))
}
