//! Cases of the rules on lines and keywords beyond their pages: line ends, encodings, dialects, and one finding a fault.

use inpact_parser::deck::{Deck, Keep, ScanOptions, Scanner};
use inpact_parser::grammar::{Dialect, Grammar, Release};
use inpact_parser::model;
use inpact_validation::{Diagnostic, Severity, apply};

fn scanned(bytes: &[u8], grammar: &Grammar, keep: Keep) -> Deck {
    let mut scanner = Scanner::new("test.inp", ScanOptions { grammar, keep });
    scanner.push(bytes);
    scanner.finish()
}

fn findings_in(bytes: &[u8], grammar: &Grammar, keep: Keep) -> Vec<Diagnostic> {
    let deck = scanned(bytes, grammar, keep);
    let (model, problems) = model::read(&deck, grammar);
    inpact_validation::check(&deck, grammar, &model, &problems)
}

fn findings(bytes: &[u8]) -> Vec<Diagnostic> {
    findings_in(bytes, Grammar::builtin(), Keep::Everything)
}

/// The families of the rules on lines and keywords; the others have tests of their own.
fn codes(bytes: &[u8]) -> Vec<&'static str> {
    let found = findings(bytes);
    found.iter().map(|found| found.code).filter(|code| code.starts_with(['S', 'K'])).collect()
}

#[track_caller]
fn check(bytes: impl AsRef<[u8]>, expected: &[&str]) {
    let bytes = bytes.as_ref();
    assert_eq!(codes(bytes), expected, "{}", String::from_utf8_lossy(bytes));
}

#[track_caller]
fn check_fixed(text: &str, code: &str, expected: &str) {
    let of_code = findings(text.as_bytes()).into_iter().filter(|found| found.code == code);
    let edits: Vec<_> = of_code.filter_map(|found| found.fix).flat_map(|fix| fix.edits).collect();
    let fixed = apply(text.as_bytes(), &edits);
    assert_eq!(String::from_utf8_lossy(&fixed), expected);
}

/// The only finding.
#[track_caller]
fn only(bytes: &[u8], code: &str) -> Diagnostic {
    let mut found = findings(bytes);
    found.retain(|found| found.code == code);
    assert_eq!(found.len(), 1, "{found:#?}");
    found.remove(0)
}

#[test]
fn s001_points_after_character_256() {
    let found = only(format!("*SURFACE INTERACTION, NAME=A{}, UNSYMM, USER\n", " ".repeat(250)).as_bytes(), "S001");
    assert_eq!((found.primary.position.line, found.primary.position.column), (1, 257));
    // Trailing blanks do not count, and a character of two bytes is not cut.
    check(format!("*NODE\n1, 2.{}\n", " ".repeat(300)), &[]);
    let straddling = format!("*NODE, NSET={}éé{}\n", "A".repeat(243), "A".repeat(20));
    assert_eq!(only(straddling.as_bytes(), "S001").primary.position.column, 256);
}

#[test]
fn s002_names_what_it_found() {
    assert_eq!(only(b"*NODE, NSET=A\xE9\n", "S002").message, "byte 0xE9 is not an ASCII character");
    assert_eq!(only("*NODE, NSET=µ\n".as_bytes(), "S002").message, "`µ` (U+00B5) is not an ASCII character");
    assert_eq!(only("*NODE\n1,\u{A0}2.\n".as_bytes(), "S002").message, "U+00A0 is not an ASCII character");
    check("** é\n*HEADING\né\n*NODE, NSET=\"é\"\n", &[]);
}

#[test]
fn s002_leaves_a_malformed_cell_to_its_own_rule() {
    check("*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n1.,\u{A0}0.\n2., 1.\n", &["S006"]);
    check("*NODÉ\n1\n", &["K001"]);
}

#[test]
fn s003_takes_all_commas_and_no_line_end() {
    check_fixed("*STEP, \r\n*STATIC,, ,\r\n1.,\r\n", "S003", "*STEP \r\n*STATIC\r\n1.,\r\n");
    check_fixed("*HEADING,", "S003", "*HEADING");
}

