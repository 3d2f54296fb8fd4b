//! Uses of the interactions: surfaces, contact pairs, property assignments, procedures (section 9); and the physical constants of the deck.

use super::Reader;
use super::entry::{Entry, take};
use crate::grammar::Level;
use crate::model::{ContactPair, Procedure, PropertyAssignment, SubOption, Surface, SurfacePair};

impl Reader<'_> {
    pub(super) fn read_surface(&mut self, option: Entry<'_>) {
        let value = option.parameter("NAME").and_then(|parameter| parameter.value);
        if let Some(name) = value.and_then(|value| self.reference(value)) {
            self.model.surfaces.push(Surface { span: option.keyword.visible_span(self.deck), name });
        }
    }

    pub(super) fn read_contact_pair(&mut self, option: Entry<'_>) {
        self.check_level(option);
        let interaction = option.parameter("INTERACTION").and_then(|parameter| parameter.value);
        let mut parameters = self.given_parameters(option);
        take(&mut parameters, "INTERACTION");
        let pairs = self.deck.data_lines(option.block).filter_map(|line| {
            let mut items = line.items();
            let slave = self.reference(items.next()?)?;
            Some(SurfacePair { slave, master: items.next().and_then(|item| self.reference(item)) })
        });
        let pair = ContactPair {
            span: option.keyword.visible_span(self.deck),
            interaction: interaction.and_then(|value| self.reference(value)),
            parameters: parameters.into(),
            pairs: pairs.collect(),
        };
        self.model.contact_pairs.push(pair);
    }

    pub(super) fn read_property_assignments(&mut self, option: Entry<'_>) {
        for line in self.deck.data_lines(option.block).filter(|line| !line.is_blank()) {
            let mut items = line.items();
            let mut next = || items.next().and_then(|item| self.reference(item));
            let assignment = PropertyAssignment { span: line.span, first: next(), second: next(), interaction: next() };
            self.model.property_assignments.push(assignment);
        }
    }

    /// The constants of *PHYSICAL CONSTANTS; a later one keeps those it does not give (2.6).
    pub(super) fn read_constants(&mut self, option: Entry<'_>) {
        let given = [self.float_of(option, "ABSOLUTE ZERO"), self.float_of(option, "STEFAN BOLTZMANN")];
        let constants = &mut self.model.constants;
        constants.absolute_zero = given[0].or(constants.absolute_zero);
        constants.stefan_boltzmann = given[1].or(constants.stefan_boltzmann);
    }

    pub(super) fn read_procedure(&mut self, option: Entry<'_>) {
        self.explicit |= option.is_given("EXPLICIT");
        let in_step = self.levels.iter().any(|(level, _)| *level == Level::Step);
        let step = if in_step { self.steps } else { 0 };
        let rows = self.texts(option.block);
        let option = SubOption { rows, table: None, ..self.generic(option) };
        self.model.procedures.push(Procedure { step, option });
    }
}
