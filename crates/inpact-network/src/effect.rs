//! Contradictions in a scene, and values in it without effect: temperatures below absolute zero, friction that cools, numbers that no law reads.

use crate::interface::Contact;
use crate::problem::Problem;
use crate::scene::{Course, Field, Procedure, SceneInterface, UNUSABLE_NUMBER};
use inpact_evaluation::law::{ContactState, contradicts};
use inpact_evaluation::nodes::{CONTRADICTORY_RATE, Findings, Place};

impl Problem<'_> {
    /// Reports temperatures that are given below absolute zero.
    pub(crate) fn check_temperatures(&self, findings: &mut Findings) {
        let Some(zero) = self.absolute_zero else { return };
        let scene = self.scene;
        let conditions = scene.conditions(Field::Temperature);
        let fixed =
            conditions.fixed.iter().flat_map(|(node, course)| course.values().map(|value| (*node, "fixed", value)));
        let initial = conditions.initial.iter().map(|(node, value)| (*node, "initial", *value));
        let help = "mend the temperature, or ABSOLUTE ZERO of *PHYSICAL CONSTANTS: both are of one scale";
        for (node, key, value) in fixed.chain(initial).filter(|(.., value)| *value < zero) {
            let place = Place { line: scene.node_lines.get(&node).copied(), ..Place::default() };
            let name = &scene.nodes[node as usize];
            let message = format!("`{key}` of `temperature` of `{name}` is {value:?}, below absolute zero at {zero:?}");
            findings.report(&UNUSABLE_NUMBER, place, message, help);
        }
        if let Some(value) = scene.initial_temperature.filter(|value| *value < zero) {
            let message = format!("`initial.temperature` is {value:?}, below absolute zero at {zero:?}");
            findings.report(&UNUSABLE_NUMBER, Place::default(), message, help);
        }
    }

    /// Reports shear and slip rate of opposite signs: frictional dissipation is never negative.
    pub(crate) fn check_friction(&self, findings: &mut Findings) {
        for (_, row, laws) in self.rows_of(Field::Temperature) {
            let Some(source) = laws.friction.filter(|source| !source.takes_magnitudes) else { continue };
            let Some((shear, slip_rate)) = row.shear.zip(source.slip_rate.or(row.slip_rate)) else { continue };
            if (shear < 0.0 && 0.0 < slip_rate) || (0.0 < shear && slip_rate < 0.0) {
                let message = format!(
                    "`shear` of {} is {shear:?} and its slip rate {slip_rate:?}: friction of opposite signs would cool",
                    self.label(row)
                );
                let (place, message) = row.located(message);
                findings.report(&UNUSABLE_NUMBER, place, message, "give both along one direction, or their magnitudes");
            }
        }
    }

    /// Reports given rates of a clearance that differ from its time course by more than 1 % (O-5, D021): the rate is used for gap filling.
    pub(crate) fn check_rates(&self, findings: &mut Findings) {
        let Procedure::Transient(span) = self.scene.procedure else { return };
        for (_, row, _) in self.rows_of(Field::PorePressure) {
            let Some((course, given)) = row.clearance.as_ref().zip(row.clearance_rate) else { continue };
            let inside = course.corners().filter(|time| span.start < *time && *time < span.end);
            let times: Vec<f64> = [span.start].into_iter().chain(inside).chain([span.end]).collect();
            let rates = times
                .windows(2)
                .map(|ends| ([ends[0], ends[1]], (course.at(ends[1]) - course.at(ends[0])) / (ends[1] - ends[0])));
            let Some(([from, to], rate)) = rates.into_iter().find(|(_, rate)| contradicts(given, *rate)) else {
                continue;
            };
            let message = format!(
                "`clearance_rate` of {} is {given:?}, and its clearance changes at {rate:?} from time {from:?} to {to:?}",
                self.label(row)
            );
            let (place, message) = row.located(message);
            let help = "the gap fills at the rate that is given: mend it, or leave it out so that it follows from the clearance";
            findings.report(&CONTRADICTORY_RATE, place, message, help);
        }
    }

    /// Notes values without effect.
    pub(crate) fn note_without_effect(&mut self) {
        let mut notes = Vec::new();
        let mut note = |count: usize, what: &str, one: &str, why: &str| {
            if count > 0 {
                let plural = if count == 1 { "" } else { "s" };
                notes.push(format!("{what} of {count} {one}{plural}: {why}"));
            }
        };
        for field in self.solved_fields() {
            let conditions = self.scene.conditions(field);
            let key = format!("`initial` of `{}`", field.key());
            let held = |node: &&u32| conditions.fixed.contains_key(node);
            let count = conditions.initial.keys().filter(held).count();
            note(count, &key, "node", "its value is fixed");
            if self.scene.is_transient() {
                let stores = |node: &u32| conditions.capacities.get(node).is_some_and(|capacity| *capacity > 0.0);
                let free = conditions.initial.keys().filter(|node| !held(node) && !stores(node)).count();
                note(
                    free,
                    &key,
                    "node",
                    "without a capacity it has no value of its own at the start, and is only a first guess",
                );
            }
        }
        let rows = &self.scene.interfaces;
        let is_pressed = |row: &&SceneInterface| {
            row.closed == Some(false) && row.pressure.as_ref().is_some_and(|of| of.values().any(|value| value != 0.0))
        };
        note(rows.iter().filter(is_pressed).count(), "`pressure`", "interface", "`closed = false` has the say over it");
        let rubs = |row: &usize| {
            let of = &rows[*row];
            let tells =
                self.laws_of(*row).is_some_and(|laws| laws.friction.is_some() && laws.heat_generation.is_some());
            tells && of.shear.is_some() && self.stays_open(of)
        };
        let apart = (0..rows.len()).filter(rubs).count();
        note(apart, "heat of friction", "interface", "it is open, and what does not touch does not rub");
        let one_sided = |row: &&SceneInterface| {
            let [slave, master] = row.bulk_permeabilities;
            let pore = self.field(Field::PorePressure);
            slave.is_some() != master.is_some()
                && pore.is_some_and(|of| row.nodes().into_iter().all(|node| of.carries(node)))
        };
        let count = rows.iter().filter(one_sided).count();
        note(
            count,
            "`perm_s` or `perm_m`",
            "interface",
            "one without the other leaves the gap's fluid shared half and half",
        );
        let unread = (0..rows.len()).filter(|row| self.has_unread_fields(*row)).count();
        note(unread, "`fv`", "interface", "no law that is evaluated depends on it");
        self.left_out.extend(notes);
    }

    /// Whether a row is open at all times.
    fn stays_open(&self, row: &SceneInterface) -> bool {
        let corners = row.clearance.iter().chain(&row.pressure).flat_map(Course::corners);
        let is_open = |time: f64| Contact::of(row, time).is_some_and(|contact| contact.state == ContactState::Open);
        std::iter::once(self.start()).chain(corners).all(is_open)
    }

    /// Whether a row has field variables that no law of a field crossing it reads.
    fn has_unread_fields(&self, row: usize) -> bool {
        let of = &self.scene.interfaces[row];
        let Some(laws) = self.laws_of(row).filter(|_| of.field_variables.iter().any(|value| !value.is_nan())) else {
            return false;
        };
        if matches!(laws.electrical, Some(inpact_evaluation::law::ElectricalSource::User(..))) {
            return false;
        }
        let reads = |field: Field| {
            let crosses = self.field(field).is_some_and(|nodes| nodes.rows.iter().any(|&other| other as usize == row));
            crosses && !Self::dependence(of, laws, field, self.start()).fields.is_empty()
        };
        !Field::ALL.into_iter().any(reads)
    }
}
