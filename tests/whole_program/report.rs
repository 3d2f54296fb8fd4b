//! `inpact report`: one page that asks nothing of a network, says what `eval` says, and in which nothing of a deck runs.

use crate::program::{Folder, dialect_of, inpact, root, sample_decks};
use serde_json::Value;
use std::fmt::Write;

const DECK: &str = "\
*SURFACE INTERACTION, NAME=JOINT
*GAP ELECTRICAL CONDUCTANCE, DEPENDENCIES=1
20., 0., 300., 1.
3., 0.1, 300., 1.
0., 0.7, 300., 1.
33., 0., 400., 2.
4., 0.3, 400., 2.
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
50., 0., 300.
65., 100., 300.
70., 0., 400.
90., 70., 400.
*CONTACT PAIR, INTERACTION=JOINT
LOWER, UPPER
";

fn reported(deck: &str, more: &[&str]) -> String {
    reported_with(0, deck, more)
}

/// The page of a deck with which the command ends so.
fn reported_with(code: i32, deck: &str, more: &[&str]) -> String {
    let folder = Folder::with(&[("a.inp", deck)]);
    let run = folder.inpact(&[&["report", "a.inp", "-o", "a.html"], more].concat());
    assert_eq!((run.code, run.output.as_str()), (code, ""), "{}", run.errors);
    folder.read("a.html")
}

/// The data beside each figure.
fn data(html: &str) -> Vec<Value> {
    let parts = html.split("<script type=\"application/json\">").skip(1);
    let parts = parts.map(|part| part.split("</script>").next().expect("an end"));
    parts.map(|json| serde_json::from_str(json).expect("JSON")).collect()
}

fn numbers(values: &Value) -> Vec<f64> {
    values.as_array().expect("numbers").iter().filter_map(Value::as_f64).collect()
}

/// Nothing is fetched, two scripts run, and every link within the page has a target.
fn check_page(html: &str) {
    let page = html.split("<script>/*! https").next().expect("a page");
    // In text `<` is escaped: what begins with it is a tag.
    for tag in page.split('<').skip(1).filter_map(|part| part.split('>').next()) {
        let fetches = ["src=", "url(", "href=\"http"].iter().any(|reference| tag.contains(reference));
        let is_foreign = ["iframe", "object", "link", "img", "b"].contains(&tag.split(' ').next().expect("a name"));
        assert!(!fetches && !is_foreign && !tag.contains(" on"), "{tag}");
    }
    assert!(!page.contains("@import") && !page.contains("url("), "a style that fetches");
    assert_eq!(html.matches("<script>").count(), 2);
    assert_eq!(html.matches("<script").count(), 2 + data(html).len());
    for link in html.split("href=\"#").skip(1) {
        let id = link.split('"').next().expect("an end");
        assert!(html.contains(&format!("id=\"{id}\"")), "a link to `{id}`, which is not there");
    }
}

#[test]
fn every_sample_deck_has_a_report() {
    for deck in sample_decks() {
        let nodes = deck.replace(".inp", "-nodes.csv");
        let has_nodes = root().join(&nodes).exists() && !deck.contains("user-law");
        let more: &[&str] = if has_nodes { &["--nodes", &nodes] } else { &[] };
        let run = inpact(&[&["report", &deck], dialect_of(&deck), more].concat());
        let code = i32::from(deck.contains("faulty"));
        assert_eq!(run.code, code, "{deck}: {}", run.errors);
        check_page(&run.output);
        assert!(run.output.len() < 500_000, "{deck}: {} bytes", run.output.len());
        assert_eq!(has_nodes, run.output.contains("<h2 id=\"results\">"), "{deck}");
    }
}

#[test]
fn a_report_is_the_same_each_time_and_names_its_inputs_by_their_hashes() {
    assert_eq!(reported(DECK, &[]), reported(DECK, &[]));
    // SHA-256 of nothing.
    let html = reported("", &[]);
    assert!(html.contains("e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"));
    assert!(html.contains("inpact report a.inp -o report.html"), "{}", &html[..2000]);
    let folder = Folder::with(&[("a.inp", "*INCLUDE, INPUT=b.inp\n"), ("b.inp", DECK)]);
    let html = folder.inpact(&["report", "a.inp"]).output;
    assert!(html.contains("<td class=\"text\">b.inp</td>"), "the included file is an input");
    assert!(!html.contains(folder.path().to_str().expect("text")), "where the files are is nobody's business");
}

