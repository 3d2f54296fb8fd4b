//! From the blocks of a deck to its [`Model`].
//!
//! Walks the blocks once, in reading order, and knows at each where it is: in a part, in a step, inside which interaction.
//! Collects problems and never stops at one (T-44).

use super::rows::{read_table, undefined_parameter};
use super::{
    ConstraintMethod, ContactPair, ContactPermeability, GivenParameter, HeatGeneration, Interaction, Model, Name,
    Procedure, PropertyAssignment, Reference, SetAside, SetAsideItem, SetAsideReason, SubOption, Surface, SurfacePair,
    Table,
};
use crate::deck::{Block, Deck, KeywordLine, Parameter};
use crate::expression::{StatementLine, define, substitute};
use crate::grammar::{Definition, Grammar, KeywordId, Level, RowShape};
use crate::number::{read_float, read_integer};
use crate::problem::{Problem, ProblemKind};
use crate::span::Span;

/// The most field variables a table may depend on here; a larger DEPENDENCIES is read as this.
///
/// The manual names no bound. A number without one would let a typing error ask for gigabytes.
pub const MOST_FIELD_VARIABLES: usize = 1000;

/// Reads the model of a deck, and says what did not fit.
pub fn read(deck: &Deck, grammar: &Grammar) -> (Model, Vec<Problem>) {
    let mut reader = Reader {
        deck,
        grammar,
        model: Model::default(),
        problems: Vec::new(),
        interaction: None,
        parent: None,
        closed_by: None,
        levels: Vec::new(),
        steps: 0,
        explicit: false,
    };
    // All definitions of the deck come first, wherever they stand (S-61).
    for block in deck.blocks() {
        reader.define_parameters(block);
    }
    for block in deck.blocks() {
        reader.read_block(block);
    }
    reader.close_interaction(None);
    (reader.model, reader.problems)
}

struct Reader<'a> {
    deck: &'a Deck,
    grammar: &'a Grammar,
    model: Model,
    problems: Vec<Problem>,
    /// The *SURFACE INTERACTION whose block is open.
    interaction: Option<Interaction>,
    /// The last keyword that is no sub-option of an interaction.
    parent: Option<KeywordId>,
    /// The keyword line that closed the last interaction.
    closed_by: Option<Span>,
    /// The open levels below the model, with the lines that opened them.
    levels: Vec<(Level, Span)>,
    steps: usize,
    /// Whether the open step is one of Abaqus/Explicit, where interactions may stand in a step (S-73).
    explicit: bool,
}

/// A block whose keyword the grammar defines.
#[derive(Clone, Copy)]
struct Entry<'a> {
    id: KeywordId,
    name: &'a str,
    definition: &'a Definition,
    keyword: &'a KeywordLine,
    block: &'a Block,
}

impl<'a> Entry<'a> {
    /// The last setting of a parameter counts.
    fn parameter(self, name: &str) -> Option<&'a Parameter> {
        let is_meant = |parameter: &&Parameter| {
            parameter.index().is_some_and(|index| self.definition.parameters[index].name == name)
        };
        self.keyword.parameters.iter().rev().find(is_meant)
    }

    fn is_given(self, name: &str) -> bool {
        self.parameter(name).is_some()
    }
}

