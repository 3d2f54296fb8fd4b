//! Writes a deck from a model, for `inpact inp` on the model view.
//!
//! The text is read again and compared with the model, so a model that no deck can express is rejected rather than altered.

use super::{
    ConstraintMethod, ContactPair, ContactPermeability, ElectricalConductance, GivenParameter, Interaction, Model,
    Name, Procedure, PropertyAssignment, Reference, SubOption, Table, read,
};
use crate::Error;
use crate::deck::scan;
use crate::expression;
use crate::grammar::{Definition, Dialect, Grammar};
use crate::number::float_text;
use std::fmt::Write;

/// The longest keyword line that is not split (S-06 allows 256).
const KEYWORD_LINE: usize = 120;

/// Writes the model as a deck: interactions first, then their uses, then the steps with their procedures.
///
/// # Errors
/// A deck that would be read back as another model: a name with a comma and no quotes, a keyword the grammar does not
/// know, a row that begins with an asterisk.
pub fn print(model: &Model, grammar: &Grammar) -> Result<String, Error> {
    let mut out = String::new();
    print_parameters(&mut out, model.parameters.definitions());
    let is_explicit = |procedure: &Procedure| {
        let definition = grammar.id_of(&procedure.option.keyword).and_then(|id| grammar.keyword(id).definition());
        let knows = definition.is_some_and(|definition| definition.parameter("EXPLICIT").is_some());
        knows && procedure.option.parameter("EXPLICIT").is_some()
    };
    let has_explicit_step = model.procedures.iter().any(is_explicit);
    for interaction in model.interactions.values() {
        print_interaction(&mut out, interaction, has_explicit_step, grammar);
    }
    for pair in &model.contact_pairs {
        print_contact_pair(&mut out, pair);
    }
    print_property_assignments(&mut out, &model.property_assignments);
    print_procedures(&mut out, &model.procedures, grammar);
    let named = named_in(grammar.dialect(), model.without_places());
    // Two names that the dialect does not distinguish.
    if named.interactions.len() < model.interactions.len() {
        return Err(Error::unprintable("the list of interactions"));
    }
    let (again, _) = read(&scan("", out.as_bytes(), grammar), grammar);
    match difference(&named, &again.without_places()) {
        None => Ok(out),
        Some(what) => Err(Error::unprintable(what)),
    }
}

/// The model with its names as a dialect compares them: JSON does not record the dialect.
pub(crate) fn named_in(dialect: Dialect, mut model: Model) -> Model {
    let rename = |name: &mut Name| *name = Name::in_dialect(name.written(), dialect);
    let interactions = std::mem::take(&mut model.interactions).into_values();
    model.interactions = interactions
        .map(|mut interaction| {
            rename(&mut interaction.name);
            interaction
        })
        .collect();
    let pairs = model.contact_pairs.iter_mut().flat_map(|pair| {
        let surfaces = pair.pairs.iter_mut().flat_map(|pair| [Some(&mut pair.slave), pair.master.as_mut()]);
        surfaces.flatten().chain(pair.interaction.as_mut())
    });
    let assigned = model.property_assignments.iter_mut().flat_map(|assignment| {
        [&mut assignment.first, &mut assignment.second, &mut assignment.interaction].into_iter().flatten()
    });
    pairs.chain(assigned).for_each(|reference| rename(&mut reference.name));
    model
}

/// The first difference between two models.
fn difference(model: &Model, again: &Model) -> Option<String> {
    if !same(&model.parameters, &again.parameters) {
        return Some("the list of parameters".to_owned());
    }
    for (name, interaction) in model.interactions.iter() {
        if again.interactions.get(name).is_none_or(|found| !same(found, interaction)) {
            return Some(format!("interaction `{name}`"));
        }
    }
    if model.interactions.len() != again.interactions.len() {
        return Some("the list of interactions".to_owned());
    }
    if !same(&model.contact_pairs, &again.contact_pairs) {
        return Some("the list of contact pairs".to_owned());
    }
    if !same(&model.property_assignments, &again.property_assignments) {
        return Some("the list of property assignments".to_owned());
    }
    (!same(&model.procedures, &again.procedures)).then(|| "the list of procedures".to_owned())
}

/// Equality in which a NaN, the value of a cell written as a parameter, equals itself.
fn same<T: std::fmt::Debug + PartialEq>(a: &T, b: &T) -> bool {
    a == b || format!("{a:?}") == format!("{b:?}")
}

fn print_parameters(out: &mut String, definitions: &[expression::Definition]) {
    if !definitions.is_empty() {
        print_keyword(out, "PARAMETER", []);
    }
    for definition in definitions {
        let _ = writeln!(out, "{} = {}", definition.name, definition.expression);
    }
}

