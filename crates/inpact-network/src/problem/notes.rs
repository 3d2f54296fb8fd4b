//! Findings and notes on a problem: missing quantities, unknown interactions, parts that are left out.

use super::{Problem, field_of};
use crate::interface::Contact;
use crate::scene::nearest::meant_or;
use crate::scene::{Course, Field, MISSING_QUANTITY, Scene, SceneInterface};
use inpact_evaluation::nodes::{Findings, Place, UNKNOWN_INTERACTION};
use inpact_parser::model::{Model, Name};

impl Problem<'_> {
    /// Reports each row that lacks an input of its laws.
    pub(super) fn check_rows(&self, findings: &mut Findings) {
        for field in Field::ALL {
            for (_, row, laws) in self.rows_of(field) {
                let needs = Self::dependence(row, laws, field, self.start());
                let mut missing: Vec<String> = Vec::new();
                let mut need = |is_needed: bool, is_there: bool, what: &str| {
                    if is_needed && !is_there {
                        missing.push(format!("`{what}`"));
                    }
                };
                let corners = row.pressure.iter().flat_map(Course::corners);
                let is_known = |time: f64| Contact::of(row, time).is_some();
                need(true, is_known(self.start()) && corners.into_iter().all(is_known), "clearance");
                need(needs.clearance, row.clearance.is_some(), "clearance");
                need(needs.pressure, row.pressure.is_some(), "pressure");
                need(needs.mass_flow, row.mass_flow.is_some(), "mass_flow");
                let knows_temperature =
                    self.receives_heat(row) || row.temperature.is_some() || self.scene.initial_temperature.is_some();
                need(needs.temperature, knows_temperature, "temperature");
                for number in &needs.fields {
                    let is_given = row.field_variables.get(number - 1).is_some_and(|value| !value.is_nan());
                    need(true, is_given, &format!("fv{number}"));
                }
                missing.dedup();
                if !missing.is_empty() {
                    let message = format!(
                        "{} lacks {}, which its {} depends on",
                        self.label(row),
                        missing.join(", "),
                        match field {
                            Field::Potential => "electrical conductance",
                            Field::Temperature => "thermal conductance",
                            Field::PorePressure => "pore fluid flow",
                        }
                    );
                    report_row(row, findings, &message, "give it in the scene");
                }
            }
        }
    }

    /// Reports rows with a law that cannot be evaluated: without it the interface would silently be sealed.
    pub(super) fn check_laws(&self, findings: &mut Findings) {
        for (row, of) in self.scene.interfaces.iter().enumerate() {
            let left_out = self.laws_of(row).map_or(&[][..], |laws| &laws.left_out);
            for (flow, left) in left_out {
                let field = field_of(*flow);
                let Some(nodes) = self.field(field) else { continue };
                if of.nodes().into_iter().any(|node| nodes.carries(node)) {
                    let message =
                        format!("the {} of {} cannot be evaluated: {}", left.what, self.label(of), left.reason);
                    report_row(of, findings, &message, "give what it needs, or leave the interface out of the scene");
                }
            }
        }
    }

    /// Reports nodes with a capacity but without an initial value.
    pub(super) fn check_initial(&self, findings: &mut Findings) {
        if !self.scene.is_transient() {
            return;
        }
        for field in self.solved_fields() {
            let conditions = self.scene.conditions(field);
            let of_all = match field {
                Field::PorePressure => self.scene.initial_pore_pressure,
                _ => self.scene.initial_temperature,
            };
            let stores = conditions.capacities.iter().filter(|(_, capacity)| **capacity > 0.0).map(|(node, _)| node);
            for node in stores.filter(|node| of_all.is_none() && !conditions.initial.contains_key(node)) {
                let name = &self.scene.nodes[*node as usize];
                let place = Place { line: self.scene.node_lines.get(node).copied(), ..Place::default() };
                let message = format!("`{name}` has a capacity, and nothing says at which {field} it begins");
                let help =
                    format!("give `initial` beside its capacity, or `{}` under `[initial]` for all nodes", field.key());
                findings.report(&MISSING_QUANTITY, place, message, help);
            }
        }
    }

    /// Notes heat and fluid at nodes that do not carry the field.
    pub(super) fn note_one_sided(&mut self) {
        let [temperature, pore] = [Field::Temperature, Field::PorePressure].map(|field| self.field(field));
        let impermeable = self.scene.interfaces.iter().enumerate().filter(|(row, of)| {
            let has_law = self.laws_of(*row).is_some_and(|laws| laws.pore.is_some());
            let carries = pore.filter(|_| has_law).map(|pore| of.nodes().map(|node| pore.carries(node)));
            carries.is_some_and(|[slave, master]| slave != master)
        });
        let impermeable = impermeable.count();
        let loses = |nodes: [u32; 2], shares: [f64; 2]| {
            let loses = |(node, share)| share > 0.0 && temperature.is_some_and(|of| !of.carries(node));
            nodes.into_iter().zip(shares).any(loses)
        };
        let heated = self.rows_of(Field::Potential).filter(|(_, of, laws)| {
            let heat = laws.heat_generation.filter(|heat| heat.fraction > 0.0);
            heat.is_some_and(|heat| loses(of.nodes(), [heat.slave_weight, 1.0 - heat.slave_weight]))
        });
        let rubbed = (0..self.scene.interfaces.len())
            .filter(|&row| loses(self.scene.interfaces[row].nodes(), self.friction(row, self.start())));
        let links = self.field(Field::Potential).map_or(&[][..], |of| &of.links);
        let heated_links = links.iter().filter(|&&link| {
            let of = &self.scene.links[link as usize];
            of.joule_heat_fraction > 0.0 && loses(of.nodes, [0.5; 2])
        });
        let counts = [
            (impermeable, "interface", "pore fluid across", "one side carries no pore pressure (P-01)"),
            (heated.count(), "interface", "a share of the heat of currents in", "its node carries no temperature"),
            (rubbed.count(), "interface", "a share of the heat of friction in", "its node carries no temperature"),
            (heated_links.count(), "link", "a share of the heat of currents in", "its node carries no temperature"),
        ];
        for (count, of, what, why) in counts.into_iter().filter(|(count, ..)| *count > 0) {
            let plural = if count == 1 { "" } else { "s" };
            self.left_out.push(format!("{what} {count} {of}{plural}: {why}"));
        }
    }

    /// Notes the heat of friction of which rows give only a part, and slip rates that the deck determines.
    pub(super) fn note_friction(&mut self) {
        let (mut without, mut overruled) = ([0; 2], 0);
        for (_, row, laws) in self.rows_of(Field::Temperature) {
            let Some(source) = laws.friction else { continue };
            let slip_rate = source.slip_rate.or(row.slip_rate);
            without[0] += usize::from(row.shear.is_none() && slip_rate.is_some());
            without[1] += usize::from(row.shear.is_some() && slip_rate.is_none());
            overruled += usize::from(source.slip_rate.is_some() && row.slip_rate.is_some());
        }
        let of = |count: usize| format!("{count} interface{}", if count == 1 { "" } else { "s" });
        for (count, key) in without.into_iter().zip(["shear", "slip_rate"]).filter(|(count, _)| *count > 0) {
            self.left_out.push(format!("heat of friction of {}: `{key}` is missing", of(count)));
        }
        if overruled > 0 {
            self.left_out.push(format!("`slip_rate` of {}: the deck gives the speed of slip", of(overruled)));
        }
    }
}