impl<'a> Reader<'a> {
    fn read_block(&mut self, block: &'a Block) {
        // An unknown keyword leaves an interaction open: it is more often a typing error in a sub-option than the end of the block.
        let Some(keyword) = &block.keyword else { return };
        let Some(id) = keyword.id() else {
            if is_likely_interaction(self.deck.text(keyword.name)) {
                self.close_interaction(Some(keyword.visible_span(self.deck)));
            }
            return;
        };
        self.check_references(keyword);
        let entry = self.grammar.keyword(id);
        let Some(definition) = entry.definition() else {
            return self.leave_interaction(id, keyword);
        };
        let option = Entry { id, name: &entry.name, definition, keyword, block };
        if self.grammar.is_interaction_option(id) {
            return self.read_sub_option(option);
        }
        match option.name {
            // Legal at every level and inside every block (S-51, S-66).
            "INCLUDE" | "PARAMETER" => return,
            "SURFACE INTERACTION" => return self.open_interaction(option),
            _ => self.leave_interaction(id, keyword),
        }
        match option.name {
            "PART" => self.levels.push((Level::Part, keyword.span)),
            "INSTANCE" => self.levels.push((Level::Instance, keyword.span)),
            "ASSEMBLY" => self.levels.push((Level::Assembly, keyword.span)),
            "STEP" => self.begin_step(keyword),
            "END STEP" => self.end_level(Level::Step),
            "END PART" => self.end_level(Level::Part),
            "END INSTANCE" => self.end_level(Level::Instance),
            "END ASSEMBLY" => self.end_level(Level::Assembly),
            "SURFACE" => self.read_surface(option),
            "CONTACT PAIR" => self.read_contact_pair(option),
            "CONTACT PROPERTY ASSIGNMENT" => self.read_property_assignments(option),
            _ if definition.procedure => self.read_procedure(option),
            _ => {}
        }
    }

    // Parameters (S-60 to S-66).

    fn define_parameters(&mut self, block: &Block) {
        let Some(keyword) = &block.keyword else { return };
        let Some(id) = keyword.id().filter(|id| self.grammar.keyword(*id).name == "PARAMETER") else { return };
        let from_table = self.grammar.keyword(id).definition().is_some_and(|definition| {
            let is_table = |index: usize| definition.parameters[index].name == "TABLE";
            keyword.parameters.iter().any(|parameter| parameter.index().is_some_and(is_table))
        });
        if from_table {
            let span = keyword.visible_span(self.deck);
            self.problems.push(Problem { kind: ProblemKind::UninterpretedParameters, span, keyword: keyword.span });
            return;
        }
        let lines = self.deck.data_lines(block).map(|line| StatementLine { span: line.span, text: line.text });
        let mut invalid = Vec::new();
        define(lines, &mut self.model.parameters, &mut invalid);
        self.problems.extend(invalid.into_iter().map(|problem| Problem {
            kind: ProblemKind::InvalidExpression {
                message: problem.message,
                help: problem.help,
                undefined: problem.undefined,
            },
            span: problem.span,
            keyword: keyword.span,
        }));
    }

    /// The text of a keyword value, its parameters replaced by their values (S-62).
    ///
    /// A parameter without a value stays a name; [`Reader::check_references`] reports it.
    fn value_text(&self, value: Span) -> String {
        let text = self.deck.shown(value);
        match substitute(&text, &self.model.parameters) {
            Ok(replaced) => replaced.into_owned(),
            Err(_) => text,
        }
    }

    /// Reports the parameters without a definition in the values of a keyword line.
    fn check_references(&mut self, keyword: &KeywordLine) {
        for value in keyword.parameters.iter().filter_map(|parameter| parameter.value) {
            let text = self.deck.text(value);
            if !text.contains(&b'<') {
                continue;
            }
            let text = self.deck.shown(value);
            if let Err(error) = substitute(&text, &self.model.parameters) {
                self.problems.extend(undefined_parameter(&error, &self.model.parameters, value, keyword.span));
            }
        }
    }

    // Levels and steps (S-71 to S-74).

    fn begin_step(&mut self, keyword: &KeywordLine) {
        // A step that was never ended (18 in the list of what decks do) ends here.
        self.end_level(Level::Step);
        self.steps += 1;
        self.explicit = false;
        self.levels.push((Level::Step, keyword.span));
    }

    fn end_level(&mut self, level: Level) {
        if let Some(open) = self.levels.iter().rposition(|(open, _)| *open == level) {
            self.levels.truncate(open);
        }
    }

    fn level(&self) -> (Level, Option<Span>) {
        self.levels.last().map_or((Level::Model, None), |(level, span)| (*level, Some(*span)))
    }

    /// Whether the option may stand at this level; reports it when it may not.
    fn check_level(&mut self, option: Entry<'_>) -> bool {
        let (level, opened_by) = self.level();
        let in_explicit_step = level == Level::Step && self.explicit;
        if option.definition.levels.is_empty() || option.definition.levels.contains(&level) || in_explicit_step {
            return true;
        }
        self.report(ProblemKind::WrongLevel { keyword: option.id, level, opened_by }, option);
        false
    }