#[test]
fn s004_and_s011_tell_fragments_from_other_files() {
    check("1, 0., 0.\n2, 1., 0.\nSET-1, \"a b\", 1.5-3,\n", &["S004"]);
    check(">**\n*NODE\n1, 0.\n", &["S004"]);
    check("1.0 2.0 3.0\n4.0 5.0 6.0\n", &["S011"]);
    check("This is a letter.\nIt has no rows.\n", &["S011"]);
    check(b"\x89PNG\r\n\x1A\n\0\0\0\rIHDR\0", &["S011"]);
    check(b"\xFF\xFE*\0N\0O\0D\0E\0\n\0", &["S011"]);
    check("", &[]);
    check("** only a comment\n\n", &[]);
    check("\u{FEFF}*NODE\n1, 0.\n", &[]);
    let help = |bytes: &[u8]| only(bytes, "S011").help.unwrap_or_default();
    assert!(help(b"1.0 2.0\n").contains("commas"));
    assert!(help(b"\xFF\xFE*\0\n\0").contains("UTF-8"));
    assert!(help(b"version https://git-lfs.github.com/spec/v1\nsize 1\n").contains("git lfs pull"));
}

#[test]
fn s004_looks_at_the_beginning_only_when_rows_are_not_kept() {
    let rows = "1, 2., 3.\n".repeat(20_000) + "*NODE\n";
    let found = findings_in(rows.as_bytes(), Grammar::builtin(), Keep::Interpreted);
    assert_eq!(found.iter().map(|found| found.code).collect::<Vec<_>>(), ["S004"]);
}

#[test]
fn s005_hides_what_follows_from_the_quote() {
    check("*SURFACE INTERACTION, NAME=\"A, UNSYMM\n", &["S005"]);
    check("*SURFACE INTERACTION, NAME=A, \"UNSYMM\n", &["S005"]);
    check("*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n1., \"0.\n2., 1.\n", &["S005"]);
    check("*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n** \"\n1., 0.\n2., 1.\n", &[]);
    check("*HEADING\n\"open\n*NODE\n1, \"\n", &[]);
}

#[test]
fn s006_sees_what_a_parameter_becomes() {
    let deck = |value: &str| {
        format!(
            "*PARAMETER\nx = {value}\n*SURFACE INTERACTION, NAME=A, PAD THICKNESS=<x>\n*GAP CONDUCTANCE, PRESSURE\n1., 0.\n<x>, 1.\n"
        )
    };
    check(deck("2.5"), &[]);
    check(deck("'abc'"), &["S006", "S006"]);
    let found = findings(deck("'1.5-3'").as_bytes());
    let found: Vec<_> = found.iter().filter(|found| found.code == "S006").collect();
    assert_eq!(
        found[0].message,
        "`<x>`, which is `1.5-3`, as the value of `PAD THICKNESS` has an exponent without its letter"
    );
    assert!(found.iter().all(|found| found.fix.is_none()), "the number is not where the finding is");
}

#[test]
fn s007_s008_and_k010_share_the_integers() {
    let deck = |value: &str| {
        format!("*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE, DEPENDENCIES={value}\n1., 0.\n2., 1.\n")
    };
    let of = |value: &str| {
        let mut found = codes(deck(value).as_bytes());
        found.retain(|code| ["S007", "S008", "K010"].contains(code));
        found
    };
    assert_eq!(of("1"), [""; 0]);
    assert_eq!(of("0000000001"), ["S008"]);
    assert_eq!(of("2.0"), ["S007"]);
    assert_eq!(of("two"), ["S007"]);
    assert_eq!(of("99999999999999999999"), ["S007"]);
    assert_eq!(of("-1"), ["K010"]);
    assert_eq!(of("1000000000"), ["K010"]);
    assert_eq!(of("1001"), ["K010"]);
}

#[test]
fn s008_is_reported_once_for_a_block() {
    let rows = "1.00000000000000000000, 0.00000000000000000000\n".repeat(2);
    let deck = format!("*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n{rows}");
    assert!(only(deck.as_bytes(), "S008").note.is_some_and(|note| note.starts_with("4 numbers")));
}

#[test]
fn s009_mends_what_is_kept() {
    let deck = "*NODE\n\t** a\n1, 0.\n  ** b\n*STEP\n";
    check_fixed(deck, "S009", "*NODE\n** a\n1, 0.\n** b\n*STEP\n");
    let found = findings_in(deck.as_bytes(), Grammar::builtin(), Keep::Interpreted);
    let edits = found[0].fix.as_ref().map_or(0, |fix| fix.edits.len());
    assert_eq!((found.len(), found[0].code, edits), (1, "S009", 1), "mesh rows are not kept");
}

