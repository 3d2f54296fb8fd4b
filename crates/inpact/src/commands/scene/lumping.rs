//! The cost of one temperature a terminal, and of one pressure a joint.
//!
//! A body conducts most where each terminal has one temperature, and least where its flow is spread evenly; a joint conducts most where both sides have one
//! temperature (the mean of its conductances by area), and least where its flow is spread evenly (their harmonic mean). Between held nodes a network of such parts
//! scales with them: if none is off by more than a share, no flow is.

use super::network_field;
use super::terminals::Terminal;
use inpact_body::Lumped;
use inpact_contact::{Interfaces, LumpedPair, PairInterfaces};
use inpact_evaluation::law::{Clearance, ContactPoint, ContactPressure, ContactState, InterfaceLaws};
use inpact_evaluation::nodes::{Column, Part};
use inpact_evaluation::plan::Choices;
use inpact_evaluation::results::rounded_up;
use inpact_network::scene::Field;
use inpact_parser::model::Model;

/// Areas that differ by less are the same but for rounding.
const ROUNDING: f64 = 1e-9;

pub(super) struct Lumping {
    pub(super) lines: Vec<String>,
    /// The largest relative cost so far.
    worst: f64,
    /// Whether an estimate is among the costs: areas of two sides that differ have no bound.
    is_estimate: bool,
    /// Joints whose conductance is not known at all nodes.
    unknown: Vec<String>,
}

impl Lumping {
    pub(super) fn new(terminals: &[Terminal], lumped: &[Lumped]) -> Self {
        let mut lumping = Self { lines: Vec::new(), worst: 0.0, is_estimate: false, unknown: Vec::new() };
        for of in lumped {
            let key = network_field(of.field).conductance_key();
            for (terminal, summary) in terminals.iter().zip(&of.terminals) {
                if summary.upper <= 0.0 {
                    continue;
                }
                let cost = summary.relative();
                lumping.worst = lumping.worst.max(cost);
                let (lower, upper, cost) = (summary.lower, summary.upper, percent(cost));
                lumping.lines.push(format!(
                    "`{}`: {key} conductance to the rest of its body {upper:?} at one value, {lower:?} with an even flow: at most {cost} less",
                    terminal.name
                ));
            }
        }
        lumping
    }

    /// Takes the cost of a joint with one pressure and one clearance.
    pub(super) fn joint(
        &mut self,
        model: &Model,
        choices: &Choices,
        interfaces: &Interfaces,
        (pair, lumped): (&PairInterfaces, &LumpedPair),
    ) {
        let Some(interaction) = model.interactions.get(&pair.interaction) else { return };
        let laws = InterfaceLaws::of(model, interaction, choices);
        let Some(thermal) = &laws.thermal else { return };
        let at = |values: &dyn Fn(usize) -> Option<f64>| {
            let of =
                |column: Column| interfaces.quantities.iter().position(|quantity| *quantity == column).and_then(values);
            let (clearance, pressure) = (of(Column::Clearance), of(Column::Pressure));
            let state = ContactState::of(None, clearance, pressure)?;
            let fields = (1..=u32::from(u8::MAX)).map(|number| of(Column::FieldVariable(number, Part::Both)));
            let fields = fields.take_while(Option::is_some).flatten();
            let temperature = of(Column::Temperature(Part::Both)).unwrap_or(f64::NAN);
            let variables: Vec<f64> = [temperature, 0.0].into_iter().chain(fields).collect();
            let point = ContactPoint {
                clearance: Clearance(clearance.unwrap_or(f64::NAN)),
                pressure: ContactPressure(pressure.unwrap_or(f64::NAN)),
                state,
                variables: &variables,
            };
            Some(thermal.conductance(&point).value).filter(|value| value.is_finite())
        };
        let whole = at(&|quantity| lumped.means[quantity].map(|mean| mean.mean));
        let each: Option<Vec<(f64, f64)>> =
            pair.rows.iter().map(|row| Some((row.area, at(&|quantity| row.values[quantity])?))).collect();
        let (Some(whole), Some(each)) = (whole, each) else {
            self.unknown.push(format!("`{}` on `{}`", pair.slave, pair.master));
            return;
        };
        let area: f64 = each.iter().map(|(area, _)| area).sum();
        let upper = each.iter().map(|(area, value)| area * value).sum::<f64>() / area;
        let lower = area / each.iter().map(|(area, value)| area / value).sum::<f64>();
        let cost = ((upper - whole).abs().max((whole - lower).abs())) / whole;
        if cost.is_finite() {
            self.worst = self.worst.max(cost);
            self.lines.push(format!(
                "`{}` on `{}`: thermal conductance per area {whole:?} of the means, {upper:?} at one temperature on either side, {lower:?} with an even flow: off by at most {}",
                pair.slave,
                pair.master,
                percent(cost)
            ));
        } else {
            self.unknown.push(format!("`{}` on `{}`", pair.slave, pair.master));
        }
    }

    /// Takes the cost of a joint whose sides do not end where the other does: the faces of the bodies that meet have other areas than the joint.
    pub(super) fn areas(&mut self, lumped: &[Lumped], (pair, of): (&PairInterfaces, &LumpedPair)) {
        for bodies in lumped {
            for name in [&pair.slave, &pair.master] {
                let Some(terminal) = bodies.terminals.iter().find(|terminal| terminal.name == *name) else { continue };
                let cost = terminal.area.map_or(1.0, |area| (area - of.area).abs() / of.area.min(area));
                if cost < ROUNDING {
                    continue;
                }
                self.worst = self.worst.max(cost);
                self.is_estimate = true;
                let line = match terminal.area {
                    Some(area) => format!(
                        "`{name}`: its whole faces in the joint have the area {area:?}, the joint has {:?}: off by about {}",
                        of.area,
                        percent(cost)
                    ),
                    None => format!(
                        "`{name}`: no whole face of it is in the joint, so that what lumping costs has no bound"
                    ),
                };
                // Areas are the same for heat and current.
                if !self.lines.contains(&line) {
                    self.lines.push(line);
                }
            }
        }
    }

    /// The lines, and what they come to.
    pub(super) fn finish(self) -> Vec<String> {
        let Self { mut lines, worst, is_estimate, unknown } = self;
        let beside = if unknown.is_empty() {
            String::new()
        } else {
            format!(", beside what varies over the joints {}, whose conductance is not known yet", unknown.join(", "))
        };
        let areas = if is_estimate { ", where differences of areas are estimates and no bounds" } else { "" };
        lines.push(format!("{} between held nodes: off by at most {}{areas}{beside}", flows(), percent(worst)));
        lines
    }
}

fn flows() -> String {
    format!("{} and {}", Field::Temperature.flow_name(), Field::Potential.flow_name())
}

/// A share in percent, never smaller than it is.
fn percent(share: f64) -> String {
    match 100.0 * share {
        0.0 => "0.0 %".to_owned(),
        percent @ 0.1..1e4 => format!("{:.1} %", (percent * 10.0).ceil() / 10.0),
        percent => format!("{} %", rounded_up(percent)),
    }
}
