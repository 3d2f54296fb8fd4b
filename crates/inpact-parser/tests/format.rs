//! Formatting: one style for the blocks of contact interfaces, and nothing else changed.

use inpact_parser::deck::{Block, Deck, items, lines, scan};
use inpact_parser::format;
use inpact_parser::grammar::{Dialect, Grammar, Release};
use inpact_parser::model::{self, Model};
use inpact_parser::span::SourceId;
use proptest::prelude::*;
use std::path::{Path, PathBuf};

fn formatted(deck: &str) -> String {
    let bytes = formatted_bytes(deck.as_bytes(), Grammar::builtin());
    String::from_utf8(bytes).unwrap()
}

fn formatted_bytes(deck: &[u8], grammar: &Grammar) -> Vec<u8> {
    format(&scan("x", deck, grammar), SourceId::ROOT, grammar)
}

#[track_caller]
fn check(deck: &str, expected: &str) {
    assert_eq!(formatted(deck), expected);
    check_promises(deck.as_bytes(), Grammar::builtin()).unwrap();
}

#[track_caller]
fn check_untouched(deck: &str) {
    check(deck, deck);
}

/// The promises of formatting for any bytes, checked on the scanned decks before and after; the error names the broken one.
fn check_promises(bytes: &[u8], grammar: &Grammar) -> Result<(), String> {
    let before = scan("x", bytes, grammar);
    let text = format(&before, SourceId::ROOT, grammar);
    let after = scan("x", &text, grammar);
    if format(&after, SourceId::ROOT, grammar) != text {
        return Err("formatting twice changes something".to_owned());
    }
    let (model_before, problems_before) = model::read(&before, grammar);
    let (model_after, problems_after) = model::read(&after, grammar);
    if said(&model_before) != said(&model_after) {
        return Err("the model changes".to_owned());
    }
    let kinds = |problems: &[inpact_parser::Problem]| -> Vec<_> {
        problems.iter().map(|problem| std::mem::discriminant(&problem.kind)).collect()
    };
    if kinds(&problems_before) != kinds(&problems_after) || model_before.set_aside.len() != model_after.set_aside.len()
    {
        return Err("the problems change".to_owned());
    }
    if before.blocks().len() != after.blocks().len() {
        return Err("the blocks change".to_owned());
    }
    before
        .blocks()
        .iter()
        .zip(after.blocks())
        .try_for_each(|blocks| same_but_for_style(&before, &after, blocks, grammar))
}

/// A model as text: a cell that is no number is NaN, which equals nothing.
fn said(model: &Model) -> String {
    let mut model = model.without_places();
    // Their order in print is left to chance, so only the definitions count.
    let parameters = std::mem::take(&mut model.parameters);
    format!("{:?}{model:?}", parameters.definitions())
}

/// Blocks of no interface are the same byte for byte; of the others comments, blank lines, line ends and items are.
fn same_but_for_style(
    before: &Deck,
    after: &Deck,
    (old, new): (&Block, &Block),
    grammar: &Grammar,
) -> Result<(), String> {
    let (old_text, new_text) = (before.text(old.span()), after.text(new.span()));
    let is_of_interface = old.keyword_id().is_some_and(|id| {
        let uses = ["SURFACE INTERACTION", "CONTACT PAIR", "CONTACT PROPERTY ASSIGNMENT"];
        grammar.is_interaction_option(id) || uses.contains(&grammar.keyword(id).name.as_str())
    });
    if !is_of_interface {
        let is_same = old_text == new_text;
        return is_same.then_some(()).ok_or_else(|| format!("{} changes", before.shown(old.span())));
    }
    let (old_rows, new_rows) = (before.text(old.rows()), after.text(new.rows()));
    let (old_lines, new_lines) = (physical_lines(old_text), physical_lines(new_text));
    if old_lines.len() != new_lines.len() {
        return Err(format!("the lines of {} change", before.shown(old.span())));
    }
    for (old_line, new_line) in old_lines.into_iter().zip(new_lines) {
        let content = |line: &'_ [u8]| lines::without_line_end(line).len();
        if old_line[content(old_line)..] != new_line[content(new_line)..] {
            return Err("a line end changes".to_owned());
        }
        let is_kept = matches!(
            lines::line_kind(old_line),
            lines::LineKind::Comment | lines::LineKind::IndentedComment | lines::LineKind::Blank
        );
        if is_kept && old_line != new_line {
            return Err("a comment or a blank line changes".to_owned());
        }
    }
    let rows_of = |text| -> Vec<Vec<Vec<u8>>> { physical_lines(text).into_iter().map(used_items).collect() };
    let is_same = rows_of(old_rows) == rows_of(new_rows);
    is_same.then_some(()).ok_or_else(|| format!("the items of {} change", before.shown(old.span())))
}

