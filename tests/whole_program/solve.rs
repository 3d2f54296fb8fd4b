//! `inpact solve`: what goes in and comes out by which stream, option and format, and what a person reads.

use crate::program::{Folder, Run, inpact, root};
use std::collections::BTreeMap;
use std::path::Path;

/// A table that was printed; where there is a time, the first rows of each key are at the start.
pub(crate) struct Table {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    pub(crate) fn read(csv: &str) -> Self {
        let mut lines = csv.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        let header = lines.next().expect("a header");
        let rows: Vec<Vec<String>> = lines.collect();
        assert!(rows.iter().all(|row| row.len() == header.len()), "{csv}");
        Self { header, rows }
    }

    fn place(&self, column: &str) -> usize {
        self.header.iter().position(|name| name == column).unwrap_or_else(|| panic!("no `{column}`: {:?}", self.header))
    }

    /// A column as text, in all rows that begin with `keys`, of which there is at least one.
    pub(crate) fn cells(&self, keys: &[&str], column: &str) -> Vec<&str> {
        let place = self.place(column);
        let rows = self.rows.iter().filter(|row| row.iter().zip(keys).all(|(cell, key)| cell == key));
        let cells: Vec<&str> = rows.map(|row| row[place].as_str()).collect();
        assert!(!cells.is_empty(), "no row {keys:?}");
        cells
    }

    /// A column in all rows that begin with `keys`: of a transient, its course.
    pub(crate) fn course(&self, keys: &[&str], column: &str) -> Vec<f64> {
        let number = |cell: &&str| cell.parse().unwrap_or_else(|_| panic!("{keys:?} {column}: `{cell}`"));
        self.cells(keys, column).iter().map(number).collect()
    }

    /// A number in the only row that begins with `keys`.
    pub(crate) fn number(&self, keys: &[&str], column: &str) -> f64 {
        let course = self.course(keys, column);
        assert_eq!(course.len(), 1, "{keys:?}");
        course[0]
    }

    /// A number in the last row that begins with `keys`.
    pub(crate) fn last(&self, keys: &[&str], column: &str) -> f64 {
        *self.course(keys, column).last().expect("a row")
    }
}

/// A solved scene: its nodes, its links and the result table of its interfaces.
pub(crate) struct Solved {
    pub(crate) nodes: Table,
    pub(crate) links: Table,
    pub(crate) interfaces: Table,
    pub(crate) errors: String,
}

/// Solves a scene in a folder.
pub(crate) fn solve_in(folder: &Folder, scene: &str, options: &[&str]) -> Solved {
    let run = folder.inpact(&[&["solve", scene, "--links", "--interfaces", "result.csv"], options].concat());
    assert_eq!(run.code, 0, "{}", run.errors);
    let (nodes, links) = run.output.split_once("\n\n").expect("an empty line before the links");
    let interfaces = Table::read(&folder.read("result.csv"));
    Solved { nodes: Table::read(nodes), links: Table::read(links), interfaces, errors: run.errors }
}

/// Solves a scene of the samples.
pub(crate) fn solve_sample(name: &str, options: &[&str]) -> Solved {
    solve_edited(name, &[], options)
}

/// Solves a scene of the samples with some of its text replaced, every time it stands there.
pub(crate) fn solve_edited(name: &str, changes: &[(&str, &str)], options: &[&str]) -> Solved {
    solve_in(&edited(name, changes), "scene.toml", options)
}

/// A folder with a scene of the samples, changed, as `scene.toml`, and its deck.
pub(crate) fn edited(name: &str, changes: &[(&str, &str)]) -> Folder {
    let path = root().join("decks/scenes").join(format!("{name}.toml"));
    let mut scene = std::fs::read_to_string(&path).expect("readable");
    for (from, to) in changes {
        assert!(scene.contains(from), "{name} has no `{from}`");
        scene = scene.replace(from, to);
    }
    let deck = scene.lines().find_map(|line| line.strip_prefix("deck = ")).expect("a deck").trim_matches('"');
    let text = std::fs::read_to_string(path.with_file_name(Path::new(deck))).expect("readable");
    Folder::with(&[("scene.toml", &scene), (deck, &text)])
}

