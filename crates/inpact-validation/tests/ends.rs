//! A deck of which the ends of ordered tables were kept has the findings of the whole deck, or says that it lacks rows.

use inpact_parser::deck::{Deck, Keep, RowsKept, ScanOptions, Scanner};
use inpact_parser::grammar::{Dialect, Grammar, Release};
use inpact_parser::model;
use inpact_validation::Diagnostic;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use std::cell::Cell;

fn scanned(text: &[u8], grammar: &Grammar, keep: Keep, piece: usize) -> Deck {
    let mut scanner = Scanner::new("deck.inp", ScanOptions { grammar, keep });
    text.chunks(piece).for_each(|piece| scanner.push(piece));
    scanner.finish()
}

/// The findings, with their places, and whether rows were missed.
fn findings(deck: &Deck, grammar: &Grammar) -> (Vec<Diagnostic>, bool) {
    let (model, problems) = model::read(deck, grammar);
    let found = inpact_validation::check(deck, grammar, &model, &problems);
    (found, deck.lacks_rows())
}

/// The number of tables of which the ends were kept.
fn thinned(deck: &Deck) -> usize {
    deck.blocks().iter().filter(|block| block.rows_kept == RowsKept::Ends).count()
}

/// Compares both ways of reading; gives the number of tables of which the ends were kept and whether that was enough.
fn compare(text: &[u8], grammar: &Grammar, piece: usize) -> (usize, bool) {
    let whole = scanned(text, grammar, Keep::Interpreted, piece);
    let ends = scanned(text, grammar, Keep::Ends, piece);
    let shown = || String::from_utf8_lossy(text).into_owned();
    let places = |deck: &Deck| deck.blocks().iter().map(inpact_parser::deck::Block::span).collect::<Vec<_>>();
    assert_eq!(places(&whole), places(&ends), "{}", shown());
    let (expected, misses) = findings(&whole, grammar);
    assert!(!misses);
    let (found, lacks) = findings(&ends, grammar);
    if !lacks {
        assert_eq!(found, expected, "{}", shown());
        for label in found.iter().flat_map(Diagnostic::labels) {
            // What an excerpt shows of the lines around it.
            let lines = |deck: &Deck| {
                let (start, text) = deck.surroundings(label.span);
                let offset = |place: u64| usize::try_from(place - start).expect("after the start");
                let (from, to) = (offset(label.span.start()), offset(label.span.end()));
                let before: Vec<u8> =
                    text[..from].rsplitn(3, |byte| *byte == b'\n').take(2).flatten().copied().collect();
                let after: Vec<u8> = text[to..].splitn(3, |byte| *byte == b'\n').take(2).flatten().copied().collect();
                (before, after)
            };
            assert_eq!(lines(&ends), lines(&whole), "{label:?}\n{}", shown());
        }
        assert!(!ends.lacks_rows(), "{}", shown());
    }
    (thinned(&ends), !lacks)
}

/// Rows of a table, group by group, with values that fall or rise.
fn rows(groups: usize, points: usize, value: impl Fn(usize, usize) -> f64, is_wide: bool) -> String {
    let row = |(group, point): (usize, usize)| {
        let (value, temperature) = (value(group, point), 300 + 50 * group);
        if is_wide || groups > 1 {
            format!(" {value:?}, {}e-3,  {temperature}.\n", 2 * point)
        } else {
            format!("{value:?},{}e-3\n", 2 * point)
        }
    };
    (0..groups).flat_map(|group| (0..points).map(move |point| (group, point))).map(row).collect()
}

fn table() -> impl Strategy<Value = String> {
    let kinds = prop::sample::select(vec![
        "GAP ELECTRICAL CONDUCTANCE",
        "GAP ELECTRICAL CONDUCTANCE, PRESSURE",
        "GAP CONDUCTANCE",
        "GAP CONDUCTANCE, PRESSURE",
        "CONTACT PERMEABILITY",
        "GAP ELECTRICAL CONDUCTANCE, DEPENDENCIES=2",
        "GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=<n>",
        "GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=7",
        "GAP ELECTRICAL CONDUCTANCE, USER",
        "GAP ELECTRICAL CONDUCTANCE, PRESURE",
    ]);
    let shape = (1..4_usize, 2..30_usize, prop::sample::select(vec![0.0, 0.5, 1000.0]), any::<bool>(), 0..10_u8);
    (kinds, shape).prop_map(|(kind, (groups, points, least, is_wide, odd))| {
        // One table in ten goes the wrong way.
        let falls = kind.contains("PRES") == (odd == 0);
        let value = |group: usize, point: usize| {
            let steps = if falls { points - 1 - point } else { point };
            least + (1 + group) as f64 * steps as f64
        };
        format!("*{kind}\n{}", rows(groups, points, value, is_wide))
    })
}

