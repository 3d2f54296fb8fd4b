//! Scenes that are hard to solve or have no solution: steep tables, rough tolerances, first guesses at which nothing flows, temperatures that cannot be.

use super::solve::close;
use crate::program::{Folder, Run};

/// Solves a scene beside its deck.
fn solve(deck: &str, scene: &str, arguments: &[&str]) -> Run {
    let folder = Folder::with(&[("deck.inp", deck), ("scene.toml", &format!("deck = \"deck.inp\"\n{scene}"))]);
    folder.inpact(&[&["solve", "scene.toml"], arguments].concat())
}

/// The number of a node in a column of the state, from 1.
fn value(run: &Run, node: &str, column: usize) -> f64 {
    assert_eq!(run.code, 0, "{}", run.errors);
    let of_node = |line: &&str| line.split(',').next() == Some(node);
    let line = run.output.lines().find(of_node).unwrap_or_else(|| panic!("{node} in {}", run.output));
    line.split(',').nth(column).and_then(|cell| cell.parse().ok()).expect("a number")
}

const TEMPERATURE: usize = 2;

/// Walls at 1 K radiate 5.67e-8 W to a body at most: a watt cannot be drawn from it.
#[test]
fn no_temperature_is_below_absolute_zero() {
    let deck = "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0., STEFAN BOLTZMANN=5.67E-8\n*SURFACE INTERACTION, NAME=R\n*GAP RADIATION\n1., 1.\n1., 0.\n1., 10.\n";
    let scene = |body: &str, walls: &str| {
        format!(
            "[[node]]\nname = \"body\"\ntemperature = {body}\n[[node]]\nname = \"walls\"\ntemperature = {{ fixed = {walls} }}\n\
             [[interface]]\nslave = \"body\"\nmaster = \"walls\"\narea = 1.0\nclearance = 1.0\n"
        )
    };
    let run = solve(deck, &scene("{ source = -1.0 }", "1.0"), &[]);
    assert!(run.code == 1 && run.output.is_empty(), "{}", run.shown());
    assert!(run.errors.contains("error[D019] the temperature of `body` would be -"), "{}", run.errors);
    // 5.67e-8 (100⁴ − T⁴) = 1 has a solution.
    let run = solve(deck, &scene("{ source = -1.0 }", "100.0"), &[]);
    close(value(&run, "body", TEMPERATURE), (1e8 - 1.0 / 5.67e-8_f64).powf(0.25));
    // Given values are held to the same.
    for (body, walls) in [("{ fixed = 5.0 }", "-1.0"), ("{ initial = -2.0 }", "1.0")] {
        let run = solve(deck, &scene(body, walls), &[]);
        assert!(
            run.code == 1 && run.errors.contains("error[D014]") && run.errors.contains("below absolute zero"),
            "{}",
            run.errors
        );
    }
}

/// A table that is zero at the first guess: x²/2 − 10 x − 5000 = 0 for x = T − 40.
#[test]
fn a_switch_that_is_off_at_the_first_guess() {
    let deck = "*SURFACE INTERACTION, NAME=S\n*GAP CONDUCTANCE, PRESSURE\n 0., 0., 50.\n 0., 1., 50.\n 1., 0., 100.\n 1., 1., 100.\n";
    let scene = |heater: &str| {
        format!(
            "[[node]]\nname = \"sink\"\ntemperature = {{ fixed = 40.0 }}\n[[node]]\nname = \"heater\"\ntemperature = {heater}\n\
             [[interface]]\nslave = \"heater\"\nmaster = \"sink\"\narea = 1.0\nclosed = true\npressure = 0.5\n"
        )
    };
    let run = solve(deck, &scene("{ source = 100.0 }"), &[]);
    close(value(&run, "heater", TEMPERATURE), 50.0 + 10_100.0_f64.sqrt());
    // If nothing flows at the solution either, its level is undetermined.
    let off = deck.replace("1., 0., 100.", "0., 0., 100.").replace("1., 1., 100.", "0., 1., 100.");
    let run = solve(&off, &scene("{ source = 100.0 }"), &[]);
    assert!(run.code == 1 && run.errors.contains("error[D016]"), "{}", run.errors);
}

