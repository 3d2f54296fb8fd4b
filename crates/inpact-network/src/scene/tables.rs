//! The tables of a scene file: nodes, links and interfaces as values separated by commas, semicolons or tabs, detected from the header.
//!
//! | table | columns |
//! |---|---|
//! | nodes | `node`; `potential_fixed`, `potential_source`; `temperature_fixed`, `temperature_source`, `temperature_capacity`, `temperature_initial`; the same with `pore_pressure_` |
//! | links | `node_1`, `node_2`; `electrical`, `thermal`, `hydraulic`; `joule_heat_fraction` |
//! | interfaces | `slave`, `master` (or `secondary`, `main`), `interaction`; and of a node table `area`, `clearance`, `pressure`, `closed`, `fv1` …, `temp` (or `temperature`), `mass_flow`, `shear`, `slip_rate`, `clearance_rate`, `char_length`, `perm_s`, `perm_m` |

use super::course::Course;
use super::nearest::{meant_or, quoted};
use super::read::CheckedCondition;
use super::rules::MALFORMED_SCENE;
use super::usable::{self, Given, Refusal};
use super::{Field, SceneInterface};
use csv::StringRecord;
use inpact_evaluation::nodes::{Column, DUPLICATE_COLUMN, Findings, MALFORMED_CELL, MISSING_COLUMN, Part, Place};
use inpact_parser::model::{MAX_FIELD_VARIABLES, Name};

const NODE_COLUMNS: &str = "a table of nodes has `node`, and of each field `potential_fixed`, `potential_source`, `temperature_fixed`, `temperature_source`, \
                            `temperature_capacity`, `temperature_initial`, `pore_pressure_fixed`, `pore_pressure_source`, `pore_pressure_capacity`, \
                            `pore_pressure_initial`";

const LINK_COLUMNS: &str =
    "a table of links has `node_1`, `node_2`, `electrical`, `thermal`, `hydraulic` and `joule_heat_fraction`";

const INTERFACE_COLUMNS: &str = "a table of interfaces has `slave`, `master`, `interaction`, `area`, `clearance`, `pressure`, `closed`, `fv1` and so on up to number 1000, `temp`, \
                                 `mass_flow`, `shear`, `slip_rate`, `clearance_rate`, `char_length`, `perm_s` and `perm_m`";

/// A row of a table of nodes.
pub(super) struct NodeRow {
    pub(super) name: String,
    pub(super) line: u64,
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

/// Quantities of a field in a column.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Quantity {
    Fixed,
    Source,
    Capacity,
    Initial,
}

impl Quantity {
    /// The key in the scene file.
    fn key(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Source => "source",
            Self::Capacity => "capacity",
            Self::Initial => "initial",
        }
    }
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
        let all = [Quantity::Fixed, Quantity::Source, Quantity::Capacity, Quantity::Initial];
        let of_field = if field == Field::Potential { &all[..2] } else { &all[..] };
        let quantity = of_field.iter().find(|quantity| quantity.key() == &header[field.key().len() + 1..])?;
        Some(NodeColumn::Of(field, *quantity))
    };
    let needed = [(NodeColumn::Name, "node")];
    each_row(bytes, findings, (NODE_COLUMNS, named), &needed, |row| {
        let name = row.name(NodeColumn::Name)?;
        let mut conditions: [CheckedCondition; 3] = std::array::from_fn(|_| CheckedCondition::default());
        for &(place, column) in row.columns {
            let NodeColumn::Of(field, quantity) = column else { continue };
            let Some(value) = row.number(place, quantity.key())? else { continue };
            let condition = &mut conditions[field.index()];
            match quantity {
                Quantity::Fixed => condition.fixed = Some(Course::constant(value)),
                Quantity::Source => condition.source = Some(Course::constant(value)),
                Quantity::Capacity => condition.capacity = Some(value),
                Quantity::Initial => condition.initial = Some(value),
            }
        }
        for (field, condition) in Field::ALL.into_iter().zip(&conditions) {
            let given = Given {
                fixed: condition.fixed.is_some(),
                source: condition.source.is_some(),
                capacity: condition.capacity.is_some(),
                initial: condition.initial.is_some(),
            };
            usable::condition(field, given, &name)?;
        }
        take(NodeRow { name, line: row.line, conditions }).map_err(|refusal| row.about(NodeColumn::Name, refusal))
    });
}