/// The rows of the tables are samples of the curves, bit for bit, and known as rows.
#[test]
fn rows_are_read_to_the_last_digit() {
    let html = reported(DECK, &[]);
    let data = data(&html);
    let closed = &data[0]["curves"][1]["sides"][1];
    assert_eq!(numbers(&closed["knots"]), [0.0, 70.0]);
    let x = numbers(&data[0]["halves"][1]["x"]);
    for (pressure, value) in [(0.0, 70.0), (70.0, 90.0)] {
        let place = x.iter().position(|of| *of == pressure).expect("a row");
        assert_eq!(closed["y"][place].as_f64(), Some(value));
    }
}

/// Of more rows than a page can hold, those stay where a curve bends most, and the panel says how many were left out.
#[test]
fn a_spike_among_very_many_rows_is_in_curves_and_sliders() {
    let mut deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n".to_owned();
    for temperature in [20, 90] {
        for index in 0..3_000 {
            let value = if (temperature, index) == (20, 1_234) { 777 } else { temperature };
            let _ = writeln!(deck, "{value}., {index}., {temperature}.");
        }
    }
    let html = reported(&deck, &[]);
    let data = data(&html);
    let x = numbers(&data[0]["halves"][1]["x"]);
    assert!(x.contains(&1_234.0) && x.len() <= 400, "{} abscissae", x.len());
    let x = numbers(&data[0]["probe"]["branches"][1]["x"]);
    assert!(x.contains(&1_234.0) && x.len() <= 40, "{} abscissae of the sliders", x.len());
    assert!(numbers(&data[0]["probe"]["branches"][1]["y"]).contains(&777.0));
    assert!(html.contains("abscissae, those where a curve bends most among them"));
}

/// Curves and sliders have the values of `eval`, which prints them to the last digit.
#[test]
fn curves_and_sliders_have_the_values_of_eval() {
    let folder = Folder::with(&[("a.inp", DECK)]);
    let html = folder.inpact(&["report", "a.inp"]).output;
    let data = data(&html);
    let [temperatures, fields] = [0, 1].map(|axis| numbers(&data[0]["probe"]["axes"][axis]["stops"]));
    assert_eq!(temperatures, [300.0, 325.0, 350.0, 375.0, 400.0]);
    assert_eq!(fields.len(), 5);
    let mut table = "clearance,pressure,closed,temp,fv1\n".to_owned();
    let mut expected = Vec::new();
    for side in [0, 1] {
        let branch = &data[0]["probe"]["branches"][side];
        let x = numbers(&branch["x"]);
        let y = branch["y"].as_array().expect("values");
        assert_eq!(y.len(), x.len() * temperatures.len() * fields.len());
        let stops = temperatures.iter().flat_map(|temperature| fields.iter().map(move |field| (temperature, field)));
        for (stop, (temperature, field)) in stops.enumerate() {
            for (index, at) in x.iter().enumerate() {
                let (clearance, pressure) = if side == 0 { (*at, 0.0) } else { (0.0, *at) };
                let _ = writeln!(table, "{clearance:?},{pressure:?},{side},{temperature:?},{field:?}");
                expected.push(y[stop * x.len() + index].as_f64().expect("a value"));
            }
        }
    }
    folder.write("a.csv", &table);
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "a.csv", "--outputs", "conductance"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let values: Vec<f64> = run.output.lines().skip(1).map(|line| line.parse().expect("a number")).collect();
    assert_eq!(values.len(), expected.len());
    assert!(200 < values.len());
    for (row, (value, expected)) in values.iter().zip(&expected).enumerate() {
        assert_eq!(value.to_bits(), expected.to_bits(), "{}", table.lines().nth(row + 1).expect("a row"));
    }
}

