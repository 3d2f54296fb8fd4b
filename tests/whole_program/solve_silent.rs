//! `inpact solve` where something of a scene would be lost: it is solved, refused or told, never passed over.

use crate::program::{Folder, Run};

const DECK: &str = "\
*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0., STEFAN BOLTZMANN=5.67E-8
*SURFACE INTERACTION, NAME=FILTER
*CONTACT PERMEABILITY
1.E-3, 0.
2.E-3, 100.
*SURFACE INTERACTION, NAME=BARE
*SURFACE INTERACTION, NAME=BRANCHES
*GAP ELECTRICAL CONDUCTANCE
10., 0.
5., 1.
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
20., 0.
30., 100.
*SURFACE INTERACTION, NAME=BY-FIELDS
*GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=2
10., 0., , 0., 0.
10., 1., , 0., 0.
20., 0., , 5., 0.
20., 1., , 5., 0.
10., 0., , 0., 4.
10., 1., , 0., 4.
40., 0., , 5., 4.
40., 1., , 5., 4.
*SURFACE INTERACTION, NAME=BY-TEMPERATURE
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
10., 0., 0.
10., 1., 0.
20., 0., 100.
20., 1., 100.
*SURFACE INTERACTION, NAME=RADIATING
*GAP RADIATION
1., 1.
1., 0.
1., 1.
*SURFACE INTERACTION, NAME=OWN
*GAP ELECTRICAL CONDUCTANCE, USER
";

/// Solves a scene whose first node carries `a`, whose second `b`, with one interface of these keys.
fn solve(head: &str, a: &str, b: &str, interface: &str) -> Run {
    let scene = format!(
        "deck = \"deck.inp\"\n{head}\n[[node]]\nname = \"a\"\n{a}\n[[node]]\nname = \"b\"\n{b}\n\
         [[interface]]\nslave = \"a\"\nmaster = \"b\"\narea = 1.0\n{interface}\n"
    );
    Folder::with(&[("deck.inp", DECK), ("scene.toml", &scene)]).inpact(&["solve", "scene.toml", "--links"])
}

fn is_refused(run: &Run, code: &str, message: &str) {
    assert_eq!(run.code, 1, "{}", run.errors);
    assert!(run.errors.contains(code) && run.errors.contains(message), "{}", run.errors);
}

#[test]
fn a_permeability_needs_a_clearance_for_its_cutoffs() {
    let pore = ["pore_pressure = { fixed = 2.0 }", "pore_pressure = { fixed = 1.0 }"];
    let closed = solve("", pore[0], pore[1], "interaction = \"FILTER\"\nclosed = true\npressure = 0.0");
    is_refused(&closed, "D018", "lacks `clearance`, which its pore fluid flow depends on");
    let given = solve("", pore[0], pore[1], "interaction = \"FILTER\"\nclearance = 0.0\npressure = 0.0");
    assert_eq!(given.code, 0, "{}", given.errors);
    assert!(given.errors.contains("0.001 in and 0.001 out"), "{}", given.errors);
}

/// P-03: without *CONTACT PERMEABILITY both sides have one pore pressure.
#[test]
fn pore_fluid_crosses_an_interface_of_which_the_deck_says_nothing() {
    let run =
        solve("", "pore_pressure = { fixed = 2.0 }", "pore_pressure = {}", "interaction = \"BARE\"\nclearance = 0.0");
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.output.contains("b,,,2\n"), "{}", run.output);
}

/// P-01: an interface of which only one side carries pore pressure is impermeable.
#[test]
fn an_interface_with_one_side_of_pore_pressure_is_noted() {
    let run =
        solve("", "pore_pressure = { fixed = 2.0 }", "", "interaction = \"FILTER\"\nclearance = 0.0\npressure = 0.0");
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(
        run.errors.contains("pore fluid across 1 interface: one side carries no pore pressure (P-01)"),
        "{}",
        run.errors
    );
}