/// Reads a table of links; `take` returns the end of a row that it rejects.
pub(super) fn links(
    bytes: &[u8],
    findings: &mut Findings,
    take: &mut dyn FnMut(LinkRow) -> Result<(), (usize, Refusal)>,
) {
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
            nodes: [row.name(LinkColumn::Node(0))?, row.name(LinkColumn::Node(1))?],
            conductances: [0.0; 3],
            joule_heat_fraction: None,
        };
        let mut has_conductance = false;
        for &(place, column) in row.columns {
            match column {
                LinkColumn::Node(_) => {}
                LinkColumn::Conductance(field) => {
                    let Some(value) = row.number(place, field.conductance_key())? else { continue };
                    link.conductances[field.index()] = value;
                    has_conductance = true;
                }
                LinkColumn::JouleHeatFraction => {
                    link.joule_heat_fraction = row.number(place, "joule_heat_fraction")?;
                }
            }
        }
        let what = format!("row {}", row.number);
        usable::joined([&link.nodes[0], &link.nodes[1]], &what)?;
        usable::conducting(has_conductance, &what)?;
        take(link).map_err(|(end, refusal)| row.about(LinkColumn::Node(end), refusal))
    });
}

/// Reads a table of interfaces; `take` returns the side of a row that it rejects.
pub(super) fn interfaces(
    bytes: &[u8],
    findings: &mut Findings,
    take: &mut dyn FnMut(InterfaceRow) -> Result<(), (usize, Refusal)>,
) {
    let named = |header: &str| match header {
        "slave" | "secondary" => Some(InterfaceColumn::Slave),
        "master" | "main" => Some(InterfaceColumn::Master),
        "interaction" => Some(InterfaceColumn::Interaction),
        _ => {
            // The name in the scene file.
            let column = Column::named(if header == "temperature" { "temp" } else { header })?;
            // More fields than a deck can have would only waste memory in every row.
            let is_known = |number: u32| usize::try_from(number).is_ok_and(|number| number <= MAX_FIELD_VARIABLES);
            let is_of_interface = matches!(
                column,
                Column::Area
                    | Column::Clearance
                    | Column::Pressure
                    | Column::Closed
                    | Column::Temperature(Part::Both)
                    | Column::MassFlow(Part::Both)
                    | Column::Shear
                    | Column::SlipRate
                    | Column::ClearanceRate
                    | Column::CharacteristicLength
                    | Column::BulkPermeability(_)
            ) || matches!(column, Column::FieldVariable(number, Part::Both) if is_known(number));
            is_of_interface.then_some(InterfaceColumn::Of(column))
        }
    };
    let needed = [
        (InterfaceColumn::Slave, "slave"),
        (InterfaceColumn::Master, "master"),
        (InterfaceColumn::Of(Column::Area), "area"),
    ];
    each_row(bytes, findings, (INTERFACE_COLUMNS, named), &needed, |row| {
        let sides = [InterfaceColumn::Slave, InterfaceColumn::Master];
        let [slave, master] = [row.name(sides[0])?, row.name(sides[1])?];
        let interface = interface_of(row)?;
        usable::joined([&slave, &master], &format!("row {}", row.number))?;
        take(InterfaceRow { slave, master, interface }).map_err(|(side, refusal)| row.about(sides[side], refusal))
    });
}

fn interface_of(row: &Row<'_, InterfaceColumn>) -> Result<SceneInterface, Refusal> {
    let mut interface = SceneInterface { place: (row.line, None), ..SceneInterface::default() };
    let name = row.text(InterfaceColumn::Interaction);
    interface.interaction = (!name.is_empty()).then(|| Name::new(name));
    for &(place, column) in row.columns {
        let InterfaceColumn::Of(column) = column else { continue };
        let number = row.number(place, key_of(column)).map_err(|refusal| match column {
            Column::Closed => refusal.with_help("write 1 where it is closed and 0 where it is open"),
            _ => refusal,
        });
        let Some(value) = number? else {
            if column == Column::Area {
                let message = format!("`{}` of row {} is empty", &row.headers[place], row.number);
                let help = "give the area of the slave node";
                return Err(Refusal::new(&MALFORMED_SCENE, message, help).at(&row.headers[place]));
            }
            continue;
        };
        match column {
            Column::Area => interface.area = value,
            Column::Clearance => interface.clearance = Some(Course::constant(value)),
            Column::Pressure => interface.pressure = Some(Course::constant(value)),
            Column::Closed => interface.closed = Some(value != 0.0),
            Column::FieldVariable(number, _) => {
                let number = number as usize;
                if interface.field_variables.len() < number {
                    interface.field_variables.resize(number, f64::NAN);
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

/// The key in the scene file of a quantity whose range is limited.
fn key_of(column: Column) -> &'static str {
    match column {
        Column::Area => "area",
        Column::CharacteristicLength => "char_length",
        Column::BulkPermeability(Part::Slave) => "perm_s",
        Column::BulkPermeability(_) => "perm_m",
        _ => "",
    }
}

/// A row of a table with columns `C`.
struct Row<'a, C> {
    record: &'a StringRecord,
    columns: &'a [(usize, C)],
    headers: &'a StringRecord,
    /// Counted from 1 below the header.
    number: u64,
    line: u64,
}

impl<C: Copy + PartialEq> Row<'_, C> {
    /// The cell of a record in a column; empty where there is none.
    fn cell<'r>(&self, record: &'r StringRecord, column: C) -> &'r str {
        let place = self.columns.iter().find(|(_, of)| *of == column).map(|(place, _)| *place);
        place.and_then(|place| record.get(place)).unwrap_or_default()
    }

    fn text(&self, column: C) -> &str {
        self.cell(self.record, column)
    }

    /// The name of a node.
    fn name(&self, column: C) -> Result<String, Refusal> {
        let name = self.text(column);
        let what = || format!("`{}` of row {}", self.header(column), self.number);
        usable::node_name(name, what).map_err(|refusal| self.about(column, refusal))?;
        Ok(name.to_owned())
    }

    fn header(&self, column: C) -> &str {
        self.cell(self.headers, column)
    }

    /// A rejection of the cell of a column.
    fn about(&self, column: C, refusal: Refusal) -> Refusal {
        refusal.at(self.header(column))
    }

    /// The number in a cell, corresponding to a key of the scene file; `None` where it is empty.
    fn number(&self, place: usize, key: &str) -> Result<Option<f64>, Refusal> {
        let text = self.record.get(place).unwrap_or_default();
        if text.is_empty() {
            return Ok(None);
        }
        let header = &self.headers[place];
        let what = || format!("`{header}` of row {}", self.number);
        let Ok(value) = text.parse() else {
            let message = format!("{} is `{text}`, which is no number", what());
            let help = "write a number with a decimal point, or leave the cell empty where nothing is known";
            return Err(Refusal::new(&MALFORMED_CELL, message, help).at(header));
        };
        usable::number(key, value, text, what).map_err(|refusal| refusal.at(header))?;
        Ok(Some(value))
    }
}

