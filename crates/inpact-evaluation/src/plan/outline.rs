//! The plan as a tree with costs, before and after simplification.

use super::cost::{COMPUTE_OUTPUT, KEEP_HISTORY, READ_NUMBER, WRITE_NUMBER};
use super::dropped::Dropped;
use super::{ColumnRole, InteractionPlan, Plan, TablePlan};
use crate::results::{Along, Output, number_text};
use std::fmt::{self, Formatter};

/// Costs of an evaluation before and after simplification, and the dropped parts.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Everything that deck and node table allow.
    pub before: Node,
    /// The tree after simplification.
    pub after: Node,
    /// The dropped parts, in the order of the tree.
    pub cuts: Vec<Cut>,
}

/// A part of an evaluation.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Its name.
    pub name: String,
    /// Its own cost, in nanoseconds for each row of the node table.
    pub cost: f64,
    /// Its parts.
    pub parts: Vec<Node>,
}

/// A dropped part.
#[derive(Debug, Clone, PartialEq)]
pub struct Cut {
    /// Its interaction; `None` for a column of the node table.
    pub interaction: Option<String>,
    /// Its name.
    pub what: String,
    /// Why it was cut.
    pub reason: String,
    /// The cost saved, in nanoseconds for each row of the node table.
    pub saved: f64,
}

impl Node {
    fn leaf(name: impl Into<String>, cost: f64) -> Self {
        Self { name: name.into(), cost, parts: Vec::new() }
    }

    /// Its cost with all its parts.
    pub fn total(&self) -> f64 {
        self.cost + self.parts.iter().map(Self::total).sum::<f64>()
    }

    fn write(&self, depth: usize, formatter: &mut Formatter<'_>) -> fmt::Result {
        let name = format!("{:indent$}{}", "", self.name, indent = 2 * depth);
        writeln!(formatter, "  {name:<64} {:>8.1}", self.total())?;
        self.parts.iter().try_for_each(|part| part.write(depth + 1, formatter))
    }
}

impl Plan {
    /// The tree of the evaluation before and after simplification.
    pub fn outline(&self) -> Outline {
        let mut outline =
            Outline { before: Node::leaf("scene", 0.0), after: Node::leaf("scene", 0.0), cuts: Vec::new() };
        self.outline_columns(&mut outline);
        for plan in &self.interactions {
            let share = if self.rows == 0 { 1.0 } else { plan.rows as f64 / self.rows as f64 };
            plan.outline(share, &mut outline);
        }
        outline
    }

    fn outline_columns(&self, outline: &mut Outline) {
        let mut before = Node::leaf("read columns", 0.0);
        let mut after = before.clone();
        for column in &self.columns {
            let node = Node::leaf(format!("`{}`", column.header), READ_NUMBER);
            match &column.role {
                ColumnRole::Key => {}
                ColumnRole::KeyAndRead | ColumnRole::Read => {
                    before.parts.push(node.clone());
                    after.parts.push(node);
                }
                ColumnRole::NotRead(reason) => {
                    before.parts.push(node);
                    outline.cuts.push(Cut {
                        interaction: None,
                        what: format!("column `{}`", column.header),
                        reason: reason.to_string(),
                        saved: READ_NUMBER,
                    });
                }
            }
        }
        outline.before.parts.push(before);
        outline.after.parts.push(after);
    }
}

