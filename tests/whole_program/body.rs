//! `inpact body`: conductances and capacities of a deck's bodies, as tables, JSON, links and parts of scenes; what is refused, with its line.

use crate::program::{Folder, Run, inpact, root};

/// An L of three unit cubes along x, the last with one more above it: terminals at both ends and beside the first.
const ELL: &str = "\
*NODE
1, 0., 0., 0.\n2, 1., 0., 0.\n3, 2., 0., 0.\n4, 0., 1., 0.\n5, 1., 1., 0.\n6, 2., 1., 0.
11, 0., 0., 1.\n12, 1., 0., 1.\n13, 2., 0., 1.\n14, 0., 1., 1.\n15, 1., 1., 1.\n16, 2., 1., 1.
22, 1., 0., 2.\n23, 2., 0., 2.\n25, 1., 1., 2.\n26, 2., 1., 2.
*ELEMENT, TYPE=C3D8, ELSET=ELL
1, 1, 2, 5, 4, 11, 12, 15, 14
2, 2, 3, 6, 5, 12, 13, 16, 15
3, 12, 13, 16, 15, 22, 23, 26, 25
*SURFACE, NAME=END
1, S6
*SURFACE, NAME=TOP
3, S2
*NSET, NSET=SIDE
3, 6, 13, 16
*SOLID SECTION, ELSET=ELL, MATERIAL=STEEL
*MATERIAL, NAME=STEEL
*CONDUCTIVITY
60., 0.
40., 100.
*ELECTRICAL CONDUCTIVITY
5e6
*DENSITY
7800.
*SPECIFIC HEAT
500.
";

/// The deck as `a.inp`, the command on it with these further arguments.
fn of(deck: &str, arguments: &[&str]) -> Run {
    Folder::with(&[("a.inp", deck)]).inpact(&[&["body", "a.inp"], arguments].concat())
}

/// Standard error without the time the run took.
fn timeless(run: &Run) -> String {
    let line = |line: &str| match line.rsplit_once(", ") {
        Some((before, rest)) if rest.ends_with(" s") => format!("{before}, TIME\n"),
        _ => format!("{line}\n"),
    };
    let errors = run.errors.lines().map(line).collect::<String>();
    format!("exit code {}\n{}--- standard error\n{errors}", run.code, run.output)
}

const ALL: &[&str] = &["--terminals", "END,TOP,SIDE", "--temperature", "25"];

#[test]
fn tables_for_a_person() {
    insta::assert_snapshot!(timeless(&of(ELL, ALL)));
}

/// The pages show what the sample gives.
#[test]
fn the_example_of_the_pages() {
    let command = "inpact body decks/bracket/bracket.inp --terminals END,TOP,SIDE --temperature 25 --field thermal";
    let run = inpact(&command.split(' ').skip(1).collect::<Vec<_>>());
    assert_eq!(run.code, 0, "{}", run.errors);
    for page in ["README.md", "docs/bodies.md"] {
        let text = std::fs::read_to_string(root().join(page)).expect("readable");
        let shown = text.split_once(&format!("$ {command}\n")).expect("the command").1;
        let shown = shown.split_once("```").expect("the end of the example").0;
        assert_eq!(shown, run.output, "{page}");
    }
}

