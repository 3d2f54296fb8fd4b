//! Files of `inpact solve`: the states before a failure, every row of the interfaces, and the files that a scene is made from.

use super::solve::Table;
use crate::program::Folder;

/// A conductance that falls to nothing as the gap opens.
const HEAT: &str = "\
*SURFACE INTERACTION, NAME=JOINT
*GAP CONDUCTANCE
10., 0.
5., 1.
0., 1.5
";

/// A gap that opens between times 0 and 3, after which nothing holds what is heated.
const OPENING: &str = "\
deck = \"deck.inp\"
procedure = \"transient\"
[time]
end = 4.0
step = 1.0
[[node]]
name = \"a\"
temperature = { source = 1.0 }
[[node]]
name = \"b\"
temperature = { fixed = 1.0 }
[[link]]
nodes = [\"b\", \"c\"]
thermal = 1.0
[[node]]
name = \"c\"
[[interface]]
slave = \"a\"
master = \"b\"
area = 1.0
clearance = [[0.0, 0.0], [3.0, 1.5]]
";

fn opening() -> Folder {
    Folder::with(&[("deck.inp", HEAT), ("scene.toml", OPENING)])
}

#[test]
fn the_states_before_a_failure_are_kept_wherever_they_go() {
    let folder = opening();
    let shown = folder.inpact(&["solve", "scene.toml", "--links"]);
    assert_eq!(shown.code, 1, "{}", shown.errors);
    assert!(shown.errors.contains("D016") && shown.errors.contains("after time 2.0"), "{}", shown.errors);
    let (states, links) = shown.output.split_once("\n\n").expect("links after the states");
    assert_eq!(Table::read(states).course(&["a"], "time"), [0.0, 1.0, 2.0]);
    assert_eq!(Table::read(links).course(&["b", "c"], "time"), [0.0, 1.0, 2.0]);
    let arguments = ["solve", "scene.toml", "-o", "states.csv", "--links=links.csv", "--interfaces", "rows.csv"];
    let run = folder.inpact(&arguments);
    assert_eq!((run.code, run.output.as_str()), (1, ""), "{}", run.errors);
    assert_eq!(folder.read("states.csv"), format!("{states}\n"));
    assert_eq!(folder.read("links.csv"), links);
    assert_eq!(Table::read(&folder.read("rows.csv")).course(&["a"], "time"), [0.0, 1.0, 2.0]);
}

#[test]
fn the_states_before_a_failure_are_kept_as_json() {
    let run = opening().inpact(&["solve", "scene.toml", "--format", "json"]);
    assert_eq!(run.code, 1, "{}", run.errors);
    let document: serde_json::Value = serde_json::from_str(&run.output).expect("a document");
    let states = document["states"].as_array().expect("states");
    assert_eq!((states.len(), document["time"].as_f64()), (3, Some(2.0)));
}

const CURRENT: &str = "\
*SURFACE INTERACTION, NAME=JOINT
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
20., 0.
30., 100.
";

/// Two parallel rows, a node that is called as the pair is, and a third that reads as both of them do.
#[test]
fn parallel_rows_have_labels_of_their_own() {
    let mut scene = "deck = \"deck.inp\"\nprocedure = \"transient\"\n[time]\nend = 1.0\nstep = 0.5\n".to_owned();
    for (name, potential) in [("a", 2.0), ("b", 1.0), ("a|b", 2.0), ("c", 1.0), ("b|c", 1.0), ("a|b|3", 1.0)] {
        scene += &format!("[[node]]\nname = \"{name}\"\npotential = {{ fixed = {potential:?} }}\n");
    }
    let pairs = [("a", "b", 0), ("a", "b", 50), ("a|b", "c", 0), ("a|b", "c", 50), ("a", "b|c", 0), ("a|b|3", "c", 0)];
    for (slave, master, pressure) in pairs {
        scene += &format!(
            "[[interface]]\nslave = \"{slave}\"\nmaster = \"{master}\"\narea = 1.0\nclearance = 0.0\npressure = {pressure}.0\n"
        );
    }
    let folder = Folder::with(&[("deck.inp", CURRENT), ("scene.toml", &scene)]);
    let run = folder.inpact(&["solve", "scene.toml", "-o", "states.csv", "--interfaces", "rows.csv"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert_eq!(Table::read(&folder.read("states.csv")).course(&["a"], "time"), [0.0, 0.5, 1.0]);
    let rows = Table::read(&folder.read("rows.csv"));
    let labels = ["a|b|2", "a|b|4", "a|b|c", "a|b|c|2", "a|b|c|3", "a|b|3"];
    for (label, current) in labels.into_iter().zip([20.0, 25.0, 20.0, 25.0, 20.0, 0.0]) {
        assert_eq!(rows.course(&[label], "ECD"), [current; 3], "{label}");
    }
}

/// A corner that is near the ends of two increments lies in neither of them.
#[test]
fn a_corner_near_two_ends_is_passed_over_by_none() {
    let scene =
        OPENING.replace("end = 4.0", "end = 1.0000000015").replace("[3.0, 1.5]", "[1.00000000075, 0.5], [5.0, 1.0]");
    let run = Folder::with(&[("deck.inp", HEAT), ("scene.toml", &scene)]).inpact(&["solve", "scene.toml"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(!run.errors.contains("passed over"), "{}", run.errors);
    let scene = scene.replace("1.00000000075", "0.75");
    let run = Folder::with(&[("deck.inp", HEAT), ("scene.toml", &scene)]).inpact(&["solve", "scene.toml"]);
    assert!(run.errors.contains("1 point of time courses inside increments, passed over"), "{}", run.errors);
}

#[test]
fn increments_that_rounding_would_lose_are_refused() {
    let cases = [
        ("step = 1.0", "tolerance = 1e-13", "`tolerance` is 1e-13", "1e-12 or above"),
        ("step = 1.0", "step = 1e-16", "`step` is 1e-16", "give a longer one"),
        ("step = 1.0", "tolerance = 1e-3\nfirst_step = 1e-16", "`first_step` is 1e-16", "give a longer one"),
        (
            "end = 4.0\nstep = 1.0",
            "start = 1e9\nend = 1000000001\nstep = 5e-7",
            "beside a time of 1000000001.0",
            "nearer to 0",
        ),
        (
            "step = 1.0",
            "step = 1e-7",
            "a `step` of 1e-7 makes 40000000 increments, more than 10000000",
            "longer `step`",
        ),
    ];
    for (from, to, message, help) in cases {
        let folder = Folder::with(&[("deck.inp", HEAT), ("scene.toml", &OPENING.replace(from, to))]);
        let run = folder.inpact(&["solve", "scene.toml"]);
        assert_eq!((run.code, run.output.as_str()), (1, ""), "{to}: {}", run.errors);
        for said in ["D015", message, help] {
            assert!(run.errors.contains(said), "{said}: {}", run.errors);
        }
    }
}

/// Temperature is solved for elsewhere; where the row is not part of that, its own temperature counts, then that of the scene.
#[test]
fn a_row_of_a_given_temperature_is_evaluated_at_it() {
    let deck = "*SURFACE INTERACTION, NAME=JOINT\n*GAP ELECTRICAL CONDUCTANCE\n10., 0., 0.\n10., 1., 0.\n20., 0., 100.\n20., 1., 100.\n";
    let scene = "\
deck = \"deck.inp\"
[initial]
temperature = 30.0
[[node]]
name = \"a\"
potential = { fixed = 2.0 }
[[node]]
name = \"b\"
potential = { fixed = 1.0 }
[[node]]
name = \"c\"
temperature = { fixed = 5.0 }
[[node]]
name = \"d\"
[[link]]
nodes = [\"c\", \"d\"]
thermal = 1.0
[[interface]]
slave = \"a\"
master = \"b\"
area = 1.0
clearance = 0.0
temperature = 50.0
[[interface]]
slave = \"b\"
master = \"a\"
area = 1.0
clearance = 0.0
";
    let folder = Folder::with(&[("deck.inp", deck), ("scene.toml", scene)]);
    let run = folder.inpact(&["solve", "scene.toml", "--interfaces", "rows.csv"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let rows = Table::read(&folder.read("rows.csv"));
    assert_eq!((rows.number(&["a"], "ECD"), rows.number(&["b"], "ECD")), (15.0, -13.0));
}

#[test]
fn failures_at_rows_of_a_table_name_its_line() {
    let deck = "*SURFACE INTERACTION, NAME=JOINT\n*CONTACT PERMEABILITY\n2., 0.\n";
    let scene = "\
deck = \"deck.inp\"
[[node]]
name = \"a\"
pore_pressure = { fixed = 1.0 }
[[node]]
name = \"b\"
pore_pressure = { source = 1.0 }
[[interface_file]]
file = \"rows.csv\"
";
    let rows = "slave,master,area,clearance,pressure\na,b,1,0,0\nb,a,1,0.5,0\n";
    let folder = Folder::with(&[("deck.inp", deck), ("scene.toml", scene), ("rows.csv", rows)]);
    let run = folder.inpact(&["solve", "scene.toml"]);
    assert_eq!(run.code, 1, "{}", run.errors);
    assert!(run.errors.contains("D018") && run.errors.contains("(line 3 of `rows.csv`)"), "{}", run.errors);
}

#[test]
fn failures_say_what_to_try() {
    let run = opening().inpact(&["solve", "scene.toml"]);
    assert!(run.errors.contains("give one of these nodes a fixed temperature, a capacity, or"), "{}", run.errors);
    let huge = "deck = \"deck.inp\"\n[[node]]\nname = \"a\"\ntemperature = { fixed = 1.7e308 }\n[[node]]\nname = \"b\"\n\
                temperature = { fixed = -1.7e308 }\n[[link]]\nnodes = [\"a\", \"b\"]\nthermal = 1.0\n";
    let run = Folder::with(&[("deck.inp", HEAT), ("scene.toml", huge)]).inpact(&["solve", "scene.toml"]);
    assert_eq!(run.code, 1, "{}", run.errors);
    assert!(run.errors.contains("D019") && run.errors.contains("a larger `--tolerance`"), "{}", run.errors);
}

/// A scene of every kind of file: a table beside it, a deck, and a deck that this includes.
#[test]
fn no_result_replaces_what_the_scene_is_made_from() {
    let scene = OPENING.to_owned() + "[[link_file]]\nfile = \"links.csv\"\n";
    let inputs = [
        ("deck.inp", "*INCLUDE, INPUT=joint.inp\n"),
        ("joint.inp", HEAT),
        ("links.csv", "node_1,node_2,thermal\nb,c,1\n"),
        ("scene.toml", &scene),
    ];
    let folder = Folder::with(&inputs);
    for (name, _) in inputs {
        let links = format!("--links={name}");
        let commands: [&[&str]; 4] = [
            &["solve", "scene.toml", "-o", name],
            &["solve", "scene.toml", &links],
            &["solve", "scene.toml", "--interfaces", name],
            &["tradeoff", "--scene", "scene.toml", "-o", name],
        ];
        for arguments in commands {
            let run = folder.inpact(arguments);
            assert_eq!((run.code, run.output.as_str()), (2, ""), "{arguments:?}: {}", run.errors);
            assert!(run.errors.contains("would replace"), "{arguments:?}: {}", run.errors);
        }
    }
    for (name, text) in inputs {
        assert_eq!(folder.read(name), text, "{name}");
    }
}

#[test]
fn two_results_do_not_go_to_one_file() {
    let folder = opening();
    let commands: [&[&str]; 3] = [
        &["solve", "scene.toml", "-o", "result.csv", "--interfaces", "./result.csv"],
        &["solve", "scene.toml", "-o", "result.csv", "--links=result.csv"],
        &["tradeoff", "--scene", "scene.toml", "-o", "result.svg", "--plot", "result.svg"],
    ];
    for arguments in commands {
        let run = folder.inpact(arguments);
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{arguments:?}: {}", run.errors);
        assert!(run.errors.contains("two results would go to"), "{arguments:?}: {}", run.errors);
    }
    assert_eq!(folder.names(), ["deck.inp", "scene.toml"]);
}
