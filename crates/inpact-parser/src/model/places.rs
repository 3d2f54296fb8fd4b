//! A model without its source locations, to compare decks by meaning.

use super::{GivenParameter, Interaction, Model, Reference, SubOption, Table};
use crate::span::Span;

impl Model {
    /// The model without source locations and without options set aside, to compare decks by meaning.
    ///
    /// *SURFACE definitions are left out as well: their rows name sets of a mesh, which a model does not hold.
    #[must_use]
    pub fn without_places(&self) -> Self {
        let mut model = self.clone();
        model.set_aside.clear();
        model.surfaces.clear();
        model.parameters.forget_places();
        model.interactions.for_each_mut(Interaction::forget_places);
        for pair in &mut model.contact_pairs {
            pair.span = Span::default();
            pair.parameters.iter_mut().for_each(GivenParameter::forget_place);
            let surfaces = pair.pairs.iter_mut().flat_map(|pair| [Some(&mut pair.slave), pair.master.as_mut()]);
            surfaces.flatten().chain(pair.interaction.as_mut()).for_each(Reference::forget_place);
        }
        for assignment in &mut model.property_assignments {
            assignment.span = Span::default();
            let references = [&mut assignment.first, &mut assignment.second, &mut assignment.interaction];
            references.into_iter().flatten().for_each(Reference::forget_place);
        }
        model.procedures.iter_mut().for_each(|procedure| procedure.option.forget_places());
        model
    }
}

impl Interaction {
    fn forget_places(&mut self) {
        self.span = Span::default();
        self.parameters.iter_mut().for_each(GivenParameter::forget_place);
        if let Some(law) = &mut self.gap_electrical_conductance {
            law.user = law.user.map(|_| Span::default());
            [&mut law.clearance, &mut law.pressure].into_iter().flatten().for_each(|table| table.forget_places());
        }
        if let Some(permeability) = &mut self.contact_permeability {
            permeability.span = Span::default();
            permeability.table.iter_mut().for_each(Table::forget_places);
        }
        if let Some(heat) = &mut self.gap_heat_generation {
            (heat.span, heat.row) = (Span::default(), None);
        }
        self.other.iter_mut().for_each(SubOption::forget_places);
    }
}

impl SubOption {
    fn forget_places(&mut self) {
        self.span = Span::default();
        self.parameters.iter_mut().for_each(GivenParameter::forget_place);
        self.table.iter_mut().for_each(|table| table.forget_places());
    }
}

impl GivenParameter {
    fn forget_place(&mut self) {
        self.span = Span::default();
    }
}

impl Reference {
    fn forget_place(&mut self) {
        self.span = Span::default();
    }
}
