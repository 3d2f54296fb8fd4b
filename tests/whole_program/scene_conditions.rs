//! Scenes whose nodes stand for sets and surfaces of the deck and take its conditions.

use crate::program::{Folder, Run};

/// A bar of two bricks, 1 by 1 by 2, and a third one beyond a joint: conditions of every kind that is taken.
const DECK: &str = "\
*NODE, NSET=ALL
1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.
5, 0., 0., 2.\n6, 1., 0., 2.\n7, 1., 1., 2.\n8, 0., 1., 2.
11, 0., 0., 2.\n12, 1., 0., 2.\n13, 1., 1., 2.\n14, 0., 1., 2.
15, 0., 0., 4.\n16, 1., 0., 4.\n17, 1., 1., 4.\n18, 0., 1., 4.
*ELEMENT, TYPE=DC3D8, ELSET=LOWER
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=DC3D8, ELSET=UPPER
2, 11, 12, 13, 14, 15, 16, 17, 18
*NSET, NSET=BOTTOM
1, 2, 3, 4
*NSET, NSET=TOP
15, 16, 17, 18
*SURFACE, NAME=LOW
LOWER, S2
*SURFACE, NAME=UP
UPPER, S1
*SURFACE, NAME=ROOF
UPPER, S2
*SURFACE INTERACTION, NAME=JOINT
*GAP CONDUCTANCE
4., 0.
0., 1.
*CONTACT PAIR, INTERACTION=JOINT
UP, LOW
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, 20.
*AMPLITUDE, NAME=COURSE
0., 1., 10., 3.
*STEP
*HEAT TRANSFER
1., 10.
";

/// Bottom and joint faces, the conductance between them 4 and 2, and the top.
const SCENE: &str = "\
deck = \"d.inp\"
[conditions]
[[node]]
name = \"bottom\"
set = \"BOTTOM\"
[[node]]
name = \"low\"
surface = \"LOW\"
[[node]]
name = \"up\"
surface = \"UP\"
[[node]]
name = \"top\"
set = \"TOP\"
[[link]]
nodes = [\"bottom\", \"low\"]
thermal = 4.0
[[link]]
nodes = [\"up\", \"top\"]
thermal = 2.0
[[interface]]
slave = \"up\"
master = \"low\"
area = 1.0
clearance = 0.0
";

fn folder(conditions: &str) -> Folder {
    Folder::with(&[("d.inp", &format!("{DECK}{conditions}*END STEP\n")), ("s.toml", SCENE)])
}

fn transient(scene: &str) -> String {
    scene.replacen(
        "deck = \"d.inp\"\n",
        "deck = \"d.inp\"\nprocedure = \"transient\"\n[time]\nend = 10.0\nstep = 5.0\n",
        1,
    )
}

/// The temperatures of a node in the states of a run.
fn temperatures(run: &Run, node: &str) -> Vec<f64> {
    assert_eq!(run.code, 0, "{}", run.errors);
    let mut lines = run.output.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let at = lines.next().expect("a header").iter().position(|name| *name == "temperature").expect("temperatures");
    lines.filter(|row| row[0] == node).map(|row| row[at].parse().expect("a number")).collect()
}

fn close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= 1e-12 * b.abs()), "{found:?} for {expected:?}");
}

#[test]
fn what_is_held_on_a_set_is_held_at_its_node() {
    let folder = folder("*BOUNDARY\nBOTTOM, 11, 11, 20.\nTOP, 11, , 120.\n");
    let run = folder.inpact(&["solve", "s.toml"]);
    // 4, 4 and 2 in series: 100 W.
    close(&temperatures(&run, "up"), &[70.0]);
    close(&temperatures(&run, "low"), &[45.0]);
    assert!(!run.errors.contains("D025"), "{}", run.errors);
}

