//! The numbers of a row: those of a result file at the slave node, else of the geometry; fields of the master are interpolated by the weights of its nodes.

use crate::pair::{Pair, across, interpolated};
use crate::state::{ContactQuantity, NodeQuantity, State};
use crate::summary::Origin;
use inpact_evaluation::nodes::{Column, Part};
use inpact_geometry::{ContactNode, NodeId};
use inpact_parser::mesh::Mesh;

/// The columns that some of the states fill.
pub(crate) fn columns(states: &[State]) -> Vec<Column> {
    let mut columns = vec![Column::Clearance, Column::Area];
    columns.extend(states.iter().flat_map(|state| &state.contact).map(|field| field.quantity.column()));
    let quantities = states.iter().flat_map(|state| &state.fields).map(|field| field.quantity);
    columns.extend(quantities.flat_map(|quantity| [Part::Slave, Part::Master].map(|part| quantity.column(part))));
    let has = |known: fn(&State) -> bool| states.iter().any(known);
    columns.extend(has(|state| state.moment.step.is_some()).then_some(Column::Step));
    columns.extend(has(|state| state.moment.increment.is_some()).then_some(Column::Increment));
    columns.extend(has(|state| state.moment.step_time.is_some()).then_some(Column::StepTime));
    columns.sort_by_key(|column| (rank(*column), *column));
    columns.dedup();
    columns
}

/// The order of columns: contact, fields, others.
fn rank(column: Column) -> usize {
    let of_contact = ContactQuantity::ALL.iter().position(|quantity| quantity.column() == column);
    let of_fields = || NodeQuantity::of(column).map(|_| ContactQuantity::ALL.len());
    of_contact.or_else(of_fields).unwrap_or(ContactQuantity::ALL.len() + 1)
}

/// The number of a slave node in a column, and its source; `None` where it is unknown.
pub(crate) fn number<'a>(
    mesh: &Mesh,
    pair: &Pair<'_>,
    state: &'a State,
    node: &ContactNode,
    column: Column,
) -> Option<(f64, Option<Origin<'a>>)> {
    #[expect(clippy::cast_precision_loss, reason = "steps and increments are counted")]
    let counted = |number: i64| number as f64;
    match column {
        Column::Step => return Some((counted(state.moment.step?), None)),
        Column::Increment => return Some((counted(state.moment.increment?), None)),
        Column::StepTime => return Some((state.moment.step_time?, None)),
        _ => {}
    }
    if let Some(quantity) = ContactQuantity::of(column) {
        if let Some((value, source)) = state.contact(quantity, pair.index, node.node) {
            return Some((value, Some(Origin::Said(source))));
        }
        let value = match quantity {
            ContactQuantity::Clearance => across(node)?.clearance,
            ContactQuantity::Area => node.area,
            ContactQuantity::Pressure | ContactQuantity::Shear | ContactQuantity::SlipRate => return None,
        };
        let keeps = quantity == ContactQuantity::Area && pair.keeps_areas();
        let moved = state.displacements.as_ref().filter(|_| !keeps);
        return Some((value, Some(moved.map_or(Origin::Mesh, |moved| Origin::Moved(&moved.source)))));
    }
    let (quantity, part) = NodeQuantity::of(column)?;
    let field = state.field(quantity)?;
    let value = match part {
        Part::Slave => field.values[node.node.index()],
        _ => {
            let value = |node: NodeId| field.values[node.index()].map(|value| [value]);
            interpolated(mesh, pair.of, across(node)?, value).map(|[value]| value)
        }
    };
    value.map(|value| (value, Some(Origin::Said(&field.source))))
}
