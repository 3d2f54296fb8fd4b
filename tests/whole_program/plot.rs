//! `inpact plot`: every sample deck, every option, and decks that no picture was made for.

use crate::program::{Folder, dialect_of, inpact, root, sample_decks};
use roxmltree::Document;
use std::fmt::Write;

const DECK: &str = "\
*SURFACE INTERACTION, NAME=JOINT
*GAP ELECTRICAL CONDUCTANCE
20., 0.
3., 0.1
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
50., 0., 300.
65., 100., 300.
70., 0., 400.
90., 70., 400.
";

fn plotted(deck: &str, more: &[&str]) -> (String, String) {
    let folder = Folder::with(&[("a.inp", deck)]);
    let run = folder.inpact(&[&["plot", "a.inp", "-o", "a.svg"], more].concat());
    assert_eq!((run.code, run.output.as_str()), (0, ""), "{}", run.errors);
    (folder.read("a.svg"), run.errors)
}

fn in_letters(deck: &str, more: &[&str]) -> String {
    let run = Folder::with(&[("a.inp", deck)]).inpact(&[&["plot", "a.inp"], more].concat());
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    assert!(run.output.lines().all(|line| line.chars().count() <= 80), "{}", run.output);
    run.output
}

/// All texts of a drawing; none goes over its edge as far as letters of an average width tell.
fn texts(svg: &str) -> Vec<String> {
    let document = Document::parse(svg).expect("well-formed");
    let root = document.root_element();
    let width: f64 = root.attribute("width").and_then(|width| width.parse().ok()).expect("a width");
    let mut texts = Vec::new();
    for node in document.descendants().filter(|node| node.has_tag_name("text")) {
        let text = node.text().unwrap_or_default().to_owned();
        if let Some(x) = node.attribute("x").and_then(|x| x.parse::<f64>().ok()) {
            let size: f64 = node.attribute("font-size").and_then(|size| size.parse().ok()).expect("a size");
            let length = 0.58 * size * text.chars().count() as f64;
            let left = match node.attribute("text-anchor") {
                Some("middle") => x - length / 2.0,
                Some("end") => x - length,
                _ => x,
            };
            assert!(-4.0 <= left && left + length <= width + 4.0, "`{text}` is clipped: {left} to {}", left + length);
        }
        texts.push(text);
    }
    texts
}

fn has(texts: &[String], wanted: &str) -> bool {
    texts.iter().any(|text| text == wanted)
}

#[test]
fn every_sample_deck_has_a_picture_or_says_why_not() {
    let folder = Folder::with(&[]);
    let mut drawn = 0;
    for deck in sample_decks() {
        let picture = folder.path().join("picture.svg");
        let picture = picture.to_str().expect("a name that is text");
        let run = inpact(&[&["plot", &deck, "--findings", "-o", picture], dialect_of(&deck)].concat());
        let text = inpact(&[&["plot", &deck], dialect_of(&deck)].concat());
        assert!(text.output.lines().all(|line| line.chars().count() <= 80), "{deck}: {}", text.output);
        assert_eq!(run.code, text.code, "{deck}");
        if run.code == 1 {
            assert!(run.errors.contains("no table of conductance, permeability or view factor"), "{}", run.errors);
            continue;
        }
        assert_eq!(run.code, 0, "{deck}: {}", run.errors);
        drawn += 1;
        let texts = texts(&folder.read("picture.svg"));
        assert!(texts.iter().any(|text| text.contains("clearance (L)") || text.contains("pressure (M L⁻¹ T⁻²)")));
    }
    assert!(20 < drawn, "{drawn}");
}

#[test]
fn a_plot_in_letters_is_legible_without_colours() {
    insta::assert_snapshot!(in_letters(DECK, &["--findings"]));
}

#[test]
fn laws_interactions_and_variables_are_chosen() {
    let deck = std::fs::read_to_string(root().join("decks/spot-weld/spot-weld.inp")).expect("a sample");
    let all = in_letters(&deck, &[]);
    assert_eq!(all.matches(": electrical conductance").count(), 2);
    let one = in_letters(&deck, &["--interaction", "faying", "--law", "thermal"]);
    assert!(one.starts_with("FAYING: thermal conductance\n"), "{one}");
    assert!(!one.contains("electrical"));
    let held = in_letters(&deck, &["--interaction", "FAYING", "--law", "electrical", "--at", "temp=510"]);
    assert!(held.starts_with("FAYING: electrical conductance, temp = 510\n"), "{held}");
    assert!(!held.contains("a="));
}