/// A conductance that falls from 2 to 1 within a millionth of a degree: the solution lies in the fall, at 1.5 of it, where a last digit of the temperature is 1e-8 of the conductance.
#[test]
fn a_fall_within_a_few_digits_of_a_temperature() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n 2.0, 0.0, 100.0\n 1.0, 0.0, 100.000001\n*GAP HEAT GENERATION\n 1., 0.5\n";
    let link = |node: &str| format!("[[link]]\nnodes = [\"{node}\", \"env\"]\nthermal = 0.00937499994140625\n");
    let scene = format!(
        "[[node]]\nname = \"a\"\npotential = {{ fixed = 1.0 }}\n[[node]]\nname = \"b\"\npotential = {{ fixed = 0.0 }}\n\
         [[node]]\nname = \"env\"\ntemperature = {{ fixed = 20.0 }}\n{}{}\
         [[interface]]\nslave = \"a\"\nmaster = \"b\"\narea = 1.0\nclosed = true\npressure = 0.0\n",
        link("a"),
        link("b")
    );
    let run = solve(deck, &scene, &[]);
    let temperature = value(&run, "a", TEMPERATURE);
    assert!((temperature - 100.000_000_5).abs() < 2e-12, "{temperature:?}");
}

/// Monotone scenes of one unknown with steep steps: a source S into g(θ̄)(T − 0), g in steps that rise or fall.
#[test]
fn one_unknown_at_steep_steps_is_bracketed() {
    // g θ rises through the fall, from 10 · 10 to 4 · 26 in means: one solution for every source.
    for (rows, sources) in [
        (
            "10., 0., 5.\n 10., 1., 5.\n 1000., 0., 5.0001\n 1000., 1., 5.0001\n 1001., 0., 9.\n 1001., 1., 9.\n",
            [50.0, 90.0, 101.0, 5_000.0, 9_000.0, 30_000.0],
        ),
        ("1e-3, 0., 50.\n 1e-3, 1., 50.\n 1e6, 0., 50.00001\n 1e6, 1., 50.00001\n", [0.01, 0.05, 0.1, 1.0, 1e7, 1e9]),
    ] {
        let deck = format!("*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n {rows}");
        for source in sources {
            let scene = format!(
                "[[node]]\nname = \"ground\"\ntemperature = {{ fixed = 0.0 }}\n[[node]]\nname = \"hot\"\ntemperature = {{ source = {source:?} }}\n\
                 [[interface]]\nslave = \"hot\"\nmaster = \"ground\"\narea = 1.0\nclosed = true\npressure = 0.5\n"
            );
            let run = solve(&deck, &scene, &["--format", "json"]);
            assert_eq!(run.code, 0, "{source}: {}", run.errors);
            assert!(run.errors.contains("\"missing\":0.0") || run.errors.contains("e-"), "{}", run.errors);
        }
    }
}

const MILD: &str = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n 10., 0., 0.\n 5.,  0., 200.\n\
                    *GAP CONDUCTANCE, PRESSURE\n 3., 0., 0.\n 3., 1., 0.\n 2., 0., 200.\n 2., 1., 200.\n";

/// A scene solved to the last digit is solved to any tolerance, by every solver, and not worse than that.
#[test]
fn a_looser_tolerance_fails_nowhere() {
    let mut scene = String::from("joule_heat_fraction = 1.0\n");
    for (name, potential) in [("p", "10.0"), ("q", "0.0")] {
        scene += &format!(
            "[[node]]\nname = \"{name}\"\npotential = {{ fixed = {potential} }}\ntemperature = {{ fixed = 20.0 }}\n"
        );
    }
    for name in ["a", "b", "c"] {
        scene += &format!("[[node]]\nname = \"{name}\"\n");
    }
    for (one, other, electrical, thermal) in
        [("p", "a", 4.1, 2.3), ("p", "c", 1.3, 0.7), ("b", "q", 3.7, 1.9), ("c", "b", 2.9, 1.1)]
    {
        scene +=
            &format!("[[link]]\nnodes = [\"{one}\", \"{other}\"]\nelectrical = {electrical}\nthermal = {thermal}\n");
    }
    for (slave, master, area) in [("a", "b", 1.0), ("c", "a", 0.31)] {
        scene += &format!(
            "[[interface]]\nslave = \"{slave}\"\nmaster = \"{master}\"\narea = {area:?}\nclosed = true\npressure = 0.0\n"
        );
    }
    let right = value(&solve(MILD, &scene, &[]), "b", TEMPERATURE);
    for solver in ["direct", "mixed", "iterative"] {
        for tolerance in ["1e-1", "1e-3", "1e-6", "1e-12"] {
            let run = solve(MILD, &scene, &["--solver", solver, "--tolerance", tolerance]);
            let found = value(&run, "b", TEMPERATURE);
            let allowed = 10.0 * tolerance.parse::<f64>().expect("a number") * right;
            assert!((found - right).abs() <= allowed, "{solver} {tolerance}: {found} {right}");
        }
    }
}