/// The interaction with its sub-options; in a deck with an Explicit step its rows are only properties (K-03).
fn print_interaction(out: &mut String, interaction: &Interaction, has_explicit_step: bool, grammar: &Grammar) {
    let name =
        GivenParameter { name: "NAME".into(), value: Some(interaction.name.written().into()), span: interaction.span };
    let named = !interaction.name.written().is_empty();
    let name = named.then_some(&name);
    let parameters = match grammar.dialect() {
        Dialect::Abaqus => with_meant(name, &interaction.parameters),
        // The first of several names applies.
        Dialect::Calculix => name.into_iter().chain(&interaction.parameters).collect(),
    };
    print_keyword(out, "SURFACE INTERACTION", parameters);
    let is_default = interaction.thickness.to_bits() == 1.0_f64.to_bits();
    let rows_are_properties = has_explicit_step
        || interaction.parameters.iter().any(|parameter| parameter.name == "USER" && parameter.value.is_some());
    let has_thickness = !(rows_are_properties && interaction.has_parameter("USER"));
    let is_needed = !is_default || !interaction.properties.is_empty();
    if has_thickness && is_needed {
        let _ = writeln!(out, "{},", float_text(interaction.thickness));
    }
    for line in interaction.properties.chunks(8) {
        let items = line.iter().map(|value| float_text(*value)).collect::<Vec<_>>().join(", ");
        let _ = writeln!(out, "{items}");
    }
    if let Some(law) = &interaction.gap_electrical_conductance {
        print_electrical(out, law, grammar);
    }
    if let Some(permeability) = &interaction.contact_permeability {
        print_permeability(out, permeability, grammar);
    }
    if let Some(heat) = &interaction.gap_heat_generation {
        print_keyword(out, "GAP HEAT GENERATION", []);
        let values = [Some(heat.fraction), Some(heat.slave_weight), heat.slip_rate];
        let items = values.into_iter().flatten().enumerate().map(|(cell, value)| {
            let text = heat.texts.iter().find(|text| text.cell == cell);
            text.map_or_else(|| float_text(value), |text| text.text.clone())
        });
        let _ = writeln!(out, "{}", joined(&items.collect::<Vec<_>>()));
    }
    for option in &interaction.other {
        print_option(out, option, grammar);
    }
}

/// A parameter that precedes the others; after them where they contain it too, since the last setting applies.
fn with_meant<'a>(meant: Option<&'a GivenParameter>, others: &'a [GivenParameter]) -> Vec<&'a GivenParameter> {
    let mut all: Vec<_> = others.iter().collect();
    if let Some(meant) = meant {
        let is_repeated = others.iter().any(|other| other.name == meant.name);
        all.insert(if is_repeated { all.len() } else { 0 }, meant);
    }
    all
}

fn print_electrical(out: &mut String, law: &ElectricalConductance, grammar: &Grammar) {
    let keyword = "GAP ELECTRICAL CONDUCTANCE";
    let kind = law.kind.iter().map(|kind| parameter("TYPE", Some(kind.to_string())));
    let kind: Vec<_> = kind.collect();
    for (table, flag) in [(&law.clearance, None), (&law.pressure, Some("PRESSURE"))] {
        if let Some(table) = table {
            let mut parameters = kind.clone();
            parameters.extend(flag.map(|flag| parameter(flag, None)));
            print_table_option(out, keyword, parameters, table, grammar);
        }
    }
    let has_table = law.clearance.is_some() || law.pressure.is_some();
    if law.user.is_some() || !has_table {
        let mut parameters = kind;
        parameters.extend(law.user.map(|_| parameter("USER", None)));
        print_keyword(out, keyword, &parameters);
    }
}

fn print_permeability(out: &mut String, permeability: &ContactPermeability, grammar: &Grammar) {
    let cutoff = |name, value: Option<f64>| value.map(|value| parameter(name, Some(float_text(value))));
    let method = permeability.constraint_method.map(|method| match method {
        ConstraintMethod::Direct => "DIRECT",
        ConstraintMethod::Penalty => "PENALTY",
    });
    let parameters = [
        cutoff("CUTOFF FLOW ACROSS", permeability.cutoff_flow_across),
        cutoff("CUTOFF GAP FILL", permeability.cutoff_gap_fill),
        method.map(|method| parameter("CONSTRAINT METHOD", Some(method.to_owned()))),
    ];
    let parameters: Vec<_> = parameters.into_iter().flatten().collect();
    match &permeability.table {
        Some(table) => print_table_option(out, "CONTACT PERMEABILITY", parameters, table, grammar),
        None => print_keyword(out, "CONTACT PERMEABILITY", &parameters),
    }
}

fn parameter(name: &str, value: Option<String>) -> GivenParameter {
    GivenParameter { name: name.into(), value: value.map(Into::into), span: crate::span::Span::default() }
}

/// A keyword with a table; DEPENDENCIES follows from the columns unless it is given.
fn print_table_option(
    out: &mut String,
    keyword: &str,
    mut parameters: Vec<GivenParameter>,
    table: &Table,
    grammar: &Grammar,
) {
    let dependencies = table.declared_dependencies();
    if dependencies > 0 && !parameters.iter().any(|parameter| parameter.name == "DEPENDENCIES") {
        parameters.push(parameter("DEPENDENCIES", Some(dependencies.to_string())));
    }
    print_keyword(out, keyword, &parameters);
    let definition = grammar.id_of(keyword).and_then(|id| grammar.keyword(id).definition());
    print_rows(out, table, definition);
}