#[test]
fn what_does_not_exist_is_refused() {
    let folder = Folder::with(&[("a.inp", DECK)]);
    for (arguments, message) in [
        (&["--interaction", "JOINTS"][..], "there is no interaction `JOINTS`; there are `JOINT`"),
        (&["--at", "temp"], "expected NAME=VALUE"),
        (&["--at", "temp=warm"], "expected a number after `temp=`, found `warm`"),
        (&["--units", "presure=MPa"], "there is no quantity `presure`"),
        (&["-o", "a.gif"], "must end in"),
        (&["-o", "a.inp"], "must end in"),
    ] {
        let run = folder.inpact(&[&["plot", "a.inp"], arguments].concat());
        assert_eq!(run.code, 2, "{arguments:?}");
        assert!(run.errors.contains(message), "{arguments:?}: {}", run.errors);
    }
    assert!(in_letters(DECK, &["--at", "fv3=1"]).contains("no table of the deck depends on `fv3`"));
}

#[test]
fn units_are_dimensions_or_those_of_the_user() {
    assert!(has(&texts(&plotted(DECK, &[]).0), "contact pressure (M L⁻¹ T⁻²)"));
    let (svg, _) = plotted(DECK, &["--units", "M=t,L=mm,T=s,pressure=MPa,theta=K"]);
    let texts = texts(&svg);
    for title in ["contact pressure (MPa)", "clearance (mm)", "temperature (K)"] {
        assert!(has(&texts, title), "{title}: {texts:?}");
    }
}

/// The rows of the table are marks that tell their numbers, and curves go from mark to mark.
#[test]
fn rows_are_marks_at_their_numbers() {
    let (svg, _) = plotted(DECK, &[]);
    let document = Document::parse(&svg).expect("well-formed");
    let texts: Vec<&str> = document
        .descendants()
        .filter(|node| node.has_tag_name("title") && !node.parent().is_some_and(|of| of.has_tag_name("svg")))
        .filter_map(|node| node.text())
        .collect();
    for row in ["clearance 0: 20", "clearance 0.1: 3", "pressure 100: 65", "pressure 70: 90"] {
        assert!(texts.contains(&row), "{row}: {texts:?}");
    }
}

/// beyond the last clearance constant by the text, zero by the figure; both dashed.
#[test]
fn q_01_what_follows_the_last_clearance_is_dashed() {
    let (constant, zero) = (plotted(DECK, &[]).0, plotted(DECK, &["--clearance-tail", "zero"]).0);
    assert!(constant.contains("stroke-dasharray=\"5 4\"") && zero.contains("stroke-dasharray=\"5 4\""));
    assert_ne!(constant, zero);
}

#[test]
fn findings_are_marked_at_their_rows() {
    let deck = "\
*SURFACE INTERACTION, NAME=A
*GAP ELECTRICAL CONDUCTANCE
20., 0.
30., 0.05
10., 0.1
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
5000., 0.
6500., 100.
6000., 200.
*SURFACE INTERACTION, NAME=B
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
1., 0.
3., 20.
2., 10.
";
    let marked = texts(&plotted(deck, &["--findings"]).0);
    for code in ["T001", "P005", "P006", "P007", "P008"] {
        assert!(has(&marked, code), "{code}: {marked:?}");
    }
    assert!(marked.iter().any(|text| text.starts_with("not evaluated, the rows as written")));
    let unmarked = texts(&plotted(deck, &[]).0);
    assert!(!has(&unmarked, "P005"));
    assert!(in_letters(deck, &["--findings"]).contains("! T001 at pressure 10, line 14:"));
}

