//! Definitions and uses of interactions and surfaces, for the rules on references.

use crate::parameter::given_as;
use crate::rule::Context;
use crate::suggestion::did_you_mean;
use inpact_parser::deck::KeywordLine;
use inpact_parser::grammar::nearest_names;
use inpact_parser::model::{Name, Reference};
use inpact_parser::span::Span;
use std::collections::HashMap;

/// The maximum number of names of a deck that are compared for suggestions.
const MAX_COMPARED: usize = 10_000;

/// The maximum number of findings of a rule with a suggestion, which takes a comparison with every name.
const MAX_SUGGESTIONS: usize = 20;

/// The definitions of names of one kind.
#[derive(Debug, Default)]
pub(crate) struct Definitions {
    by_name: HashMap<Name, Span>,
    /// The quoted names, by their form without quotes, case and blanks (S-41).
    quoted: HashMap<String, (Name, Span)>,
    /// Some of the names, for suggestions.
    compared: Vec<String>,
}

/// Result of looking up a reference.
#[derive(Debug)]
pub(crate) enum Found<'a> {
    /// It is defined.
    Defined,
    /// Its name is quoted in the definition and not in the reference, or vice versa.
    QuotedOtherwise(&'a Name, Span),
    /// Nothing.
    Missing,
}

impl Definitions {
    /// The interactions of the deck.
    pub(crate) fn interactions(context: &Context<'_>) -> Self {
        let mut definitions = Self::default();
        for interaction in context.model.all_interactions() {
            definitions.add(interaction.name.clone(), interaction.span);
        }
        definitions.add_possible(context);
        definitions
    }

    /// The surfaces of the deck, those of older keywords (*SURFACE DEFINITION, *RIGID SURFACE, *CONTACT NODE SET) too.
    pub(crate) fn surfaces(context: &Context<'_>) -> Self {
        let mut definitions = Self::default();
        for surface in &context.model.surfaces {
            definitions.add(surface.name.name.clone(), surface.name.span);
        }
        for keyword in context.keyword_lines() {
            let Some(id) = keyword.id() else { continue };
            let name = &context.grammar.keyword(id).name;
            if (name.contains("SURFACE") && name != "SURFACE INTERACTION") || name == "CONTACT NODE SET" {
                definitions.add_name_of(context, keyword);
            }
        }
        definitions.add_possible(context);
        definitions
    }

    fn add(&mut self, name: Name, span: Span) {
        if name.is_quoted() {
            self.quoted.entry(folded(&name)).or_insert_with(|| (name.clone(), span));
        }
        if self.compared.len() < MAX_COMPARED {
            self.compared.push(name.written().to_owned());
        }
        self.by_name.entry(name).or_insert(span);
    }

    /// Adds the definitions of misspelt keywords: these have findings of their own.
    fn add_possible(&mut self, context: &Context<'_>) {
        // CalculiX skips it.
        if context.is_for_calculix() {
            return;
        }
        for keyword in context.keyword_lines().filter(|keyword| keyword.id().is_none()) {
            self.add_name_of(context, keyword);
        }
    }

    fn add_name_of(&mut self, context: &Context<'_>, keyword: &KeywordLine) {
        context.values_of(keyword, b"NAME").for_each(|value| self.add(context.name(value), value));
    }

    /// Whether a name is defined.
    pub(crate) fn has(&self, name: &Name) -> bool {
        self.by_name.contains_key(name)
    }

    /// Looks up a reference.
    pub(crate) fn find(&self, name: &Name) -> Found<'_> {
        if self.by_name.contains_key(name) {
            return Found::Defined;
        }
        let quoted_otherwise = if name.is_quoted() {
            self.by_name.get_key_value(&Name::new(&folded(name)))
        } else if self.quoted.is_empty() {
            None
        } else {
            self.quoted.get(&folded(name)).map(|(defined, span)| (defined, span))
        };
        match quoted_otherwise {
            Some((defined, span)) if defined.differs_by_quotes_only(name) => Found::QuotedOtherwise(defined, *span),
            _ => Found::Missing,
        }
    }
}

/// Suggests a name with similar spelling, for the first findings of a rule.
pub(crate) fn suggestion(definitions: &Definitions, name: &Name, finding: usize) -> Option<String> {
    if finding >= MAX_SUGGESTIONS {
        return None;
    }
    let mut names = nearest_names(name.canonical().as_bytes(), definitions.compared.iter().map(String::as_str), 3);
    names.dedup();
    did_you_mean(names)
}