    fn report(&mut self, kind: ProblemKind, option: Entry<'_>) {
        let span = option.keyword.visible_span(self.deck);
        self.problems.push(Problem { kind, span, keyword: option.keyword.span });
    }

    // Interactions.

    fn open_interaction(&mut self, option: Entry<'_>) {
        self.close_interaction(Some(option.keyword.span));
        self.check_level(option);
        self.parent = Some(option.id);
        let mut parameters = self.given_parameters(option);
        // Without a name it governs nothing that could name it, yet its tables are to be judged (K006).
        take(&mut parameters, "NAME");
        let name = self.value_of(option, "NAME").unwrap_or_default();
        let mut interaction = Interaction::new(Name::new(&name), option.keyword.visible_span(self.deck));
        let is_user = parameters.iter().any(|parameter| parameter.name == "USER");
        interaction.parameters = parameters;
        self.read_interaction_rows(option, is_user, &mut interaction);
        self.interaction = Some(interaction);
    }

    /// The thickness on the first line; with USER the properties on the further ones (K-01, K-02).
    fn read_interaction_rows(&mut self, option: Entry<'_>, is_user: bool, interaction: &mut Interaction) {
        let constants = if is_user { 8 } else { 0 };
        for (index, line) in self.deck.data_lines(option.block).enumerate() {
            let allowed = if index == 0 { 1 } else { constants };
            let given = line.items().filter(|item| !item.is_empty()).count();
            if given > allowed {
                let kind = ProblemKind::TooManyItems { allowed, given, lines: 1 };
                self.problems.push(Problem { kind, span: line.span, keyword: option.keyword.span });
            }
            for item in line.items().filter(|item| !item.is_empty()).take(allowed) {
                match read_float(self.deck.text(item)) {
                    Ok(value) if index == 0 => interaction.thickness = value,
                    Ok(value) => interaction.properties.push(value),
                    Err(error) => {
                        let column = if index == 0 { "thickness" } else { "property" }.to_owned();
                        let kind = ProblemKind::MalformedNumber { error, column };
                        self.problems.push(Problem { kind, span: item, keyword: option.keyword.span });
                    }
                }
            }
        }
    }

    fn leave_interaction(&mut self, id: KeywordId, keyword: &KeywordLine) {
        self.close_interaction(Some(keyword.visible_span(self.deck)));
        self.parent = Some(id);
    }

    fn close_interaction(&mut self, closed_by: Option<Span>) {
        let Some(interaction) = self.interaction.take() else { return };
        self.closed_by = closed_by;
        let span = interaction.span;
        if let Some(earlier) = self.model.interactions.insert(interaction.name.clone(), interaction) {
            self.set_aside(SetAsideReason::ReplacedBy(span), SetAsideItem::Interaction(Box::new(earlier)));
        }
    }

    fn set_aside(&mut self, reason: SetAsideReason, item: SetAsideItem) {
        self.model.set_aside.push(SetAside { reason, item });
    }

    // Sub-options.

    fn read_sub_option(&mut self, option: Entry<'_>) {
        let under_other_parent = self.interaction.is_none()
            && self.parent.is_some_and(|parent| option.definition.has_parent(&self.grammar.keyword(parent).name));
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
        // What is misplaced is read all the same, into a block of its own that is set aside.
        let mut interaction = if placed { self.interaction.take() } else { None }
            .unwrap_or_else(|| Interaction::new(Name::new(""), option.keyword.span));
        match option.name {
            "GAP ELECTRICAL CONDUCTANCE" => self.read_electrical(option, &mut interaction),
            "CONTACT PERMEABILITY" => self.read_permeability(option, &mut interaction),
            "GAP HEAT GENERATION" => self.read_heat_generation(option, &mut interaction),
            _ => interaction.other.push(self.generic(option)),
        }
        if placed {
            self.interaction = Some(interaction);
        } else {
            self.set_parts_aside(interaction);
        }
    }