/// Two porous blocks that begin with different pressures meet at a joint without resistance: they share what they hold, in proportion to their capacities.
#[test]
fn initial_values_at_a_joint_without_resistance() {
    let deck = "*SURFACE INTERACTION, NAME=J\n*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.5, CUTOFF GAP FILL=0.5\n";
    let scene = |a: &str, b: &str| {
        format!(
            "procedure = \"transient\"\n[time]\nend = 1.0\nstep = 0.5\n[[node]]\nname = \"a\"\npore_pressure = {a}\n\
             [[node]]\nname = \"b\"\npore_pressure = {b}\n\
             [[interface]]\nslave = \"a\"\nmaster = \"b\"\narea = 1.0\nclearance = 0.0\n"
        )
    };
    let of_node = |run: &Run, node: &str| -> Vec<f64> {
        assert_eq!(run.code, 0, "{}", run.errors);
        let lines = run.output.lines().filter(|line| line.starts_with(&format!("{node},")));
        lines.map(|line| line.rsplit(',').next().and_then(|cell| cell.parse().ok()).expect("a number")).collect()
    };
    let run = solve(deck, &scene("{ capacity = 1.0, initial = 100.0 }", "{ capacity = 3.0, initial = 20.0 }"), &[]);
    assert_eq!((of_node(&run, "a"), of_node(&run, "b")), (vec![100.0, 40.0, 40.0], vec![20.0, 40.0, 40.0]));
    // Beside a fixed value an initial one has no say from the first increment on.
    let run = solve(deck, &scene("{ fixed = 7.0 }", "{ capacity = 3.0, initial = 20.0 }"), &[]);
    assert_eq!((of_node(&run, "a"), of_node(&run, "b")), (vec![7.0; 3], vec![20.0, 7.0, 7.0]));
    // Two fixed values are one too many at any time.
    let run = solve(deck, &scene("{ fixed = 7.0 }", "{ fixed = 8.0 }"), &[]);
    assert!(run.code == 1 && run.errors.contains("error[D017]"), "{}", run.errors);
}

const RUBBING: &str = "*SURFACE INTERACTION, NAME=F\n*GAP CONDUCTANCE, PRESSURE\n 10., 0.\n 10., 1.\n*GAP HEAT GENERATION\n 0.8, 0.25\n*FRICTION\n 0.3,\n";

/// Surfaces that are apart do not rub, and friction never cools; in `eval` as well.
#[test]
fn friction_heats_what_touches() {
    let scene = |clearance: &str, shear: &str| {
        format!(
            "[[node]]\nname = \"b\"\ntemperature = {{ fixed = 0.0 }}\n[[node]]\nname = \"c\"\ntemperature = {{ fixed = 0.0 }}\n\
             [[interface]]\nslave = \"b\"\nmaster = \"c\"\narea = 1.0\npressure = 0.0\nclearance = {clearance}\nshear = {shear}\nslip_rate = 2.0\n"
        )
    };
    let run = solve(RUBBING, &scene("0.0", "3.0"), &[]);
    assert!(
        run.errors.contains("4.800000000000001 generated") || run.errors.contains("4.8 generated"),
        "{}",
        run.errors
    );
    let run = solve(RUBBING, &scene("0.5", "3.0"), &[]);
    assert!(
        run.errors.contains(" 0.0 generated") && run.errors.contains("left out: heat of friction of 1 interface"),
        "{}",
        run.errors
    );
    let run = solve(RUBBING, &scene("0.0", "-3.0"), &[]);
    assert!(
        run.code == 1 && run.errors.contains("error[D014] `shear` of the interface of `b` and `c` is -3.0"),
        "{}",
        run.errors
    );
    let nodes = "clearance,pressure,temp_s,temp_m,shear,slip_rate\n0,0,0,0,3,2\n0.5,0,0,0,3,2\n";
    let folder = Folder::with(&[("deck.inp", RUBBING), ("nodes.csv", nodes)]);
    let run = folder.inpact(&["eval", "deck.inp", "--nodes", "nodes.csv", "--outputs", "SFDR"]);
    assert!(
        run.output.lines().skip(1).map(str::trim).eq(["4.800000000000001", "0"]) || run.output.contains("4.8\n0"),
        "{}",
        run.output
    );
}

