//! Any model survives JSON and back, and a deck and back.

use inpact_parser::deck::scan;
use inpact_parser::expression::{Parameters, StatementLine, define};
use inpact_parser::grammar::Grammar;
use inpact_parser::json;
use inpact_parser::model::{
    CellText, ConstraintMethod, ContactPair, ContactPermeability, ElectricalConductance, GivenParameter,
    HeatGeneration, Interaction, Model, Name, Procedure, PropertyAssignment, Reference, SubOption, SurfacePair, Table,
    print, read,
};
use inpact_parser::span::Span;
use proptest::option::of;
use proptest::prelude::*;
use proptest::sample::{select, subsequence};

/// The text by which two models are compared, because a cell without a value is NaN, which equals nothing.
fn meaning(model: &Model) -> (Parameters, String) {
    let mut model = model.without_places();
    (std::mem::take(&mut model.parameters), format!("{model:#?}"))
}

proptest! {
    #[test]
    fn any_model_survives_json(model in model()) {
        let text = json::model::write(&model, "deck.inp");
        let again = json::model::read(&text).map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))?;
        prop_assert_eq!(meaning(&again), meaning(&model));
        // Spans come back from JSON where it has them, so the second text is the first.
        prop_assert_eq!(json::model::write(&again, "deck.inp"), text);
    }

    #[test]
    fn any_model_survives_a_deck(model in model()) {
        let grammar = Grammar::builtin();
        let text = print(&model, grammar).map_err(|error| TestCaseError::fail(format!("{error}\n{model:#?}")))?;
        let (again, _) = read(&scan("deck.inp", text.as_bytes(), grammar), grammar);
        prop_assert_eq!(meaning(&again), meaning(&model), "{}", text);
        prop_assert_eq!(print(&again, grammar), Ok(text));
    }

    #[test]
    fn any_deck_of_a_model_survives_the_lossless_json(model in model()) {
        let grammar = Grammar::builtin();
        let text = print(&model, grammar).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let json = json::syntax::write(&scan("deck.inp", text.as_bytes(), grammar), grammar);
        prop_assert_eq!(json::syntax::read(&json, grammar), Ok(vec![("deck.inp".to_owned(), text.into_bytes())]));
    }
}

// Models.

/// The values of the parameters `p1`, `p2`, …: short decimals, which every way to write a number keeps.
const PARAMETERS: [f64; 4] = [0.25, 3.5, 20.0, 1250.0];

fn model() -> impl Strategy<Value = Model> {
    let interactions = prop::collection::vec(interaction(), 0..4);
    let pairs = prop::collection::vec(contact_pair(), 0..3);
    let assignments = prop::collection::vec(property_assignment(), 0..3);
    let procedures = prop::collection::vec(procedure(), 0..5);
    (interactions, pairs, assignments, procedures).prop_map(|(interactions, pairs, assignments, mut procedures)| {
        let mut model = Model { parameters: parameters(), ..Model::default() };
        for interaction in interactions {
            // Of two equal names the later definition would replace the earlier.
            if !model.interactions.contains_key(&interaction.name) {
                model.interactions.insert(interaction);
            }
        }
        model.contact_pairs = pairs;
        model.property_assignments = assignments;
        // A deck holds its steps in order.
        procedures.sort_by_key(|procedure| procedure.step);
        model.procedures = procedures;
        model
    })
}

fn parameters() -> Parameters {
    let mut parameters = Parameters::new();
    for (index, value) in PARAMETERS.iter().enumerate() {
        let statement = format!("p{} = {value:?}", index + 1);
        let mut problems = Vec::new();
        define([StatementLine { span: Span::default(), text: statement.as_bytes() }], &mut parameters, &mut problems);
        assert!(problems.is_empty(), "{problems:?}");
    }
    parameters
}

fn interaction() -> impl Strategy<Value = Interaction> {
    let name = prop_oneof![9 => name(), 1 => Just(Name::new(""))];
    let constants = of(prop::collection::vec(number(), 0..20));
    let given = chosen(&[("UNSYMM", None), ("PAD THICKNESS", Some("2.5")), ("TRACKING THICKNESS", Some("<p1>"))]);
    let laws = (of(electrical()), of(permeability()), of((number(), number())));
    let other = prop::collection::vec(sub_option(), 0..3);
    (name, number(), constants, given, laws, other).prop_map(|(name, thickness, constants, given, laws, other)| {
        let mut interaction = Interaction::new(name, Span::default());
        interaction.thickness = thickness;
        let mut parameters = given;
        if let Some(constants) = constants {
            parameters.push(parameter("USER", None));
            parameters.push(parameter("PROPERTIES", Some(&constants.len().to_string())));
            interaction.properties = constants.into();
        }
        interaction.parameters = parameters.into();
        (interaction.gap_electrical_conductance, interaction.contact_permeability) =
            (laws.0.map(Box::new), laws.1.map(Box::new));
        interaction.gap_heat_generation = laws.2.map(|(fraction, slave_weight)| {
            Box::new(HeatGeneration {
                span: Span::default(),
                row: None,
                fraction,
                slave_weight,
                slip_rate: None,
                texts: Vec::new(),
            })
        });
        interaction.other = other;
        interaction
    })
}