#[test]
fn findings_have_their_excerpt_and_lead_to_their_rows() {
    let deck = DECK.replace("65., 100., 300.\n", "65., -100., 300.\n");
    let html = reported_with(1, &deck, &[]);
    check_page(&html);
    assert!(html.contains("<span class=\"word\">error T001</span>"), "no finding");
    assert!(html.contains("row 2 of a table of JOINT"));
    assert!(html.contains("-100., 300."), "no excerpt");
    assert!(html.contains("Fix: sort the rows of the table"));
    assert!(html.contains("not evaluated, the rows as written"));
}

/// Names, labels, headings and units of strangers: text, and nothing else.
#[test]
fn nothing_of_a_deck_runs() {
    let hostile = "</script><script>alert(1)</script><img src=x onerror=alert(1)>\u{202e}";
    let deck = format!(
        "*SURFACE INTERACTION, NAME=\"{hostile}\"\n*GAP ELECTRICAL CONDUCTANCE\n2., 0., {hostile}\n0., 1., '\"\n\
         *SURFACE INTERACTION, NAME=B\n*FRICTION, X=\"{hostile}\"\n{hostile}\n*GAP ELECTRICAL CONDUCTANCE\n2., 0.\n0., 1.\n\
         *CONTACT PAIR, INTERACTION=B\n\"{hostile}\", \"{hostile}\"\n"
    );
    let html = reported_with(1, &deck, &["--units", "L=</script><b>,C=\"'&"]);
    check_page(&html);
    let page = html.split("<script>/*! https").next().expect("a page");
    assert!(!page.contains('\u{202e}'));
    assert!(page.contains("&lt;/script&gt;&lt;script&gt;alert(1)"));
    assert!(html.contains("script-src 'sha256-"), "no policy");
}

#[test]
fn decks_without_curves_and_with_very_many_have_a_report() {
    assert!(reported("*HEADING\nnothing\n", &[]).contains("The deck defines no *SURFACE INTERACTION."));
    let mut deck = String::new();
    for index in 0..10_000 {
        let _ = write!(deck, "*SURFACE INTERACTION, NAME=I{index}\n*GAP ELECTRICAL CONDUCTANCE\n2., 0.\n0., 1.\n");
    }
    let html = reported(&deck, &[]);
    assert!(html.contains("9600 more interactions are not shown"), "{}", html.len());
    assert!(html.contains("250 panels are drawn and 9750 laws are not"));
    assert!(html.len() < 5_000_000, "{}", html.len());
}