#[test]
fn decks_stand_side_by_side_with_the_same_axes() {
    let new = DECK.replace("90., 70., 400.", "900., 240., 400.");
    let folder = Folder::with(&[("old.inp", DECK), ("new.inp", &new)]);
    let run = folder.inpact(&["plot", "old.inp", "new.inp", "-o", "a.svg"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let texts = texts(&folder.read("a.svg"));
    assert!(has(&texts, "old.inp") && has(&texts, "new.inp"));
    let count = |label: &str| texts.iter().filter(|text| *text == label).count();
    // Ticks that only the larger of both needs, of values and of pressures.
    assert_eq!((count("800"), count("200")), (2, 4), "{texts:?}");
}

#[test]
fn what_changed_between_decks_is_said() {
    let new = DECK.replace("90., 70., 400.", "91., 70., 400.") + "*SURFACE INTERACTION, NAME=K\n";
    let folder = Folder::with(&[("old.inp", DECK), ("new.inp", &new)]);
    let run = folder.inpact(&["plot", "old.inp", "new.inp", "--units", "L=mm"]);
    let said = run.output.replace('\n', " ");
    let change = "changed since old.inp: electrical conductance of JOINT against pressure: row 4: conductance 90 -> 91";
    assert!(said.contains(change), "{}", run.output);
    assert!(said.contains("changed since old.inp: K is new"), "{}", run.output);
    let same = folder.inpact(&["plot", "old.inp", "old.inp"]);
    assert!(same.output.contains("the same as old.inp"), "{}", same.output);
}

/// D007 in a picture: where the rows of a node table are, and how many of them are beyond the tables.
#[test]
fn nodes_are_points_with_histograms_and_the_share_beyond() {
    let nodes = "clearance,pressure,temp\n.03,0,310\n.07,0,320\n.2,0,330\n0,10,340\n0,33,399\n0,900,350\n";
    let folder = Folder::with(&[("a.inp", DECK), ("a.csv", nodes)]);
    let run = folder.inpact(&["plot", "a.inp", "--nodes", "a.csv", "-o", "a.svg"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.errors.contains("note[D007]"));
    let svg = folder.read("a.svg");
    let texts = texts(&svg);
    let share = "node table: 6 rows: 3 closed, 3 open; 2 beyond the table (33.3 %)";
    assert!(texts.iter().any(|text| text.contains(share)), "{texts:?}");
    assert!(has(&texts, "500"), "an axis that ends before the nodes: {texts:?}");
    assert_eq!(svg.matches("fill-opacity=\"0.35\"").count(), 6, "a point a row");
    // Three bars for clearances, two for pressures, four for values.
    assert!(6 < svg.matches("fill-opacity=\"0.45\"").count());
    let run = folder.inpact(&["plot", "a.inp", "a.inp", "--nodes", "a.csv"]);
    assert_eq!(run.code, 2);
    assert!(run.errors.contains("`--nodes` is for one deck"));
}

#[test]
fn a_page_of_curves_is_made() {
    let folder = Folder::with(&[("a.inp", DECK)]);
    let run = folder.inpact(&["plot", "a.inp", "-o", "a.html"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let html = folder.read("a.html");
    assert!(html.starts_with("<!DOCTYPE html>") && html.contains("figure class=\"law\""));
}

#[test]
fn a_picture_of_pixels_is_drawn() {
    let folder = Folder::with(&[("a.inp", DECK)]);
    let run = folder.inpact(&["plot", "a.inp", "-o", "a.png"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let bytes = std::fs::read(folder.path().join("a.png")).expect("a picture");
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
}

#[test]
fn ten_thousand_interactions_are_drawn_in_part() {
    let mut deck = String::new();
    for index in 0..10_000 {
        let _ = write!(deck, "*SURFACE INTERACTION, NAME=I{index}\n*GAP ELECTRICAL CONDUCTANCE\n2., 0.\n0., 1.\n");
    }
    let (svg, errors) = plotted(&deck, &[]);
    assert!(errors.contains("40 panels are drawn and 9960 laws are not"), "{errors}");
    assert!(has(&texts(&svg), "I39: electrical conductance"));
    let (svg, errors) = plotted(&deck, &["--interaction", "I9999"]);
    assert_eq!(errors, "");
    assert!(has(&texts(&svg), "I9999: electrical conductance"));
}

#[test]
fn a_table_of_very_many_rows_is_thinned_out_with_its_extremes() {
    let mut deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n".to_owned();
    for index in 0..200_000 {
        let value = if index == 123_457 { 900 } else { 100 };
        let _ = writeln!(deck, "{value}., {index}.");
    }
    let (svg, _) = plotted(&deck, &[]);
    assert!(svg.len() < 60_000, "{}", svg.len());
    let texts = texts(&svg);
    assert!(has(&texts, "800"), "the spike is left out: {texts:?}");
    assert!(texts.iter().any(|text| text.contains("200000 rows are not marked")), "{texts:?}");
}

#[test]
fn six_hundred_decades_have_a_picture() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n1.e-300, 0.\n1., 1.e-300\n1.e300, 1.e300\n";
    let linear = texts(&plotted(deck, &[]).0);
    assert!(linear.iter().any(|text| text.contains("values over 600 decades: `--log` tells them apart")), "{linear:?}");
    let logarithmic = texts(&plotted(deck, &["--log=xy"]).0);
    assert!(has(&logarithmic, "1e-200") && has(&logarithmic, "1e200"), "{logarithmic:?}");
    assert!(!logarithmic.iter().any(|text| text.contains("--log")), "{logarithmic:?}");
    in_letters(deck, &["--log=xy"]);
}

#[test]
fn one_row_is_a_level_line() {
    let (svg, _) = plotted("*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n1.0E6, 0.0\n", &[]);
    assert!(has(&texts(&svg), "1e6"));
}

/// Zero rows, infinities, words instead of numbers: a picture of what there is, or a message, never a fault of the program.
#[test]
fn rows_that_are_none_are_said() {
    let folder = Folder::with(&[
        ("none.inp", "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n"),
        ("nothing.inp", "*HEADING\nnothing\n"),
        ("user.inp", "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, USER\n"),
        (
            "infinite.inp",
            "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n1., 0.\n1e999, 5.\n3., inf\n",
        ),
        ("words.inp", "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\none, two\nthree, four\n"),
        (
            "extremes.inp",
            "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n-1.7e308, -1.7e308\n1.7e308, 1.7e308\n",
        ),
    ]);
    for (name, code, message) in [
        ("none.inp", 1, "no table of conductance"),
        ("nothing.inp", 1, "no table of conductance"),
        ("user.inp", 1, "needs user subroutine GAPELECTR"),
        ("infinite.inp", 0, "its rows form no table"),
        ("words.inp", 0, "its rows form no table"),
        ("extremes.inp", 0, ""),
    ] {
        for more in [&[][..], &["--log=xy"], &["-o", "a.svg"], &["-o", "a.svg", "--log=xy"]] {
            let run = folder.inpact(&[&["plot", name], more].concat());
            assert_eq!(run.code, code, "{name} {more:?}: {}", run.errors);
            let said = if more.contains(&"-o") && code == 0 { folder.read("a.svg") } else { run.output + &run.errors };
            assert!(said.contains(message), "{name} {more:?}: {said}");
            assert!(!said.contains("NaN\"") && !said.contains("inf\""), "a coordinate that is no number: {said}");
        }
    }
}

#[test]
fn hostile_names_stay_names() {
    let long = "X".repeat(80);
    let deck = format!(
        "*SURFACE INTERACTION, NAME=\"</script><svg onload=alert(1)>&amp;\u{202e}\"\n*GAP ELECTRICAL CONDUCTANCE\n2., 0.\n0., 1.\n\
         *SURFACE INTERACTION, NAME={long}\n*GAP ELECTRICAL CONDUCTANCE\n2., 0.\n0., 1.\n"
    );
    let (svg, _) = plotted(&deck, &[]);
    let document = Document::parse(&svg).expect("well-formed");
    assert!(document.descendants().all(|node| !node.has_tag_name("script") && node.attribute("onload").is_none()));
    let texts = texts(&svg);
    assert!(texts.iter().any(|text| text.contains("</script>")), "{texts:?}");
    assert!(!svg.contains('\u{202e}'), "an order of letters that the name decides");
    assert!(texts.iter().any(|text| text.ends_with('…')), "{texts:?}");
    assert!(!in_letters(&deck, &[]).contains('\u{202e}'));
}

/// The pictures of `docs/pictures` are those that `inpact plot` draws; `INPACT_UPDATE=1` draws them anew.
#[test]
fn pictures_of_the_sample_decks_are_fresh() {
    const BEGIN: &str = "## The sample decks\n";
    let folder = Folder::with(&[]);
    let target = folder.path().join("picture.svg");
    let target = target.to_str().expect("a name that is text");
    let is_update = std::env::var_os("INPACT_UPDATE").is_some();
    let mut gallery =
        format!("{BEGIN}\nDrawn with `--findings`, and with `--nodes` where a node table is beside the deck.\n");
    let mut drawn = Vec::new();
    for deck in sample_decks() {
        let nodes = deck.replace(".inp", "-nodes.csv");
        let has_nodes = root().join(&nodes).exists() && !deck.contains("user-law");
        let more: &[&str] = if has_nodes { &["--nodes", &nodes] } else { &[] };
        let run = inpact(&[&["plot", &deck, "--findings", "-o", target], dialect_of(&deck), more].concat());
        if run.code == 1 {
            continue;
        }
        assert_eq!(run.code, 0, "{deck}: {}", run.errors);
        let name = deck.rsplit('/').next().expect("a name").replace(".inp", ".svg");
        let picture = root().join("docs/pictures").join(&name);
        if is_update {
            std::fs::copy(target, &picture).expect("writable");
        }
        let kept = std::fs::read_to_string(&picture).unwrap_or_default();
        let is_fresh = kept == folder.read("picture.svg");
        assert!(is_fresh, "`docs/pictures/{name}` is out of date: run this test again with INPACT_UPDATE=1");
        let _ = write!(gallery, "\n[{deck}](../{deck})\n\n![Curves of {deck}](pictures/{name})\n");
        drawn.push(name);
    }
    let page = root().join("docs/pictures.md");
    let written = std::fs::read_to_string(&page).expect("readable");
    let begin = written.find(BEGIN).expect("the section of the samples");
    let fresh = written[..begin].to_owned() + &gallery;
    if is_update {
        std::fs::write(&page, &fresh).expect("writable");
    } else {
        assert!(fresh == written, "`docs/pictures.md` is out of date: run this test again with INPACT_UPDATE=1");
    }
    let mut kept: Vec<String> = std::fs::read_dir(root().join("docs/pictures"))
        .expect("a folder")
        .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
        .collect();
    kept.sort();
    drawn.sort();
    assert_eq!(kept, drawn, "pictures of decks that are gone");
}