/// Solves a scene with a deck of its own.
pub(crate) fn solve_text(deck: &str, scene: &str, options: &[&str]) -> Solved {
    let folder = Folder::with(&[("deck.inp", deck), ("scene.toml", &format!("deck = \"deck.inp\"\n{scene}"))]);
    solve_in(&folder, "scene.toml", options)
}

/// The document of a scene that is printed with `--format json`, and the one on standard error.
pub(crate) fn solve_json(folder: &Folder, options: &[&str]) -> (serde_json::Value, serde_json::Value) {
    let run = folder.inpact(&[&["solve", "scene.toml", "--format", "json"], options].concat());
    assert_eq!(run.code, 0, "{}", run.errors);
    let json = |text: &str| serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"));
    (json(&run.output), json(&run.errors))
}

/// Exact but for the last digits of f64.
pub(crate) fn close(found: f64, exact: f64) {
    within(found, exact, 1e-12);
}

pub(crate) fn within(found: f64, exact: f64, relative: f64) {
    assert!((found - exact).abs() <= relative * exact.abs(), "{found} for {exact}");
}

/// All the digits that were published.
pub(crate) fn prints(found: f64, published: &str) {
    let decimals = published.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    assert_eq!(format!("{found:.decimals$}"), published);
}

/// Standard error of a run, without the time it took and without the sizes of rounding errors, which another processor may round otherwise.
fn said(run: &Run) -> String {
    let of_rounding = |word: &str| {
        let number = word.trim_end_matches([',', ';']);
        let tiny = number.contains('e') && number.parse().is_ok_and(|size: f64| size.abs() < 1e-12);
        if tiny { word.replace(number, "TINY") } else { word.to_owned() }
    };
    let untimed = |line: &str| match line.rsplit_once(", ") {
        Some((before, time)) if time.ends_with(" s") => format!("{before}, TIME s"),
        _ => line.split(' ').map(of_rounding).collect::<Vec<_>>().join(" "),
    };
    run.errors.lines().map(|line| untimed(line) + "\n").collect()
}

#[test]
fn what_a_person_reads_of_a_steady_state() {
    let run = inpact(&["solve", "decks/scenes/two-bodies.toml", "--links"]);
    insta::assert_snapshot!(format!("{}--- standard error\n{}", run.output, said(&run)));
}

#[test]
fn what_a_person_reads_of_a_transient() {
    let run = inpact(&["solve", "decks/scenes/closing-gap.toml", "--links"]);
    insta::assert_snapshot!(format!("{}--- standard error\n{}", run.output, said(&run)));
}

/// A law of the deck that the scene says nothing of is no mistake, but it is told.
#[test]
fn parts_left_out_are_noted() {
    let errors = |name: &str, changes: &[(&str, &str)], options: &[&str]| solve_edited(name, changes, options).errors;
    let no_current = "left out: potential: the deck has laws of it, and the scene says nothing of it";
    assert!(errors("cooling", &[], &[]).contains(no_current));
    assert!(!errors("two-bodies", &[], &[]).contains("left out"));
    // `eval` says of the same deck: without heat of friction: `shear` is missing.
    let rubbed = errors("ccx/friction", &[("shear = 500.0\n", "")], &["--dialect", "calculix"]);
    assert!(rubbed.contains("heat of friction") && rubbed.contains("`shear`"), "{rubbed}");
}

#[test]
fn links_follow_the_nodes_or_have_a_file_of_their_own() {
    let folder = edited("two-bodies", &[]);
    let nodes = folder.inpact(&["solve", "scene.toml"]).output;
    let both = folder.inpact(&["solve", "scene.toml", "--links"]).output;
    let run = folder.inpact(&["solve", "scene.toml", "--links=links.csv", "-o", "nodes.csv"]);
    assert_eq!((run.code, run.output.as_str()), (0, ""), "{}", run.errors);
    assert_eq!(folder.read("nodes.csv"), nodes);
    assert_eq!(format!("{nodes}\n{}", folder.read("links.csv")), both);
}

