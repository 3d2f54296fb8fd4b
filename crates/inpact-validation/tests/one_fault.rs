//! One fault gives one finding: decks with a fault each, and what the rules on tables, references, contexts and physics say.

use inpact_parser::deck::{Keep, ScanOptions, Scanner, scan};
use inpact_parser::grammar::Grammar;
use inpact_parser::model;
use inpact_parser::span::SourceId;
use inpact_validation::{Diagnostic, Severity, apply};

fn findings(deck: &str) -> Vec<Diagnostic> {
    let grammar = Grammar::builtin();
    let deck = scan("deck.inp", deck.as_bytes(), grammar);
    let (model, problems) = model::read(&deck, grammar);
    let found = inpact_validation::check(&deck, grammar, &model, &problems);
    found.into_iter().filter(|found| found.code.starts_with(['T', 'P', 'R', 'C'])).collect()
}

/// Compares the findings as `CODE@line`; findings on lines and keywords (S, K) are left out.
#[track_caller]
fn check(deck: &str, expected: &str) {
    let found = findings(deck);
    let shown: Vec<String> =
        found.iter().map(|found| format!("{}@{}", found.code, found.primary.position.line)).collect();
    let messages: String = found.iter().map(|found| format!("\n{}", found.message)).collect();
    assert_eq!(shown.join(" "), expected, "in\n{deck}{messages}");
}

/// The line after the last that fits is a row, whatever it says, and nothing is mended: its parameters would stay rows.
#[test]
fn s003_a_keyword_line_ends_where_it_gets_too_long() {
    let (grammar, keep) = (Grammar::builtin(), Keep::Everything);
    let text = "*SURFACE INTERACTION, NAME=A,\nUNSYMM,\nUSER\n*HEADING\n";
    let judged = |most: usize| {
        let mut scanner = Scanner::new("deck.inp", ScanOptions { grammar, keep });
        scanner.set_longest_keyword_line(u32::try_from(most).expect("a few bytes"));
        scanner.push(text.as_bytes());
        let deck = scanner.finish();
        assert_eq!(deck.print(SourceId::ROOT), text.as_bytes());
        let count = deck.blocks()[0].keyword.as_ref().expect("a keyword").parameters().len();
        let (model, problems) = model::read(&deck, grammar);
        let found = inpact_validation::check(&deck, grammar, &model, &problems);
        (count, found.into_iter().find(|found| found.code == "S003"))
    };
    let whole = text.find("*HEADING").expect("the next keyword");
    assert!(matches!(judged(whole), (3, None)));
    let (count, found) = judged(whole - 1);
    let found = found.expect("a finding");
    assert_eq!((count, found.severity, found.primary.position.line), (2, Severity::Error, 2));
    let message = "with the next line the keyword line of `*SURFACE INTERACTION` has more than 42 bytes";
    assert_eq!((found.message.as_str(), found.fix.is_none()), (message, true));
    assert_eq!(found.help.as_deref(), Some("write fewer parameters, each once"));
}

/// A table of *GAP ELECTRICAL CONDUCTANCE in an interaction: its rows begin on line 3.
fn electrical(parameters: &str, rows: &str) -> String {
    format!("*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE{parameters}\n{rows}\n")
}

/// The deck after the fixes of all findings of a rule.
fn fixed(deck: &str, code: &str) -> String {
    let edits: Vec<_> =
        findings(deck).into_iter().filter(|found| found.code == code).filter_map(|found| found.fix).collect();
    let edits: Vec<_> = edits.into_iter().flat_map(|fix| fix.edits).collect();
    String::from_utf8(apply(deck.as_bytes(), &edits)).expect("the deck is UTF-8")
}

#[test]
fn order_of_one_axis() {
    check(&electrical(", PRESSURE", "1, 0\n2, 10\n3, 20"), "");
    check(&electrical(", PRESSURE", "1, 0\n3, 20\n2, 10\n4, 30"), "T001@5");
    check(&electrical(", PRESSURE", "4, 30\n3, 20\n2, 10\n1, 0"), "T001@4");
    // Sorted and with equal values: T002 alone.
    check(&electrical(", PRESSURE", "1, 0\n2, 10\n3, 10.\n4, 1E1\n5, 30"), "T002@5 T002@6");
    // A table with a fall and equal values elsewhere is not sorted by the fix.
    let restart = electrical(", PRESSURE", "1, 0\n2, 10\n1, 0\n3, 10");
    check(&restart, "T001@5");
    assert_eq!(fixed(&restart, "T001"), restart);
    check(&electrical("", "0, 0.2\n1, 0.1\n2, 0"), "T001@4");
}