/// A change of one line.
#[derive(Debug, Clone)]
enum Change {
    Replace(&'static str, &'static str),
    Insert(&'static str),
    Delete,
    Repeat,
}

fn change() -> impl Strategy<Value = Change> {
    let replaced = [
        ("1", "2"),
        (".", ","),
        ("e", "E+"),
        ("e", "d"),
        ("-3", "-30"),
        ("0", "-0"),
        (",", ", "),
        (",", ",,"),
        (" ", "\t"),
    ];
    let inserted = [
        "",
        "** a comment",
        "**inpact: ignore P008",
        "** inpact: ignore all",
        " ** indented",
        "nan",
        "1., 2., 3., 4., 5.",
        "1.",
        "\"",
        "*STEP",
        "*INCLUDE, INPUT=x.inp",
        "GAP CONDUCTANCE, PRESSURE",
        "é",
        "** é",
        "*SURFACE INTERACTION, NAME=A",
        "*FOO",
        "1.,\r",
    ];
    prop_oneof![
        4 => prop::sample::select(replaced.to_vec()).prop_map(|(from, to)| Change::Replace(from, to)),
        3 => prop::sample::select(inserted.to_vec()).prop_map(Change::Insert),
        1 => Just(Change::Delete),
        1 => Just(Change::Repeat),
    ]
}

fn deck() -> impl Strategy<Value = Vec<u8>> {
    let interactions = prop::collection::vec(prop::collection::vec(table(), 0..3), 1..4);
    let changes = prop::collection::vec((any::<prop::sample::Index>(), change()), 0..3);
    (interactions, changes, any::<bool>(), any::<bool>()).prop_map(|(interactions, changes, is_dos, has_pairs)| {
        let mut text = "*HEADING\nA deck\n*PARAMETER\nn = 1\n".to_owned();
        for (index, tables) in interactions.iter().enumerate() {
            text += &format!("** \n*SURFACE INTERACTION, NAME=A{index}\n1.,\n{}", tables.concat());
        }
        if has_pairs {
            text += "**\n*CONTACT PAIR, INTERACTION=A0\nS, M\n";
        }
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        for (place, change) in changes {
            let at = place.index(lines.len());
            match change {
                Change::Replace(from, to) => lines[at] = lines[at].replacen(from, to, 1),
                Change::Insert(line) => lines.insert(at, line.to_owned()),
                Change::Repeat => lines.insert(at, lines[at].clone()),
                Change::Delete => drop(lines.remove(at)),
            }
        }
        let end = if is_dos { "\r\n" } else { "\n" };
        lines.iter().flat_map(|line| [line.as_bytes(), end.as_bytes()]).flatten().copied().collect()
    })
}

#[test]
fn the_findings_are_those_of_the_whole_deck() {
    let (tables, lacking, enough) = (Cell::new(0), Cell::new(0), Cell::new(0));
    let count = |counter: &Cell<usize>, by: usize| counter.set(counter.get() + by);
    let judged = runner(600).run(&(deck(), 1..3000_usize), |(text, piece)| {
        let (thinned, is_enough) = compare(&text, Grammar::builtin(), piece);
        count(&tables, thinned);
        count(if is_enough { &enough } else { &lacking }, usize::from(thinned > 0));
        Ok(())
    });
    judged.expect("the same findings");
    // Both happen: that the ends were enough, and that they were not.
    assert!(tables.get() > 300 && lacking.get() > 20 && enough.get() > 100, "{tables:?} {lacking:?} {enough:?}");
}

#[test]
fn calculix_keeps_every_row() {
    let grammar = Grammar::new(Dialect::Calculix, Release::NEWEST);
    let judged = runner(60).run(&deck(), |text| {
        prop_assert_eq!(compare(&text, &grammar, 1000).0, 0);
        Ok(())
    });
    judged.expect("all rows");
}

fn runner(cases: u32) -> TestRunner {
    TestRunner::new(Config::with_cases(cases))
}

/// The tables of an interaction in order, against clearance and against pressure.
fn in_order(rows_falling: &str, rows_rising: &str) -> String {
    format!(
        "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n{rows_falling}*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n{rows_rising}"
    )
}

#[test]
fn tables_in_order_are_judged_by_their_ends() {
    let falling = rows(3, 20, |_, point| (19 - point) as f64, true);
    let rising = rows(3, 20, |_, point| (19 + point) as f64, true);
    assert_eq!(compare(in_order(&falling, &rising).as_bytes(), Grammar::builtin(), 100), (2, true));
    // P007 and P008 are about the ends of a table that are there.
    let falling = rows(1, 40, |_, point| (50 - point) as f64, false);
    let rising = rows(1, 40, |_, point| (1000 + point) as f64, false);
    let text = in_order(&falling, &rising);
    assert_eq!(compare(text.as_bytes(), Grammar::builtin(), 100), (2, true));
    let ends = scanned(text.as_bytes(), Grammar::builtin(), Keep::Ends, 4096);
    let codes: Vec<_> = findings(&ends, Grammar::builtin()).0.iter().map(|found| found.code).collect();
    assert!(codes.contains(&"P007") && codes.contains(&"P008"), "{codes:?}");
}

#[test]
fn what_lies_between_the_ends_is_missed() {
    // The second group does not end at zero (P008).
    let falling = rows(3, 20, |group, point| (19 - point + usize::from(group == 1)) as f64, true);
    let rising = rows(3, 20, |_, point| (19 + point) as f64, true);
    assert_eq!(compare(in_order(&falling, &rising).as_bytes(), Grammar::builtin(), 100), (2, false));
    // T011 counts the rows beside USER.
    let user = format!("*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, USER\n{falling}");
    assert_eq!(compare(user.as_bytes(), Grammar::builtin(), 100), (1, false));
}