    fn set_parts_aside(&mut self, interaction: Interaction) {
        let electrical = interaction.gap_electrical_conductance.into_iter();
        let tables =
            electrical.flat_map(|option| [option.clearance, option.pressure]).flatten().map(SetAsideItem::Table);
        let items = tables
            .chain(interaction.contact_permeability.map(SetAsideItem::ContactPermeability))
            .chain(interaction.gap_heat_generation.map(SetAsideItem::HeatGeneration))
            .chain(interaction.other.into_iter().map(SetAsideItem::SubOption));
        for item in items {
            self.set_aside(SetAsideReason::Misplaced, item);
        }
    }

    fn read_electrical(&mut self, option: Entry<'_>, interaction: &mut Interaction) {
        let law = interaction.gap_electrical_conductance.get_or_insert_default();
        if let Some(kind) = self.value_of(option, "TYPE") {
            law.kind = Some(kind);
        }
        if option.is_given("USER") {
            law.user = Some(option.keyword.visible_span(self.deck));
            return;
        }
        let Some(table) = self.table(option) else { return };
        let branch = if option.is_given("PRESSURE") { &mut law.pressure } else { &mut law.clearance };
        if let Some(earlier) = branch.replace(table) {
            let span = option.keyword.visible_span(self.deck);
            self.set_aside(SetAsideReason::ReplacedBy(span), SetAsideItem::Table(earlier));
        }
    }

    fn read_permeability(&mut self, option: Entry<'_>, interaction: &mut Interaction) {
        let span = option.keyword.visible_span(self.deck);
        let permeability = ContactPermeability {
            span,
            table: self.table(option),
            cutoff_flow_across: self.float_of(option, "CUTOFF FLOW ACROSS"),
            cutoff_gap_fill: self.float_of(option, "CUTOFF GAP FILL"),
            constraint_method: self.constraint_method(option),
        };
        if let Some(earlier) = interaction.contact_permeability.replace(permeability) {
            self.set_aside(SetAsideReason::ReplacedBy(span), SetAsideItem::ContactPermeability(earlier));
        }
    }

    fn constraint_method(&self, option: Entry<'_>) -> Option<ConstraintMethod> {
        let parameter = option.parameter("CONSTRAINT METHOD")?;
        let definition = &option.definition.parameters[parameter.index()?];
        match definition.choice_named(self.deck.text(parameter.value?))? {
            "DIRECT" => Some(ConstraintMethod::Direct),
            "PENALTY" => Some(ConstraintMethod::Penalty),
            _ => None,
        }
    }

    fn read_heat_generation(&mut self, option: Entry<'_>, interaction: &mut Interaction) {
        let span = option.keyword.visible_span(self.deck);
        let table = self.table(option);
        let row = table.as_ref().and_then(|table| table.rows.first().copied());
        let values = table.as_ref().map_or(&[1.0, 0.5][..], |table| table.row(0));
        let [fraction, slave_weight] = [values[0], values[1]];
        for surplus in table.iter().flat_map(|table| table.rows.iter().skip(1)) {
            let problem = Problem { kind: ProblemKind::SurplusRow, span: *surplus, keyword: option.keyword.span };
            self.problems.push(problem);
        }
        let heat = HeatGeneration { span, row, fraction, slave_weight };
        if let Some(earlier) = interaction.gap_heat_generation.replace(heat) {
            self.set_aside(SetAsideReason::ReplacedBy(span), SetAsideItem::HeatGeneration(earlier));
        }
    }

    // Rows and parameters of any option.

    /// The rows as a table; `None` when there are none, or USER makes them void.
    fn table(&mut self, option: Entry<'_>) -> Option<Table> {
        let dependencies = self.dependencies(option);
        let layout = option.definition.layout(|name| option.is_given(name), dependencies)?;
        let table = read_table(self.deck, option.block, layout, &self.model.parameters, &mut self.problems);
        (table.row_count() > 0).then_some(table)
    }

    fn dependencies(&self, option: Entry<'_>) -> usize {
        let value = self.value_of(option, "DEPENDENCIES");
        let number = value.and_then(|value| read_integer(value.as_bytes()).ok()).unwrap_or(0);
        usize::try_from(number).unwrap_or(0).min(MOST_FIELD_VARIABLES)
    }