#[test]
fn order_of_many_axes() {
    let rows = |rows: &str| electrical(", PRESSURE, DEPENDENCIES=2", rows);
    // Pressure, temperature, first and second field: the last runs slowest.
    check(&rows("1,0,20,1,1\n2,9,20,1,1\n1,0,30,1,1\n2,9,30,1,1\n1,0,20,2,1\n2,9,20,2,1\n1,0,20,1,2\n2,9,20,1,2"), "");
    // The temperature falls while both fields stay.
    check(&rows("1,0,30,1,1\n2,9,30,1,1\n1,0,20,1,1\n2,9,20,1,1"), "T003@5");
    // The first field falls while the second stays; the temperature increases, which does not count.
    check(&rows("1,0,20,2,1\n2,9,20,2,1\n1,0,30,1,1\n2,9,30,1,1"), "T003@5");
    // Significance the wrong way round: temperature slower than the fields.
    check(&rows("1,0,20,1,1\n2,9,20,1,1\n1,0,20,2,1\n2,9,20,2,1\n1,0,30,1,1\n2,9,30,1,1"), "T003@7");
    // Temperatures outside, pressures inside, but written pressure by pressure.
    check(&electrical(", PRESSURE", "1,0,20\n1,0,30\n2,9,20\n2,9,30"), "T003@5");
    // An empty temperature reads as 0.
    check(&electrical(", PRESSURE", "1,0,20\n2,9,20\n1,0,\n2,9"), "T003@5");
}

#[test]
fn sorting_keeps_rows_and_comments() {
    let deck = "*SURFACE INTERACTION, NAME=A\r\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\r\n  3, 20 \r\n** why\r\n\t2, 10,\r\n1,0";
    let sorted = "*SURFACE INTERACTION, NAME=A\r\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\r\n  1,0 \r\n** why\r\n\t2, 10,\r\n3, 20";
    assert_eq!(fixed(deck, "T001"), sorted);
    check(sorted, "");
    // Groups and rows inside them at once.
    let deck = electrical(", PRESSURE", "2,9,30\n1,0,30\n2,9,20\n1,0,20");
    check(&deck, "T001@4 T003@5");
    let sorted = electrical(", PRESSURE", "1,0,20\n2,9,20\n1,0,30\n2,9,30");
    assert_eq!(fixed(&deck, "T001"), sorted);
    assert_eq!(fixed(&deck, "T003"), sorted);
}

#[test]
fn cells_without_a_number_take_no_part() {
    check(&electrical(", PRESSURE", "1, 0\n2, <p>\n3, 20"), "");
    check(&electrical(", PRESSURE", "1, 0\n2, 1.5-3\n3, 20"), "");
    check(&electrical("", "3, 0\n2, x\n0, 20"), "");
    check(&electrical("", "x, 0\n2, 1\n0, 20"), "");
    // The other rows must ascend all the same.
    check(&electrical(", PRESSURE", "1, 0\n2, x\n3, 20\n4, 10"), "T001@6");
    check(&electrical("", "3, 0.5\n2, x\n0, 20"), "T004@3");
    check(&electrical("", "3, x\n2, 0.5\n0, 20"), "");
    check(&electrical(", DEPENDENCIES=1", "3, 0,,x\n2, 0.5,,1\n0, 20,,1"), "");
    // A row of names that lost its keyword line.
    check(&electrical(", PRESSURE, DEPENDENCIES=1", "1, 0,, 1\n2, 10,, 1\nBAR-1, BAR-2"), "");
}