/// Fluxes of nodes add up, those of faces are times their area, and a film is a link to its sink.
#[test]
fn fluxes_and_films_on_a_terminal() {
    for (fluxes, heat) in [
        ("*CFLUX\nTOP, 11, 2.5\n", 10.0),
        ("*CFLUX\n15, 11, 4.\n16, , 3.\n15, 11, 3.\n", 10.0),
        ("*DSFLUX\nROOF, S, 10.\n", 10.0),
        ("*DFLUX\nUPPER, S2, 6.\n*CFLUX\n17, 11, 4.\n", 10.0),
    ] {
        let folder = folder(&format!("*BOUNDARY\nBOTTOM, 11, 11, 20.\n{fluxes}"));
        let run = folder.inpact(&["solve", "s.toml"]);
        close(&temperatures(&run, "top"), &[20.0 + heat * (0.25 + 0.25 + 0.5)]);
        assert!(!run.errors.contains("D025"), "{fluxes}{}", run.errors);
    }
    for film in ["*FILM\nUPPER, F2, 120., 1.\n", "*SFILM\nROOF, F, 120., 1.\n"] {
        let folder = folder(&format!("*BOUNDARY\nBOTTOM, 11, 11, 20.\n{film}"));
        let run = folder.inpact(&["solve", "s.toml"]);
        // 100 K over 1/4 + 1/4 + 1/2 + 1/1.
        close(&temperatures(&run, "top"), &[70.0]);
        close(&temperatures(&run, "top film"), &[120.0]);
    }
}

/// An amplitude is a course of a transient; a steady state takes its value at the end of the step.
#[test]
fn an_amplitude_is_a_course() {
    let conditions = "*BOUNDARY\nBOTTOM, 11, 11, 20.\n*BOUNDARY, AMPLITUDE=COURSE\nTOP, 11, 11, 40.\n";
    let folder = folder(conditions);
    close(&temperatures(&folder.inpact(&["solve", "s.toml"]), "top"), &[120.0]);
    folder.write("s.toml", &transient(SCENE));
    close(&temperatures(&folder.inpact(&["solve", "s.toml"]), "top"), &[40.0, 80.0, 120.0]);
    for (from, to) in [
        ("*AMPLITUDE, NAME=COURSE\n", "*AMPLITUDE, NAME=COURSE, DEFINITION=SMOOTH STEP\n"),
        ("*AMPLITUDE, NAME=COURSE\n", "*AMPLITUDE, NAME=OTHER\n"),
        ("*STEP\n*HEAT", "*STEP, AMPLITUDE=RAMP\n*HEAT"),
    ] {
        folder.write("d.inp", &format!("{DECK}{conditions}*END STEP\n").replacen(from, to, 1));
        let run = folder.inpact(&["solve", "s.toml"]);
        assert!(run.code == 1 && run.errors.contains("error[D024] the temperature of `"), "{to}{}", run.errors);
    }
}

/// *INITIAL CONDITIONS are what a node with a capacity begins with.
#[test]
fn initial_conditions_are_taken() {
    let folder = folder("*BOUNDARY\nBOTTOM, 11, 11, 20.\nTOP, 11, 11, 20.\n");
    let scene =
        transient(SCENE).replacen("surface = \"UP\"\n", "surface = \"UP\"\ntemperature = { capacity = 5.0 }\n", 1);
    folder.write("s.toml", &scene);
    close(&temperatures(&folder.inpact(&["solve", "s.toml"]), "up"), &[20.0, 20.0, 20.0]);
}

/// A later step changes what an earlier one said (OP=MOD), or takes it away (OP=NEW).
#[test]
fn conditions_of_the_step_that_is_named() {
    let second = |boundary: &str| {
        format!(
            "*BOUNDARY\nBOTTOM, 11, 11, 20.\nTOP, 11, 11, 120.\n*CFLUX\n5, 11, 1.\n*END STEP\n*STEP\n*HEAT TRANSFER, STEADY STATE\n{boundary}"
        )
    };
    let folder = folder(&second("*BOUNDARY\nTOP, 11, 11, 220.\n*CFLUX, OP=NEW\n"));
    let run = folder.inpact(&["solve", "s.toml"]);
    assert!(run.code == 1 && run.errors.contains("error[D023] the deck has 2 steps"), "{}", run.errors);
    let at = |step: &str| {
        folder.write("s.toml", &SCENE.replacen("[conditions]\n", &format!("[conditions]\nstep = {step}\n"), 1));
    };
    at("2");
    close(&temperatures(&folder.inpact(&["solve", "s.toml"]), "top"), &[220.0]);
    close(&temperatures(&folder.inpact(&["solve", "s.toml"]), "up"), &[120.0]);
    at("1");
    close(&temperatures(&folder.inpact(&["solve", "s.toml"]), "top"), &[120.0]);
    for (step, code) in [("3", "D023"), ("1.5", "D011"), ("0", "D011")] {
        at(step);
        let run = folder.inpact(&["solve", "s.toml"]);
        assert!(
            run.code == 1 && run.errors.contains(&format!("error[{code}] `conditions.step` is {step}")),
            "{}",
            run.errors
        );
    }
}