/// Reads a table row by row, with names of its columns for messages; reports its faults, and the rows that `take` rejects.
fn each_row<C: Copy + PartialEq>(
    bytes: &[u8],
    findings: &mut Findings,
    (all_columns, named): (&str, impl Fn(&str) -> Option<C>),
    needed: &[(C, &str)],
    mut take: impl FnMut(&Row<'_, C>) -> Result<(), Refusal>,
) {
    let delimiter = separator(bytes, |header| named(header).is_some());
    let mut reader = csv::ReaderBuilder::new().delimiter(delimiter).trim(csv::Trim::All).from_reader(bytes);
    let headers = match reader.headers() {
        Ok(headers) => headers.clone(),
        Err(error) => return report_csv(&error, findings),
    };
    let mut columns: Vec<(usize, C)> = Vec::new();
    for (place, header) in headers.iter().enumerate() {
        let at = Place { column: Some(header.to_owned()), ..Place::of_line(1) };
        match named(&header.to_ascii_lowercase()) {
            None => {
                let help = meant_or(header, quoted(all_columns), all_columns);
                findings.report(&MALFORMED_CELL, at, format!("such a table has no column `{header}`"), help);
            }
            Some(column) if columns.iter().any(|(_, other)| *other == column) => {
                let message = format!("a second header means what `{header}` does");
                findings.report(&DUPLICATE_COLUMN, at, message, "keep one of the two columns");
            }
            Some(column) => columns.push((place, column)),
        }
    }
    for (column, name) in needed {
        if !columns.iter().any(|(_, other)| other == column) {
            let at = Place::of_line(1);
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
        if let Err(Refusal { rule, column, message, help }) = take(&row) {
            findings.report(rule, Place { row: Some(number), column, ..Place::of_line(line) }, message, help);
        }
    }
}

/// The separator of cells: of comma, semicolon and tab the one that gives the most known columns in the header.
fn separator(bytes: &[u8], is_known: impl Fn(&str) -> bool) -> u8 {
    let line = bytes.split(|byte| matches!(byte, b'\n' | b'\r')).next().unwrap_or_default();
    let known = |separator: u8| {
        let headers = line.split(|byte| *byte == separator).filter_map(|cell| std::str::from_utf8(cell).ok());
        headers.filter(|header| is_known(&header.trim().trim_matches('"').to_ascii_lowercase())).count()
    };
    // The first of equal ones.
    [b',', b';', b'\t'].into_iter().rev().max_by_key(|separator| known(*separator)).unwrap_or(b',')
}

fn report_csv(error: &csv::Error, findings: &mut Findings) {
    let line = error.position().map(csv::Position::line);
    let (message, help) = match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            let message = format!("the row has {len} cells where the header has {expected_len}");
            (message, "leave a cell empty where nothing is known, and write a text with separators in quotes")
        }
        csv::ErrorKind::Utf8 { .. } => ("the row is not UTF-8".to_owned(), "save the table as UTF-8"),
        _ => (error.to_string(), ""),
    };
    findings.report(&MALFORMED_CELL, Place { line, ..Place::default() }, message, help);
}
