//! `inpact tradeoff`: time and error of every mode, in every format, and the picture.

use crate::program::{Folder, Run, inpact, root};
use serde_json::Value;

const DECK: &str = "\
*SURFACE INTERACTION, NAME=A
*GAP ELECTRICAL CONDUCTANCE
20., 0.
3., 0.1
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
50., 0., 300.
65., 100., 300.
70., 0., 400.
90., 70., 400.
";
const NODES: &str = "node,clearance,pressure,temp\n1,.03,0,310\n2,.07,0,320\n3,.2,0,330\n4,0,10,340\n5,0,33,399\n";

fn scene() -> Folder {
    Folder::with(&[("a.inp", DECK), ("a.csv", NODES)])
}

fn tradeoff(folder: &Folder, more: &[&str]) -> Run {
    folder.inpact(&[&["tradeoff", "a.inp", "--nodes", "a.csv", "--rounds", "1"], more].concat())
}

/// The text with times and rates, and what follows from them, taken out; errors depend on no processor but on what is measured first alone.
fn untimed(text: &str) -> String {
    let is_time = |cell: &str| cell.contains('.') && cell.parse::<f64>().is_ok_and(|number| number < 1e6);
    let untimed = |line: &str| {
        if line.starts_with("a whole row") {
            let parts = line.split(' ').map(|word| match word.trim_end_matches(',').parse::<f64>() {
                Ok(time) if time > 0.0 => "TIME".to_owned(),
                _ => word.to_owned(),
            });
            return parts.collect::<Vec<_>>().join(" ");
        }
        let (is_row, is_refused) = (line.starts_with("* ") || line.starts_with("  "), line.starts_with("  refused"));
        if !is_row || is_refused || line.trim_start().starts_with("mode") {
            return line.to_owned();
        }
        let cells: Vec<&str> = line[2..].split_whitespace().collect();
        let time = cells.iter().position(|cell| is_time(cell)).expect("a time");
        [&cells[..time], &["TIME", "RATE"], &cells[time + 2..]].concat().join(" ")
    };
    text.lines().map(|line| untimed(line) + "\n").collect()
}

#[test]
fn a_table_for_a_person() {
    let run = tradeoff(&scene(), &[]);
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    insta::assert_snapshot!(untimed(&run.output));
}

#[test]
fn a_table_for_a_spreadsheet() {
    let run = tradeoff(&scene(), &["--format", "csv"]);
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    let untimed = |(number, line): (usize, &str)| {
        let mut cells: Vec<&str> = line.split(',').collect();
        if number > 0 && !cells[3].is_empty() {
            assert!(cells[3].parse::<f64>().expect("a time") > 0.0, "{line}");
            assert!(cells[4].parse::<f64>().expect("a rate") > 0.0, "{line}");
            (cells[3], cells[4], cells[13]) = ("TIME", "RATE", "FRONT");
        }
        cells.join(",") + "\n"
    };
    insta::assert_snapshot!(run.output.lines().enumerate().map(untimed).collect::<String>());
}

#[test]
fn json_for_another_program() {
    let run = tradeoff(&scene(), &["--format", "json"]);
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    let mut document: Value = serde_json::from_str(&run.output).expect("JSON");
    for part in ["read", "laws", "write"] {
        assert!(document["whole_row_ns"][part].as_f64().expect("a time") > 0.0);
        document["whole_row_ns"][part] = "TIME".into();
    }
    for table in document["tables"].as_array_mut().expect("tables") {
        table["copy_ns_per_row"] = "TIME".into();
        let modes = table["modes"].as_array_mut().expect("modes");
        assert!(modes.iter().any(|mode| mode["pareto"] == true), "some mode is on the front");
        for mode in modes {
            assert!(mode["ns_per_row"].as_f64().expect("a time") > 0.0);
            assert_bound_holds(mode);
            assert!(mode["rms_error"].as_f64() <= mode["largest_error"].as_f64(), "{mode}");
            (mode["ns_per_row"], mode["rows_per_second"], mode["pareto"]) =
                ("TIME".into(), "RATE".into(), "FRONT".into());
        }
    }
    insta::assert_snapshot!(format!("{document:#}"));
}

