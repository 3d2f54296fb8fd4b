//! Reading scene files: every key, and every message of what may be wrong with them.

mod scene_support;

use inpact_evaluation::law::ClosingHeat;
use inpact_network::scene::{Course, Field, Procedure, SCENE_RULES, SceneLink, StartFrom, Steps, TimeSpan};
use inpact_parser::model::Name;
use proptest::prelude::*;
use scene_support::{SCENE, model_of, mutated, problem, read_with, refused, scene, show};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

fn changed(from: &str, to: &str) -> String {
    assert!(SCENE.contains(from), "{from}");
    SCENE.replacen(from, to, 1)
}

/// A transient scene with this time.
fn timed(time: &str) -> String {
    changed("joule_heat_fraction = 0.25\n", &format!("procedure = \"transient\"\n{time}\n"))
}

/// Changes and what is said of each.
fn findings(changes: &[(&str, &str)]) -> String {
    let mut shown = String::new();
    for (from, to) in changes {
        let plain = |text: &str| text.trim_end().replace('\n', " / ");
        let _ = writeln!(shown, "{} -> {}", plain(from), plain(to));
        show(&mut shown, &refused(&changed(from, to)));
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

/// The keys of every table of a schema.
fn keys_of(schema: &Value, keys: &mut BTreeSet<String>) {
    match schema {
        Value::Object(entries) => {
            if let Some(Value::Object(properties)) = entries.get("properties") {
                keys.extend(properties.keys().cloned());
            }
            entries.values().for_each(|value| keys_of(value, keys));
        }
        Value::Array(values) => values.iter().for_each(|value| keys_of(value, keys)),
        _ => {}
    }
}

/// A scene that has every key of the committed schema is read.
#[test]
fn every_key_of_the_schema_can_be_read() {
    let text = timed(
        "joule_heat_fraction = 0.25\ntime = { start = 0.0, end = 1.0, tolerance = 0.1, first_step = 0.1, start_from = \"at-rest\", closing_heat = \"manual\" }",
    ) + "[[node_file]]\nfile = \"n\"\n[[link_file]]\nfile = \"k.mtx\"\nconducts = \"electrical\"\nprefix = \"n\"\n[[interface_file]]\nfile = \"r\"\n";
    let (scene, findings) = read_with(&text, &[]);
    assert!(scene.is_some(), "{findings:?}");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../schema/scene.schema.json");
    let schema = std::fs::read_to_string(path).expect("the schema is committed");
    let mut keys = BTreeSet::new();
    keys_of(&serde_json::from_str(&schema).expect("a schema is JSON"), &mut keys);
    // The other way to give the length of increments; and parts of a deck, which need one with a mesh: the tests of whole programs read them.
    for key in ["step", "conditions", "set", "surface"] {
        assert!(keys.remove(key), "{key}");
    }
    assert!(keys.len() > 30, "{keys:?}");
    let names: BTreeSet<&str> = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').collect();
    let missing: Vec<&String> = keys.iter().filter(|key| !names.contains(key.as_str())).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn the_least_scene_is_a_deck_and_a_node() {
    let scene = scene("deck = \"a.inp\"\n[[node]]\nname = \"a\"");
    assert!(scene.nodes.len() == 1 && scene.links.is_empty() && scene.interfaces.is_empty());
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
    let steps = |start, end, steps| {
        let (start_from, closing_heat) = (StartFrom::FirstRow, ClosingHeat::Balanced);
        Procedure::Transient(TimeSpan { start, end, steps, start_from, closing_heat })
    };
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
        "deck = \"a.inp\"\n[[node]]\nname = \"a\"\ntemperature = 1.0\n",
        "deck = \"a.inp\"\n[[node]]\nname = \"a\"\ntemperature = [1.0, 0.0, 2.0, 3.0]\n",
        "deck = \"a.inp\"\n[[node]]\nname = \"a\"\ntemperature = { fixed = [[0.0, 1.0, 2.0]] }\n",
        "deck = \"a.inp\"\n[[node]]\nname = \"a\"\ntemperature = { fixed = 1.0, fixed = 2.0 }\n",
        "deck = \"a.inp\"\n[[node]]\nname = \"a\"\ntemperature = { fixed = 1.0, initail = 2.0 }\n",
        "deck = \"a.inp\"\n[[node]]\nname = \"a\"\ntemperature = { fixed = 1.0, capacity = true }\n",
        "deck = \"a.inp\"\n[node]\nname = \"a\"\n",
        "deck = \"a.inp\"\nnode = [\"a\"]\n",
        "deck = \"a.inp\"\n[[node]]\ntemperature = { fixed = 1.0 }\n",
        "deck = \"a.inp\"\n[[node]]\nname = 7\n",
        "deck = \"a.inp\"\n[[link]]\nnodes = [\"a\"]\n",
        "deck = \"a.inp\"\n[[link]]\nnodes = [\"a\", \"b\", \"c\"]\n",
        "deck = \"a.inp\"\n[[link]]\nnodes = [\"a\", \"b\", 7]\n",
        "deck = \"a.inp\"\n[[link]]\nnodes = [\"a\",\n7]\n",
        "deck = \"a.inp\"\n[[link]]\nnodes = []\n",
        "deck = \"a.inp\"\n[[link]]\nnodes = \"a\"\n",
        "deck = \"a.inp\"\n[[link]]\nnodes = [\n\"a\",\n\"b\",\n\"c\"]\n",
        "deck = \"a.inp\"\n[[link]]\nthermal = 1.0\n",
        "deck = \"a.inp\"\n[[link]]\nnodes = [\"a\", \"b\"]\nthermal = \"1.0\"\n",
        "deck = \"a.inp\"\n[[interface]]\nslave = \"a\"\nsecondary = \"a\"\nmaster = \"b\"\narea = 1.0\n",
        "deck = \"a.inp\"\n[[interface]]\nslave = \"a\"\nmaster = \"b\"\narea = 1.0\nclosed = 1\n",
        "deck = \"a.inp\"\n[[interface]]\nslave = \"a\"\nmaster = \"b\"\narea = 1.0\nfv = 1.0\n",
        "deck = \"a.inp\"\n[[interface]]\nslave = \"a\"\nmaster = \"b\"\nmain = \"b\"\narea = 1.0\n",
        "deck = \"a.inp\"\n[[interface]]\nslave = \"a\"\nmaster = \"b\"\n",
        "deck = \"a.inp\"\n[[interface]]\nslave = \"a\"\nmaster = \"b\"\narea = 1.0\nfv = [1.0, \"x\"]\n",
        "deck = \"a.inp\"\n[[interface]]\nslave = \"a\"\nmaster = \"b\"\naera = 1.0\n",
        "deck = \"a.inp\"\n[initial]\ntemperatur = 1.0\n",
        "deck = \"a.inp\"\ninitial = [20.0, 1.0]\n",
        "deck = \"a.inp\"\n[initial]\n[initial]\n",
        "deck = \"a.inp\"\ntime = 1.0\n",
        "deck = \"a.inp\"\nnode_file = \"a.csv\"\n",
        "deck = \"a.inp\"\nnode_file = [[\"a.csv\"]]\n",
        "deck = \"a.inp\"\n[[link_file]]\nfile = \"a.mtx\"\nconducts = \"termal\"\n",
        "deck = \"a.inp\"\n\"unknown field `a`, expected `b\" = 1\n",
        "deck = \"a.inp\"\n[[node_file]]\nname = \"a.csv\"\n",
        "deck = \"a.inp\"\n[[link_file]]\nfile = \"a.mtx\"\nconducts = \"heat\"\n",
        "deck = \"a.inp\"\nprocedure = \"dynamic\"\n",
        "deck = \"a.inp\"\nprocedure = \"transient\"\n[time]\nstep = 1.0\n",
    ] {
        let _ = writeln!(shown, "{}", text.trim_end().replace('\n', " / "));
        show(&mut shown, &refused(text));
    }
    insta::assert_snapshot!(shown);
}

/// D011, D012 and D013 of nodes, links and interfaces.
#[test]
fn what_does_not_fit_together() {
    let shown = findings(&[
        ("fixed = 100.0", "fixed = 100.0, source = 1.0"),
        ("fixed = 100.0", "fixed = 100.0, capacity = 1.0"),
        ("fixed = 2.0", "capacity = 2.0"),
        ("fixed = 2.0", "fixed = 2.0, initial = 2.0"),
        ("[\"hot\", \"middle\"]", "[\"hot\", \"hot\"]"),
        ("electrical = 3.0\nthermal = inf\n", ""),
        ("slave = \"middle\"", "slave = \"cold\""),
        ("slave = \"middle\"", "slave = \"\""),
        ("[\"hot\", \"middle\"]", "[\"hot\", \"\"]"),
        ("name = \"hot\"", "name = \"\""),
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
    let shown = findings(&[
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
        ("area = 0.5", "area = 1e999"),
        ("area = 0.5", "area = -1_0e0"),
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
    let time = "time = { end = 1.0, step = 0.1 }";
    let text = timed(time).replace("pressure = -1.0", "pressure = [[0.0, 1.0], [0.5, inf]]");
    let mut shown = shown + "pressure = [[0.0, 1.0], [0.5, inf]]\n";
    show(&mut shown, &refused(&text));
    insta::assert_snapshot!(shown);
}

/// A deck has at most a thousand field variables.
#[test]
fn as_many_field_variables_as_a_deck_can_have() {
    let many = |count: usize| changed("fv = [1.0, -2.0]", &format!("fv = {:?}", vec![1.0; count]));
    assert_eq!(scene(&many(1000)).interfaces[0].field_variables.len(), 1000);
    let found = refused(&many(1001));
    assert!(found.len() == 1 && found[0].contains("D011") && found[0].contains("has 1001 numbers"), "{found:?}");
}

/// D015.
#[test]
fn times_that_do_not_go_forward() {
    let mut shown = findings(&[
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
        show(&mut shown, &found);
    }
    for course in
        ["[]", "[[1.0, 2.0], [1.0, 3.0]]", "[[2.0, 2.0], [1.0, 3.0]]", "[[0.0, 2.0], [inf, 3.0]]", "[[nan, 1.0]]"]
    {
        let text = timed("time = { end = 1.0, step = 0.1 }");
        let _ = writeln!(shown, "source = {course}");
        let found = refused(&text.replace("source = -3.0", &format!("source = {course}")));
        show(&mut shown, &found);
    }
    insta::assert_snapshot!(shown);
}

/// The rules, with what they are about: codes are never used for something else.
#[test]
fn the_rules_of_scenes() {
    let lines = SCENE_RULES.iter().map(|rule| {
        format!(
            "{} {:?} {}: {}\n",
            rule.code,
            rule.severity,
            rule.name,
            rule.documentation.lines().next().unwrap_or_default().trim()
        )
    });
    let shown: String = lines.collect();
    insta::assert_snapshot!(shown);
}

/// More than twenty findings of a rule are counted.
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
        show(&mut shown, &findings);
        assert_eq!(problem.is_none(), !findings.is_empty(), "{findings:?}");
    }
    insta::assert_snapshot!(shown);
}

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
}