/// Everything that is not in the scene is named with its line.
#[test]
fn what_is_left_out_is_named() {
    let left = "*CFLUX\nALL, 11, 1.\n*RADIATE\nUPPER, R2, 20., 1.E-8\n*DFLUX\nUPPER, BF, 3.\n*BOUNDARY, USER\nTOP, 11, 11\n*BOUNDARY\nTOP, 1, 3\n";
    let folder = folder(&format!("*BOUNDARY\nBOTTOM, 11, 11, 20.\n{left}"));
    let scene = SCENE.replacen("surface = \"LOW\"\n", "", 1);
    folder.write("s.toml", &scene);
    let run = folder.inpact(&["solve", "s.toml"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let line = |text: &str| folder.read("d.inp").lines().position(|line| line == text).expect("the line") + 1;
    for said in [
        format!(
            "warning[D025] *CFLUX on `ALL` acts on 4 nodes that no node of the scene stands for (line {} of `d.inp`)",
            line("ALL, 11, 1.")
        ),
        format!("warning[D025] *RADIATE is not taken over (line {} of `d.inp`)", line("*RADIATE")),
        format!(
            "warning[D025] the row of *DFLUX is not taken over: expected a face such as `S1`, found `BF` (line {} of `d.inp`)",
            line("UPPER, BF, 3.")
        ),
        format!("warning[D025] *BOUNDARY with USER is not taken over (line {} of `d.inp`)", line("*BOUNDARY, USER")),
    ] {
        assert!(run.errors.contains(&said), "{said}\n{}", run.errors);
    }
    assert_eq!(run.errors.matches("D025").count(), 4, "{}", run.errors);
}

#[test]
fn a_node_has_one_condition() {
    let folder = folder("*BOUNDARY\nBOTTOM, 11, 11, 20.\n15, 11, 11, 120.\n");
    let run = folder.inpact(&["solve", "s.toml"]);
    let said = "s.toml:14: error[D024] the temperature of `top`: *BOUNDARY holds the temperature of 1 of its 4 nodes only (line ";
    assert!(run.code == 1 && run.errors.contains(said), "{}", run.errors);
    // What the scene says has the say.
    folder.write("s.toml", &SCENE.replacen("set = \"TOP\"\n", "set = \"TOP\"\ntemperature = { fixed = 120.0 }\n", 1));
    close(&temperatures(&folder.inpact(&["solve", "s.toml"]), "up"), &[70.0]);
    folder.write("s.toml", SCENE);
    let several = format!("{DECK}*BOUNDARY\nBOTTOM, 11, 11, 20.\nTOP, 11, 11, 120.\n15, 11, 11, 130.\n*END STEP\n");
    folder.write("d.inp", &several);
    let run = folder.inpact(&["solve", "s.toml"]);
    assert!(
        run.code == 1 && run.errors.contains("holds its nodes at several values of the temperature"),
        "{}",
        run.errors
    );
}

#[test]
fn parts_that_are_not_there() {
    let folder = folder("*BOUNDARY\nBOTTOM, 11, 11, 20.\nTOP, 11, 11, 120.\n");
    for (from, to, said) in [
        ("set = \"TOP\"", "set = \"ROOF\"", "error[D023] the deck has no node set `ROOF` with a node in it"),
        ("surface = \"UP\"", "surface = \"TOP\"", "error[D023] the deck has no surface `TOP` with a node in it"),
        ("set = \"TOP\"", "set = \"BOTTOM\"", "error[D024] two nodes stand for the node set `BOTTOM`"),
        ("set = \"TOP\"", "set = \"TOP\"\nsurface = \"ROOF\"", "error[D011] node `top` has `set` and `surface`"),
        ("[conditions]\n", "", "error[D011] the node stands for `BOTTOM` of the deck, and nothing is taken from there"),
        ("[conditions]\n", "[conditions]\nsteps = 1\n", "error[D011]"),
    ] {
        folder.write("s.toml", &SCENE.replacen(from, to, 1));
        let run = folder.inpact(&["solve", "s.toml"]);
        assert!(run.code == 1 && run.errors.contains(said), "{said}\n{}", run.errors);
    }
}