#[test]
fn results_are_histories_and_totals() {
    let folder =
        Folder::with(&[("a.inp", "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n2., 0.\n2., 1.\n")]);
    folder.write(
        "a.csv",
        "node,time,clearance,epot_s,epot_m,area\n1,1,.5,3,0,10\n1,2,.5,5,0,10\n2,1,.5,3,0,1\n2,2,.5,5,0,1\n",
    );
    let run = folder.inpact(&["report", "a.inp", "--nodes", "a.csv"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    check_page(&run.output);
    // ECDA of 11 units of area: 2 · 3 · 11 and 2 · 5 · 11.
    assert!(run.output.contains("ECDA of A, over all nodes"));
    for row in ["<td>1</td>\n<td>66</td>", "<td>2</td>\n<td>110</td>"] {
        assert!(run.output.contains(row), "{row}");
    }
    assert!(run.output.contains("4 rows: 0 closed, 4 open; 0 beyond the table (0.0 %)"));
}

/// A deck with errors has a page that shows them, and the command says so at its end; so does one without an interaction.
#[test]
fn a_page_of_errors_is_no_success() {
    let deck = root().join("decks/faulty/first-mistakes.inp").display().to_string();
    let folder = Folder::with(&[("n.inp", "*NODE\n1, 0., 0., 0.\n"), ("a.inp", DECK), ("a.csv", "clearance\n0\n")]);
    let run = folder.inpact(&["report", &deck, "-o", "a.html"]);
    assert_eq!(run.code, 1, "{}", run.errors);
    assert!(run.errors.starts_with("6 errors in the deck: see the page, or `inpact check "), "{}", run.errors);
    check_page(&folder.read("a.html"));
    let run = folder.inpact(&["report", "n.inp", "-o", "n.html"]);
    let note = "note: `n.inp` defines no *SURFACE INTERACTION: the page has its findings alone\n";
    assert_eq!((run.code, run.errors.as_str()), (0, note));
    // Rows on which what is wrong with the deck leaves nothing to evaluate.
    folder.write("a.inp", &DECK.replace("*GAP ELECTRICAL", "*GAP ELECTRIKAL"));
    let run = folder.inpact(&["report", "a.inp", "--nodes", "a.csv", "-o", "b.html"]);
    assert_eq!(run.code, 1, "{}", run.errors);
}

#[test]
fn what_is_wrong_with_the_data_is_said() {
    let folder = Folder::with(&[("a.inp", DECK), ("a.csv", "clearance\nfar\n")]);
    let run = folder.inpact(&["report", "a.inp", "--nodes", "a.csv", "-o", "a.html"]);
    assert_eq!(run.code, 1, "{}", run.errors);
    assert!(run.errors.contains("error["), "{}", run.errors);
    assert_eq!(folder.names(), ["a.csv", "a.inp"]);
    let run = folder.inpact(&["report", "a.inp", "-o", "a.inp"]);
    assert_eq!(run.code, 2, "{}", run.errors);
    assert_eq!(folder.read("a.inp"), DECK);
}

/// What a deck's own job wrote: its states are times, and what interfaces add up to are histories of it.
#[test]
fn results_of_a_job_are_taken_instead_of_a_node_table() {
    let Some(folder) = crate::nodes_results::ccx(crate::nodes_results::PRESSED) else { return };
    let options = ["job.inp", "--dialect", "calculix", "--results", "job.frd"];
    let run = folder.inpact(&[&["report"], &options[..]].concat());
    assert_eq!(run.code, 0, "{}", run.errors);
    check_page(&run.output);
    assert!(run.output.contains("HFLA of I, over all nodes"), "no history");
    assert!(run.output.contains("HFL on 1 face at time 2, from "), "no coloured interface");
    assert!(run.output.contains("<td class=\"text\">job.frd</td>"), "no hash of the results");
    // The sums of `eval`, which prints the rows.
    let table = folder.inpact(&[&["eval"], &options[..], &["--outputs", "HFLA"]].concat());
    assert_eq!(table.code, 0, "{}", table.errors);
    let header: Vec<&str> = table.output.lines().next().expect("a header").split(',').collect();
    let place = |name| header.iter().position(|column| *column == name).expect("a column");
    for time in ["1", "2"] {
        let rows = table.output.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
        let rows = rows.filter(|row| row[place("time")] == time && !row[place("HFLA")].is_empty());
        let sum: f64 = rows.map(|row| row[place("HFLA")].parse::<f64>().expect("a number")).sum();
        let history = run.output.split("HFLA of I, over all nodes").nth(1).expect("a history");
        let shown = history.split(&format!("<td>{time}</td>\n<td>")).nth(1).expect("a row of that time");
        let shown: f64 = shown.split('<').next().expect("an end").parse().expect("a number");
        assert!((shown - sum).abs() <= 1e-12 * sum.abs(), "{shown} {sum}");
    }
}

/// The deck's own mesh: its interfaces in the colours of what is known without a result; and the cost of accuracy on its rows.
#[test]
fn a_mesh_is_shown_and_the_trade_is_measured_where_that_is_wanted() {
    let deck = root().join("decks/weld-mesh/weld-mesh.inp").display().to_string();
    let run = inpact(&["report", &deck, "--mesh", "--tradeoff"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    check_page(&run.output);
    assert!(run.output.contains("clearance on "), "no coloured interface");
    assert!(run.output.contains("id=\"tradeoff\""), "no section");
    assert!(run.output.contains("Work and precision of weld-mesh.inp"), "no diagram");
    // Nothing that depends on the day without it.
    let again = || inpact(&["report", &deck, "--mesh"]).output;
    assert_eq!(again(), again());
    assert!(!again().contains("Work and precision"));

    let run = inpact(&["report", &deck, "--tradeoff"]);
    assert_eq!(run.code, 2, "{}", run.errors);
    assert!(run.errors.contains("give `--nodes TABLE`, `--results FILE` or `--mesh`"), "{}", run.errors);
}