#[test]
fn a_scene_may_come_from_standard_input() {
    let folder = edited("two-bodies", &[]);
    let from_file = folder.inpact(&["solve", "scene.toml"]);
    let run = folder.inpact_with_input(&["solve", "-"], folder.read("scene.toml").as_bytes());
    assert_eq!((run.code, run.output), (0, from_file.output), "{}", run.errors);
}

#[test]
fn json_has_the_numbers_of_the_tables() {
    for (name, more) in [("two-bodies", "links"), ("cooling", "states")] {
        let folder = edited(name, &[]);
        let tables = solve_in(&folder, "scene.toml", &[]);
        let (document, summary) = solve_json(&folder, &["--links"]);
        assert!(document[more].is_array(), "{document}");
        let nodes = document["nodes"].as_array().expect("nodes");
        for node in nodes {
            let name = node["node"].as_str().expect("a name");
            for field in ["potential", "temperature", "pore_pressure"] {
                let cell = tables.nodes.cells(&[name], field).last().expect("a row").parse::<f64>().ok();
                assert_eq!(node[field].as_f64(), cell, "{name} {field}");
            }
        }
        for link in document["links"].as_array().expect("links") {
            let nodes = [&link["nodes"][0], &link["nodes"][1]].map(|name| name.as_str().expect("a name"));
            assert_eq!(link["heat"].as_f64(), Some(tables.links.last(&nodes, "heat")));
        }
        assert_eq!((summary["nodes"].as_u64(), summary["interfaces"].as_u64()), (Some(nodes.len() as u64), Some(1)));
        assert_eq!(summary["balance"], document["balance"]);
    }
}

#[test]
fn the_states_of_a_transient_are_in_json_as_in_the_table() {
    let folder = edited("cooling", &[]);
    let course = solve_in(&folder, "scene.toml", &[]).nodes.course(&["hot"], "temperature");
    let (document, _) = solve_json(&folder, &[]);
    let states = document["states"].as_array().expect("states");
    let found: Vec<f64> = states.iter().filter_map(|state| state["nodes"][0]["temperature"].as_f64()).collect();
    assert_eq!((found.len(), found), (49, course));
}