/// Values without effect are noted.
#[test]
fn values_without_effect_are_noted() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n 10., 0.\n 10., 1.\n";
    let scene = "procedure = \"transient\"\n[time]\nend = 1.0\nstep = 0.5\n\
                 [[node]]\nname = \"a\"\ntemperature = { fixed = 100.0, initial = 5.0 }\n[[node]]\nname = \"b\"\ntemperature = { initial = 77.0 }\n\
                 [[node]]\nname = \"c\"\ntemperature = { fixed = 0.0 }\n[[link]]\nnodes = [\"a\", \"b\"]\nthermal = 2.0\n\
                 [[link]]\nnodes = [\"b\", \"c\"]\nthermal = 2.0\n\
                 [[interface]]\nslave = \"b\"\nmaster = \"c\"\narea = 1.0\nclosed = false\npressure = 5.0\nfv = [1.0]\n";
    let run = solve(deck, scene, &[]);
    for note in [
        "`initial` of `temperature` of 1 node: its value is fixed",
        "only a first guess",
        "`closed = false` has the say over it",
        "`fv` of 1 interface",
    ] {
        assert!(run.errors.contains(note), "{note}: {}", run.errors);
    }
}

/// D014: digits that leave the range of f64 are no infinity and no zero that was meant, in tables, matrices and the scene alike.
#[test]
fn numbers_beyond_the_range_are_refused_everywhere() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n 10., 0.\n 10., 1.\n";
    let ends = "[[node]]\nname = \"1\"\ntemperature = { fixed = 100.0 }\n[[node]]\nname = \"2\"\ntemperature = { fixed = 0.0 }\n";
    let matrix = |value: &str| format!("%%MatrixMarket matrix coordinate real symmetric\n2 2 1\n2 1 {value}\n");
    let (link, capacity) =
        (|value: &str| format!("node_1,node_2,thermal\n1,2,{value}\n"), "[[link]]\nnodes = [\"1\", \"2\"]\nthermal = ");
    for value in ["1e400", "1e-400", "+2.5E999"] {
        let files = [("links.csv", link(value)), ("k.mtx", matrix(value))];
        for (name, text) in &files {
            let conducts = if *name == "k.mtx" { "conducts = \"thermal\"\n" } else { "" };
            let scene = format!(
                "deck = \"deck.inp\"\n[[link_file]]\nfile = \"{name}\"\n{conducts}{}",
                if *name == "k.mtx" { "" } else { ends }
            );
            let folder = Folder::with(&[("deck.inp", deck), ("scene.toml", &scene), (name, text)]);
            let run = folder.inpact(&["solve", "scene.toml"]);
            assert!(run.code == 1 && run.errors.contains("error[D014]"), "{name} {value}: {}", run.errors);
        }
        let run = solve(deck, &format!("{ends}{capacity}{value}\n"), &[]);
        assert_eq!(run.code, 1, "{value}: {}", run.errors);
    }
    // An infinity, or a zero, that is written is meant.
    for (value, hot) in [("inf", 50.0), ("0.0e5", 100.0)] {
        let run = solve(
            deck,
            &format!(
                "{}{capacity}{value}\n[[link]]\nnodes = [\"1\", \"3\"]\nthermal = 1.0\n",
                ends.replace("{ fixed = 0.0 }", "{}").replace("= \"2\"", "= \"2\"\npotential = { source = 0.0 }")
                    + "[[node]]\nname = \"3\"\ntemperature = { source = 0.0 }\n"
            ),
            &[],
        );
        // The second node has the value of the first, or none.
        assert_eq!(run.code == 0, hot < 60.0, "{value}: {}", run.errors);
    }
}

/// A product that is beyond the range names both factors.
#[test]
fn a_conductance_times_an_area_beyond_the_range() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n 10., 0.\n 10., 1.\n";
    let scene = "[[node]]\nname = \"b\"\ntemperature = { fixed = 1.0 }\n[[node]]\nname = \"c\"\ntemperature = { fixed = 0.0 }\n\
                 [[interface]]\nslave = \"b\"\nmaster = \"c\"\narea = 1e308\nclosed = true\npressure = 1.0\n";
    let run = solve(deck, scene, &[]);
    assert!(
        run.code == 1 && run.errors.contains("10.0, times its area of 1e308 is beyond the range"),
        "{}",
        run.errors
    );
}

