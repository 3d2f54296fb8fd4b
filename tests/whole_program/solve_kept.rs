//! What `inpact solve` keeps: the states before a failure, every row of the interfaces, and the files that a scene is made from.

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
    let (states, links) = shown.output.split_once("\n\n").expect("links behind the states");
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