#[test]
fn json_has_every_digit_and_the_text_its_first_ones() {
    let run = of(ELL, &[ALL, &["--format", "json"]].concat());
    assert_eq!(run.code, 0, "{}", run.errors);
    let value: serde_json::Value = serde_json::from_str(&run.output).expect("JSON");
    assert_eq!(value["schema"], "inpact/body/1");
    assert_eq!(value["terminals"], serde_json::json!(["END", "TOP", "SIDE"]));
    let thermal = &value["fields"]["thermal"];
    let pairs = thermal["isothermal"].as_array().expect("pairs");
    assert_eq!(pairs.len(), 3);
    // Both fields of one material differ by their conductivities alone: 55 W/(m·K) at 25 degrees, 5e6 S/m.
    for (thermal, electrical) in
        pairs.iter().zip(value["fields"]["electrical"]["isothermal"].as_array().expect("pairs"))
    {
        let [thermal, electrical] = [thermal, electrical].map(|pair| pair["conductance"].as_f64().expect("a number"));
        assert!((thermal / 55.0 - electrical / 5e6).abs() <= 1e-14 * (thermal / 55.0).abs());
    }
    let body = &thermal["bodies"][0];
    assert_eq!((&body["nodes"], &body["elements"]), (&serde_json::json!(16), &serde_json::json!(3)));
    assert!((body["capacity"].as_f64().expect("a number") - 3.0 * 7800.0 * 500.0).abs() < 1e-3);
    let summary: serde_json::Value = serde_json::from_str(run.errors.lines().last().expect("a line")).expect("JSON");
    assert_eq!(summary["summary"]["bodies"], 1);
}

/// A table of links and the parts of a scene are solved as they are: the bar of 0.5 × 40 between 100 and 0.
#[test]
fn solve_takes_links_and_scenes_as_they_are() {
    let bar = "\
*NODE
1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 2.\n6, 1., 0., 2.\n7, 1., 1., 2.\n8, 0., 1., 2.
*ELEMENT, TYPE=DC3D8, ELSET=BAR
1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=LOW\n1, 2, 3, 4
*NSET, NSET=\"The top\"\n5, 6, 7, 8
*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL
*MATERIAL, NAME=STEEL
*CONDUCTIVITY\n40.\n*DENSITY\n2.\n*SPECIFIC HEAT\n3.
*SURFACE INTERACTION, NAME=NONE
";
    let folder = Folder::with(&[("a.inp", bar)]);
    let terminals = "LOW,\"The top\"";
    for format in ["links", "scene"] {
        let run = folder.inpact(&["body", "a.inp", "--terminals", terminals, "--format", format, "-o", "part"]);
        assert_eq!(run.code, 0, "{}", run.errors);
        let part = folder.read("part");
        let scene = if format == "links" {
            let conductance = part.strip_prefix("node_1,node_2,thermal\nLOW,\"\"\"The top\"\"\",").expect("a link");
            assert!((conductance.trim().parse::<f64>().expect("a number") - 20.0).abs() < 1e-12, "{part}");
            folder.write("links.csv", &part);
            let node =
                |name: &str, value: f64| format!("[[node]]\nname = '{name}'\ntemperature = {{ fixed = {value:?} }}\n");
            format!(
                "deck = \"a.inp\"\n{}{}[[link_file]]\nfile = \"links.csv\"\n",
                node("LOW", 100.0),
                node("\"The top\"", 0.0)
            )
        } else {
            let mut values = ["100.0", "0.0"].into_iter();
            let held = part.lines().map(|line| match line.split_once("capacity = ") {
                Some((before, capacity)) => {
                    let capacity: f64 = capacity.trim_end_matches(" }").parse().expect("a number");
                    assert!((capacity - 6.0).abs() < 1e-12, "{line}");
                    format!("{before}fixed = {} }}\n", values.next().expect("two nodes"))
                }
                None => format!("{line}\n"),
            });
            format!("deck = \"a.inp\"\n{}", held.collect::<String>())
        };
        folder.write("s.toml", &scene);
        let solved = folder.inpact(&["solve", "s.toml", "--links"]);
        assert_eq!(solved.code, 0, "{scene}{}", solved.errors);
        let flow =
            solved.output.lines().last().and_then(|line| line.rsplit(',').find_map(|cell| cell.parse::<f64>().ok()));
        assert!(flow.is_some_and(|flow| (flow - 2000.0).abs() < 1e-9), "{}", solved.output);
    }
}

