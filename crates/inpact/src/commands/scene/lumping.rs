//! The lumping error of one temperature per terminal, and of one pressure per joint.
//!
//! A body conducts most where each terminal is isothermal, and least where its flow is uniform; a joint conducts most where both sides are isothermal
//! (the area-weighted mean of its conductances), and least where its flow is uniform (their harmonic mean). Between two held values the conductance of a network of such
//! parts scales with them: if the relative error of none exceeds a bound, nor does that of any flow. Uniform flows are taken over the part of a surface that is opposite the other.

use super::terminals::Terminal;
use super::{SAME_AREA, network_field};
use crate::commands::joule_heat::JouleHeats;
use crate::text::in_backticks;
use inpact_body::Lumped;
use inpact_contact::{Interfaces, LumpedPair, PairInterfaces};
use inpact_evaluation::law::{Clearance, ContactPoint, ContactPressure, ContactState, InterfaceLaws};
use inpact_evaluation::nodes::{Column, Part};
use inpact_evaluation::plan::Choices;
use inpact_evaluation::results::rounded_up;
use inpact_network::scene::Field;
use inpact_parser::model::Model;

pub(super) struct Lumping<'a> {
    terminals: &'a [Terminal],
    interfaces: &'a Interfaces,
    model: &'a Model,
    choices: Choices,
    pub(super) lines: Vec<String>,
    /// The largest relative error so far; `None` where one has no bound.
    worst: Option<f64>,
    /// Joints whose conductance is unknown at some nodes.
    unknown: Vec<String>,
    /// Whether there is Joule heat in bodies.
    is_heated: bool,
}

impl<'a> Lumping<'a> {
    pub(super) fn new(
        (terminals, interfaces): (&'a [Terminal], &'a Interfaces),
        (model, choices): (&'a Model, Choices),
        (lumped, heats): (&[Lumped], &JouleHeats),
    ) -> Self {
        let (lines, worst, unknown, is_heated) = (Vec::new(), Some(0.0), Vec::new(), heats.is_any());
        let mut lumping = Self { terminals, interfaces, model, choices, lines, worst, unknown, is_heated };
        for of in lumped {
            let key = network_field(of.field).conductance_key();
            for (terminal, summary) in terminals.iter().zip(&of.terminals) {
                if summary.upper <= 0.0 {
                    continue;
                }
                let cost = summary.relative();
                lumping.costs(cost);
                let (lower, upper, cost) = (summary.lower, summary.upper, percent(cost));
                lumping.lines.push(format!(
                    "`{}`: {key} conductance to the rest of its body {upper:?} at one value, {lower:?} with an even flow: at most {cost} less",
                    terminal.name
                ));
            }
            for body in of.bodies.iter().filter(|body| 2 < body.terminals.len()) {
                let names = in_backticks(body.terminals.iter().map(|at| &terminals[*at].name));
                lumping.costs(body.relative);
                lumping.lines.push(format!(
                    "the body of {names}: {key} conductances with even flows at most {} less, whatever the values of its terminals",
                    percent(body.relative)
                ));
            }
        }
        lumping.lines.extend(heats.heated.iter().cloned());
        for terminal in terminals.iter().filter(|terminal| terminal.meets_several()) {
            lumping.worst = None;
            lumping.lines.push(format!(
                "`{}`: it meets several surfaces and has one value, so that what lumping costs has no bound",
                terminal.name
            ));
        }
        lumping
    }

    /// Adds a relative error.
    fn costs(&mut self, cost: f64) {
        self.worst = self.worst.map(|worst| worst.max(cost));
    }

    /// Adds the error of a joint with one pressure, one clearance and an area.
    pub(super) fn joint(&mut self, pair: &PairInterfaces, lumped: &LumpedPair, area: f64) {
        let of_area = self.areas(pair, area);
        let varying = self.varying(pair, lumped);
        // Both belong to one conductance.
        self.costs(of_area + varying + of_area * varying);
    }

    /// The error of one pressure and one clearance; 0 where it is unknown, which is reported.
    fn varying(&mut self, pair: &PairInterfaces, lumped: &LumpedPair) -> f64 {
        let Self { interfaces, model, choices, .. } = self;
        let Some(interaction) = model.interactions.get(&pair.interaction) else { return 0.0 };
        let laws = InterfaceLaws::of(model, interaction, choices);
        let Some(thermal) = &laws.thermal else { return 0.0 };
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
            return 0.0;
        };
        let area: f64 = each.iter().map(|(area, _)| area).sum();
        let upper = each.iter().map(|(area, value)| area * value).sum::<f64>() / area;
        let lower = area / each.iter().map(|(area, value)| area / value).sum::<f64>();
        let cost = ((upper - whole).abs().max((whole - lower).abs())) / whole;
        if cost.is_finite() {
            self.lines.push(format!(
                "`{}` on `{}`: thermal conductance per area {whole:?} of the means, {upper:?} at one temperature on either side, {lower:?} with an even flow: off by at most {}",
                pair.slave,
                pair.master,
                percent(cost)
            ));
            cost
        } else {
            self.unknown.push(format!("`{}` on `{}`", pair.slave, pair.master));
            0.0
        }
    }

    /// The error of the area of a joint, by the opposite parts of both surfaces.
    fn areas(&mut self, pair: &PairInterfaces, area: f64) -> f64 {
        let mut largest = 0.0_f64;
        for name in [&pair.slave, &pair.master] {
            let Some(terminal) = self.terminals.iter().find(|terminal| terminal.name == *name) else { continue };
            if terminal.meets_several() {
                continue;
            }
            let Some(found) = terminal.area() else {
                self.worst = None;
                self.lines.push(format!(
                    "`{name}`: how much of it has the other surface across is not known, so that what lumping costs has no bound"
                ));
                continue;
            };
            let cost = (found - area).abs() / area;
            if cost < SAME_AREA {
                continue;
            }
            largest = largest.max(cost);
            self.lines.push(format!(
                "`{name}`: {found:?} of it has the other surface across, the joint has the area {area:?}: off by {}",
                percent(cost)
            ));
        }
        largest
    }

    /// The lines, and their total.
    pub(super) fn finish(self) -> Vec<String> {
        let Self { mut lines, worst, unknown, is_heated, .. } = self;
        let mut beside = Vec::new();
        if !unknown.is_empty() {
            beside.push(format!(
                "what varies over the joints {}, whose conductance is not known yet",
                unknown.join(", ")
            ));
        }
        if is_heated {
            beside.push("where in bodies the current makes its heat".to_owned());
        }
        let beside = if beside.is_empty() { String::new() } else { format!(", beside {}", beside.join(" and ")) };
        let measure = worst.map_or_else(
            || "no bound of what lumping costs".to_owned(),
            |worst| format!("off by at most {}", percent(worst)),
        );
        lines.push(format!("{} between held nodes: {measure}{beside}", flows()));
        lines
    }
}

fn flows() -> String {
    format!("{} and {}", Field::Temperature.flow_name(), Field::Potential.flow_name())
}

/// A fraction in percent, rounded up.
fn percent(share: f64) -> String {
    match 100.0 * share {
        0.0 => "0.0 %".to_owned(),
        percent @ 0.1..1e4 => format!("{:.1} %", (percent * 10.0).ceil() / 10.0),
        percent => format!("{} %", rounded_up(percent)),
    }
}