#[test]
fn starts_are_judged_group_by_group() {
    check(&electrical("", "3, 0, 20\n0, 1, 20\n3, 0.1, 30\n0, 1, 30"), "T004@5");
    check(&electrical("", "3, -1\n2, 0\n0, 1"), "T004@3");
    // Out of order the start is judged only where it is the lowest value.
    check(&electrical("", "3, 0.1\n1, 0.3\n2, 0.2"), "T004@3 T001@5");
    check(&electrical("", "3, 2e8\n2, 1e-6\n0, 1"), "T001@4");
    // A wrong temperature makes a group of its own.
    check(&electrical("", "3, 0, 300\n1, 1, 30\n0, 2, 300"), "T003@4");
    // Pressures in a table that lacks PRESSURE: the start says it all.
    check(&electrical("", "1, 100\n2, 200"), "T004@3");
    check(&electrical(", PRESSURE", "1, -5\n2, 0\n3, 5"), "");
    check(&electrical(", PRESSURE", "1, 5, 20\n2, 9, 20\n1, 0, 30\n2, 9, 30"), "T005@3");
    check(
        "*SURFACE INTERACTION, NAME=A\n*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=1, CUTOFF GAP FILL=1\n1, 5\n2, 9",
        "",
    );
}

#[test]
fn a_misread_table_is_judged_no_further() {
    // DEPENDENCIES is missing, misspelt, or no number.
    check(&electrical("", "3, 0,, 1\n0, 1,, 1\n3, 0,, 2\n0, 1,, 2"), "T006@3");
    check(&electrical(", DEPENDENCY=1", "3, 0,, 1\n0, 1,, 1\n3, 0,, 2\n0, 1,, 2"), "");
    check(&electrical(", DEPENDENCIES=one", "3, 0,, 1\n0, 1,, 1\n3, 0,, 2\n0, 1,, 2"), "");
    check(&electrical(", DEPENDENCIES", "3, 0,, 1\n0, 1,, 1\n3, 0,, 2\n0, 1,, 2"), "");
    // PRESSURE is misspelt: neither a rise with clearance nor a tail that is not 0.
    check(&electrical(", PRESURE", "3, 0\n4, 100"), "");
    // A line is missing inside a table of two lines a row.
    let rows = "1,0,20,1,2,3,4,5\n6\n2,9,20,1,2,3,4,5\n1,0,30,1,2,3,4,5\n6";
    check(&electrical(", PRESSURE, DEPENDENCIES=6", rows), "T006@6");
    check(&electrical(", PRESSURE, DEPENDENCIES=6", "1,0,20,1,2,3,4,5\n6\n2,9,20,1,2,3,4,5"), "T007@5");
}

#[test]
fn a_parameter_counts_columns() {
    let parameter = "*PARAMETER\nn = 1\np = 10\n";
    let table = |rows| format!("{parameter}{}", electrical(", PRESSURE, DEPENDENCIES=<n>", rows));
    check(&table("1, 0,, 1\n2, <p>,, 1\n1, 0,, 2\n2, <p>,, 2"), "");
    check(&table("1, 0,, 1\n2, <p>,, 1\n3, 5,, 1"), "T001@8");
    let cutoffs = "*SURFACE INTERACTION, NAME=A\n*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=-<p>, CUTOFF GAP FILL=1";
    check(&format!("{parameter}{cutoffs}"), "P002@5");
}

#[test]
fn a_row_over_lines_is_one_row() {
    let parameters = ", PRESSURE, DEPENDENCIES=6";
    check(&electrical(parameters, "1,0,20,1,2,3,4,5\n6\n2,9,20,1,2,3,4,5\n6"), "");
    let deck = electrical(parameters, "2,9,20,1,2,3,4,5\n** of row 1\n6\n1,0,20,1,2,3,4,5\n6");
    check(&deck, "T001@6");
    let sorted = electrical(parameters, "1,0,20,1,2,3,4,5\n6\n2,9,20,1,2,3,4,5\n** of row 1\n6");
    assert_eq!(fixed(&deck, "T001"), sorted);
    // The value of field 6 falls: it is on the second line of the row.
    check(&electrical(parameters, "1,0,20,1,2,3,4,5\n7\n2,9,20,1,2,3,4,5\n7\n1,0\n6\n2,9\n6"), "T003@8");
}

