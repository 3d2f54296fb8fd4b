//! C001: properties of a field that no step solves.

use crate::quantity::and_more;
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::model::{Interaction, OptionKind, Procedure};
use inpact_parser::span::Span;
use std::collections::HashSet;

declare_rule! {
    /// The deck has steps, and none of them solves the field that a contact property belongs to.
    ///
    /// - Electrical conductance counts in *COUPLED THERMAL-ELECTRICAL and in *COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL.
    /// - Permeability counts in *SOILS and *GEOSTATIC.
    /// - Thermal conductance, radiation and heat generation count where temperatures are solved: in the coupled procedures, *HEAT TRANSFER, *DYNAMIC TEMPERATURE-DISPLACEMENT, and *SOILS with heat transfer.
    ///
    /// Nothing is reported when the procedure of a step is not known, or when the deck includes files that could not be read.
    ///
    /// ## Why
    /// The property is legal but never used.
    /// A flag of the procedure may have been forgotten, such as `ELECTRICAL`.
    ///
    /// ## What to do
    /// Check the procedures of the steps.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// *STEP
    /// *COUPLED TEMPERATURE-DISPLACEMENT
    /// 0.1, 1.
    /// *END STEP
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// *STEP
    /// *COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL
    /// 0.1, 1.
    /// *END STEP
    /// ```
    "C001", "property-never-used", Note, fix: None, source: "C-26, 9.2"
}

/// A field with the properties that need it.
struct Field {
    /// The name of the field.
    name: &'static str,
    is_solved: fn(&Procedure) -> bool,
    /// The keyword lines of the properties in an interaction.
    properties: fn(&Interaction) -> Vec<Span>,
    /// Procedures that solve it.
    help: &'static str,
}

const FIELDS: [Field; 3] = [
    Field {
        name: "electric potential",
        is_solved: solves_potential,
        properties: electrical_properties,
        help: "use `*COUPLED THERMAL-ELECTRICAL`, or give `ELECTRICAL` on `*COUPLED TEMPERATURE-DISPLACEMENT`",
    },
    Field {
        name: "pore pressure",
        is_solved: Procedure::solves_pore_pressure,
        properties: |interaction| interaction.contact_permeability.iter().map(|option| option.span).collect(),
        help: "use `*SOILS` or `*GEOSTATIC`",
    },
    Field {
        name: "temperature",
        is_solved: solves_temperature,
        properties: thermal_properties,
        help: "use `*HEAT TRANSFER` or a coupled procedure",
    },
];

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    if context.has_unread_files() || !procedures_are_known(context) {
        return;
    }
    for field in FIELDS {
        if context.model.procedures.iter().any(field.is_solved) {
            continue;
        }
        let mut properties = context.model.interactions.values().flat_map(field.properties);
        let Some(first) = properties.next() else { continue };
        let more = and_more(properties.count(), "option of this deck is", "options of this deck are");
        report
            .at(context.trimmed(first), format!("never used: no step of the deck solves {}", field.name))
            .label(format!("needs {}", field.name))
            .note(format!("the property is legal and has no effect{more}"))
            .help(field.help);
    }
}

/// Whether the deck has steps, and each has a procedure that the grammar defines.
fn procedures_are_known(context: &Context<'_>) -> bool {
    let steps = context.defined_blocks().filter(|block| block.name == "STEP").count();
    let known: HashSet<usize> = context.model.procedures.iter().map(|procedure| procedure.step).collect();
    steps > 0 && (1..=steps).all(|step| known.contains(&step))
}

fn solves_potential(procedure: &Procedure) -> bool {
    procedure.solves_electrical() || procedure.option.keyword == "COUPLED THERMAL-ELECTROCHEMICAL"
}

fn solves_temperature(procedure: &Procedure) -> bool {
    let is_without_heat = || {
        let heat = procedure.option.parameter("HEAT").and_then(|heat| heat.value.as_deref());
        heat.is_some_and(|value| value.eq_ignore_ascii_case("NO"))
    };
    match &*procedure.option.keyword {
        "HEAT TRANSFER"
        | "COUPLED TEMPERATURE-DISPLACEMENT"
        | "COUPLED THERMAL-ELECTRICAL"
        | "COUPLED THERMAL-ELECTROCHEMICAL"
        | "DYNAMIC TEMPERATURE-DISPLACEMENT" => true,
        "SOILS" => !is_without_heat(),
        _ => false,
    }
}

fn electrical_properties(interaction: &Interaction) -> Vec<Span> {
    let law = interaction.gap_electrical_conductance.iter();
    let spans = law.filter_map(|law| {
        let tables = [&law.clearance, &law.pressure].into_iter().flatten().map(|table| table.keyword);
        law.user.into_iter().chain(tables).min_by_key(|span| span.start())
    });
    spans.collect()
}

fn thermal_properties(interaction: &Interaction) -> Vec<Span> {
    let is_thermal = |kind| matches!(kind, OptionKind::GapConductance | OptionKind::GapRadiation);
    let other = interaction.other.iter().filter(|option| is_thermal(option.kind())).map(|option| option.span);
    other.chain(interaction.gap_heat_generation.as_ref().map(|heat| heat.span)).collect()
}