/// The name in upper case without blanks and quotes.
fn folded(name: &Name) -> String {
    let kept = name.canonical().chars().filter(|character| !character.is_ascii_whitespace() && *character != '"');
    kept.map(|character| character.to_ascii_uppercase()).collect()
}

/// A reference to a name.
#[derive(Debug, Clone)]
pub(crate) struct Use {
    /// The name.
    pub(crate) name: Name,
    /// Its place.
    pub(crate) span: Span,
    /// Its keyword.
    pub(crate) keyword: &'static str,
}

impl Use {
    fn of(reference: &Reference, keyword: &'static str) -> Self {
        Self { name: reference.name.clone(), span: reference.span, keyword }
    }

    /// Whether the reference is unknown: a `<parameter>` without a value (S-62), or no name at all but `X=Y`, the
    /// parameters of a keyword line that does not continue (S003).
    pub(crate) fn is_unclear(&self) -> bool {
        self.name.written().contains('<') || (!self.name.is_quoted() && self.name.written().contains('='))
    }
}

/// The interactions that *CONTACT PAIR, *CONTACT PROPERTY ASSIGNMENT and *CHANGE FRICTION name.
pub(crate) fn uses_of_interactions(context: &Context<'_>) -> Vec<Use> {
    let pairs = context.model.contact_pairs.iter().filter_map(|pair| pair.interaction.as_ref());
    let pairs = pairs.map(|reference| Use::of(reference, "CONTACT PAIR"));
    let assignments = context.model.property_assignments.iter().filter_map(|line| line.interaction.as_ref());
    let assignments = assignments.map(|reference| Use::of(reference, "CONTACT PROPERTY ASSIGNMENT"));
    let changes = context.defined_blocks().filter(|block| block.name == "CHANGE FRICTION").filter_map(|block| {
        let span = given_as(block, "INTERACTION")?.value()?;
        Some(Use { name: context.name(span), span, keyword: "CHANGE FRICTION" })
    });
    pairs.chain(assignments).chain(changes).collect()
}

/// The surfaces that *CONTACT PAIR and *CONTACT PROPERTY ASSIGNMENT name.
pub(crate) fn uses_of_surfaces(context: &Context<'_>) -> impl Iterator<Item = Use> {
    let pairs = context.model.contact_pairs.iter().flat_map(|pair| &pair.pairs);
    let pairs = pairs.flat_map(|pair| [Some(&pair.slave), pair.master.as_ref()]).flatten();
    let pairs = pairs.map(|reference| Use::of(reference, "CONTACT PAIR"));
    let assignments = context.model.property_assignments.iter();
    let assignments = assignments.flat_map(|line| [line.first.as_ref(), line.second.as_ref()]).flatten();
    pairs.chain(assignments.map(|reference| Use::of(reference, "CONTACT PROPERTY ASSIGNMENT")))
}

/// The parts of a dotted name, split at periods outside quotes (S-44).
pub(crate) fn components(name: &Name) -> Vec<Name> {
    let mut quoted = false;
    let is_dot = |character: char| {
        quoted ^= character == '"';
        character == '.' && !quoted
    };
    name.written().split(is_dot).map(Name::new).collect()
}

/// The names that are not defined, each at its first place, and the number of further ones.
pub(crate) fn missing<'a>(uses: &'a [Use], definitions: &Definitions) -> Vec<(&'a Use, usize)> {
    let mut found: Vec<(&Use, usize)> = Vec::new();
    let mut places: HashMap<&Name, usize> = HashMap::new();
    let missing =
        uses.iter().filter(|used| !used.is_unclear() && matches!(definitions.find(&used.name), Found::Missing));
    for used in missing {
        let place = *places.entry(&used.name).or_insert(found.len());
        match found.get_mut(place) {
            Some((_, more)) => *more += 1,
            None => found.push((used, 0)),
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn s_44_dotted_names_are_cut_outside_quotes() {
        let parts = |text: &str| components(&Name::new(text)).iter().map(Name::to_string).collect::<Vec<_>>();
        assert_eq!(parts("Assembly-1.Instance-1.Surf-1"), ["Assembly-1", "Instance-1", "Surf-1"]);
        assert_eq!(parts("Hinge.\"Set 1.2\""), ["Hinge", "\"Set 1.2\""]);
        assert_eq!(parts("\"a.b\""), ["\"a.b\""]);
        assert_eq!(parts("Surf-1"), ["Surf-1"]);
    }
}