#[test]
fn broken_rows_keep_their_line_ends() {
    let deck = "*SURFACE INTERACTION, NAME=A\r\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=14\r\n\t1,0,20,1,2,3,4,5 , ,7,8,9,10,11,12,13, 14\r\n";
    check(deck, "T014@3");
    let broken = "*SURFACE INTERACTION, NAME=A\r\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=14\r\n\t1,0,20,1,2,3,4,5\r\n\t,7,8,9,10,11,12,13\r\n\t14\r\n";
    assert_eq!(fixed(deck, "T014"), broken);
    check(broken, "");
}

#[test]
fn field_values_with_one_row() {
    check(&electrical(", PRESSURE, DEPENDENCIES=1", "1,0,20,1\n1,0,30,1\n1,0,20,2\n2,9,20,2"), "T015@5");
    check(&electrical(", PRESSURE, DEPENDENCIES=1", "1,0,,1\n1,0,,2\n1,0,,3"), "T012@3");
    check(&electrical(", PRESSURE, DEPENDENCIES=1", "1,0,,1\n2,9,,1\n3,10,,1.1\n1,0,,2\n2,9,,2"), "T012@5");
    check(&electrical(", PRESSURE", "1,0,20\n1,0,30"), "");
}

#[test]
fn physics_of_what_is_trusted() {
    check(&electrical(", PRESSURE", "1, 0\n-2, 1\n3, 2"), "P001@4");
    check(&electrical(", PRESSURE", "3, 0\n2, 1\n1, 2"), "P006@4");
    check(&electrical("", "1, 0\n2, 1\n0, 2"), "P005@4");
    check(&electrical("", "1, 0\n2, 100\n3, 200"), "P005@4");
    check(&electrical("", "3, 0\n , 1\n2, 2\n0, 3"), "T013@4");
    check(&electrical("", "3, 0\n2, 1"), "P008@4");
    check(&electrical("", "3, 0"), "T008@3");
    check(&electrical("", "3, 0.1"), "T008@3 T004@3");
    check(&electrical(", PRESSURE", "3"), "");
}

#[test]
fn branches_meet_at_contact() {
    let branches = |clearance: &str, pressure: &str| {
        format!("{}*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n{pressure}\n", electrical("", clearance))
    };
    check(&branches("1, 0\n0, 1", "10, 0\n20, 1"), "");
    check(&branches("1, 0\n0, 1", "11, 0\n20, 1"), "P007@6");
    check(&branches("0, 0\n0, 1", "11, 0\n20, 1"), "P007@6");
    // Between the two rows around zero pressure.
    check(&branches("1, 0\n0, 1", "1, -1\n17, 1"), "");
    check(&branches("1, 0\n0, 1", "1, -1\n27, 1"), "P007@7");
    // Group by group.
    check(&branches("1,0,20\n0,1,20\n1,0,30\n0,1,30", "1,0,20\n2,1,20\n20,0,30\n21,1,30"), "P007@10");
    check(&branches("1,0,20\n0,1,20\n1,0,30\n0,1,30", "50,0,25\n60,1,25"), "");
}

#[test]
fn duplicates_of_each_kind() {
    let interaction = "*SURFACE INTERACTION, NAME=A\n";
    let thermal = "*GAP CONDUCTANCE, PRESSURE\n1, 0\n2, 1\n";
    check(&format!("{interaction}{thermal}{thermal}{thermal}"), "T010@5 T010@8");
    check(&format!("{interaction}{thermal}*GAP CONDUCTANCE\n1, 0\n0, 1\n"), "");
    // Between them another interaction may have been meant to begin; or PRESSURE is misspelt.
    check(&format!("{interaction}{thermal}*SURFACE INTERACTON, NAME=B\n{thermal}"), "");
    check(&format!("{interaction}*GAP CONDUCTANCE, PRESURE\n1, 0\n2, 1\n*GAP CONDUCTANCE\n1, 0\n0, 1\n"), "");
    let heat = "*GAP HEAT GENERATION\n1., 0.5\n";
    check(&format!("{interaction}*FRICTION\n0.3\n{heat}{heat}"), "T010@6");
    check(&format!("{interaction}{thermal}*GAP CONDUCTANCE, USER\n"), "C003@5");
    check(&format!("{interaction}*GAP CONDUCTANCE, USER\n1, 0\n2, 1\n"), "T011@3");
}

