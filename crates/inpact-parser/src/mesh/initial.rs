//! *INITIAL CONDITIONS of the nodes of surfaces: temperature, pore pressure, field variables; by node, set and instance.
//!
//! The last row for a node takes precedence.
//! A quantity without a row is absent: the solver's default is not assumed here.

use super::Mesh;
use super::layout::Entry;
use super::located::Located;
use super::reader::{Context, Reader};
use super::rows::data_lines;
use super::selected::{Kind, Selected};
use crate::deck::items;
use crate::number::read_float;
use crate::span::Span;
use std::io;
use std::rc::Rc;

/// Quantities of initial conditions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum InitialQuantity {
    /// TYPE=TEMPERATURE (θ).
    Temperature,
    /// TYPE=PORE PRESSURE (F L⁻²).
    PorePressure,
    /// TYPE=FIELD with its VARIABLE, from 1.
    FieldVariable(u32),
}

/// Initial values at the nodes of surfaces.
#[derive(Debug, Clone, PartialEq)]
pub struct InitialField {
    /// The quantity.
    pub quantity: InitialQuantity,
    /// One value per node, in the order of [`Mesh::nodes`]; `None` where no row names it.
    pub values: Vec<Option<f64>>,
}

impl Mesh {
    /// The initial values of a quantity, one per node; `None` where the deck has none.
    pub fn initial_values(&self, quantity: InitialQuantity) -> Option<&[Option<f64>]> {
        self.initial.iter().find(|field| field.quantity == quantity).map(|field| field.values.as_slice())
    }
}

/// A row: its target and its numbers.
struct Row {
    target: String,
    /// `None` for what is not a number.
    values: Vec<Option<f64>>,
    span: Span,
}

impl Reader<'_, '_> {
    /// Reads the initial conditions of the nodes that were found.
    pub(super) fn initial(&mut self, located: &Located) -> io::Result<Vec<InitialField>> {
        let mut fields: Vec<InitialField> = Vec::new();
        if located.len() == 0 {
            return Ok(fields);
        }
        for option in std::mem::take(&mut self.layout.initial_conditions) {
            let Some(quantity) = self.quantity(option) else { continue };
            let at = fields.iter().position(|field| field.quantity == quantity).unwrap_or_else(|| {
                fields.push(InitialField { quantity, values: vec![None; located.len()] });
                fields.len() - 1
            });
            let rows = self.initial_rows(option)?;
            self.apply(rows, located, &mut fields[at])?;
        }
        // An option whose rows name no node of a surface is ignored.
        fields.retain(|field| field.values.iter().any(Option::is_some));
        fields.sort_by_key(|field| field.quantity);
        Ok(fields)
    }

    /// The quantity of an option; `None` where it is of something else, or is not read.
    fn quantity(&mut self, option: Entry<'_>) -> Option<InitialQuantity> {
        let kind = option.choice("TYPE").unwrap_or_default();
        let quantity = match kind.as_str() {
            "TEMPERATURE" => InitialQuantity::Temperature,
            "POREPRESSURE" => InitialQuantity::PorePressure,
            "FIELD" => {
                let number = option.parameter("VARIABLE").map(|text| text.trim().parse());
                match number.unwrap_or(Ok(1)) {
                    Ok(number) if number != 0 => InitialQuantity::FieldVariable(number),
                    _ => {
                        let message = "expected a number from 1 as VARIABLE; the initial field was not read";
                        self.note(option.span(), message.to_owned());
                        return None;
                    }
                }
            }
            "CONTACT" => {
                let message = "TYPE=CONTACT of *INITIAL CONDITIONS is not honoured: clearances are those of the mesh";
                self.note(option.span(), message.to_owned());
                return None;
            }
            _ => return None,
        };
        let elsewhere = ["FILE", "INPUT", "USER", "STEP", "INTERPOLATE"];
        if let Some(name) = elsewhere.into_iter().find(|name| option.parameter(name).is_some()) {
            self.note(option.span(), format!("initial conditions with {name} are not read"));
            return None;
        }
        Some(quantity)
    }

    fn initial_rows(&mut self, option: Entry<'_>) -> io::Result<Vec<Row>> {
        let mut rows = Vec::new();
        data_lines(&mut *self.rows, option.block, &mut |line, span| {
            let mut cells = items(line).map(|item| &line[item]);
            let target = String::from_utf8_lossy(cells.next().unwrap_or_default()).into_owned();
            let mut values: Vec<Option<f64>> = cells.map(|cell| read_float(cell).ok()).collect();
            while values.len() > 1 && values.last() == Some(&None) {
                values.pop();
            }
            rows.push(Row { target, values, span });
        })?;
        Ok(rows)
    }

    fn apply(&mut self, rows: Vec<Row>, located: &Located, field: &mut InitialField) -> io::Result<()> {
        let mut wrong = Vec::new();
        let mut more = Vec::new();
        // Consecutive rows mostly differ; each set is looked up once.
        let mut last: Option<(String, Rc<Selected>)> = None;
        for Row { target, values, span } in rows {
            let value = match (field.quantity, &values[..]) {
                // A pore pressure with elevations varies with height.
                (InitialQuantity::PorePressure, &[Some(value)]) => value,
                (InitialQuantity::Temperature | InitialQuantity::FieldVariable(_), &[Some(value), ref others @ ..]) => {
                    if !others.is_empty() {
                        more.push((span, format!("the initial values of `{target}` after the first")));
                    }
                    value
                }
                _ => {
                    wrong.push((span, format!("the initial condition of `{target}`, which is no single number,")));
                    continue;
                }
            };
            let selected = match &last {
                Some((name, selected)) if *name == target => Rc::clone(selected),
                _ => Rc::new(self.select(Kind::Nodes, Context::Top, &target, span)?),
            };
            for (instance, selection) in selected.iter() {
                if let Some(label) = selection.single() {
                    if let Some(node) = located.id(*instance, label) {
                        field.values[node.index()] = Some(value);
                    }
                    continue;
                }
                for node in located.of_instances[*instance].clone() {
                    if selection.contains(located.label(node), located.options[node]) {
                        field.values[node] = Some(value);
                    }
                }
            }
            last = Some((target, selected));
        }
        self.note_first(wrong, "was not read");
        self.note_first(more, "were not read");
        Ok(())
    }
}
