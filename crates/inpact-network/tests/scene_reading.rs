//! Reading scenes: every key, every table, and every message of what may be wrong with them.

mod scene_support;

use inpact_network::scene::{Course, Field, Procedure, SCENE_RULES, Scene, SceneLink, Steps, TimeSpan};
use inpact_parser::model::Name;
use proptest::prelude::*;
use scene_support::{model_of, problem, read_with, refused, scene};
use std::fmt::Write as _;

/// A scene with something in every place.
const SCENE: &str = "\
deck = \"deck.inp\"
joule_heat_fraction = 0.25
[initial]
temperature = 20.0
pore_pressure = 1.5
[[node]]
name = \"hot\"
potential = { fixed = 2.0 }
temperature = { fixed = 100.0 }
[[node]]
name = \"middle\"
temperature = { source = -3.0, capacity = 5.0, initial = 30.0 }
pore_pressure = {}
[[node]]
name = \"cold\"
potential = { source = 0.5 }
[[link]]
nodes = [\"hot\", \"middle\"]
electrical = 3.0
thermal = inf
[[link]]
nodes = [\"middle\", \"cold\"]
hydraulic = 0.0
joule_heat_fraction = 1.0
[[interface]]
interaction = \"joint 1\"
slave = \"middle\"
master = \"cold\"
area = 0.5
clearance = 0.25
pressure = -1.0
closed = true
fv = [1.0, -2.0]
temperature = 40.0
mass_flow = 6.0
shear = 7.0
slip_rate = -8.0
clearance_rate = 9.0
char_length = 0.0
perm_s = 10.0
perm_m = 11.0
";

fn changed(from: &str, to: &str) -> String {
    assert!(SCENE.contains(from), "{from}");
    SCENE.replacen(from, to, 1)
}

/// A transient scene with this time.
fn timed(time: &str) -> String {
    changed("joule_heat_fraction = 0.25\n", &format!("procedure = \"transient\"\n{time}\n"))
}

/// Changes and what is said of each.
fn told(changes: &[(&str, &str)]) -> String {
    let mut shown = String::new();
    for (from, to) in changes {
        let plain = |text: &str| text.trim_end().replace('\n', " / ");
        let _ = writeln!(shown, "{} -> {}", plain(from), plain(to));
        refused(&changed(from, to)).iter().for_each(|line| writeln!(shown, "  {line}").expect("text can be written"));
    }
    shown
}

#[test]
fn every_key_has_its_place() {
    let scene = scene(SCENE);
    assert_eq!((scene.deck.as_str(), scene.procedure), ("deck.inp", Procedure::Steady));
    assert_eq!((scene.initial_temperature, scene.initial_pore_pressure), (Some(20.0), Some(1.5)));
    assert_eq!(scene.nodes, ["hot", "middle", "cold"]);
    assert_eq!(scene.node_lines.into_iter().collect::<Vec<_>>(), [(0, 7), (1, 11), (2, 15)]);
    let [potential, temperature, pore_pressure] = &scene.conditions;
    let constant = |node, value| [(node, Course::constant(value))].into_iter().collect();
    assert_eq!((&potential.fixed, &potential.sources), (&constant(0, 2.0), &constant(2, 0.5)));
    assert_eq!((&temperature.fixed, &temperature.sources), (&constant(0, 100.0), &constant(1, -3.0)));
    assert_eq!(temperature.capacities.iter().collect::<Vec<_>>(), [(&1, &5.0)]);
    assert_eq!(temperature.initial.iter().collect::<Vec<_>>(), [(&1, &30.0)]);
    // A node that is named and nothing more carries the field.
    assert_eq!(pore_pressure.sources, constant(1, 0.0));
    let link = |nodes, conductances, joule_heat_fraction| SceneLink { nodes, conductances, joule_heat_fraction };
    assert_eq!(scene.links, [link([0, 1], [3.0, f64::INFINITY, 0.0], 0.25), link([1, 2], [0.0, 0.0, 0.0], 1.0)]);
    let [row] = &scene.interfaces[..] else { panic!("{:?}", scene.interfaces) };
    assert_eq!((&row.interaction, row.slave, row.master), (&Some(Name::new("JOINT1")), 1, 2));
    assert_eq!((row.area, row.closed, &row.field_variables[..]), (0.5, Some(true), &[1.0, -2.0][..]));
    assert_eq!((&row.clearance, &row.pressure), (&Some(Course::constant(0.25)), &Some(Course::constant(-1.0))));
    assert_eq!((row.temperature, row.mass_flow, row.shear), (Some(40.0), Some(6.0), Some(7.0)));
    assert_eq!((row.slip_rate, row.clearance_rate, row.characteristic_length), (Some(-8.0), Some(9.0), Some(0.0)));
    assert_eq!((row.bulk_permeabilities, &row.place), ([Some(10.0), Some(11.0)], &(25, None)));
}

#[test]
fn the_least_scene_is_a_deck() {
    let scene = scene("deck = \"a.inp\"");
    assert!(scene.nodes.is_empty() && scene.links.is_empty() && scene.interfaces.is_empty());
    assert_eq!((scene.initial_temperature, scene.initial_pore_pressure, scene.is_transient()), (None, None, false));
    assert!(Field::ALL.iter().all(|field| !scene.mentions(*field)));
}

#[test]
fn sides_may_be_called_secondary_and_main() {
    let other = changed("slave = ", "secondary = ").replace("master = ", "main = ");
    assert_eq!(scene(&other), scene(SCENE));
}

#[test]
fn times_and_courses() {
    let span = |text: &str| scene(&timed(text)).procedure;
    let steps = |start, end, steps| Procedure::Transient(TimeSpan { start, end, steps });
    assert_eq!(span("time = { end = 2.0, step = 0.5 }"), steps(0.0, 2.0, Steps::Given(0.5)));
    let by_error = |first| Steps::ByError { tolerance: 0.01, first };
    assert_eq!(span("time = { start = -2.0, end = 2.0, tolerance = 0.01 }"), steps(-2.0, 2.0, by_error(4e-3)));
    assert_eq!(span("time = { end = 2.0, tolerance = 0.01, first_step = 5.0 }"), steps(0.0, 2.0, by_error(5.0)));
    let text = timed("time = { end = 2.0, step = 0.5 }");
    let text = text.replacen("fixed = 100.0", "fixed = [[0.0, 100.0], [1.0, 50.0]]", 1);
    let scene = scene(&text.replacen("clearance = 0.25", "clearance = [[3.0, 0.25]]", 1));
    let fixed = &scene.conditions(Field::Temperature).fixed[&0];
    assert_eq!([-1.0, 0.5, 7.0].map(|time| fixed.at(time)), [100.0, 75.0, 50.0]);
    assert_eq!(scene.interfaces[0].clearance.as_ref().map(|course| course.at(0.0)), Some(0.25));
}

/// D011 where the text is no TOML, or no scene.
#[test]
fn a_text_that_is_no_scene() {
    let mut shown = String::new();
    for text in [
        "",
        "deck",
        "deck = \"a.inp\"\nnode = 3\n",
        "deck = \"a.inp\"\ndeck = \"b.inp\"\n",
        "deck = 'a\nnext = 1\n",
        "deck = \"a.inp\"\n[[nodes]]\nname = \"a\"\n",
        "deck = \"a.inp\"\n[[node]]\nname = \"a\"\ntemprature = { fixed = 1.0 }\n",
        "deck = \"a.inp\"\n[[node]]\nname = \"a\"\ntemperature = { fixed = \"1.0\" }\n",
        "deck = \"a.inp\"\n[[node]]\ntemperature = { fixed = 1.0 }\n",
        "deck = \"a.inp\"\n[[node]]\nname = 7\n",
        "deck = \"a.inp\"\n[[link]]\nnodes = [\"a\"]\n",
        "deck = \"a.inp\"\n[[link]]\nthermal = 1.0\n",
        "deck = \"a.inp\"\n[[interface]]\nslave = \"a\"\nsecondary = \"a\"\nmaster = \"b\"\narea = 1.0\n",
        "deck = \"a.inp\"\n[[interface]]\nslave = \"a\"\nmaster = \"b\"\narea = 1.0\nclosed = 1\n",
        "deck = \"a.inp\"\n[[interface]]\nslave = \"a\"\nmaster = \"b\"\narea = 1.0\nfv = 1.0\n",
        "deck = \"a.inp\"\n[initial]\ntemperatur = 1.0\n",
        "deck = \"a.inp\"\n[[node_file]]\nname = \"a.csv\"\n",
        "deck = \"a.inp\"\n[[link_file]]\nfile = \"a.mtx\"\nconducts = \"heat\"\n",
        "deck = \"a.inp\"\nprocedure = \"dynamic\"\n",
        "deck = \"a.inp\"\nprocedure = \"transient\"\n[time]\nstep = 1.0\n",
    ] {
        let _ = writeln!(shown, "{}", text.trim_end().replace('\n', " / "));
        refused(text).iter().for_each(|line| writeln!(shown, "  {line}").expect("text can be written"));
    }
    insta::assert_snapshot!(shown);
}

/// D011, D012 and D013 of nodes, links and interfaces.
#[test]
fn what_does_not_fit_together() {
    let shown = told(&[
        ("fixed = 100.0", "fixed = 100.0, source = 1.0"),
        ("fixed = 100.0", "fixed = 100.0, capacity = 1.0"),
        ("fixed = 2.0", "capacity = 2.0"),
        ("fixed = 2.0", "fixed = 2.0, initial = 2.0"),
        ("[\"hot\", \"middle\"]", "[\"hot\", \"hot\"]"),
        ("electrical = 3.0\nthermal = inf\n", ""),
        ("slave = \"middle\"", "slave = \"cold\""),
        ("name = \"cold\"", "name = \"hot\""),
        ("[\"hot\", \"middle\"]", "[\"Hot\", \"middel\"]"),
        ("[\"hot\", \"middle\"]", "[\"hot\", \"elsewhere\"]"),
        ("master = \"cold\"", "master = \"colt\""),
    ]);
    insta::assert_snapshot!(shown);
}

/// D014.
#[test]
fn numbers_that_cannot_be_used() {
    let shown = told(&[
        ("joule_heat_fraction = 0.25", "joule_heat_fraction = 1.5"),
        ("joule_heat_fraction = 0.25", "joule_heat_fraction = nan"),
        ("temperature = 20.0", "temperature = inf"),
        ("pore_pressure = 1.5", "pore_pressure = nan"),
        ("fixed = 100.0", "fixed = -inf"),
        ("source = -3.0", "source = nan"),
        ("capacity = 5.0", "capacity = -5.0"),
        ("capacity = 5.0", "capacity = inf"),
        ("initial = 30.0", "initial = inf"),
        ("electrical = 3.0", "electrical = -3.0"),
        ("electrical = 3.0", "electrical = nan"),
        ("thermal = inf", "thermal = -inf"),
        ("joule_heat_fraction = 1.0", "joule_heat_fraction = -0.5"),
        ("area = 0.5", "area = 0.0"),
        ("area = 0.5", "area = inf"),
        ("clearance = 0.25", "clearance = nan"),
        ("pressure = -1.0", "pressure = inf"),
        ("fv = [1.0, -2.0]", "fv = [1.0, nan]"),
        ("temperature = 40.0", "temperature = nan"),
        ("mass_flow = 6.0", "mass_flow = inf"),
        ("shear = 7.0", "shear = nan"),
        ("slip_rate = -8.0", "slip_rate = nan"),
        ("clearance_rate = 9.0", "clearance_rate = inf"),
        ("char_length = 0.0", "char_length = -1.0"),
        ("perm_s = 10.0", "perm_s = -1.0"),
        ("perm_m = 11.0", "perm_m = inf"),
    ]);
    insta::assert_snapshot!(shown);
}

/// D015.
#[test]
fn times_that_do_not_go_forward() {
    let mut shown = told(&[
        ("joule_heat_fraction = 0.25", "time = { end = 1.0, step = 0.1 }"),
        ("joule_heat_fraction = 0.25", "procedure = \"transient\""),
        ("fixed = 100.0", "fixed = [[0.0, 100.0], [1.0, 50.0]]"),
        ("clearance = 0.25", "clearance = [[0.0, 1.0]]"),
    ]);
    for time in [
        "end = 0.0, step = 1.0",
        "start = 3.0, end = 2.0, step = 1.0",
        "end = inf, step = 1.0",
        "start = nan, end = 1.0, step = 1.0",
        "end = 1.0, step = 0.0",
        "end = 1.0, step = inf",
        "end = 1.0, tolerance = -1.0",
        "end = 1.0, tolerance = 1e-3, first_step = nan",
        "end = 1.0, step = 0.1, first_step = 0.1",
        "end = 1.0, step = 0.1, tolerance = 1e-3",
        "end = 1.0, first_step = 0.1",
        "end = 1.0",
    ] {
        let _ = writeln!(shown, "time = {{ {time} }}");
        let found = refused(&timed(&format!("time = {{ {time} }}")));
        found.iter().for_each(|line| writeln!(shown, "  {line}").expect("text can be written"));
    }
    for course in
        ["[]", "[[1.0, 2.0], [1.0, 3.0]]", "[[2.0, 2.0], [1.0, 3.0]]", "[[0.0, 2.0], [inf, 3.0]]", "[[nan, 1.0]]"]
    {
        let text = timed("time = { end = 1.0, step = 0.1 }");
        let _ = writeln!(shown, "source = {course}");
        let found = refused(&text.replace("source = -3.0", &format!("source = {course}")));
        found.iter().for_each(|line| writeln!(shown, "  {line}").expect("text can be written"));
    }
    insta::assert_snapshot!(shown);
}

/// The rules, with what they are about: codes are never used for something else.
#[test]
fn the_rules_of_scenes() {
    let lines =
        SCENE_RULES.iter().map(|rule| format!("{} {:?} {}: {}\n", rule.code, rule.severity, rule.name, rule.summary));
    let shown: String = lines.collect();
    insta::assert_snapshot!(shown);
}

/// What is beyond twenty findings of a rule is counted.
#[test]
fn many_findings_of_one_kind_are_counted() {
    let mut text = "deck = \"a.inp\"\n".to_owned();
    for _ in 0..30 {
        text += "[[link]]\nnodes = [\"a\", \"b\"]\nthermal = 1.0\n";
    }
    let found = refused(&text);
    assert_eq!(found.len(), 20);
    assert!(found[19].ends_with("40 more findings of this rule in this table are not shown"), "{}", found[19]);
}

/// A scene with tables beside it, and what is said of them.
fn beside(entries: &str, files: &[(&str, &str)]) -> (Option<Scene>, Vec<String>) {
    let files: Vec<(&str, &[u8])> = files.iter().map(|(name, text)| (*name, text.as_bytes())).collect();
    read_with(&format!("{SCENE}{entries}"), &files)
}

fn node_file(text: &str) -> (Option<Scene>, Vec<String>) {
    beside("[[node_file]]\nfile = \"nodes.csv\"\n", &[("nodes.csv", text)])
}

fn link_file(text: &str) -> (Option<Scene>, Vec<String>) {
    beside("[[link_file]]\nfile = \"links.csv\"\n", &[("links.csv", text)])
}

fn interface_file(text: &str) -> (Option<Scene>, Vec<String>) {
    beside("[[interface_file]]\nfile = \"rows.csv\"\n", &[("rows.csv", text)])
}

/// A table of nodes goes on where the scene ends; columns come in any order and case, an empty cell says nothing.
#[test]
fn a_table_of_nodes() {
    let (scene, findings) = node_file(
        "temperature_initial, NODE ,potential_source,pore_pressure_fixed,temperature_capacity\n\
         ,a,,7,\n\n 25.5 ,\"b, c\",-1e3,,0\n",
    );
    let scene = scene.unwrap_or_else(|| panic!("{findings:?}"));
    assert_eq!(scene.nodes, ["hot", "middle", "cold", "a", "b, c"]);
    let constant = |value| Some(Course::constant(value));
    let [potential, temperature, pore_pressure] = &scene.conditions;
    assert_eq!((potential.sources.get(&3), potential.sources.get(&4)), (None, constant(-1e3).as_ref()));
    assert_eq!((temperature.initial.get(&3), temperature.initial.get(&4)), (None, Some(&25.5)));
    assert_eq!((temperature.capacities.get(&3), temperature.capacities.get(&4)), (None, Some(&0.0)));
    assert_eq!((pore_pressure.fixed.get(&3), pore_pressure.fixed.get(&4)), (constant(7.0).as_ref(), None));
    assert_eq!(scene.node_lines.get(&3), None);
}

/// A table of links may name nodes that nothing else names: they are new ones.
#[test]
fn a_table_of_links() {
    let (scene, findings) =
        link_file("node_1,node_2,thermal,electrical,joule_heat_fraction\nhot,cold,inf,,\nnew,hot,,2.5,0.5\n");
    let scene = scene.unwrap_or_else(|| panic!("{findings:?}"));
    assert_eq!(scene.nodes, ["hot", "middle", "cold", "new"]);
    let link = |nodes, conductances, joule_heat_fraction| SceneLink { nodes, conductances, joule_heat_fraction };
    assert_eq!(scene.links[2..], [link([0, 2], [0.0, f64::INFINITY, 0.0], 0.25), link([3, 0], [2.5, 0.0, 0.0], 0.5)]);
}

#[test]
fn a_table_of_interfaces() {
    let (scene, findings) = interface_file(
        "Secondary,MAIN,interaction,area,COPEN,cpress,closed,fv2,temp,mass_flow,shear,slip_rate,clearance_rate,char_length,perm_s,perm_m\n\
         hot,cold,other,2,0.5,3,1,9,30,4,5,6,7,8,1,2\n\
         hot,middle,,1,,,,,,,,,,,,\n",
    );
    let scene = scene.unwrap_or_else(|| panic!("{findings:?}"));
    let [_, row, bare] = &scene.interfaces[..] else { panic!("{:?}", scene.interfaces) };
    assert_eq!((row.slave, row.master, row.area), (0, 2, 2.0));
    assert_eq!(row.interaction, Some(Name::new("OTHER")));
    assert_eq!((&row.clearance, &row.pressure), (&Some(Course::constant(0.5)), &Some(Course::constant(3.0))));
    assert_eq!((row.closed, &row.field_variables[..]), (Some(true), &[0.0, 9.0][..]));
    assert_eq!(
        (row.temperature, row.mass_flow, row.shear, row.slip_rate),
        (Some(30.0), Some(4.0), Some(5.0), Some(6.0))
    );
    assert_eq!((row.clearance_rate, row.characteristic_length), (Some(7.0), Some(8.0)));
    assert_eq!((row.bulk_permeabilities, &row.place), ([Some(1.0), Some(2.0)], &(2, Some("rows.csv".to_owned()))));
    assert_eq!((bare.slave, bare.master, &bare.interaction, bare.closed), (0, 1, &None, None));
    assert_eq!((&bare.clearance, bare.field_variables.len(), bare.temperature), (&None, 0, None));
}

/// What is wrong with tables, one after the other.
#[test]
fn tables_that_are_not_right() {
    type Reads = fn(&str) -> (Option<Scene>, Vec<String>);
    let cases: [(Reads, &[&str]); 3] = [
        (
            node_file,
            &[
                "",
                "name,temperature_fixed\na,1\n",
                "node,temperature\na,1\n",
                "node,potential_capacity,potential_initial\na,1,1\n",
                "node,NODE\na,a\n",
                "node,temperature_fixed\na,warm\n",
                "node,temperature_fixed\na,1,2\n",
                "node,temperature_fixed\na,inf\nb,nan\n",
                "node,temperature_capacity\na,-1\n",
                "node\nhot\n",
                "node\na\n\"a\"\n",
            ],
        ),
        (
            link_file,
            &[
                "node_1,thermal\na,1\n",
                "node_1,node_2,heat\na,b,1\n",
                "node_1,node_2,thermal\na,b,-1\na,b,nan\na,b,1e\n",
                "node_1,node_2,joule_heat_fraction\na,b,inf\na,b,-1\n",
                "node_1,node_2,thermal\na,a,1\n",
                "node_1,node_2,thermal\na,b\n",
            ],
        ),
        (
            interface_file,
            &[
                "slave,master\nhot,cold\n",
                "slave,main,master,area\nhot,cold,cold,1\n",
                "slave,master,area,node\nhot,cold,1,7\n",
                "slave,master,area,temp_s\nhot,cold,1,7\n",
                "slave,master,area\nhot,clod,1\nhto,cold,1\n",
                "slave,master,area\nhot,cold,0\nhot,cold,-1\nhot,cold,inf\n",
                "slave,master,area,fv1,char_length\nhot,cold,1,nan,1\nhot,cold,1,1,-1\n",
                "slave,master,area,closed\nhot,cold,1,yes\n",
            ],
        ),
    ];
    let mut shown = String::new();
    for (reads, texts) in cases {
        for text in texts {
            let (scene, findings) = reads(text);
            assert!(scene.is_none(), "{text}: {findings:?}");
            let _ = writeln!(shown, "{}", text.trim_end().replace('\n', " / "));
            findings.iter().for_each(|line| writeln!(shown, "  {line}").expect("text can be written"));
        }
    }
    insta::assert_snapshot!(shown);
}

/// Bytes that are no text in one row: what came before is not blamed for it.
#[test]
fn a_table_that_is_not_utf_8() {
    let files: [(&str, &[u8]); 1] = [("nodes.csv", b"node\na\nk\xFCrzer\nb\n")];
    let (scene, findings) = read_with(&format!("{SCENE}[[node_file]]\nfile = \"nodes.csv\"\n"), &files);
    assert!(scene.is_none());
    assert_eq!(findings, ["nodes.csv:3: Error[D002 malformed-cell] the row is not UTF-8"]);
}

/// A node may be in the table that was refused: that it is not known is not said as well.
#[test]
fn nodes_of_a_table_that_was_refused_are_not_missed() {
    let entries = "[[node_file]]\nfile = \"nodes.csv\"\n[[link]]\nnodes = [\"hot\", \"far\"]\nthermal = 1.0\n\
                   [[interface_file]]\nfile = \"rows.csv\"\n";
    let rows = ("rows.csv", "slave,master,area\nfar,hot,1\n");
    let (scene, findings) = beside(entries, &[("nodes.csv", "node,potential_fixed\nfar,x\n"), rows]);
    assert!(scene.is_none() && findings.len() == 1 && findings[0].contains("which is no number"), "{findings:?}");
    // Nor where the table is not there; that the caller says.
    let (_, findings) = beside(entries, &[rows]);
    assert_eq!(findings, Vec::<String>::new());
    // In a table that is right it would be there.
    let (_, findings) = beside(entries, &[("nodes.csv", "node\nnear\n"), rows]);
    assert_eq!(findings.iter().filter(|line| line.contains("defines no node `far`")).count(), 2, "{findings:?}");
}

const MATRIX: &str = "%%MatrixMarket matrix coordinate real symmetric\n";

/// A scene with a matrix of this text.
fn matrix(text: &str) -> (Option<Scene>, Vec<String>) {
    beside("[[link_file]]\nfile = \"K.MTX\"\nconducts = \"thermal\"\nprefix = \"n\"\n", &[("K.MTX", text)])
}

/// The nodes and conductances of links that a matrix brings.
fn links_of(text: &str) -> Vec<(String, f64)> {
    let (scene, findings) = matrix(text);
    let scene = scene.unwrap_or_else(|| panic!("{text}: {findings:?}"));
    let link = |link: &SceneLink| {
        let names = link.nodes.map(|node| scene.nodes[node as usize].clone()).join("-");
        assert_eq!((link.conductances[0], link.conductances[2], link.joule_heat_fraction), (0.0, 0.0, 0.25));
        (names, link.conductances[1])
    };
    scene.links[2..].iter().map(link).collect()
}

#[test]
fn matrices_of_conductances_and_assembled_ones() {
    let expected = [("n2-n1".to_owned(), 2.0), ("n3-n2".to_owned(), 0.5)];
    let conductances = format!("{MATRIX}% two links\n3 3 2\n\n2 1 2.0\n%\n  3\t2  5e-1 \n");
    assert_eq!(links_of(&conductances), expected);
    let assembled = format!("{MATRIX}3 3 5\n1 1 2\n2 1 -2\n2 2 2.5\n3 2 -0.5\n3 3 0.5\n");
    assert_eq!(links_of(&assembled), expected);
    assert_eq!(links_of(&assembled.replace("coordinate real", "Coordinate INTEGER")), expected);
    assert_eq!(links_of(&conductances.replace('\n', "\r\n")), expected);
    // Two entries are two links, as side by side they conduct.
    let twice = links_of(&format!("{MATRIX}2 2 2\n2 1 2\n1 2 3\n"));
    assert_eq!(twice, [("n2-n1".to_owned(), 2.0), ("n1-n2".to_owned(), 3.0)]);
    assert_eq!(links_of(&format!("{MATRIX}0 0 0\n")), []);
    // A diagonal of zero is none.
    assert_eq!(links_of(&format!("{MATRIX}2 2 2\n1 1 0\n2 1 4\n")), [("n2-n1".to_owned(), 4.0)]);
}

#[test]
fn matrices_that_are_not_right() {
    let mut shown = String::new();
    let header = |kind: &str, rest: &str| format!("%%MatrixMarket {kind}\n{rest}");
    let cases = [
        String::new(),
        "1 1 0\n".to_owned(),
        header("matrix coordinate real general", "2 2 1\n2 1 1.0\n"),
        header("matrix coordinate pattern symmetric", "2 2 1\n2 1\n"),
        header("matrix array real symmetric", "2 2\n1\n-1\n1\n"),
        header("matrix coordinate complex symmetric", "2 2 1\n2 1 1.0 0.0\n"),
        MATRIX.to_owned(),
        format!("{MATRIX}2 2\n"),
        format!("{MATRIX}2 2 -1\n"),
        format!("{MATRIX}2 3 1\n2 1 1.0\n"),
        format!("{MATRIX}2 2 1\n3 1 1.0\n"),
        format!("{MATRIX}2 2 1\n2 0 1.0\n"),
        format!("{MATRIX}2 2 1\n2 1 inf\n"),
        format!("{MATRIX}2 2 1\n2 1\n"),
        format!("{MATRIX}2 2 1\n2 1 1.0 0.0\n"),
        format!("{MATRIX}2 2 2\n2 1 1.0\n"),
        format!("{MATRIX}2 2 1\n2 1 1.0\n1 2 1.0\n"),
        format!("{MATRIX}3 3 2\n2 1 1.0\n3 1 -1.0\n"),
        format!("{MATRIX}2 2 2\n1 1 1.0\n2 1 1.0\n"),
        format!("{MATRIX}2 2 3\n1 1 1.0\n2 1 -1.0\n2 2 2.0\n"),
        format!("{MATRIX}2 2 1\n2 1 -1.0\n"),
    ];
    for text in &cases {
        let (scene, findings) = matrix(text);
        assert!(scene.is_none(), "{text}: {findings:?}");
        let _ = writeln!(shown, "{}", text.trim_end().replace('\n', " / "));
        findings.iter().for_each(|line| writeln!(shown, "  {line}").expect("text can be written"));
    }
    let unsaid = beside("[[link_file]]\nfile = \"K.mtx\"\n", &[("K.mtx", MATRIX)]);
    let _ = writeln!(shown, "without conducts\n  {}", unsaid.1.join("\n  "));
    insta::assert_snapshot!(shown);
}

const DECK: &str = "\
*SURFACE INTERACTION, NAME=BOTH
*GAP CONDUCTANCE, PRESSURE, DEPENDENCIES=1
1., 0., 0., 0., 5.
2., 1., 0., 0., 5.
3., 0., 10., 0., 5.
4., 1., 10., 0., 5.
5., 0., 0., 0., 6.
6., 1., 0., 0., 6.
*GAP ELECTRICAL CONDUCTANCE
20., 0.
10., 0.1
*SURFACE INTERACTION, NAME=PORE
*CONTACT PERMEABILITY
2., 0.
3., 4.
";

/// D004 and D018: what the deck has not, and what its laws depend on.
#[test]
fn what_the_deck_asks_of_a_scene() {
    let model = model_of(DECK);
    let mut shown = String::new();
    let start = "deck = \"deck.inp\"\n[[node]]\nname = \"a\"\npotential = { fixed = 1.0 }\ntemperature = { fixed = 1.0 }\n\
                 pore_pressure = { fixed = 1.0 }\n[[node]]\nname = \"b\"\npore_pressure = {}\n";
    for row in [
        "interaction = \"NEITHER\"\nclosed = true",
        "closed = true",
        "interaction = \"BOTH\"",
        "interaction = \"BOTH\"\nclosed = true",
        "interaction = \"BOTH\"\nclosed = false",
        "interaction = \"both\"\npressure = 0.0",
        "interaction = \"PORE\"",
        "interaction = \"PORE\"\npressure = 0.0",
        "interaction = \"PORE\"\nclosed = true",
    ] {
        let text = format!("{start}[[interface]]\nslave = \"a\"\nmaster = \"b\"\narea = 1.0\n{row}\n");
        let scene = scene(&text);
        let (problem, findings) = problem(&scene, &model);
        let _ = writeln!(shown, "{}", row.replace('\n', " / "));
        findings.iter().for_each(|line| writeln!(shown, "  {line}").expect("text can be written"));
        assert_eq!(problem.is_none(), !findings.is_empty(), "{findings:?}");
    }
    insta::assert_snapshot!(shown);
}

/// Bytes of a scene exchanged, left out, doubled or cut off.
fn mutated(text: &'static str) -> impl Strategy<Value = String> {
    let place = any::<prop::sample::Index>();
    let what = prop_oneof![
        Just(String::new()),
        "[ -~\n]{1,3}",
        prop::sample::select(&["nan", "-inf", "1e999", "[[", "]]", "\"", "{}", "= 3", "\u{0}", "ü", "-0.0"][..])
            .prop_map(str::to_owned),
    ];
    prop::collection::vec((place, 0_usize..12, what), 1..4).prop_map(move |changes| {
        let mut text = text.to_owned();
        for (place, length, what) in changes {
            let starts: Vec<usize> = text.char_indices().map(|(start, _)| start).chain([text.len()]).collect();
            let from = place.index(starts.len());
            let to = (from + length).min(starts.len() - 1);
            text.replace_range(starts[from]..starts[to], &what);
        }
        text
    })
}

const NODES: &str = "node,temperature_fixed,pore_pressure_source\na,1,2\nb,,-3\n";
const LINKS: &str = "node_1,node_2,thermal\nhot,a,1\na,b,inf\n";
const ROWS: &str = "slave,master,interaction,area,clearance,fv1\nhot,a,joint,1,0,2\n";
const ASSEMBLED: &str = "%%MatrixMarket matrix coordinate real symmetric\n% n\n2 2 3\n1 1 1.0\n2 1 -1.0\n2 2 1.0\n";

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// Whatever the text, there is a scene or a finding, never a panic; and lines that are named are there.
    #[test]
    fn no_text_makes_a_panic(text in mutated(SCENE)) {
        let (scene, findings) = read_with(&text, &[]);
        prop_assert_eq!(scene.is_none(), !findings.is_empty(), "{:?}", findings);
        for finding in findings {
            let line: usize = finding.split([':', ' ']).nth(1).and_then(|line| line.parse().ok()).unwrap_or(1);
            prop_assert!((1..=text.lines().count().max(1) + 1).contains(&line), "{}", finding);
        }
    }

    #[test]
    fn no_table_makes_a_panic(nodes in mutated(NODES), links in mutated(LINKS), rows in mutated(ROWS), matrix in mutated(ASSEMBLED)) {
        let entries = "[[node_file]]\nfile = \"n\"\n[[link_file]]\nfile = \"l\"\n[[link_file]]\nfile = \"m.mtx\"\nconducts = \"thermal\"\n\
                       [[interface_file]]\nfile = \"r\"\n";
        let (scene, findings) = beside(entries, &[("n", &nodes), ("l", &links), ("m.mtx", &matrix), ("r", &rows)]);
        prop_assert_eq!(scene.is_none(), !findings.is_empty(), "{:?}", findings);
    }
}