fn report_row(row: &SceneInterface, findings: &mut Findings, message: &str, help: &str) {
    let (place, message) = row.located(message.to_owned());
    findings.report(&MISSING_QUANTITY, place, message, help);
}

/// The interaction of a row, by its index in the model.
pub(super) fn interaction_of(row: &SceneInterface, model: &Model) -> Option<usize> {
    match &row.interaction {
        Some(name) => model.interactions.get_index_of(name),
        None => (model.interactions.len() == 1).then_some(0),
    }
}

/// Reports the interfaces of a scene whose interaction the deck does not define; the scene may have errors of its own.
pub fn report_unknown_interactions(scene: &Scene, model: &Model, findings: &mut Findings) {
    for row in scene.interfaces.iter().filter(|row| interaction_of(row, model).is_none()) {
        report_unknown(row, model, findings);
    }
}

fn report_unknown(row: &SceneInterface, model: &Model, findings: &mut Findings) {
    let names: Vec<String> = model.interactions.keys().take(8).map(|name| format!("`{name}`")).collect();
    let message = match &row.interaction {
        Some(name) => format!("the deck defines no interaction `{name}`"),
        None => format!("`interaction` is missing, and the deck has {} interactions", model.interactions.len()),
    };
    let (place, message) = row.located(message);
    let listed = format!("its interactions are {}", names.join(", "));
    let help = match &row.interaction {
        Some(name) => meant_or(name.canonical(), model.interactions.keys().map(Name::canonical), &listed),
        None => listed,
    };
    findings.report(&UNKNOWN_INTERACTION, place, message, help);
}
