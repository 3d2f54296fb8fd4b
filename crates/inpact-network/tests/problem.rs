//! The problem of a scene: fields, nodes and order, and the messages about the rest.

mod scene_support;

use inpact_network::linear::{LAST_DIGIT, Method};
use inpact_network::scene::Field::{PorePressure, Potential, Temperature};
use inpact_network::scene::{Field, Scene};
use inpact_network::{Equations, State};
use scene_support::{model_of, problem, scene};

const ELECTRICAL: &str = "*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n2., 0.\n2., 1.\n";
const ELECTRICAL_BY_TEMPERATURE: &str = "*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n2., 0., 0.\n3., 0., 100.\n";
const THERMAL: &str = "*GAP CONDUCTANCE, PRESSURE\n5., 0.\n5., 1.\n";
const THERMAL_BY_TEMPERATURE: &str = "*GAP CONDUCTANCE, PRESSURE\n5., 0., 0.\n5., 1., 0.\n6., 0., 100.\n6., 1., 100.\n";
const PORE: &str = "*CONTACT PERMEABILITY\n4., 0.\n";
const NO_HEAT: &str = "*GAP HEAT GENERATION\n0., 0.5\n";

/// The deck of one interaction with these options.
fn deck(options: &[&str]) -> String {
    format!("*SURFACE INTERACTION, NAME=A\n{}", options.concat())
}

/// Two faces with an interface, and what is known of them.
fn faces(slave: &str, master: &str, row: &str) -> Scene {
    scene(&format!(
        "deck = \"a\"\n[[node]]\nname = \"s\"\n{slave}\n[[node]]\nname = \"m\"\n{master}\n[[node]]\nname = \"apart\"\n\
         [[interface]]\nslave = \"s\"\nmaster = \"m\"\narea = 1.0\nclearance = 0.0\npressure = 0.0\n{row}\n"
    ))
}

const HELD: [&str; 2] = [
    "potential = { fixed = 3.0 }\ntemperature = { fixed = 30.0 }\npore_pressure = { fixed = 1.0 }",
    "potential = { fixed = 0.0 }\ntemperature = { source = 4.0 }\npore_pressure = { source = 2.0 }",
];

/// The fields that are solved with the nodes of each, and what is left out.
fn chosen(options: &[&str], scene: &Scene) -> (Vec<(Field, Vec<u32>)>, Vec<String>) {
    let model = model_of(&deck(options));
    let (problem, findings) = problem(scene, &model);
    let problem = problem.unwrap_or_else(|| panic!("{findings:?}"));
    let fields = problem.solved_fields().into_iter().map(|field| (field, problem.nodes_of(field).to_vec()));
    (fields.collect(), problem.left_out.clone())
}

#[test]
fn a_field_is_solved_where_the_scene_says_something_of_it() {
    let all = [ELECTRICAL, THERMAL, PORE];
    let scene = faces(HELD[0], HELD[1], "");
    let both = vec![0, 1];
    let (fields, left_out) = chosen(&all, &scene);
    assert_eq!(fields, [(Potential, both.clone()), (Temperature, both.clone()), (PorePressure, both.clone())]);
    assert_eq!(left_out, Vec::<String>::new());
    let (fields, left_out) = chosen(&all, &faces("temperature = { fixed = 1.0 }", "", ""));
    assert_eq!(fields, [(Temperature, both)]);
    assert_eq!(
        left_out,
        [
            "potential: the deck has laws of it, and the scene says nothing of it",
            "pore pressure: the deck has laws of it, and the scene says nothing of it"
        ]
    );
    let (fields, left_out) = chosen(&[ELECTRICAL], &faces("temperature = { initial = 1.0 }\npotential = {}", "", ""));
    assert_eq!(fields, [(Potential, vec![0, 1])]);
    assert_eq!(left_out, ["temperature: no interface law couples it, and nothing drives it"]);
}

/// P-01: pore fluid crosses where both sides carry pore pressure, and nowhere else.
#[test]
fn pore_pressure_does_not_spread_across_interfaces() {
    let (fields, _) = chosen(&[PORE], &faces("pore_pressure = { fixed = 1.0 }", "", ""));
    assert_eq!(fields, [(PorePressure, vec![0])]);
    let (fields, _) = chosen(&[PORE], &faces("pore_pressure = { fixed = 1.0 }", "pore_pressure = {}", ""));
    assert_eq!(fields, [(PorePressure, vec![0, 1])]);
}

/// The groups of fields that were solved together, and whether each was solved by steps.
fn stages(options: &[&str]) -> Vec<(Vec<Field>, bool)> {
    let scene = faces(HELD[0], "potential = { source = 2.0 }\ntemperature = { source = 4.0 }", "");
    let model = model_of(&deck(options));
    let (problem, findings) = problem(&scene, &model);
    let problem = problem.unwrap_or_else(|| panic!("{findings:?}"));
    let state = Equations::new(&problem, Method::Direct, LAST_DIGIT).steady().expect("a scene with a solution");
    let is_thermal = |stage: &inpact_network::StageReport| stage.fields != [PorePressure];
    let of = |stage: &inpact_network::StageReport| (stage.fields.clone(), stage.iterations > 0);
    state.reports.iter().filter(|stage| is_thermal(stage)).map(of).collect()
}

#[test]
fn what_does_not_depend_on_others_is_solved_first() {
    let (potential, temperature) = (|| vec![Potential], || vec![Temperature]);
    assert_eq!(stages(&[ELECTRICAL, THERMAL]), [(potential(), false), (temperature(), false)]);
    assert_eq!(stages(&[ELECTRICAL, THERMAL_BY_TEMPERATURE]), [(potential(), false), (temperature(), true)]);
    assert_eq!(stages(&[ELECTRICAL_BY_TEMPERATURE, THERMAL, NO_HEAT]), [(temperature(), false), (potential(), false)]);
    // All that a current dissipates is heat unless the deck says otherwise.
    assert_eq!(stages(&[ELECTRICAL_BY_TEMPERATURE, THERMAL]), [(vec![Potential, Temperature], true)]);
}

/// 4 of heat at m, and 4 / 2 by the current, of which half arises there.
#[test]
fn heat_of_a_current_arises_in_both_faces() {
    let scene = faces(HELD[0], "potential = { source = 2.0 }\ntemperature = { source = 4.0 }", "");
    let model = model_of(&deck(&[ELECTRICAL, THERMAL]));
    let (problem, _) = problem(&scene, &model);
    let problem = problem.expect("a scene that is right");
    let state = Equations::new(&problem, Method::Direct, LAST_DIGIT).steady().expect("a scene with a solution");
    let value = |state: &State, field, node| state.value(&problem, field, node);
    assert_eq!(value(&state, Potential, 1), Some(4.0));
    assert_eq!(value(&state, Temperature, 1), Some(31.0));
    assert_eq!(state.row_flow(&problem, Temperature, 0), Some(-5.0));
    assert_eq!((value(&state, Temperature, 2), value(&state, PorePressure, 1)), (None, None));
    assert_eq!(state.supplies(&problem, Temperature), [(0, -6.0)]);
    let balance = state.balance(&problem, Temperature).expect("a field that is solved");
    assert_eq!((balance.supplied, balance.withdrawn, balance.generated, balance.stored), (0.0, 6.0, 6.0, 0.0));
    assert_eq!((balance.missing, balance.turnover), (0.0, 12.0));
}