/// The heat of the current: the share of *JOULE HEAT FRACTION, in a table of links and in a scene alike, and a note where none is given.
#[test]
fn links_turn_what_the_current_dissipates_into_heat() {
    let bar = "\
*NODE
1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 2.\n6, 1., 0., 2.\n7, 1., 1., 2.\n8, 0., 1., 2.
*ELEMENT, TYPE=DC3D8E, ELSET=BAR
1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=LOW\n1, 2, 3, 4
*NSET, NSET=HIGH\n5, 6, 7, 8
*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL
*MATERIAL, NAME=STEEL
*CONDUCTIVITY\n40.\n*ELECTRICAL CONDUCTIVITY\n10.
*SURFACE INTERACTION, NAME=NONE
";
    let heated = bar.replace("10.\n*SURFACE", "10.\n*JOULE HEAT FRACTION\n0.5\n*SURFACE");
    let node = |name: &str| format!("[[node]]\nname = '{name}'\n");
    for format in ["links", "scene"] {
        let folder = Folder::with(&[("a.inp", heated.as_str()), ("b.inp", bar)]);
        let part_of = |deck: &str| {
            let run = folder.inpact(&["body", deck, "--terminals", "LOW,HIGH", "--format", format]);
            assert_eq!(run.code, 0, "{}", run.errors);
            run
        };
        let run = part_of("a.inp");
        assert!(!run.errors.contains("the current"), "{}", run.errors);
        let parts = if format == "links" {
            folder.write("links.csv", &run.output);
            format!("{}{}[[link_file]]\nfile = 'links.csv'\n", node("LOW"), node("HIGH"))
        } else {
            run.output.replace("potential = {}\ntemperature = {}\n", "")
        };
        let low = "name = 'LOW'\npotential = { fixed = 0.0 }\ntemperature = { fixed = 0.0 }\n";
        let high = "name = 'HIGH'\npotential = { fixed = 10.0 }\ntemperature = { fixed = 0.0 }\n";
        let parts = parts.replace('"', "'").replace("name = 'LOW'\n", low).replace("name = 'HIGH'\n", high);
        folder.write("s.toml", &format!("deck = 'a.inp'\n{parts}"));
        let solved = folder.inpact(&["solve", "s.toml", "--format", "json"]);
        assert_eq!(solved.code, 0, "{parts}{}", solved.errors);
        let document: serde_json::Value = serde_json::from_str(&solved.output).expect("JSON");
        // 5 × 10² dissipated, half of it heat, half of that at either end.
        let out = document["balance"]["temperature"]["supplies"]["LOW"].as_f64().expect("a supply");
        assert!((out + 125.0).abs() < 1e-9, "{out}: {parts}");
        let note = part_of("b.inp").errors;
        assert!(note.contains("b.inp:17:1: note[D029] the current makes no heat in the body of `LOW`, `HIGH`: `STEEL` has no *JOULE HEAT FRACTION"), "{note}");
    }
}

#[test]
fn what_cannot_be_taken_over_is_named_with_its_line() {
    for (deck, arguments, expected) in [
        (
            ELL.to_owned(),
            vec!["--terminals", "END,TOP"],
            "a.inp:22:1: error[D027] *CONDUCTIVITY of `STEEL` depends on temperature, from 0.0 to 100.0: a body is lumped at one temperature, which must be given\n",
        ),
        (
            ELL.to_owned(),
            vec!["--terminals", "TOP,26"],
            "a.inp:1:1: error[D028] the terminals `TOP` and `26` touch in node 26: no conductance is between them\n",
        ),
        (
            ELL.to_owned(),
            vec!["--terminals", "END,TIP"],
            "a.inp: error[D028] the deck has no surface and no node set `TIP`: it has `END`, `TOP`, `SIDE`\n",
        ),
        (
            ELL.replace("*ELECTRICAL CONDUCTIVITY\n5e6\n", ""),
            vec!["--terminals", "END,TOP", "--field", "both", "--temperature", "25"],
            "a.inp:39:1: error[D027] the material `STEEL` has no *ELECTRICAL CONDUCTIVITY: found `C3D8` in a body with terminals\n",
        ),
        (
            ELL.replace("MATERIAL=STEEL\n", "MATERIAL=IRON\n"),
            vec!["--terminals", "END,TOP", "--temperature", "25"],
            "a.inp:38:1: error[D027] the material `IRON` is not defined\n",
        ),
    ] {
        let run = of(&deck, &arguments);
        assert_eq!((run.code, run.output.as_str()), (1, ""), "{}", run.errors);
        // Places are looked for in the deck, since it has more lines than are shown here.
        let said = expected.split_once("error[").expect("an error").1;
        assert!(run.errors.ends_with(&format!("error[{said}")), "{}", run.errors);
        let place = run.errors.strip_prefix("a.inp:").and_then(|place| place.split(':').next());
        if let Some(line) = place.and_then(|line| line.parse::<usize>().ok()) {
            let text = deck.lines().nth(line - 1).expect("a line of the deck");
            assert!(text.starts_with('*'), "{text}: {}", run.errors);
        }
    }
}