impl InteractionPlan {
    /// Adds the tree of the interaction, whose rows are `share` of all.
    fn outline(&self, share: f64, outline: &mut Outline) {
        let mut before = Node::leaf(self.name.to_string(), 0.0);
        let mut after = before.clone();
        let interaction = Some(self.name.to_string());
        for (what, table) in self.tables() {
            let share = share * self.share_of(table);
            before.parts.push(Node::leaf(
                format!("{what} against {}", axes(table, |axis| axis.matters)),
                share * table.whole_cost(),
            ));
            let left = axes(table, super::AxisPlan::is_read);
            let name = if left.is_empty() { format!("{what}, a constant") } else { format!("{what} against {left}") };
            after.parts.push(Node::leaf(name, share * table.folded_cost()));
            let folds: Vec<String> = table
                .axes
                .iter()
                .filter_map(|axis| Some(format!("{} is {}", axis.along, number_text(axis.fold?))))
                .collect();
            if !folds.is_empty() {
                outline.cuts.push(Cut {
                    interaction: interaction.clone(),
                    what: format!("axes of the table of {what} against {}", table.against),
                    reason: format!("{} in every row", folds.join(", ")),
                    saved: share * (table.whole_cost() - table.folded_full_cost()),
                });
            }
            let by_form = table.folded_full_cost() - table.folded_cost();
            if let Some(form) = table.form.as_ref().filter(|_| by_form != 0.0) {
                outline.cuts.push(Cut {
                    interaction: interaction.clone(),
                    what: format!("form of the table of {what} against {}", table.against),
                    reason: format!("{} instead of full, as the accuracy asked for has it", form.method),
                    saved: share * by_form,
                });
            }
        }
        if self.has_user() {
            // Its cost cannot be reduced.
            let node = Node::leaf("conductance by GAPELECTR, whose cost is not known", 0.0);
            before.parts.push(node.clone());
            after.parts.push(node);
        }
        for Dropped { what, cost, reason } in &self.dropped {
            before.parts.push(Node::leaf(what.clone(), share * cost));
            outline.cuts.push(Cut {
                interaction: interaction.clone(),
                what: what.clone(),
                reason: reason.to_string(),
                saved: share * cost,
            });
        }
        if self.has_history() {
            let node = Node::leaf("histories", share * KEEP_HISTORY);
            before.parts.push(node.clone());
            after.parts.push(node);
        }
        let given = Node::leaf(format!("give {}", names(&self.outputs)), share * cost_of(&self.outputs));
        before.parts.push(given.clone());
        after.parts.push(given);
        outline.before.parts.push(before);
        outline.after.parts.push(after);
    }

    /// The share of the interaction's rows that read a table.
    fn share_of(&self, table: &TablePlan) -> f64 {
        let conduction = self.thermal.iter().flat_map(|law| &law.conduction).map(|part| &part.tables);
        let mut of_conductance = self.electrical.iter().map(|law| &law.tables).chain(conduction);
        let Some(tables) = of_conductance.find(|tables| tables.contains(table)) else { return 1.0 };
        match table.against {
            _ if tables.len() < 2 || self.rows == 0 => 1.0,
            Along::Pressure => self.closed as f64 / self.rows as f64,
            _ => self.open as f64 / self.rows as f64,
        }
    }
}

/// Costs of outputs: to compute and to write.
pub(crate) fn cost_of(outputs: &[Output]) -> f64 {
    outputs.len() as f64 * (COMPUTE_OUTPUT + WRITE_NUMBER)
}

/// The names of outputs, separated by blanks.
fn names(outputs: &[Output]) -> String {
    let names: Vec<String> = outputs.iter().map(ToString::to_string).collect();
    names.join(" ")
}

/// The axes of a table that fulfil a condition, with their sizes.
fn axes(table: &TablePlan, is_there: impl Fn(&super::AxisPlan) -> bool) -> String {
    let axes = table.axes.iter().filter(|axis| is_there(axis));
    let axes: Vec<String> = axes.map(|axis| format!("{} ({})", axis.along, axis.points)).collect();
    axes.join(", ")
}

impl fmt::Display for Outline {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        writeln!(formatter, "before, about so many ns a row on one core (a cost model, not a measurement)")?;
        self.before.write(0, formatter)?;
        writeln!(formatter, "\nafter")?;
        self.after.write(0, formatter)?;
        if self.cuts.is_empty() {
            return writeln!(formatter, "\nnothing was cut: the scene requires all of it");
        }
        writeln!(formatter, "\ncut")?;
        for Cut { interaction, what, reason, saved } in &self.cuts {
            let of = interaction.as_ref().map_or_else(String::new, |interaction| format!("{interaction}: "));
            writeln!(formatter, "  {saved:>8.1}  {of}{what}: {reason}")?;
        }
        Ok(())
    }
}