/// The interface rows are those of `inpact eval` on the state that was found.
#[test]
fn the_table_of_interfaces_is_that_of_eval() {
    let folder = edited("two-bodies", &[]);
    let solved = solve_in(&folder, "scene.toml", &[]);
    let of = |node: &str, field: &str| solved.nodes.cells(&[node], field)[0].to_owned();
    let cells = ["potential", "temperature"].map(|field| [of("left-face", field), of("right-face", field)].join(","));
    let header = "node,interaction,clearance,pressure,area,epot_s,epot_m,temp_s,temp_m";
    folder.write("nodes.csv", &format!("{header}\nleft-face,PLATES,0,0,1,{}\n", cells.join(",")));
    let run = folder.inpact(&["eval", "published.inp", "--nodes", "nodes.csv", "--procedure", "steady"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let eval = Table::read(&run.output);
    assert_eq!(eval.header, solved.interfaces.header);
    for column in &eval.header[2..] {
        if column.ends_with("status") {
            assert_eq!(solved.interfaces.cells(&["left-face"], column), eval.cells(&["left-face"], column));
        } else {
            close(solved.interfaces.number(&["left-face"], column), eval.number(&["left-face"], column));
        }
    }
}

#[test]
fn nodes_links_and_interfaces_may_come_from_files() {
    let folder = edited("plates", &[]);
    let expected = folder.inpact(&["solve", "scene.toml", "--links"]).output;
    folder.write("nodes.csv", "node,potential_fixed,temperature_fixed\nend,100,100\nface,,\nopposite,50,50\n");
    folder.write("links.csv", "node_1,node_2,electrical,thermal\nend,face,1,1\n");
    folder.write("interfaces.csv", "slave,master,interaction,area,closed,pressure\nface,opposite,PLATES,1,1,0\n");
    let files = "[[node_file]]\nfile = \"nodes.csv\"\n[[link_file]]\nfile = \"links.csv\"\n[[interface_file]]\nfile = \"interfaces.csv\"\n";
    folder.write("files.toml", &format!("deck = \"published.inp\"\n{files}"));
    let run = folder.inpact(&["solve", "files.toml", "--links"]);
    assert_eq!((run.code, run.output), (0, expected), "{}", run.errors);
}

/// A blind end, to which nothing flows.
#[test]
fn no_flow_is_printed_as_0() {
    let scene = "[[node]]\nname = \"a\"\ntemperature = { fixed = 2.0 }\n[[node]]\nname = \"b\"\n[[link]]\nnodes = [\"a\", \"b\"]\nthermal = 3.0\n";
    let solved = solve_text("*SURFACE INTERACTION, NAME=A\n", scene, &[]);
    assert_eq!(solved.nodes.cells(&["b"], "temperature"), ["2"]);
    assert_eq!(solved.links.cells(&["a", "b"], "heat"), ["0"]);
}

/// Two plates of 8 by 8 nodes, pressed together at every node: heat from one edge of the one to the opposite edge of the other.
#[test]
fn the_solvers_agree() {
    let mut scene = String::new();
    for plate in ["a", "b"] {
        for (row, column) in (0..8).flat_map(|row| (0..8).map(move |column| (row, column))) {
            let held = match (plate, column) {
                ("a", 0) => "temperature = { fixed = 100.0 }\n",
                ("b", 7) => "temperature = { fixed = 20.0 }\n",
                _ => "",
            };
            scene += &format!("[[node]]\nname = \"{plate}{row}{column}\"\n{held}");
            for (next_row, next_column) in [(row + 1, column), (row, column + 1)] {
                if next_row < 8 && next_column < 8 {
                    let nodes = format!("[\"{plate}{row}{column}\", \"{plate}{next_row}{next_column}\"]");
                    scene += &format!("[[link]]\nnodes = {nodes}\nthermal = {}\n", 1.0 + f64::from(row) / 7.0);
                }
            }
            if plate == "b" {
                let nodes = format!("slave = \"a{row}{column}\"\nmaster = \"b{row}{column}\"");
                scene += &format!("[[interface]]\n{nodes}\narea = 0.01\nclearance = 0.0\npressure = {}.0\n", row * 10);
            }
        }
    }
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n10., 0.\n400., 100.\n";
    let folder = Folder::with(&[("deck.inp", deck), ("scene.toml", &format!("deck = \"deck.inp\"\n{scene}"))]);
    let direct = solve_in(&folder, "scene.toml", &[]).nodes;
    for solver in ["direct", "mixed", "iterative"] {
        let other = solve_in(&folder, "scene.toml", &["--solver", solver]).nodes;
        for row in &direct.rows {
            close(other.number(&[&row[0]], "temperature"), direct.number(&[&row[0]], "temperature"));
        }
    }
    // At every node that nothing holds, what comes in goes out.
    let solved = solve_in(&folder, "scene.toml", &[]);
    let mut net: BTreeMap<&str, f64> = BTreeMap::new();
    for (row, heat) in solved.links.rows.iter().zip(solved.links.course(&[], "heat")) {
        *net.entry(&row[0]).or_default() -= heat;
        *net.entry(&row[1]).or_default() += heat;
    }
    for (row, heat) in solved.interfaces.rows.iter().zip(solved.interfaces.course(&[], "HFLA")) {
        *net.entry(&row[0]).or_default() -= heat;
        let opposite = solved.nodes.rows.iter().find(|node| node[0].strip_prefix('b') == row[0].strip_prefix('a'));
        *net.entry(&opposite.expect("a node")[0]).or_default() += heat;
    }
    let held =
        |name: &str| (name.starts_with('a') && name.ends_with('0')) || (name.starts_with('b') && name.ends_with('7'));
    let (held, free): (Vec<_>, Vec<_>) = net.iter().partition(|(name, _)| held(name));
    let through: f64 = held.iter().map(|(_, net)| net.abs()).sum();
    assert!((held.len(), free.len()) == (16, 112) && through > 100.0, "{through}");
    for (name, net) in free {
        assert!(net.abs() < 1e-13 * through, "{name}: {net} of {through}");
    }
}