fn print_rows(out: &mut String, table: &Table, definition: Option<&Definition>) {
    let width = table.width();
    let layout = definition.and_then(|definition| definition.layout(|_| false, table.dependencies()));
    let (first_line, following) = layout.map_or((width, width), |layout| (layout.first_line, layout.following.max(1)));
    let mut kept = table.texts.iter().peekable();
    let texts = table.values.iter().enumerate().map(|(cell, value)| {
        kept.next_if(|kept| kept.cell == cell).map_or_else(|| float_text(*value), |kept| kept.text.clone())
    });
    let texts: Vec<String> = texts.collect();
    for row in texts.chunks(width.max(1)) {
        // A line that begins with an asterisk is not a row: then the whole row is on one line (K-53).
        let begins_keyword = row.iter().skip(1).any(|item| item.starts_with('*'));
        let (first, further) = row.split_at(if begins_keyword { row.len() } else { first_line.min(row.len()) });
        for line in std::iter::once(first).chain(further.chunks(following)) {
            let _ = writeln!(out, "{}", joined(line));
        }
    }
}

fn print_option(out: &mut String, option: &SubOption, grammar: &Grammar) {
    match &option.table {
        Some(table) => print_table_option(out, &option.keyword, option.parameters.to_vec(), table, grammar),
        None => print_keyword(out, &option.keyword, &option.parameters),
    }
    for row in option.rows.iter() {
        // A line without an item would be a blank line, which is not the same (S-08).
        let _ = writeln!(out, "{}", if row.is_empty() { ",".to_owned() } else { row.join(", ") });
    }
}

/// The items of a line; nothing follows one whose quote does not close, since it would be a part of it (S-41).
fn joined(items: &[String]) -> String {
    let open = items.iter().position(|item| has_open_quote(item));
    items[..open.map_or(items.len(), |open| open + 1)].join(", ")
}

fn has_open_quote(text: &str) -> bool {
    text.matches('"').count() % 2 == 1
}

fn print_contact_pair(out: &mut String, pair: &ContactPair) {
    let interaction = pair.interaction.as_ref().map(|found| parameter("INTERACTION", Some(found.name.to_string())));
    print_keyword(out, "CONTACT PAIR", with_meant(interaction.as_ref(), &pair.parameters));
    for surfaces in &pair.pairs {
        let master = surfaces.master.as_ref().map_or_else(String::new, |master| format!(" {}", master.name));
        let slave = surfaces.slave.name.to_string();
        let _ = if has_open_quote(&slave) { writeln!(out, "{slave}") } else { writeln!(out, "{slave},{master}") };
    }
}

fn print_property_assignments(out: &mut String, assignments: &[PropertyAssignment]) {
    if assignments.is_empty() {
        return;
    }
    print_keyword(out, "CONTACT", []);
    print_keyword(out, "CONTACT PROPERTY ASSIGNMENT", []);
    let text = |reference: &Option<Reference>| reference.as_ref().map_or(String::new(), |found| found.name.to_string());
    for assignment in assignments {
        let items = [&assignment.first, &assignment.second, &assignment.interaction].map(text);
        let _ = writeln!(out, "{}", joined(&items));
    }
}

/// Each procedure in the step it belongs to, or between steps; the order is that of the list.
fn print_procedures(out: &mut String, procedures: &[Procedure], grammar: &Grammar) {
    let (mut steps, mut is_open) = (0, false);
    for procedure in procedures {
        if is_open && procedure.step != steps {
            print_keyword(out, "END STEP", []);
            is_open = false;
        }
        while steps < procedure.step {
            if is_open {
                print_keyword(out, "END STEP", []);
            }
            print_keyword(out, "STEP", []);
            (steps, is_open) = (steps + 1, true);
        }
        print_option(out, &procedure.option, grammar);
    }
    if is_open {
        print_keyword(out, "END STEP", []);
    }
}

fn print_keyword<'a>(out: &mut String, keyword: &str, parameters: impl IntoIterator<Item = &'a GivenParameter>) {
    let mut line = format!("*{keyword}");
    // Nothing is read after a quote that does not close.
    let is_open = |parameter: &&GivenParameter| parameter.value.as_deref().is_some_and(has_open_quote);
    let (last, first): (Vec<_>, Vec<_>) = parameters.into_iter().partition(is_open);
    for parameter in first.into_iter().chain(last) {
        let text = match &parameter.value {
            Some(value) => format!("{}={value}", parameter.name),
            None => parameter.name.to_string(),
        };
        line.push(',');
        // A flag alone on a continuation line is read as data by some readers, a value is not (S-19).
        if line.len() + text.len() > KEYWORD_LINE && parameter.value.is_some() && !text.starts_with('*') {
            let _ = writeln!(out, "{line}");
            line.clear();
        }
        line.push(' ');
        line.push_str(&text);
    }
    let _ = writeln!(out, "{line}");
}