#[test]
fn parts_of_the_deck_beside_its_bodies_are_noted() {
    let deck = ELL.to_owned()
        + "*ELEMENT, TYPE=S4R, ELSET=SKIN\n9, 1, 2, 12, 11\n*TIE, NAME=T\nEND, TOP\n*STEP\n*HEAT TRANSFER\n1., 1.\n*RADIATE\n1, R1, 0., 0.9\n*END STEP\n";
    let run = of(&deck, ALL);
    assert_eq!(run.code, 0, "{}", run.errors);
    let notes: Vec<&str> = run.errors.lines().filter_map(|line| Some(line.split_once("note[D029] ")?.1)).collect();
    assert_eq!(
        notes,
        [
            "elements of type `S4R` are not solid, and conduct nothing here",
            "*TIE is not read: what it joins conducts nothing here",
            "*RADIATE is not read: no heat leaves by radiation here",
        ]
    );
    // As JSON each is an object with the place that an editor goes to.
    let run = of(&deck, &[ALL, &["--format", "json"]].concat());
    let first: serde_json::Value = serde_json::from_str(run.errors.lines().next().expect("a line")).expect("JSON");
    let line = usize::try_from(first["line"].as_u64().expect("a line")).expect("small");
    assert_eq!(
        (first["severity"].as_str(), deck.lines().nth(line - 1)),
        (Some("note"), Some("*ELEMENT, TYPE=S4R, ELSET=SKIN"))
    );
}

/// Flat bricks that a terminal touches at one corner: between far corners heat seems to flow backwards, which no link does.
#[test]
fn conductances_below_zero_are_said_and_make_no_link() {
    let deck = "\
*NODE
1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., .05\n6, 1., 0., .05\n7, 1., 1., .05\n8, 0., 1., .05
*ELEMENT, TYPE=C3D8, ELSET=PLATE
1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=A\n1,
*NSET, NSET=B\n2,
*NSET, NSET=C\n7,
*SOLID SECTION, ELSET=PLATE, MATERIAL=STEEL
*MATERIAL, NAME=STEEL
*CONDUCTIVITY\n40.
";
    let terminals = ["--terminals", "A,B,C,3,4,5,6,8"];
    let run = of(deck, &terminals);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.output.contains("the conductance of `A` and `B` is below zero, by "), "{}", run.output);
    for format in ["links", "scene"] {
        let run = of(deck, &[&terminals[..], &["--format", format]].concat());
        assert_eq!((run.code, run.output.as_str()), (1, ""));
        assert!(run.errors.contains("below zero, which no link of a scene is: the mesh is too coarse between them"));
    }
}

#[test]
fn wrong_usage() {
    for (arguments, expected) in [
        (&[][..], "--terminals"),
        (&["--terminals", "END", "--temperature", "nan"], "expected a finite number as `--temperature`, found `NaN`"),
        (&["--terminals", "END,TOP", "-o", "a.inp"], "a.inp"),
    ] {
        let run = of(ELL, arguments);
        assert_eq!(run.code, 2, "{}", run.errors);
        assert!(run.errors.contains(expected), "{}", run.errors);
    }
}
