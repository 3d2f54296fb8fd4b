//! *SURFACE INTERACTION and the sub-options in its block (2.1 to 2.5).

use super::Reader;
use super::entry::Entry;
use crate::deck::{DataLine, KeywordLine};
use crate::expression::substitute;
use crate::grammar::{Dialect, KeywordId, RowShape};
use crate::model::rows::substitution_problem;
use crate::model::{
    CellText, ConstraintMethod, ContactPermeability, ElectricalConductance, HeatGeneration, Interaction, Name,
    OptionKind, SetAside, SetAsideItem, SetAsideReason, Table,
};
use crate::number::{read_float, read_integer};
use crate::problem::{Problem, ProblemKind};
use crate::span::Span;

impl Reader<'_> {
    pub(super) fn open_interaction(&mut self, option: Entry<'_>) {
        self.close_interaction(Some(option.keyword.span));
        self.check_level(option);
        self.parent = Some(option.id);
        let mut parameters = self.given_parameters(option);
        // Of several names CalculiX uses the first (surfaceinteractions.f), Abaqus the last.
        let named = match self.grammar.dialect() {
            Dialect::Abaqus => option.parameter("NAME"),
            Dialect::Calculix => option.first_parameter("NAME"),
        };
        parameters.retain(|parameter| named.is_none_or(|named| named.span() != parameter.span));
        // Without a name nothing can refer to it, yet its tables are checked (K006).
        let name = named.and_then(|named| named.value).map(|value| self.value_text(value)).unwrap_or_default();
        let name = Name::in_dialect(&name, self.grammar.dialect());
        let mut interaction = Interaction::new(name, option.keyword.visible_span(self.deck));
        let is_user = parameters.iter().any(|parameter| parameter.name == "USER");
        interaction.parameters = parameters.into();
        // CalculiX interprets no row here.
        if option.definition.rows() != RowShape::Items {
            self.read_interaction_rows(option, is_user, &mut interaction);
        }
        self.interaction = Some(interaction);
    }

    /// The thickness on the first line; with USER the properties on the further ones (K-01, K-02), in Explicit on all (K-03).
    pub(super) fn read_interaction_rows(&mut self, option: Entry<'_>, is_user: bool, interaction: &mut Interaction) {
        let constants = if is_user { 8 } else { 0 };
        let has_thickness = !(is_user && self.rows_are_properties(option));
        let mut properties = Vec::new();
        for (index, line) in self.deck.data_lines(option.block).enumerate() {
            let is_thickness = has_thickness && index == 0;
            let allowed = if is_thickness { 1 } else { constants };
            let given = line.items().filter(|item| !item.is_empty()).count();
            if given > allowed {
                let kind = ProblemKind::TooManyItems { allowed, given, lines: 1 };
                self.problems.push(Problem { kind, span: line.span, keyword: option.keyword.span });
            }
            let used = line.items().collect::<Vec<_>>();
            let used = used.iter().rposition(|item| !item.is_empty()).map_or(0, |last| last + 1);
            for item in line.items().take(used.min(allowed)) {
                if item.is_empty() {
                    // The default of the thickness stays; a property that is left out is zero (S-32).
                    properties.extend((!is_thickness).then_some(0.0));
                    continue;
                }
                let text = match substitute(&self.deck.shown(item), &self.model.parameters) {
                    Ok(text) => text.into_owned(),
                    Err(error) => {
                        let keyword = option.keyword.span;
                        self.problems.extend(substitution_problem(&error, &self.model.parameters, item, keyword));
                        continue;
                    }
                };
                match read_float(text.trim().as_bytes()) {
                    Ok(value) if is_thickness => interaction.thickness = value,
                    Ok(value) => properties.push(value),
                    Err(error) => {
                        let column = if is_thickness { "thickness" } else { "property" }.to_owned();
                        let kind = ProblemKind::MalformedNumber { error, column };
                        self.problems.push(Problem { kind, span: item, keyword: option.keyword.span });
                    }
                }
            }
        }
        interaction.properties = properties.into();
        self.count_properties(option, is_user);
    }

    /// Compares PROPERTIES=n with the number of values (K-02, K-03).
    fn count_properties(&mut self, option: Entry<'_>, is_user: bool) {
        let stated = match self.value_of(option, "PROPERTIES") {
            None => Some(0),
            Some(value) => read_integer(value.as_bytes()).ok().and_then(|number| usize::try_from(number).ok()),
        };
        let Some(stated) = stated.filter(|_| is_user) else { return };
        let lines = self.deck.data_lines(option.block).skip(usize::from(!self.rows_are_properties(option)));
        let lines: Vec<_> = lines.collect();
        let given = lines.iter().flat_map(DataLine::items).filter(|item| !item.is_empty()).count();
        // An empty item in the middle is a value of zero (S-32), so that the last one may be one of those stated.
        let positions = lines.iter().enumerate().filter_map(|(index, line)| {
            let last = line.items().enumerate().filter(|(_, item)| !item.is_empty()).last()?.0;
            Some(8 * index + last + 1)
        });
        let reached = positions.max().unwrap_or(0).max(given);
        if reached != stated {
            let span = lines.last().map_or(option.keyword.visible_span(self.deck), |line| line.span);
            let kind = ProblemKind::PropertyCount { stated, given: reached };
            self.problems.push(Problem { kind, span, keyword: option.keyword.span });
        }
    }

    /// Whether the rows are those of Explicit: the subroutine is VUINTERACTION, or a step of the deck is Explicit (K-03).
    fn rows_are_properties(&self, option: Entry<'_>) -> bool {
        self.has_explicit_step || option.parameter("USER").is_some_and(|user| user.value.is_some())
    }

    pub(super) fn leave_interaction(&mut self, id: KeywordId, keyword: &KeywordLine) {
        // CalculiX collects the sub-options of an interaction anywhere (CX-09).
        if self.grammar.dialect() == Dialect::Calculix {
            self.parent = Some(id);
            return;
        }
        self.close_interaction(Some(keyword.visible_span(self.deck)));
        self.parent = Some(id);
    }

    pub(super) fn close_interaction(&mut self, closed_by: Option<Span>) {
        let Some(mut interaction) = self.interaction.take() else { return };
        interaction.other.shrink_to_fit();
        self.closed_by = closed_by;
        let span = interaction.span;
        // In CalculiX a contact pair takes the first of one name (K-06, CX-11).
        if self.grammar.dialect() == Dialect::Calculix
            && let Some(first) = self.model.interactions.get(&interaction.name)
        {
            let reason = SetAsideReason::Shadowed { first: first.span };
            return self.set_aside(reason, SetAsideItem::Interaction(Box::new(interaction)));
        }
        if let Some(earlier) = self.model.interactions.insert(interaction) {
            self.set_aside(SetAsideReason::ReplacedBy(span), SetAsideItem::Interaction(Box::new(earlier)));
        }
    }

    pub(super) fn set_aside(&mut self, reason: SetAsideReason, item: SetAsideItem) {
        self.model.set_aside.push(SetAside { reason, item });
    }

    // Sub-options.

    pub(super) fn read_sub_option(&mut self, option: Entry<'_>) {
        let parent = self.parent.map(|parent| self.grammar.keyword(parent).name.as_str());
        let has_other_parent =
            parent.is_some_and(|parent| parent != "SURFACE INTERACTION" && option.definition.has_parent(parent));
        let is_outside = self.interaction.is_none() || self.grammar.dialect() == Dialect::Calculix;
        let under_other_parent = is_outside && has_other_parent;
        if under_other_parent || (self.interaction.is_none() && option.definition.has_parent("MATERIAL")) {
            return;
        }
        let placed = if self.check_level(option) {
            if self.interaction.is_none() {
                let kind = ProblemKind::Misplaced { keyword: option.id, closed_by: self.closed_by };
                self.report(kind, option);
            }
            self.interaction.is_some()
        } else {
            false
        };
        // A misplaced option is still read, into a separate block that is set aside.
        let mut interaction = if placed { self.interaction.take() } else { None }
            .unwrap_or_else(|| Interaction::new(Name::new(""), option.keyword.span));
        match OptionKind::of(option.name) {
            OptionKind::GapElectricalConductance => self.read_electrical(option, &mut interaction),
            OptionKind::ContactPermeability => self.read_permeability(option, &mut interaction),
            OptionKind::GapHeatGeneration => self.read_heat_generation(option, &mut interaction),
            _ => interaction.other.push(self.generic(option)),
        }
        if placed {
            self.interaction = Some(interaction);
        } else {
            self.set_parts_aside(interaction);
        }
    }

    pub(super) fn set_parts_aside(&mut self, interaction: Interaction) {
        let tables = interaction.gap_electrical_conductance.into_iter().flat_map(|option| {
            let ElectricalConductance { clearance, pressure, .. } = *option;
            [clearance, pressure]
        });
        let tables = tables.flatten().map(|table| SetAsideItem::Table(*table));
        let items = tables
            .chain(interaction.contact_permeability.map(SetAsideItem::ContactPermeability))
            .chain(interaction.gap_heat_generation.map(SetAsideItem::HeatGeneration))
            .chain(interaction.other.into_iter().map(SetAsideItem::SubOption));
        for item in items {
            self.set_aside(SetAsideReason::Misplaced, item);
        }
    }

    pub(super) fn read_electrical(&mut self, option: Entry<'_>, interaction: &mut Interaction) {
        let law = interaction.gap_electrical_conductance.get_or_insert_default();
        if let Some(kind) = self.value_of(option, "TYPE") {
            law.kind = Some(kind.into());
        }
        if option.is_given("USER") {
            law.user = Some(option.keyword.visible_span(self.deck));
            return;
        }
        let Some(table) = self.table(option) else { return };
        let branch = if option.is_given("PRESSURE") { &mut law.pressure } else { &mut law.clearance };
        if let Some(earlier) = branch.replace(Box::new(table)) {
            let span = option.keyword.visible_span(self.deck);
            self.set_aside(SetAsideReason::ReplacedBy(span), SetAsideItem::Table(*earlier));
        }
    }

    pub(super) fn read_permeability(&mut self, option: Entry<'_>, interaction: &mut Interaction) {
        let span = option.keyword.visible_span(self.deck);
        let permeability = ContactPermeability {
            span,
            table: self.table(option),
            cutoff_flow_across: self.float_of(option, "CUTOFF FLOW ACROSS"),
            cutoff_gap_fill: self.float_of(option, "CUTOFF GAP FILL"),
            constraint_method: self.constraint_method(option),
        };
        if let Some(earlier) = interaction.contact_permeability.replace(Box::new(permeability)) {
            self.set_aside(SetAsideReason::ReplacedBy(span), SetAsideItem::ContactPermeability(earlier));
        }
    }

    pub(super) fn constraint_method(&self, option: Entry<'_>) -> Option<ConstraintMethod> {
        let parameter = option.parameter("CONSTRAINT METHOD")?;
        let definition = &option.definition.parameters[parameter.index()?];
        match definition.choice_named(self.deck.text(parameter.value?))? {
            "DIRECT" => Some(ConstraintMethod::Direct),
            "PENALTY" => Some(ConstraintMethod::Penalty),
            _ => None,
        }
    }

    pub(super) fn read_heat_generation(&mut self, option: Entry<'_>, interaction: &mut Interaction) {
        let span = option.keyword.visible_span(self.deck);
        let table = self.table(option);
        // Of several rows Abaqus reads the first, CalculiX the last (CX-10).
        let rows = table.as_ref().map_or(0, Table::row_count);
        let counting = match self.grammar.dialect() {
            Dialect::Abaqus => 0,
            Dialect::Calculix => rows.saturating_sub(1),
        };
        let row = table.as_ref().and_then(|table| table.row_spans().nth(counting));
        let values = table.as_ref().map_or(&[1.0, 0.5][..], |table| table.row(counting));
        let [fraction, slave_weight] = [values[0], values[1]];
        let all = table.iter().flat_map(|table| table.row_spans().enumerate());
        for (_, surplus) in all.filter(|(index, _)| *index != counting) {
            let problem = Problem { kind: ProblemKind::SurplusRow, span: surplus, keyword: option.keyword.span };
            self.problems.push(problem);
        }
        let slip_rate = match self.grammar.dialect() {
            Dialect::Abaqus => None,
            // A missing item is 0 (CX-10).
            Dialect::Calculix => Some(values.get(2).copied().unwrap_or_default()),
        };
        let texts = table.iter().flat_map(|table| {
            let first = counting * table.width();
            let of_row = move |text: &CellText| {
                let cell = text.cell.checked_sub(first).filter(|cell| *cell < values.len())?;
                Some(CellText { cell, text: text.text.clone() })
            };
            table.texts.iter().filter_map(of_row)
        });
        let texts = texts.collect();
        let heat = HeatGeneration { span, row, fraction, slave_weight, slip_rate, texts };
        if let Some(earlier) = interaction.gap_heat_generation.replace(Box::new(heat)) {
            self.set_aside(SetAsideReason::ReplacedBy(span), SetAsideItem::HeatGeneration(earlier));
        }
    }
}
