//! Rows of node tables from a deck's mesh and its job's result files, with their notes: for `nodes`, `eval`, `plan` and `tradeoff`.

use super::findings::Messages;
use super::meshed::MeshedDeck;
use crate::failure::Failure;
use crate::text::{counted, number_text};
use inpact_contact::{FileSummary, NodeRows, PairSummary, State};
use serde_json::{Value, json};

/// The rows of a deck's pairs in these states, after reporting parts not read; an error where there are none.
pub(crate) fn node_rows<'a>(
    meshed: &'a MeshedDeck,
    states: &[State],
    messages: Messages<'_>,
) -> Result<NodeRows<'a>, Failure> {
    meshed.say_notes(&meshed.mesh.notes, messages)?;
    let rows = rows_of_pairs(meshed, states)?;
    meshed.say_notes(rows.notes(), messages)?;
    refuse_none(meshed, &rows)?;
    Ok(rows)
}

/// The rows of a deck's pairs in these states; an error where it has no pair.
pub(crate) fn rows_of_pairs<'a>(meshed: &'a MeshedDeck, states: &[State]) -> Result<NodeRows<'a>, Failure> {
    let MeshedDeck { name, read, mesh, .. } = meshed;
    let model = &read.model;
    if mesh.pairs.is_empty() {
        let has_none = model.contact_pairs.is_empty() && model.property_assignments.is_empty();
        return Err(Failure::Data(if has_none {
            format!(
                "`{name}` has no contact pair: expected *CONTACT PAIR, or *CONTACT PROPERTY ASSIGNMENT with two surfaces"
            )
        } else {
            format!("no contact pair of `{name}` has both of its surfaces in the mesh")
        }));
    }
    Ok(NodeRows::new(mesh, model, states)?)
}

/// Rejects pairs without a node.
pub(crate) fn refuse_none(MeshedDeck { name, .. }: &MeshedDeck, rows: &NodeRows<'_>) -> Result<(), Failure> {
    if rows.nodes() == 0 {
        return Err(Failure::Data(format!("no contact pair of `{name}` has a slave node with a place in the mesh")));
    }
    Ok(())
}

pub(crate) struct RowsSummary {
    /// Readable lines, after the one with the number of rows.
    pub(crate) lines: Vec<String>,
    /// The same as JSON.
    pub(crate) value: Value,
}

impl RowsSummary {
    pub(crate) fn of(rows: &NodeRows<'_>, files: &[FileSummary]) -> Self {
        Self { lines: lines(rows, files), value: value(rows, files) }
    }
}

fn lines(rows: &NodeRows<'_>, files: &[FileSummary]) -> Vec<String> {
    let mut lines = Vec::new();
    for file in files {
        let FileSummary { file: name, format, frames, used_frames, nodes, matched_by } = file;
        lines.push(format!(
            "  `{name}`, {format}: {used_frames} of {frames} states, {nodes} nodes found by {matched_by}"
        ));
    }
    for pair in rows.summaries() {
        let PairSummary { slave, master, interaction, area_source, clearance_source, .. } = pair;
        let beside = match pair.without_master {
            0 => String::new(),
            rows => format!(", {rows} without a master face"),
        };
        let nodes = counted(pair.nodes, "slave node");
        let (area, closed, open) = (number_text(pair.area), pair.closed, pair.open);
        lines.push(format!("  `{slave}` on `{master}`, interaction `{interaction}`: {nodes}, area {area}; {closed} closed, {open} open{beside}"));
        lines.push(format!("    area: {area_source}"));
        lines.push(format!("    clearance: {clearance_source}"));
    }
    for summary in rows.columns() {
        let empty = match summary.empty {
            0 => None,
            empty => Some(format!("empty in {}", counted(empty, "row"))),
        };
        let said: Vec<String> = summary.source().into_iter().chain(empty).collect();
        if !said.is_empty() {
            lines.push(format!("  {}: {}", summary.column, said.join(", ")));
        }
    }
    lines
}

fn value(rows: &NodeRows<'_>, files: &[FileSummary]) -> Value {
    let pair = |pair: &PairSummary| {
        json!({
            "slave": pair.slave.written(),
            "master": pair.master.written(),
            "interaction": pair.interaction.written(),
            "nodes": pair.nodes,
            "area": pair.area,
            "closed": pair.closed,
            "open": pair.open,
            "without_master": pair.without_master,
            "area_source": pair.area_source.to_string(),
            "clearance_source": pair.clearance_source,
        })
    };
    let columns = rows
        .columns()
        .iter()
        .map(|column| json!({ "column": column.column.to_string(), "source": column.source(), "empty": column.empty }));
    let file = |file: &FileSummary| {
        json!({
            "file": &*file.file,
            "format": file.format.to_string(),
            "states": file.frames,
            "used_states": file.used_frames,
            "nodes": file.nodes,
            "matched_by": file.matched_by.to_string(),
        })
    };
    json!({
        "rows": rows.rows(),
        "results": files.iter().map(file).collect::<Vec<_>>(),
        "pairs": rows.summaries().map(pair).collect::<Vec<_>>(),
        "columns": columns.collect::<Vec<_>>(),
    })
}