#[test]
fn radiation_is_a_table_against_clearance() {
    let radiation = |rows: &str| {
        let constants = "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15, STEFAN BOLTZMANN=5.67E-8";
        format!("{constants}\n*SURFACE INTERACTION, NAME=A\n*GAP RADIATION\n{rows}\n")
    };
    check(&radiation("0.8, 0.3\n1, 0\n0.5, 1\n0, 2"), "");
    check(&radiation("0.8, 0.3\n1, 0\n0, 2\n0.5, 1"), "T001@7");
    check(&radiation("0.8, 0.3\n1, 0\n0.5, 0\n0, 1"), "T002@6");
    check(&radiation("0.8, 0.3\n1, 0.1\n0, 1"), "T004@5");
    check(&radiation("0.8, 0.3\n1, 0"), "T008@5");
    check(&radiation("0.8, 0.3\n-1, 0\n0, 1"), "P001@5");
    check(&radiation("0.8, 0.3\n2, 0\n0, 1"), "P009@5");
    check(&radiation("1.8, -0.3\n1, 0\n0, 1"), "P009@4 P001@4");
    check("*SURFACE INTERACTION, NAME=A\n*GAP RADIATION\n0.8, 0.3\n1, 0\n0, 1\n", "C006@2");
    check("*INCLUDE, INPUT=constants.inp\n*SURFACE INTERACTION, NAME=A\n*GAP RADIATION\n0.8, 0.3\n1, 0\n0, 1\n", "");
    check(
        "*PHYSICAL CONSTANTS, ABSOLUT ZERO=0\n*SURFACE INTERACTION, NAME=A\n*GAP RADIATION\n0.8, 0.3\n1, 0\n0, 1\n",
        "",
    );
}

#[test]
fn references() {
    let deck =
        |interaction: &str, pair: &str| format!("*SURFACE INTERACTION{interaction}\n*CONTACT PAIR{pair}\nS, M\n");
    check(&deck(", NAME=A", ", INTERACTION=a"), "");
    check(&deck(", NAME=A", ", INTERACTION=B"), "R001@2");
    check(&deck(", NAME=A", ""), "R005@2");
    check(&deck(", NAME=\"a\"", ", INTERACTION=a"), "R006@2");
    check(&deck(", NAME=\"A\"", ", INTERACTION=a"), "");
    check(&deck(", NAME=a b", ", INTERACTION=\"A b\""), "R006@2");
    check(&deck(", NAME=\"a b\"", ", INTERACTION=\"A b\""), "R001@2");
    // A misspelt name elsewhere has its finding there.
    check(&deck(", NMAE=A", ", INTERACTION=A"), "");
    check(&deck(", NAME=A", ", INTERATCION=A"), "");
    check("*SURFACE INTERACTON, NAME=A\n*CONTACT PAIR, INTERACTION=A\nS, M\n", "");
    check("*INCLUDE, INPUT=x\n*CONTACT PAIR, INTERACTION=A\nS, M\n", "");
    // One name that is not defined is one finding, however often it occurs.
    check("*CONTACT PAIR, INTERACTION=A\nS, M\n*CONTACT PAIR, INTERACTION=A\nS, N\n", "R001@1");
    check("*CONTACT PROPERTY ASSIGNMENT\n, , A\n", "R001@2");
    check("*SURFACE INTERACTION, NAME=A\n*CONTACT PROPERTY ASSIGNMENT\n, , \n", "R002@1");
    check("*PARAMETER\nx = 'A'\n*SURFACE INTERACTION, NAME=A\n*CONTACT PAIR, INTERACTION=<x>\nS, M\n", "");
    check("*SURFACE INTERACTION, NAME=A\n*CONTACT PAIR, INTERACTION=<y>\nS, M\n", "");
    check("*SURFACE INTERACTION, NAME=A\n*STEP\n*STATIC\n*CONTACT PAIR\nS, M\n*END STEP", "");
    check(
        "*SURFACE INTERACTION, NAME=A\n*STEP\n*STATIC\n*CHANGE FRICTION, INTERACTION=B\n*FRICTION\n0.1\n*END STEP",
        "R001@4",
    );
}