fn physical_lines(text: &[u8]) -> Vec<&[u8]> {
    lines::lines(text).map(|range| &text[range]).collect()
}

/// The items of a line without the empty ones at its end.
fn used_items(line: &[u8]) -> Vec<Vec<u8>> {
    let mut found: Vec<Vec<u8>> = items(line).map(|range| line[range].to_vec()).collect();
    while found.pop_if(|item| item.is_empty()).is_some() {}
    found
}

#[test]
fn a_block_before_and_after() {
    let deck = "\
*heading
 left  as it is ,
*surface interaction,name = Weld 1
 1.,
** conductance over clearance
*gapelectricalconductance , dep=1
30000000.,0.,20.,1
\t1.5E7, 1.e-6 ,20.,1.
  ** and hot
0.,.00001,,
-2.5e+3,<gap>,300. , 1.
*CONTACT PERM, cutoff gap fill= 0.2 ,
** why
  CUTOFF FLOW ACROSS=0.1
1.
*friction, foo = 3
0.3,
*contact pair,inter=Weld 1 , type=surface to surface
UPPER-SHEET,LOWER
 A , B
*node
1,0.,  0.
";
    insta::assert_snapshot!(formatted(deck), @r#"
*heading
 left  as it is ,
*SURFACE INTERACTION, NAME=Weld 1
1.,
** conductance over clearance
*GAP ELECTRICAL CONDUCTANCE, DEPENDENCIES=1
30000000.,         0.,       20., 1
       1.5E7,      1.e-6,    20., 1.
  ** and hot
       0.,          .00001
      -2.5e+3, <gap>,       300., 1.
*CONTACT PERMEABILITY, CUTOFF GAP FILL=0.2,
** why
    CUTOFF FLOW ACROSS=0.1
1.
*FRICTION, foo = 3
0.3,
*CONTACT PAIR, INTERACTION=Weld 1, TYPE=surface to surface
UPPER-SHEET, LOWER
A,           B
*node
1,0.,  0.
"#);
    check_promises(deck.as_bytes(), Grammar::builtin()).unwrap();
}

#[test]
fn keyword_lines() {
    check("  *Surface  Interaction ,NAME= A b \r\n", "*SURFACE INTERACTION, NAME=A b\r\n");
    check(
        "*SURFACEINTERACTION,name=\"x, y = Z\",pad=1.\r",
        "*SURFACE INTERACTION, NAME=\"x, y = Z\", PAD THICKNESS=1.\r",
    );
    // S-19: a comma without a continuation stays, since Abaqus reads the next line as one.
    check("*gap heat generation ,\n1.,\n", "*GAP HEAT GENERATION,\n1.,\n");
    // Q-35: comments between a keyword line and its continuation.
    check(
        "*contactpair,inter=A,\n**x\n ** y\n\tTYPE=NODE TO SURFACE,\nsmall sliding",
        "*CONTACT PAIR, INTERACTION=A,\n**x\n ** y\n    TYPE=NODE TO SURFACE,\n    SMALL SLIDING",
    );
    check("*surface interaction, name= , unknown = 1\n", "*SURFACE INTERACTION, NAME=, unknown = 1\n");
}

#[test]
fn keyword_lines_that_stay() {
    check_untouched("*surface interaction,name=\"x\n");
    check_untouched("*surface interaction,,name=x\n");
    check_untouched("*surface interaction,name=x,,\n");
    check_untouched("*contact pair,name=(a,\nb=c)\n");
    check_untouched("*gap, name=x\n");
    check_untouched("*surfaceinteraktion,name=x\n");
    // S-06: written out in full it would not fit on the line.
    check_untouched(&format!("*SURFACE INTERACTION, name={},{}pad=1.\n", "x".repeat(220), " ".repeat(4)));
}

#[test]
fn numbers_are_aligned() {
    let head = "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, DEPENDENCIES=5\n";
    let rows = "1,2.5,3e4,,5\n8,9\n1000.25,,.5,<t>,1d5,,,,\n,\n\n1.\n";
    let aligned = "   1,    2.5, 3e4,    , 5\n8, 9\n1000.25,  ,    .5, <t>, 1d5\n ,\n\n   1.\n";
    // The rows go over two lines each (K-52), so first lines stand below first lines.
    assert_eq!(formatted(&format!("{head}{rows}")), format!("{head}{aligned}"));
    check_promises(format!("{head}{rows}").as_bytes(), Grammar::builtin()).unwrap();
}

#[test]
fn rows_that_stay() {
    let head = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n";
    // A malformed number: its row stays, and the others do not mind it.
    check(&format!("{head}1.,0.\n10. ,1.5-3\n100.,2.\n"), &format!("{head}  1., 0.\n10. ,1.5-3\n100., 2.\n"));
    // S-06: the aligned rows would not fit on a line.
    let wide = format!("0.{}1,0.{}1", "0".repeat(120), "0".repeat(120));
    check_untouched(&format!("{head}{wide}\n{}.,1.\n", "1".repeat(20)));
    // Q-25: what is ignored is not interpreted.
    check(
        "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE,user\n1.,0.\n 10. , 1.",
        "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, USER\n1.,0.\n 10. , 1.",
    );
    check_untouched("*CONTACT PAIR, INTERACTION=A\n\"x ,  y\n");
}

#[test]
fn sub_options_of_other_keywords_stay() {
    check_untouched("*MATERIAL, NAME=A\n*damage initiation,criterion=maxs\n1,2,3\n");
    check_untouched("*CHANGE FRICTION, INTERACTION=A\n*friction\n.1,\n");
    check_untouched("*GAP, ELSET=A\n*gap conductance\n1,2\n");
    // A fragment begins with a sub-option.
    check("*gap conductance\n1,2\n", "*GAP CONDUCTANCE\n1, 2\n");
}

#[test]
fn bytes_that_are_no_text_stay() {
    let grammar = Grammar::builtin();
    let deck = b"\xEF\xBB\xBF*contact pair,inter=\xE9 \n\xFF , \xC3\xA4\nb,c";
    let expected = b"\xEF\xBB\xBF*CONTACT PAIR, INTERACTION=\xE9\n\xFF, \xC3\xA4\nb, c";
    assert_eq!(formatted_bytes(deck, grammar), expected);
    check_promises(deck, grammar).unwrap();
}

#[test]
fn calculix_keeps_its_abbreviations() {
    let grammar = Grammar::new(Dialect::Calculix, Release::NEWEST);
    let deck = b"*contactpair,interaction=A,ty=x,\nB,C\n";
    let text = formatted_bytes(deck, &grammar);
    assert_eq!(String::from_utf8_lossy(&text), "*CONTACT PAIR, INTERACTION=A, ty=x,\nB, C\n");
    check_promises(deck, &grammar).unwrap();
}

#[test]
fn sample_decks_keep_their_promises() {
    let mut decks = Vec::new();
    collect(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../decks"), &mut decks);
    assert!(decks.len() > 20);
    for path in decks {
        let bytes = std::fs::read(&path).unwrap();
        for dialect in [Dialect::Abaqus, Dialect::Calculix] {
            let grammar = Grammar::new(dialect, Release::NEWEST);
            check_promises(&bytes, &grammar).unwrap_or_else(|broken| panic!("{}: {broken}", path.display()));
        }
    }
}

fn collect(folder: &Path, decks: &mut Vec<PathBuf>) {
    for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if path.is_dir() {
            collect(&path, decks);
        } else if path.extension().is_some_and(|extension| extension == "inp") {
            decks.push(path);
        }
    }
}

/// Keyword lines of interfaces and of others, in any spelling, with parameters known and unknown.
fn keyword_line() -> impl Strategy<Value = String> {
    let keyword = prop::sample::select(vec![
        "*SURFACE INTERACTION, NAME=A",
        "*surface interaction ,name=\"b, c\"",
        "*SurfaceInteraction,name=C,user,prop=9",
        "*GAP ELECTRICAL CONDUCTANCE",
        "*gapelec",
        " *Gap  Conductance",
        "*CONTACT PERMEABILITY",
        "*GAP HEAT GENERATION",
        "*GAP RADIATION",
        "*FRICTION",
        "*SURFACE BEHAVIOR",
        "*CONTACT PAIR, interaction=A",
        "*contact property assignment",
        "*CHANGE FRICTION",
        "*DAMAGE INITIATION",
        "*MATERIAL",
        "*NODE",
        "*STEP",
        "*STATIC",
        "*PARAMETER",
        "*INCLUDE, INPUT=x",
        "*NONSENSE",
        "*",
    ]);
    let parameter = prop::sample::select(vec![
        "dep=1",
        "DEPENDENCIES = 6",
        "dependencies=<n>",
        "pres",
        "Cutoff Gap Fill=\t1.",
        "user",
        "unknown = x  y",
        "p",
        "type=",
        "=5",
        "",
        "\"a",
        "(a, b)",
        "NAME=(x",
    ]);
    let comma = prop::sample::select(vec![",", ", ", " ,", ",\n", ",\r\n** c\n", " , \n  ** d , =\n "]);
    let end = prop::sample::select(vec!["", "", "", ",", " , ", "  ", ",,"]);
    (keyword, prop::collection::vec((comma, parameter), 0..4), end).prop_map(|(keyword, parameters, end)| {
        let parameters: String = parameters.into_iter().flat_map(|(comma, parameter)| [comma, parameter]).collect();
        format!("{keyword}{parameters}{end}")
    })
}

/// Rows of numbers, names, symbols and mistakes.
fn row() -> impl Strategy<Value = String> {
    let item = prop_oneof![
        4 => (-1e9..1e9_f64).prop_map(|number| number.to_string()),
        2 => prop::sample::select(vec!["1.", "0", "-.5", "1e-20", "2.5D+3", "12345678.", "7"]).prop_map(str::to_owned),
        2 => prop::sample::select(vec!["", "", " ", "\t"]).prop_map(str::to_owned),
        1 => prop::sample::select(vec!["<n>", "<", "1.5-3", "nan", "SURF-1", "A B", "\"x, Y\"", "\"", "*", "a=b", "ä", "1\x0B"]).prop_map(str::to_owned),
        1 => "[0-9]{30,90}".prop_map(|digits| digits),
    ];
    let blanks = || prop::sample::select(vec!["", "", " ", "\t", "   "]);
    let padded = (blanks(), item, blanks()).prop_map(|(before, item, after)| format!("{before}{item}{after}"));
    prop::collection::vec(padded, 1..10).prop_map(|items| items.join(","))
}

fn deck() -> impl Strategy<Value = Vec<u8>> {
    let line = prop_oneof![
        3 => keyword_line(),
        8 => row(),
        1 => prop::sample::select(vec!["", "  ", "** comment", " ** comment", "n = 6", "1.,", ","]).prop_map(str::to_owned),
    ];
    let end = prop::sample::select(vec!["\n", "\n", "\n", "\r\n", "\r"]);
    let first = prop::sample::select(vec!["", "*SURFACE INTERACTION, NAME=A\n", "\u{FEFF}"]);
    (first, prop::collection::vec((line, end), 0..30), any::<bool>()).prop_map(|(first, lines, is_ended)| {
        let mut text = first.to_owned();
        text.extend(lines.into_iter().flat_map(|(line, end)| [line, end.to_owned()]));
        let ended = text.trim_end_matches(['\n', '\r']).len();
        text.truncate(if is_ended { text.len() } else { ended });
        text.into_bytes()
    })
}

proptest! {
    #[test]
    fn any_deck_keeps_its_promises(bytes in deck()) {
        for dialect in [Dialect::Abaqus, Dialect::Calculix] {
            let grammar = Grammar::new(dialect, Release::NEWEST);
            prop_assert_eq!(check_promises(&bytes, &grammar), Ok(()));
        }
    }

    #[test]
    fn any_bytes_keep_their_promises(bytes in prop::collection::vec(any::<u8>(), 0..500)) {
        let mut deck = b"*contact pair,inter=A\n".to_vec();
        deck.extend(bytes);
        prop_assert_eq!(check_promises(&deck, Grammar::builtin()), Ok(()));
    }

    #[test]
    fn a_formatted_row_has_its_comma_right_after_the_item(rows in prop::collection::vec(prop::collection::vec(0..1_000_000_u32, 3), 1..20)) {
        let text: String = rows.iter().map(|row| format!("{}.,{},{}.5\n", row[0], row[1], row[2])).collect();
        let deck = format!("*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n{text}");
        let result = formatted(&deck);
        let lines: Vec<&str> = result.lines().skip(2).collect();
        // Points stand below points, and where there is none the comma says where one would be.
        let places = |line: &str| (line.find('.'), line.rfind('.'), line.match_indices(',').nth(1).map(|(at, _)| at));
        prop_assert!(lines.iter().all(|line| places(line) == places(lines[0])), "{result}");
        prop_assert!(!result.contains(" ,"));
    }
}