#[test]
fn s010_takes_the_line_end_along() {
    let deck = "*SURFACE INTERACTION, NAME=A\r\n*GAP CONDUCTANCE, PRESSURE\r\n1., 0.\r\n \t\r\n2., 1.\r\n\r\n";
    let fixed = "*SURFACE INTERACTION, NAME=A\r\n*GAP CONDUCTANCE, PRESSURE\r\n1., 0.\r\n2., 1.\r\n";
    check_fixed(deck, "S010", fixed);
    check("*SURFACE INTERACTION, NAME=A\n\n*HEADING\n\n\n*NODE\n\n", &[]);
}

#[test]
fn k001_helps_with_what_is_meant() {
    let help = |line: &str| only(line.as_bytes(), "K001").help.unwrap_or_default();
    assert!(help("*\n").contains("`**`"));
    assert!(help("*5e8,0\n").contains("`**`"));
    assert_eq!(help("*GAP CONDUCTANS\n"), "did you mean `*GAP CONDUCTANCE`?");
    assert_eq!(help("*STEP NLGEOM=YES\n"), "put a comma after the keyword: `*STEP, NLGEOM=YES`");
    assert!(only(b"*FLUID SECTION\n", "K001").message.contains("CalculiX"));
    let hostile = only(b"*\x1B[31mred\n", "K001");
    assert!(!hostile.message.contains('\u{1B}'), "{}", hostile.message);
}

#[test]
fn k001_knows_dialects_and_releases() {
    let calculix = Grammar::new(Dialect::Calculix, Release::NEWEST);
    let found = findings_in(b"*FLUID SECTION\n*GAP ELECTRICAL CONDUCTANCE\n*FOO\n", &calculix, Keep::Everything);
    let unknown: Vec<_> = found.iter().filter(|found| found.code == "K001").collect();
    assert_eq!(unknown.len(), 2, "{found:#?}");
    assert!(unknown.iter().all(|found| found.severity == Severity::Warning));
    assert!(unknown[0].message.contains("Abaqus"), "{}", unknown[0].message);

    let old = Grammar::new(Dialect::Abaqus, Release::R6_11);
    let found = findings_in(b"*GAP DIFFUSIVITY\n", &old, Keep::Everything);
    assert_eq!(found[0].code, "K015", "{found:#?}");
}

#[test]
fn k003_mends_only_what_is_certain() {
    let fix = |line: &str| only(line.as_bytes(), "K003").fix.map(|fix| fix.title);
    assert_eq!(fix("*GAPH\n").as_deref(), Some("write `*GAP HEAT GENERATION`"));
    // *CONSTRAINT is a keyword of CalculiX, and *ELEMENTS more likely *ELEMENT.
    assert_eq!(fix("*CONSTRAINT\n"), None);
    assert_eq!(fix("*ELEMENTS\n"), None);
}

#[test]
fn a_misspelt_parameter_is_not_missing() {
    check("*SURFACE INTERACTION, NAMME=A\n", &["K004"]);
    check("*SURFACE INTERACTION, NAME\n", &["K007"]);
    check("*SURFACE INTERACTION, NAME=\n", &["K007"]);
    check("*SURFACE INTERACTION, NAME=A, USR, UNSYMM\n", &["K004"]);
    check("*SURFACE INTERACTION, NAME=A, U, UNSYMM\n", &["K005"]);
    check("*SURFACE INTERACTION, =A\n", &["K004"]);
}

#[test]
fn k004_mends_only_into_what_is_legal() {
    let fix = |parameters: &str| {
        let deck = format!("*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, {parameters}\n1., 0.\n2., 1.\n");
        only(deck.as_bytes(), "K004").fix.map(|fix| fix.title)
    };
    assert_eq!(fix("PRESURE").as_deref(), Some("write `PRESSURE`"));
    assert_eq!(fix("PRESURE=1"), None, "a flag has no value");
    assert_eq!(fix("PRESSURE, PRESURE"), None, "it would be a duplicate");
}

#[test]
fn k012_gives_one_finding_for_a_block() {
    let block = "*GAP CONDUCTANCE, PRESSURE\n1., 0.\n2., 1.\n*GAP HEAT GENERATION\n1., 0.5\n";
    check(format!("*HEADING\n{block}"), &["K012"]);
    check(format!("*HEADING\n{block}*NODE\n{block}"), &["K012", "K012"]);
    // The misspelt keyword is the fault.
    check(format!("*SURFACE INTERACTON, NAME=A\n{block}"), &["K001"]);
    // Another parent makes them legal.
    check(format!("*GAP, ELSET=E\n0.,\n{block}"), &[]);
}

