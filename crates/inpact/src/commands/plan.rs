//! `inpact plan`: a deck and a node table in, the plan of their evaluation out.

use super::evaluable::{Evaluable, EvaluableArguments};
use super::findings::{Messages, PrintedAs, with_messages};
use super::laws::LawArguments;
use crate::failure::{Failure, Outcome};
use crate::files::{self, ResultFile};
use crate::render::Format;
use crate::settings::DeckArguments;
use clap::Args;
use inpact_diagnostics::visible::{visible, visible_json};
use inpact_evaluation::plan::{
    CharacteristicLength, ColumnRole, CurrentHeat, Cut, ElectricalPlan, FormPlan, GovernedBy, InteractionPlan, Node,
    Plan, PorePlan, SlipRateSource, Source, TablePlan, ThermalPlan, UserPlan,
};
use inpact_parser::grammar::Dialect;
use inpact_parser::model::Regime;
use serde_json::{Value, json};
use std::fmt::{self, Write as _};
use std::io::{self, Write as _};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct PlanArguments {
    #[command(flatten)]
    evaluable: EvaluableArguments,
    #[command(flatten)]
    laws: LawArguments,
    #[command(flatten)]
    reading: DeckArguments,
    /// Where to write the plan, instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// How to print the plan.
    #[arg(long, value_enum, default_value_t = PrintedAs::Text)]
    format: PrintedAs,
    /// How to print findings on standard error, instead of a line each, or of JSON with `--format json`.
    #[arg(long, value_enum, value_name = "FORMAT")]
    findings: Option<Format>,
}

pub(crate) fn run(arguments: &PlanArguments) -> Result<Outcome, Failure> {
    let findings = arguments.findings.unwrap_or(arguments.format.of_findings());
    with_messages(findings, |messages| plan(arguments, messages))
}

fn plan(arguments: &PlanArguments, messages: Messages<'_>) -> Result<Outcome, Failure> {
    let PlanArguments { evaluable, laws, reading, .. } = arguments;
    files::name_as_inputs(&evaluable.inputs());
    files::check_targets(&[arguments.output.as_deref()])?;
    let prepared = evaluable.with_threads(|| evaluable.prepare(laws, reading, messages))?;
    let Some(evaluable) = prepared else { return Ok(Outcome::HasErrors) };
    match arguments.format {
        PrintedAs::Text => {
            let mut out = VisibleText { out: ResultFile::create(arguments.output.as_deref())?, failed: None };
            let Evaluable { deck_name, nodes_name, plan, .. } = &evaluable;
            // It fails where writing does, and only there.
            let _ = write!(out, "plan for {deck_name} on {nodes_name}: {plan}");
            out.finish()?;
        }
        PrintedAs::Json => {
            files::write_result(arguments.output.as_deref(), visible_json(&as_json(&evaluable)).as_bytes())?;
        }
    }
    Ok(if evaluable.deck_has_errors { Outcome::HasErrors } else { Outcome::Clean })
}

/// Text on its way to a file, in which nothing is hidden; piece by piece, as the plan of a deck may be larger than the deck.
struct VisibleText {
    out: ResultFile,
    failed: Option<io::Error>,
}

impl fmt::Write for VisibleText {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.out.write_all(visible(text).as_bytes()).map_err(|error| {
            self.failed = Some(error);
            fmt::Error
        })
    }
}

impl VisibleText {
    fn finish(self) -> Result<(), Failure> {
        match self.failed {
            Some(error) => Err(self.out.failure(error)),
            None => self.out.finish(),
        }
    }
}

fn as_json(evaluable: &Evaluable) -> String {
    let Plan { rows, governed_by, interactions, unused, columns, outputs, .. } = &evaluable.plan;
    let columns = columns.iter().map(|column| {
        let (role, reason) = match &column.role {
            ColumnRole::Key => ("key", None),
            ColumnRole::KeyAndRead => ("key and read", None),
            ColumnRole::Read => ("read", None),
            ColumnRole::NotRead(reason) => ("left out", Some(reason.to_string())),
        };
        json!({
            "header": column.header,
            "column": column.column.map(|column| column.to_string()),
            "role": role,
            "reason": reason,
            "range": column.range.map(|(least, greatest)| [least, greatest]),
        })
    });
    let outline = evaluable.plan.outline();
    let keys = evaluable.plan.keys().iter().map(ToString::to_string);
    let document = json!({
        "schema": "inpact/plan/1",
        "deck": evaluable.deck_name,
        "nodes": evaluable.nodes_name,
        "rows": rows,
        "governed_by": match governed_by {
            GovernedBy::Chosen(_) => "choice",
            GovernedBy::TheOnlyOne(_) => "only interaction",
            GovernedBy::Column => "column",
        },
        "interactions": interactions.iter().map(interaction).collect::<Vec<_>>(),
        "unused": unused.iter().map(inpact_parser::model::Name::written).collect::<Vec<_>>(),
        "columns": columns.collect::<Vec<_>>(),
        "before": node(&outline.before),
        "after": node(&outline.after),
        "cuts": outline.cuts.iter().map(cut).collect::<Vec<_>>(),
        "outputs": keys.chain(outputs.iter().map(ToString::to_string)).collect::<Vec<_>>(),
    });
    format!("{document:#}\n")
}