#[test]
fn a_long_table_is_sampled_and_a_history_of_pore_flow_is_measured() {
    let deck = "decks/retaining-wall/retaining-wall.inp";
    let nodes = "decks/retaining-wall/retaining-wall-nodes.csv";
    let run = inpact(&["tradeoff", deck, "--nodes", nodes, "--rounds", "1", "--sample", "100", "--format", "json"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let document: Value = serde_json::from_str(&run.output).expect("JSON");
    let rows = document["rows"].as_u64().expect("rows");
    let one_of = document["one_of"].as_u64().expect("one of so many");
    assert_eq!(one_of, rows.div_ceil(100));
    assert!(document["tables"][0]["rows"].as_u64() <= Some(100));
}

#[test]
fn the_picture_is_well_formed_and_shows_every_mode() {
    let folder = scene();
    let run = tradeoff(&folder, &["--plot", "a.svg", "--format", "json", "-o", "a.json"]);
    assert_eq!((run.code, run.output.as_str(), run.errors.as_str()), (0, "", ""));
    let svg = folder.read("a.svg");
    let document = roxmltree::Document::parse(&svg).expect("well-formed XML");
    assert!(document.root_element().has_tag_name(("http://www.w3.org/2000/svg", "svg")));
    let texts: Vec<&str> = document
        .descendants()
        .filter(|node| node.has_tag_name("text") || node.has_tag_name(("http://www.w3.org/2000/svg", "text")))
        .filter_map(|node| node.text())
        .collect();
    for wanted in
        ["reference", "full", "grid exact", "copy of the columns", "Pareto front", "time of a row, ns", "a.inp"]
    {
        assert!(texts.iter().any(|text| text.contains(wanted)), "{wanted} among {texts:?}");
    }
    let circles = document.descendants().filter(|node| node.tag_name().name() == "circle").count();
    let measured: Value = serde_json::from_str(&folder.read("a.json")).expect("JSON");
    let all = measured["tables"].as_array().and_then(|tables| tables.last()).expect("all tables");
    // One a mode, and one in the legend.
    assert_eq!(circles, all["modes"].as_array().expect("modes").len() + 1);
}

#[test]
fn a_picture_of_pixels_has_them() {
    let folder = scene();
    let run = tradeoff(&folder, &["--plot", "a.PNG", "-o", "a.txt"]);
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    let png = std::fs::read(folder.path().join("a.PNG")).expect("readable");
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    assert_eq!(&png[16..24], [0, 0, 1920_u16.to_be_bytes()[0], 1920_u16.to_be_bytes()[1], 0, 0, 4, 176]);
    // Text, lines and points are more than an empty ground.
    assert!(png.len() > 20_000, "{} bytes", png.len());
}

#[test]
fn wrong_usage_is_refused() {
    let folder = scene();
    for wrong in
        [&["--plot", "a.gif"][..], &["--plot", "svg"], &["--sample", "0"], &["--rounds", "0"], &["-o", "a.csv"]]
    {
        let run = tradeoff(&folder, &[&["--format", "text"], wrong].concat());
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{wrong:?}");
        assert!(!run.errors.is_empty());
    }
    assert_eq!(folder.read("a.csv"), NODES);
    assert_eq!(tradeoff(&folder, &["--plot", "nowhere/a.svg"]).code, 2);
}

#[test]
fn what_cannot_be_measured_is_reported() {
    let folder = scene();
    folder.write("a.csv", "node,clearance,pressure,temp\n1,x,0,310\n");
    assert_eq!(tradeoff(&folder, &[]).code, 1);
    folder.write("a.csv", "node,clearance,pressure,temp\n1,.03,0,310\n2,.03,0,310\n");
    let run = tradeoff(&folder, &[]);
    assert_eq!((run.code, run.output.as_str()), (1, ""));
    assert!(run.errors.contains("there is nothing to trade"), "{}", run.errors);
    folder.write("a.csv", NODES);
    folder.write("a.inp", &DECK.replace("3., 0.1", "3., 0."));
    assert_eq!(tradeoff(&folder, &[]).code, 1);
}

/// Measured errors are within the bounds; one that is not finite says nothing.
fn assert_bound_holds(mode: &Value) {
    for (error, bound) in [("largest_error", "bound"), ("pointwise_error", "pointwise_bound")] {
        if let Some(bound) = mode[bound].as_f64() {
            assert!(mode[error].as_f64().is_some_and(|error| error <= bound), "{error} is within {bound}: {mode}");
        }
    }
}

/// The sample decks can all be measured, and on their rows the bound of every mode holds.
#[test]
fn every_bound_holds_on_every_sample() {
    for (name, quantity) in [
        ("spot-weld", "conductance against"),
        ("busbar-joint", "conductance against"),
        ("retaining-wall", "permeability"),
        ("brake-disc", "thermal conductance against"),
    ] {
        let (deck, nodes) = (format!("decks/{name}/{name}.inp"), format!("decks/{name}/{name}-nodes.csv"));
        assert!(root().join(&deck).exists());
        let run = inpact(&["tradeoff", &deck, "--nodes", &nodes, "--rounds", "1", "--format", "json"]);
        assert_eq!(run.code, 0, "{}", run.errors);
        let document: Value = serde_json::from_str(&run.output).expect("JSON");
        let tables = document["tables"].as_array().expect("tables");
        assert!(tables.iter().any(|table| table["table"].as_str().is_some_and(|name| name.contains(quantity))));
        for table in tables {
            let modes = table["modes"].as_array().expect("modes");
            let refused = table["refused"].as_array().expect("refusals");
            if table["table"] != "all tables" {
                assert_eq!(modes.len() + refused.len(), 6, "no mode is left out silently: {table:#}");
            }
            let named = |name: &str| modes.iter().find(|mode| mode["mode"] == name);
            assert!(named("full").is_some_and(|mode| mode["bound"].as_f64().is_some()), "{table:#}");
            modes.iter().for_each(assert_bound_holds);
        }
    }
}
