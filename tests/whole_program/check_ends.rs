//! `check` keeps no more of large tables in order than their ends, and says what it says of the whole deck.
//!
//! A file is read again where the ends are not enough; a stream cannot be, so that it is kept whole: both must say the same.

use crate::program::Folder;

/// A table of one axis whose values go down or up, each row with that to be done to it.
fn rows(count: usize, value: impl Fn(usize) -> usize, change: impl Fn(usize, String) -> String) -> String {
    (0..count).map(|row| change(row, format!("{}., {row}e-3\n", value(row)))).collect()
}

fn deck(falling: &str, rising: &str) -> String {
    format!(
        "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n{falling}*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n{rising}\
         *SURFACE INTERACTION, NAM=B, FOO\n*GAP ELECTRICAL CONDUCTANCE\n{falling}*GAP HEAT GENERATION\n2., 0.5\n"
    )
}

#[test]
fn a_file_and_a_stream_have_the_same_findings() {
    let same = |_, row| row;
    let falling = rows(50, |row| 49 - row, same);
    let rising = rows(50, |row| 49 + row, same);
    let in_row = |at: usize, from: &'static str, to: &'static str| {
        move |row: usize, text: String| if row == at { text.replace(from, to) } else { text }
    };
    let decks = [
        deck(&falling, &rising),
        // At the ends: P007, P008.
        deck(&rows(50, |row| 50 - row, same), &rows(50, |row| 5000 + row, same)),
        // The wrong way: P005, P006.
        deck(&rising, &falling),
        // In the middle of one: T001, T002, S006, S010, P005, a directive.
        deck(&rows(50, |row| 49 - row, in_row(20, "20e", "2e")), &rising),
        deck(&falling, &rows(50, |row| 49 + row, in_row(20, "20e", "19e"))),
        deck(&falling, &rows(50, |row| 49 + row, in_row(20, "69.", "x"))),
        deck(&rows(50, |row| 49 - row, in_row(47, "\n", "\n\n")), &rising),
        deck(&rows(50, |row| 49 - row, in_row(3, "46.", "47.")), &rising),
        deck(&rows(50, |row| 50 - row, in_row(20, "30.", "** inpact: ignore P008\n30.")), &rising),
        // Rows that count beside USER: T011.
        deck(&falling, &rising).replace("CONDUCTANCE\n", "CONDUCTANCE, USER\n"),
        deck(&falling, &rising).replace('\n', "\r\n"),
    ];
    let mut codes = std::collections::BTreeSet::new();
    for (number, deck) in decks.iter().enumerate() {
        let folder = Folder::with(&[("d.inp", deck)]);
        for format in ["full", "concise", "json", "github", "sarif"] {
            let arguments = ["check", "--isolated", "--format", format];
            let of_file = folder.inpact(&[&arguments[..], &["d.inp"]].concat());
            let of_stream = folder.inpact_with_input(&[&arguments[..], &["-"]].concat(), deck.as_bytes());
            // The name is all that differs, and what is made of it.
            let named = |text: &str| text.replace("d.inp", "-");
            let same = match format {
                "sarif" => results(&named(&of_file.output)) == results(&of_stream.output),
                _ => named(&of_file.output) == of_stream.output,
            };
            assert!(same, "deck {number}, {format}");
            assert_eq!((of_file.code, of_file.errors), (of_stream.code, of_stream.errors), "deck {number}, {format}");
            if format == "json" {
                let findings = of_file.output.lines().map(|line| serde_json::from_str(line).expect("JSON"));
                codes.extend(findings.filter_map(|found: serde_json::Value| Some(found["code"].as_str()?.to_owned())));
            }
        }
    }
    for code in ["P005", "P006", "P007", "P008", "S006", "S010", "T001", "T002", "T011", "P004", "K004"] {
        assert!(codes.contains(code), "{code} is not among {codes:?}");
    }
}

/// The findings of a SARIF log without their fingerprints, in which the name of the file counts.
fn results(log: &str) -> Vec<serde_json::Value> {
    let mut log: serde_json::Value = serde_json::from_str(log).expect("SARIF");
    let results = log["runs"][0]["results"].as_array_mut().expect("results");
    for found in results.iter_mut() {
        assert!(found.as_object_mut().and_then(|found| found.remove("partialFingerprints")).is_some());
    }
    std::mem::take(results)
}