    fn generic(&mut self, option: Entry<'_>) -> SubOption {
        let is_table = matches!(option.definition.rows(), RowShape::Table) && !option.is_given("USER");
        let table = if is_table { self.table(option) } else { None };
        let rows = if table.is_some() || is_table { Vec::new() } else { self.texts(option.block) };
        SubOption {
            keyword: option.name.to_owned(),
            span: option.keyword.visible_span(self.deck),
            parameters: self.given_parameters(option),
            table,
            rows,
        }
    }

    /// The items of every line; empty ones at the end of a line left out.
    fn texts(&self, block: &Block) -> Vec<Vec<String>> {
        let lines = self.deck.data_lines(block).filter(|line| !line.is_blank());
        let items = lines.map(|line| {
            let mut items: Vec<String> = line.items().map(|item| self.deck.shown(item)).collect();
            let used = items.iter().rposition(|item| !item.is_empty()).map_or(0, |last| last + 1);
            items.truncate(used);
            items
        });
        items.collect()
    }

    fn value_of(&self, option: Entry<'_>, name: &str) -> Option<String> {
        Some(self.value_text(option.parameter(name)?.value?))
    }

    fn float_of(&self, option: Entry<'_>, name: &str) -> Option<f64> {
        read_float(self.value_of(option, name)?.as_bytes()).ok()
    }

    fn given_parameters(&self, option: Entry<'_>) -> Vec<GivenParameter> {
        let given = option.keyword.parameters.iter().map(|parameter| GivenParameter {
            name: match parameter.index() {
                Some(index) => option.definition.parameters[index].name.clone(),
                None => self.deck.shown(parameter.name),
            },
            value: parameter.value.map(|value| self.deck.shown(value)),
            span: parameter.span(),
        });
        given.collect()
    }

    fn reference(&self, span: Span) -> Option<Reference> {
        (!span.is_empty()).then(|| Reference { name: Name::new(&self.value_text(span)), span })
    }

    // What uses the interactions.

    fn read_surface(&mut self, option: Entry<'_>) {
        let value = option.parameter("NAME").and_then(|parameter| parameter.value);
        if let Some(name) = value.and_then(|value| self.reference(value)) {
            self.model.surfaces.push(Surface { span: option.keyword.visible_span(self.deck), name });
        }
    }

    fn read_contact_pair(&mut self, option: Entry<'_>) {
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
            parameters,
            pairs: pairs.collect(),
        };
        self.model.contact_pairs.push(pair);
    }

    fn read_property_assignments(&mut self, option: Entry<'_>) {
        for line in self.deck.data_lines(option.block).filter(|line| !line.is_blank()) {
            let mut items = line.items();
            let mut next = || items.next().and_then(|item| self.reference(item));
            let assignment = PropertyAssignment { span: line.span, first: next(), second: next(), interaction: next() };
            self.model.property_assignments.push(assignment);
        }
    }

    fn read_procedure(&mut self, option: Entry<'_>) {
        self.explicit |= option.is_given("EXPLICIT");
        let step = if self.level().0 == Level::Step { self.steps } else { 0 };
        let rows = self.texts(option.block);
        let option = SubOption { rows, table: None, ..self.generic(option) };
        self.model.procedures.push(Procedure { step, option });
    }
}

/// Whether unknown words were likely meant to begin the next *SURFACE INTERACTION, whose sub-options are not the last one's.
fn is_likely_interaction(words: &[u8]) -> bool {
    let letters = words.iter().filter(|byte| !byte.is_ascii_whitespace()).map(u8::to_ascii_uppercase);
    let letters: Vec<u8> = letters.take(40).collect();
    letters.starts_with(b"SURF") && letters.windows(3).any(|piece| piece == b"INT")
}

/// Takes the last parameter of that name out of the list.
fn take(parameters: &mut Vec<GivenParameter>, name: &str) -> Option<GivenParameter> {
    let found = parameters.iter().rposition(|parameter| parameter.name == name)?;
    Some(parameters.remove(found))
}