#[test]
fn k013_gives_one_finding_for_a_block() {
    let block =
        "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n1., 0.\n2., 1.\n*CONTACT PERMEABILITY\n1., 0.\n";
    check(format!("*STEP\n*STATIC\n{block}*END STEP\n"), &["K013"]);
    check(format!("*PART, NAME=P\n{block}*END PART\n"), &["K013"]);
    let found = only(format!("*PART, NAME=P\n{block}*END PART\n").as_bytes(), "K013");
    assert!(found.message.ends_with("are inside a `*PART`") || found.message.ends_with("is inside a `*PART`"));
    // legal below *GAP in a part.
    check("*PART, NAME=P\n*GAP, ELSET=E\n0.,\n*GAP CONDUCTANCE, PRESSURE\n1., 0.\n2., 1.\n*END PART\n", &[]);
}

#[test]
fn k014_accepts_what_is_quoted_or_a_parameter() {
    let name = |name: &str| codes(format!("*SURFACE INTERACTION, NAME={name}\n").as_bytes());
    for legal in ["A", "_A", "A B-1", "\"1.5 = x, y\"", "Dübel_1", "__A"] {
        assert!(!name(legal).contains(&"K014"), "{legal}");
    }
    let eighty = "A".repeat(80);
    assert!(name(&eighty).is_empty() && !name(&format!("{eighty} ")).contains(&"K014"));
    for illegal in ["1A", "A.B", "A=B", "\"A\"B", "\"\"", "__A__", "\"__a__\"", &format!("{eighty}A"), "-A"] {
        assert_eq!(name(illegal), ["K014"], "{illegal}");
    }
    check("*PARAMETER\nn = 'A'\n*SURFACE INTERACTION, NAME=<n>\n", &[]);
    check("*PARAMETER\nn = '1A'\n*SURFACE INTERACTION, NAME=<n>\n", &["K014"]);
}

#[test]
fn findings_beyond_a_thousand_are_counted() {
    let found = findings("*NO SUCH KEYWORD\n".repeat(3000).as_bytes());
    assert_eq!(found.len(), 1000);
    assert!(found[999].note.as_ref().is_some_and(|note| note.starts_with("2000 more")));
}

/// Rows of a mesh are not kept when a deck is checked.
#[test]
fn s_21_a_lost_asterisk_is_found_in_rows_that_are_not_kept() {
    let nodes = "1, 0.5, -1.E-3, 0.\n".repeat(3);
    for (deck, expected) in [
        (format!("*NODE\n{nodes}SURFACE INTERACTION, NAME=A\n1.,\n"), 1),
        (format!("*NODE\nsurface interaction, name=A\n{nodes}"), 1),
        (
            format!(
                "*NODE\nSurface Interaction, name=A\nContact Pair, interaction=A\n{nodes}Friction\nGap Conductance\n"
            ),
            3,
        ),
        (format!("*NODE\n{nodes}\u{feff}*SURFACE INTERACTION, NAME=A\n"), 1),
        // The name of a set, and no parameter of the keyword.
        ("*BOUNDARY\nELASTIC, 1, 3\nSURFACE INTERACTION, 1\nSTEP\n".to_owned(), 0),
    ] {
        let found = |keep| {
            let found = findings_in(deck.as_bytes(), Grammar::builtin(), keep);
            let found = found.into_iter().filter(|found| found.code == "S021");
            found.map(|found| (found.primary.span, found.message)).collect::<Vec<_>>()
        };
        assert_eq!(found(Keep::Interpreted).len(), expected, "{deck}");
        assert_eq!(found(Keep::Interpreted), found(Keep::Everything), "{deck}");
    }
}

/// A block of nothing else does not fill memory.
#[test]
fn rows_like_keywords_are_noted_up_to_a_limit() {
    let deck = format!("*NSET, NSET=A\n{}", "SURFACE INTERACTION, NAME=A\n".repeat(500));
    let deck = scanned(deck.as_bytes(), Grammar::builtin(), Keep::Interpreted);
    assert_eq!(deck.notes().len(), 100);
}