#[test]
fn surfaces() {
    let deck = |pair: &str| {
        format!("*SURFACE, NAME=S\nE, S1\n*SURFACE INTERACTION, NAME=A\n*CONTACT PAIR, INTERACTION=A\n{pair}\n")
    };
    check(&deck("S, S"), "");
    check(&deck("s, Part-1.s"), "");
    check(&deck("TYPE=SURFACE TO SURFACE\nS, S"), "");
    check(&deck("S, M"), "R004@5");
    check(&deck("S, Part-1.M"), "R004@5");
    check(&deck("M, M"), "R004@5");
    check(&deck("S, \"s\""), "R006@5");
    check(&format!("*INCLUDE, INPUT=mesh\n{}", deck("S, M")), "");
    check(&format!("*INSTANCE, LIBRARY=job, INSTANCE=I\n*END INSTANCE\n{}", deck("S, M")), "");
    check(&format!("*RIGID SURFACE, TYPE=SEGMENTS, NAME=M\n{}", deck("S, M")), "");
    check("*NODE\n1, 0\n*SURFACE INTERACTION, NAME=A\n*CONTACT PAIR, INTERACTION=A\nS, M\n", "R004@5 R004@5");
}

#[test]
fn procedures() {
    let deck = |option: &str, steps: &str| format!("*SURFACE INTERACTION, NAME=A\n{option}\n{steps}\n");
    let electrical = "*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n1, 0";
    let permeability = "*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=1, CUTOFF GAP FILL=1";
    let thermal = "*GAP CONDUCTANCE, PRESSURE\n1, 0\n2, 1";
    let step = |procedure: &str| format!("*STEP\n{procedure}\n*END STEP");
    check(&deck(electrical, ""), "");
    check(&deck(electrical, &step("*STATIC")), "C001@2");
    check(&deck(electrical, &step("*COUPLED THERMAL-ELECTRICAL")), "");
    check(&deck(electrical, &step("*COUPLED TEMPERATURE-DISPLACEMENT")), "C001@2");
    check(&deck(electrical, &step("*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL")), "");
    check(&deck(electrical, &format!("{}\n{}", step("*STATIC"), step("*COUPLED THERMAL-ELECTRICAL"))), "");
    check(&deck(electrical, &step("*COUPLED THERMO-ELECTRICS")), "");
    check(&deck(permeability, &step("*STATIC")), "C001@2");
    check(&deck(permeability, &step("*SOILS, CONSOLIDATION")), "");
    check(&deck(permeability, &step("*GEOSTATIC")), "");
    check(&deck(thermal, &step("*SOILS, HEAT=NO")), "C001@2");
    check(&deck(thermal, &step("*SOILS")), "");
    check(&deck(thermal, &step("*HEAT TRANSFER")), "");
    check(&format!("*INCLUDE, INPUT=steps\n{}", deck(electrical, &step("*STATIC"))), "");
}

#[test]
fn heat_generation() {
    let deck = |interaction: &str, options: &str| format!("*SURFACE INTERACTION, NAME=A{interaction}\n{options}\n");
    check(&deck("", "*FRICTION\n0.3\n*GAP HEAT GENERATION\n1., 0.5"), "");
    check(&deck("", "*GAP HEAT GENERATION\n1., 0.5"), "C005@2");
    check(&deck("", "*FRICTON\n0.3\n*GAP HEAT GENERATION\n1., 0.5"), "");
    check(&deck(", USER", "*GAP HEAT GENERATION\n1., 0.5"), "C004@2");
    check(&deck("", "*FRICTION\n0.3\n*GAP HEAT GENERATION"), "T009@4");
    check(&deck("", "*FRICTION\n0.3\n*GAP HEAT GENERATION\n, 1.5"), "P003@5");
    check(&deck("", "*FRICTION\n0.3\n*GAP HEAT GENERATION\n-1, -1"), "P004@5 P003@5");
    check(&deck("", "*FRICTION\n0.3\n*GAP HEAT GENERATION\n1., 0.5\n1., 0.6\n1., 0.7"), "T017@6");
    check(&deck("", "1.\n2.\n"), "T017@3");
    // The keyword of these rows is missing.
    check(&deck("", "1., 0.\n2., 1.\n3., 2."), "T017@3");
    check(&deck("", "1., 0.\n"), "T006@2");
}