/// A part of the evaluation with its estimated cost in nanoseconds per row, including its parts.
fn node(part: &Node) -> Value {
    json!({ "name": part.name, "cost": part.total(), "parts": part.parts.iter().map(node).collect::<Vec<_>>() })
}

fn cut(cut: &Cut) -> Value {
    json!({ "interaction": cut.interaction, "what": cut.what, "reason": cut.reason, "saved": cut.saved })
}

fn interaction(plan: &InteractionPlan) -> Value {
    let left_out = plan.left_out.iter();
    let left_out = left_out.map(|left_out| json!({ "what": left_out.what, "reason": left_out.reason.to_string() }));
    json!({
        "name": plan.name.written(),
        "rows": plan.rows,
        "closed": plan.closed,
        "open": plan.open,
        "histories": plan.histories,
        "electrical": plan.electrical.as_deref().map(electrical),
        "thermal": plan.thermal.as_deref().map(thermal),
        "pore": plan.pore.as_deref().map(pore),
        "outputs": plan.outputs.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "left_out": left_out.collect::<Vec<_>>(),
        "notes": plan.notes,
    })
}

fn electrical(law: &ElectricalPlan) -> Value {
    json!({
        "regime": regime(law.regime.regime),
        "reason": law.regime.to_string(),
        "tables": law.tables.iter().map(table).collect::<Vec<_>>(),
        "user": law.user.as_ref().map(user),
        "heat": law.heat.map(|heat| json!({ "fraction": heat.fraction, "slave_weight": heat.slave_weight })),
        "potential_jump": law.jump.as_ref().map(columns),
    })
}

fn thermal(law: &ThermalPlan) -> Value {
    let conduction = law.conduction.as_ref().map(|conduction| {
        json!({
            "dialect": match conduction.dialect {
                Dialect::Abaqus => "abaqus",
                Dialect::Calculix => "calculix",
            },
            "tables": conduction.tables.iter().map(table).collect::<Vec<_>>(),
        })
    });
    let radiation = law.radiation.as_ref().map(|radiation| {
        json!({
            "coefficient": radiation.coefficient,
            "absolute_zero": radiation.absolute_zero,
            "table": table(&radiation.table),
        })
    });
    let friction = law.friction.as_ref().map(|friction| {
        json!({
            "shear": friction.shear.to_string(),
            "slip_rate": match friction.slip_rate {
                SlipRateSource::Column => json!("slip_rate"),
                SlipRateSource::Given(speed) => json!(speed),
            },
        })
    });
    json!({
        "conduction": conduction,
        "radiation": radiation,
        "friction": friction,
        "heat_of_current": law.current == CurrentHeat::Generated,
        "heat": law.heat.map(|heat| json!({ "fraction": heat.fraction, "slave_weight": heat.slave_weight })),
    })
}

fn user(user: &UserPlan) -> Value {
    json!({
        "subroutine": "GAPELECTR",
        "npred": user.field_variables.len(),
        "ciname": user.names.interaction.text(),
        "slname": user.names.slave.text(),
        "msname": user.names.master.text(),
    })
}

fn pore(law: &PorePlan) -> Value {
    json!({
        "regime": regime(law.regime.regime),
        "reason": law.regime.to_string(),
        "table": law.table.as_ref().map(table),
        "cutoff_flow_across": law.cutoffs.flow_across,
        "cutoff_gap_fill": law.cutoffs.gap_fill,
        "characteristic_length": match law.characteristic_length {
            CharacteristicLength::NotNeeded => json!("not needed"),
            CharacteristicLength::Column => json!("char_length"),
            CharacteristicLength::Given(length) => json!(length),
            CharacteristicLength::Unknown => Value::Null,
        },
    })
}

fn table(table: &TablePlan) -> Value {
    let axes = table.axes.iter().map(|axis| {
        json!({
            "along": axis.along.to_string(),
            "least": axis.least,
            "greatest": axis.greatest,
            "values": axis.points,
            "used": axis.is_read(),
            "folded_at": axis.fold,
        })
    });
    json!({
        "against": table.against.to_string(),
        "rows": table.rows,
        "rows_evaluated": table.folded_rows,
        "axes": axes.collect::<Vec<_>>(),
        "accuracy": table.form.as_ref().map(form),
    })
}

/// The evaluation of a table, the bounds of its error, and the methods that were not chosen.
fn form(form: &FormPlan) -> Value {
    let refused = form.refused.iter().map(|(method, reason)| json!({ "method": method, "reason": reason }));
    json!({
        "method": form.method.to_string(),
        "bound_relative_to_largest": form.bound.map(|bound| bound.relative_to_largest),
        "bound_pointwise": form.bound.map(|bound| bound.pointwise),
        "cost": form.cost,
        "refused": refused.collect::<Vec<_>>(),
    })
}

fn regime(regime: Regime) -> &'static str {
    match regime {
        Regime::SteadyState => "steady",
        Regime::Transient => "transient",
    }
}

fn columns(source: &Source<inpact_evaluation::nodes::Column>) -> Vec<String> {
    source.cells().map(|column| column.to_string()).collect()
}