#[test]
fn an_empty_field_variable_is_missing() {
    let rows = "slave,master,interaction,area,clearance,pressure,fv1,fv2\na,b,BY-FIELDS,1,0,0,,4\n";
    let scene = "deck = \"deck.inp\"\n[[node]]\nname = \"a\"\npotential = { fixed = 2.0 }\n[[node]]\nname = \"b\"\n\
                 potential = { fixed = 1.0 }\n[[interface_file]]\nfile = \"rows.csv\"\n";
    let folder = Folder::with(&[("deck.inp", DECK), ("rows.csv", rows), ("scene.toml", scene)]);
    is_refused(&folder.inpact(&["solve", "scene.toml"]), "D018", "lacks `fv1`");
}

#[test]
fn a_temperature_that_is_solved_elsewhere_is_none_of_a_row() {
    let interface = "interaction = \"BY-TEMPERATURE\"\nclearance = 0.0\npressure = 0.5";
    let elsewhere = "[[node]]\nname = \"c\"\ntemperature = { fixed = 50.0 }";
    let run = solve(elsewhere, "potential = { fixed = 2.0 }", "potential = { fixed = 1.0 }", interface);
    is_refused(&run, "D018", "lacks `temperature`, which its electrical conductance depends on");
}

#[test]
fn a_law_that_cannot_be_evaluated_seals_no_interface() {
    let interface = "interaction = \"OWN\"\nclearance = 0.0\npressure = 0.5\ntemperature = 20.0";
    let run = solve("", "potential = { fixed = 2.0 }", "potential = { fixed = 1.0 }", interface);
    is_refused(
        &run,
        "D018",
        "the electrical law of the interface of `a` and `b` cannot be evaluated: needs user subroutine GAPELECTR",
    );
}

#[test]
fn a_capacity_needs_a_beginning() {
    let head = "procedure = \"transient\"\n[time]\nend = 1.0\nstep = 0.5";
    let interface = "interaction = \"RADIATING\"\nclearance = 0.5";
    let run = solve(head, "temperature = { capacity = 1.0 }", "temperature = { fixed = 300.0 }", interface);
    is_refused(&run, "D018", "`a` has a capacity, and nothing says at which temperature it begins");
    let begun =
        solve(head, "temperature = { capacity = 1.0, initial = 400.0 }", "temperature = { fixed = 300.0 }", interface);
    assert_eq!(begun.code, 0, "{}", begun.errors);
}

#[test]
fn heat_for_a_node_without_temperature_is_noted() {
    let interface = "interaction = \"BY-TEMPERATURE\"\nclearance = 0.0\npressure = 0.0";
    let run = solve(
        "",
        "potential = { fixed = 2.0 }\ntemperature = { fixed = 20.0 }",
        "potential = { fixed = 1.0 }",
        interface,
    );
    assert_eq!(run.code, 0, "{}", run.errors);
    let message = "a share of the heat of currents in 1 interface: its node carries no temperature";
    assert!(run.errors.contains(message), "{}", run.errors);
}

/// 100 from a plate of area 1 into space at absolute zero: 100 = 5.67e-8 · T⁴ / (1/1 + 1/1 − 1).
#[test]
fn what_radiates_into_space_at_absolute_zero_floats_not() {
    let interface = "interaction = \"RADIATING\"\nclearance = 0.5";
    let run = solve("", "temperature = { source = 100.0 }", "temperature = { fixed = 0.0 }", interface);
    assert_eq!(run.code, 0, "{}", run.errors);
    let line = run.output.lines().find(|line| line.starts_with("a,")).expect("the plate");
    let found: f64 = line.split(',').nth(2).and_then(|cell| cell.parse().ok()).expect("a temperature");
    let exact = (100.0_f64 / 5.67e-8).powf(0.25);
    assert!((found - exact).abs() <= 1e-12 * exact, "{found} and {exact}");
}

/// A row given as closed needs nothing of the open branch, though its pressure follows time.
#[test]
fn a_row_that_is_closed_needs_no_clearance() {
    let head = "procedure = \"transient\"\n[time]\nend = 1.0\nstep = 0.5";
    let interface = "interaction = \"BRANCHES\"\nclosed = true\npressure = [[0.0, 0.0], [1.0, 50.0]]";
    let run = solve(head, "potential = { fixed = 2.0 }", "potential = { fixed = 1.0 }", interface);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.errors.contains("25.0 in and 25.0 out"), "{}", run.errors);
}