/// All that is wrong with a scene is told in one run: files that are missing, and beside its own errors the interactions that the deck lacks.
#[test]
fn one_run_tells_all_that_is_wrong() {
    let deck = "*SURFACE INTERACTION, NAME=COND\n*GAP CONDUCTANCE, PRESSURE\n 10., 0.\n 10., 1.\n";
    let ends = "[[node]]\nname = \"a\"\ntemperature = { fixed = nan }\n[[node]]\nname = \"b\"\n";
    let row = "[[interface]]\ninteraction = \"KOND\"\nslave = \"a\"\nmaster = \"b\"\narea = -1.0\nclearance = 0.0\n";
    let run = solve(deck, &format!("{ends}{row}"), &[]);
    for code in ["[D014] `fixed`", "[D014] `area`", "[D004] the deck defines no interaction `KOND`"] {
        assert!(run.code == 1 && run.errors.contains(code), "{code}: {}", run.errors);
    }
    let folder = Folder::with(&[(
        "scene.toml",
        "deck = \"none.inp\"\n[[node_file]]\nfile = \"n.csv\"\n[[link_file]]\nfile = \"l.csv\"\n",
    )]);
    let run = folder.inpact(&["solve", "scene.toml"]);
    assert_eq!(run.code, 2, "{}", run.errors);
    for name in ["none.inp", "n.csv", "l.csv"] {
        assert_eq!(run.errors.matches(&format!("cannot read `{name}`")).count(), 1, "{name}: {}", run.errors);
    }
}

/// Tables beside a scene may occur between commas, semicolons or tabs, as node tables may.
#[test]
fn scene_tables_with_other_separators() {
    let deck = "*SURFACE INTERACTION, NAME=COND\n*GAP CONDUCTANCE, PRESSURE\n 10., 0.\n 10., 1.\n";
    let tables = [
        "node,temperature_fixed\na,100\nb,\nc,0\n",
        "\"node_1\",node_2,thermal\na,b,10\n",
        "slave,master,area,pressure\nb,c,1,0.5\n",
    ];
    for separator in [",", ";", "\t"] {
        let [nodes, links, rows] = tables.map(|table| table.replace(',', separator));
        let scene = "deck = \"deck.inp\"\n[[node_file]]\nfile = \"n.csv\"\n[[link_file]]\nfile = \"l.csv\"\n[[interface_file]]\nfile = \"r.csv\"\n";
        let folder = Folder::with(&[
            ("deck.inp", deck),
            ("scene.toml", scene),
            ("n.csv", &nodes),
            ("l.csv", &links),
            ("r.csv", &rows),
        ]);
        close(value(&folder.inpact(&["solve", "scene.toml"]), "b", TEMPERATURE), 50.0);
    }
    // A decimal comma is no number.
    let folder = Folder::with(&[
        ("deck.inp", deck),
        ("scene.toml", "deck = \"deck.inp\"\n[[node_file]]\nfile = \"n.csv\"\n"),
        ("n.csv", "node;temperature_fixed\na;1,5\n"),
    ]);
    let run = folder.inpact(&["solve", "scene.toml"]);
    assert!(run.code == 1 && run.errors.contains("error[D002]") && run.errors.contains("`1,5`"), "{}", run.errors);
}

/// A ring of contacts whose tables rise and fall by decades: substitution finds what Newton's iteration does not. The temperatures were found by another program,
/// with substitution that goes a hundredth of the way.
#[test]
fn a_ring_of_steep_contacts() {
    let folder =
        Folder::with(&[("ring.inp", include_str!("scenes/ring.inp")), ("ring.toml", include_str!("scenes/ring.toml"))]);
    let run = folder.inpact(&["solve", "ring.toml"]);
    let found = [
        ("n0", 1.719_110_853_56),
        ("n1", 1.718_967_703_19),
        ("n2", 0.000_318_995_170_13),
        ("n3", 0.000_318_987_991_073),
        ("n4", 4.350_017_296_04e-05),
        ("n6", 13.201_879_058_1),
        ("n7", 13.237_922_003_4),
        ("n8", 13.171_743_960_5),
        ("n9", 1.719_110_875_35),
    ];
    for (node, temperature) in found {
        let solved = value(&run, node, TEMPERATURE);
        assert!((solved / temperature - 1.0).abs() < 1e-10, "{node}: {solved} {temperature}");
    }
}