fn electrical() -> impl Strategy<Value = ElectricalConductance> {
    let kind = of(select(vec!["SOLID", "Electrolyte"]));
    let clearance = of(table(&["conductance", "clearance", "temp"]));
    let pressure = of(table(&["conductance", "pressure", "temp"]));
    (any::<bool>(), kind, clearance, pressure).prop_map(|(user, kind, clearance, pressure)| ElectricalConductance {
        user: user.then(Span::default),
        clearance: clearance.map(Box::new),
        pressure: pressure.map(Box::new),
        kind: kind.map(Into::into),
    })
}

fn permeability() -> impl Strategy<Value = ContactPermeability> {
    let table = of(table(&["permeability", "pressure", "pore_pressure", "temp"]));
    let method = of(select(vec![ConstraintMethod::Direct, ConstraintMethod::Penalty]));
    (table, of(number()), of(number()), method).prop_map(|(table, flow_across, gap_fill, method)| ContactPermeability {
        span: Span::default(),
        table,
        cutoff_flow_across: flow_across,
        cutoff_gap_fill: gap_fill,
        constraint_method: method,
    })
}

/// A sub-option with a table, with rows of items, or with neither.
fn sub_option() -> impl Strategy<Value = SubOption> {
    let conductance = |branch: &'static str| {
        let columns = ["conductance", branch, "temp", "mass_flow"];
        table(&columns).prop_map(move |table| {
            let mut parameters = Vec::new();
            if branch == "pressure" {
                parameters.push(parameter("PRESSURE", None));
            }
            if table.dependencies() > 0 {
                parameters.push(parameter("DEPENDENCIES", Some(&table.dependencies().to_string())));
            }
            option("GAP CONDUCTANCE", parameters, Some(table), Vec::new())
        })
    };
    let friction = chosen(&[("SLIP TOLERANCE", Some("0.01")), ("TAUMAX", Some("<p4>")), ("ANISOTROPIC", None)]);
    let friction = (friction, rows()).prop_map(|(parameters, rows)| option("FRICTION", parameters, None, rows)).boxed();
    let diffusivity = chosen(&[("TYPE", Some("ION CONCENTRATION")), ("CUTOFF GAP FILL", Some("1.E-3"))]);
    let diffusivity =
        (diffusivity, rows()).prop_map(|(parameters, rows)| option("GAP DIFFUSIVITY", parameters, None, rows));
    prop_oneof![
        conductance("clearance"),
        conductance("pressure"),
        Just(option("GAP CONDUCTANCE", vec![parameter("USER", None)], None, Vec::new())),
        friction,
        diffusivity,
    ]
}

/// A table of 1 to 5 rows with those columns and 0 to 15 field variables; some cells are written as parameters.
fn table(lead: &[&str]) -> impl Strategy<Value = Table> + use<> {
    let lead: Vec<String> = lead.iter().map(|name| (*name).to_owned()).collect();
    (0_usize..=15, 1_usize..=5).prop_flat_map(move |(fields, rows)| {
        let columns: Vec<String> = lead.iter().cloned().chain((1..=fields).map(|field| format!("fv{field}"))).collect();
        let cells = prop::collection::vec(cell(), columns.len() * rows);
        cells.prop_map(move |cells| {
            let mut table = Table { columns: columns.clone().into(), ..Table::default() };
            let written = cells.iter().enumerate().filter_map(|(cell, (_, text))| {
                let text = text.clone()?;
                Some(CellText { cell, text })
            });
            table.texts = written.collect();
            table.values = cells.iter().map(|(value, _)| *value).collect();
            table
        })
    })
}

/// A number, `<p1>` with its value, or a parameter that is not defined.
fn cell() -> impl Strategy<Value = (f64, Option<String>)> {
    prop_oneof![
        12 => number().prop_map(|value| (value, None)),
        2 => (0..PARAMETERS.len()).prop_map(|index| (PARAMETERS[index], Some(format!("<p{}>", index + 1)))),
        1 => Just((f64::NAN, Some("<undefined>".to_owned()))),
    ]
}

fn contact_pair() -> impl Strategy<Value = ContactPair> {
    let given = chosen(&[("TYPE", Some("SURFACE TO SURFACE")), ("ADJUST", Some("0.1")), ("SMALL SLIDING", None)]);
    let pair = (reference(), of(reference())).prop_map(|(slave, master)| SurfacePair { slave, master });
    (of(reference()), given, prop::collection::vec(pair, 0..4)).prop_map(|(interaction, parameters, pairs)| {
        let (parameters, pairs) = (parameters.into(), pairs.into());
        ContactPair { span: Span::default(), interaction, parameters, pairs }
    })
}

fn property_assignment() -> impl Strategy<Value = PropertyAssignment> {
    (of(reference()), of(reference()), of(reference())).prop_map(|(first, second, interaction)| PropertyAssignment {
        span: Span::default(),
        first,
        second,
        interaction,
    })
}

/// A procedure of one of the first steps, or, as a deck may have it, of none.
fn procedure() -> impl Strategy<Value = Procedure> {
    let keywords = vec!["HEAT TRANSFER", "COUPLED THERMAL-ELECTRICAL", "SOILS", "GEOSTATIC", "STATIC"];
    let given = |keyword: &str| match keyword {
        "SOILS" => chosen(&[("CONSOLIDATION", None), ("UTOL", Some("1.E+4"))]).boxed(),
        "HEAT TRANSFER" | "COUPLED THERMAL-ELECTRICAL" => {
            chosen(&[("STEADY STATE", None), ("DELTMX", Some("100."))]).boxed()
        }
        _ => Just(Vec::new()).boxed(),
    };
    (0_usize..4, select(keywords)).prop_flat_map(move |(step, keyword)| {
        (given(keyword), rows())
            .prop_map(move |(parameters, rows)| Procedure { step, option: option(keyword, parameters, None, rows) })
    })
}

// Their parts.

fn option(keyword: &str, parameters: Vec<GivenParameter>, table: Option<Table>, rows: Vec<Vec<String>>) -> SubOption {
    let (keyword, parameters, table) = (keyword.into(), parameters.into(), table.map(Box::new));
    SubOption { keyword, span: Span::default(), parameters, table, rows: rows.into_iter().collect() }
}

fn parameter(name: &str, value: Option<&str>) -> GivenParameter {
    GivenParameter { name: name.into(), value: value.map(Into::into), span: Span::default() }
}

/// Some of these parameters.
fn chosen(all: &[(&str, Option<&str>)]) -> impl Strategy<Value = Vec<GivenParameter>> + use<> {
    let all: Vec<_> = all.iter().map(|(name, value)| parameter(name, *value)).collect();
    let count = all.len();
    subsequence(all, 0..=count)
}

/// Rows of items; an item may be empty, but the last of a row is not.
fn rows() -> impl Strategy<Value = Vec<Vec<String>>> {
    let item = prop_oneof![
        4 => number().prop_map(|value| value.to_string()),
        2 => "[A-Z][A-Za-z0-9_ .-]{0,8}[A-Z0-9]",
        1 => "\"[ -!#-~]{0,10}\"",
        1 => Just("<p2>".to_owned()),
        1 => Just(String::new()),
    ];
    let row = prop::collection::vec(item, 0..7).prop_map(|mut row| {
        while row.last().is_some_and(String::is_empty) {
            row.pop();
        }
        row
    });
    prop::collection::vec(row, 0..3)
}

/// A name without quotes, within quotes, or with a quoted component.
fn name() -> impl Strategy<Value = Name> {
    let texts = prop_oneof![
        4 => "[A-Za-z][A-Za-z0-9_-]{0,12}",
        2 => "[A-Za-z][A-Za-z0-9]{0,5} [A-Za-z0-9_]{1,6}",
        2 => "\"[A-Za-z][A-Za-z0-9 ,=*._-]{0,14}\"",
        1 => "[A-Z]{1,5}[.]\"[a-z][a-z ]{0,6}\"",
    ];
    texts.prop_map(|text| Name::new(&text))
}

fn reference() -> impl Strategy<Value = Reference> {
    name().prop_map(|name| Reference { name, span: Span::default() })
}

/// Any finite number, from the smallest to the largest, and many of a usual size.
fn number() -> impl Strategy<Value = f64> {
    let any_finite = prop::num::f64::POSITIVE | prop::num::f64::NEGATIVE | prop::num::f64::NORMAL;
    let any_finite = any_finite | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO;
    prop_oneof![2 => any_finite, 1 => (-4000_i32..4000).prop_map(|value| f64::from(value) / 8.0), 1 => Just(1.0)]
}
