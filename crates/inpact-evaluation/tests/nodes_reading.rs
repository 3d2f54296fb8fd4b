//! Node tables: headers, cells, lines, and what is wrong with them (D001 to D009).

mod evaluate_support;

use evaluate_support::{Run, evaluate, evaluate_with};
use inpact_evaluation::nodes::{Batch, Column, DATA_RULES, Findings, NodeReader, Part, Selection};
use inpact_evaluation::plan::Choices;
use inpact_parser::model::Name;
use std::fmt::Write;

const DECK: &str = "*SURFACE INTERACTION, NAME=GAP\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., 0.1\n";
const TWO: &str = "*SURFACE INTERACTION, NAME=Steel Gap\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., 0.1\n\
                   *SURFACE INTERACTION, NAME=OTHER\n*GAP ELECTRICAL CONDUCTANCE\n2., 0.\n1., 0.1\n";

/// The findings of a node table that is refused.
fn refused(deck: &str, nodes: &str) -> Vec<String> {
    let Run { plan, findings, csv, .. } = evaluate(deck, nodes);
    assert!(plan.is_none() && csv.is_empty(), "{findings:?}");
    findings
}

#[test]
fn headers_go_by_their_aliases_in_any_case() {
    let nodes = "\u{feff}NODE, COpen ,CPRESS,cStatus,NT11_S,nt11_m,CNAREA,EPOT_JUMP\n7,0.05,0,0,20,30,2,3\n";
    let run = evaluate(DECK, nodes);
    assert_eq!(run.findings, Vec::<String>::new());
    assert_eq!(run.header(), "node,ECD,ECDA,SJD,SJDA,WEIGHT,conductance,heat_s,heat_m,status");
    assert_eq!(run.column("ECDA"), ["90"]);
}

#[test]
fn texts_come_out_as_they_went_in() {
    let nodes =
        "clearance,interaction,time,node\n0,steelgap,0.10,\" 1,\"\"a\"\"\"\n0,\"STEEL  GAP\",1e-3,007\n0,other,,\n";
    let run = evaluate(TWO, nodes);
    let expected = "node,interaction,time,WEIGHT,conductance,status\n\
                    \" 1,\"\"a\"\"\",steelgap,0.10,0.5,20,closed\n007,STEEL  GAP,1e-3,0.5,20,closed\n,other,,0.5,2,closed\n";
    assert_eq!(run.csv, expected);
}

#[test]
fn labels_of_any_bytes_pass_through() {
    let mut findings = Findings::new("nodes.csv");
    let bytes: &[u8] = b"node,clearance\nk\xFCrzer,1\n";
    let mut reader = NodeReader::open(Box::new(bytes), &mut findings).expect("a slice can be read");
    reader.select(&Selection { labels: vec![Column::Node], numbers: vec![Column::Clearance, Column::Area] });
    let mut batch = Batch::default();
    assert!(reader.read_batch(&mut batch, &mut findings).expect("a slice can be read"));
    assert_eq!(batch.labels[0].get(0), b"k\xFCrzer");
    assert_eq!((batch.numbers[0].get(0), batch.numbers[1].get(0)), (Some(1.0), None));
    assert!(!reader.read_batch(&mut batch, &mut findings).expect("a slice can be read"));
}

#[test]
fn a_last_line_needs_no_end_and_blank_lines_are_no_rows() {
    for nodes in
        ["clearance,area\n0,1\n\n0.1,1", "clearance,area\r\n0,1\r\n\r\n0.1,1\r\n", "clearance,area\n0,1\n  \n0.1,1\n\n"]
    {
        assert_eq!(evaluate(DECK, nodes).column("conductance"), ["20", "10"], "{nodes:?}");
    }
}

#[test]
fn malformed_cells_have_row_column_and_line_d002() {
    // Blank lines and line ends of every kind do not lead the line number astray.
    for (nodes, line) in [
        ("node,COPEN\n1,0\n2,1.5-3\n", 3),
        ("node,COPEN\r\n1,0\r\n2,1.5-3\r\n", 3),
        ("\nnode,COPEN\n\n1,0\n\n\n2,1.5-3", 7),
        ("node,COPEN\n\"a\nb\",0\n2,1.5-3", 4),
    ] {
        let findings = refused(DECK, nodes);
        assert_eq!(findings.len(), 1, "{findings:?}");
        let start = format!("{line}:COPEN: error[D002 malformed-cell] `COPEN` of row 2 is `1.5-3`, which is no number");
        assert!(findings[0].starts_with(&start), "{findings:?}");
    }
    let short = refused(DECK, "node,clearance\n1,0\n2\n3,0,5\n");
    assert!(short[0].starts_with("3:-: error[D002 malformed-cell] row 2 has 1 cells, the header 2"), "{short:?}");
    assert!(short[1].starts_with("4:-: error[D002 malformed-cell] row 3 has 3 cells, the header 2"), "{short:?}");
    let decimal_comma = refused(DECK, "node,clearance\n1,\"0,5\"\n");
    assert!(decimal_comma[0].contains("decimal point"), "{decimal_comma:?}");
    let closed = refused(DECK, "clearance,closed\n0,1\n0,2\n");
    assert!(closed[0].starts_with("3:closed: error[D002 malformed-cell] `closed` of row 2 is 2.0"), "{closed:?}");
}

#[test]
fn cells_that_nothing_needs_are_not_read() {
    let run = evaluate(DECK, "clearance,por_s,temp_s,comment\n0,n/a,-,\"x,y\"\n");
    assert_eq!(run.findings, Vec::<String>::new());
    assert_eq!(run.column("conductance"), ["20"]);
}

#[test]
fn missing_numbers_leave_cells_empty() {
    let nodes = "clearance,epot_s,epot_m,area\n0,3,1,2\n,3,1,2\n0,3,,2\n0,3,1,\n";
    let run = evaluate(DECK, nodes);
    assert_eq!(run.findings, Vec::<String>::new());
    assert_eq!(run.column("conductance"), ["20", "", "20", "20"]);
    assert_eq!(run.column("ECD"), ["40", "", "", "40"]);
    assert_eq!(run.column("ECDA"), ["80", "", "", ""]);
    assert_eq!(run.column("status"), ["closed", "", "closed", "closed"]);
    let tally = run.tally.expect("counts");
    assert_eq!((tally.total(|of| of.incomplete), tally.total(|of| of.incomplete_flows)), (1, 1));
}

#[test]
fn numbers_that_are_not_finite_are_counted_d003() {
    let run = evaluate(DECK, "clearance,epot_jump\n0,1\nnan,1\n0,inf\ninf,1\n-inf,1\n0,1e999\n");
    assert_eq!(run.column("conductance"), ["20", "NaN", "20", "10", "20", "20"]);
    assert_eq!(run.column("ECD"), ["20", "NaN", "inf", "10", "20", "inf"]);
    assert_eq!(run.column("status"), ["closed", "", "closed", "beyond_table", "closed", "closed"]);
    assert!(
        run.findings[0].starts_with("3:clearance: warning[D003 non-finite] `clearance` is NaN or infinite in 3 rows")
    );
    assert!(
        run.findings[1].starts_with("4:epot_jump: warning[D003 non-finite] `epot_jump` is NaN or infinite in 2 rows")
    );
}

#[test]
fn unknown_interactions_are_refused_d004() {
    let findings = refused(TWO, "interaction,clearance\nOTHER,0\nBOLT,0\n,0\n");
    let line = "3:interaction: error[D004 unknown-interaction] `interaction` of row 2 is `BOLT`, which the deck does not \
                define (its interactions are `Steel Gap`, `OTHER`)";
    assert_eq!(findings[0], line);
    assert!(findings[1].starts_with("4:interaction: error[D004 unknown-interaction] `interaction` of row 3 is empty"));
    // A quoted name keeps its blanks and case (S-41).
    assert_eq!(refused(TWO, "interaction,clearance\n\"\"\"Steel Gap\"\"\",0\n").len(), 1);
    // With one interaction an empty cell leaves nothing to choose.
    assert_eq!(evaluate(DECK, "interaction,clearance\n,0\n").column("conductance"), ["20"]);
    let chosen = Choices { interaction: Some(Name::new("BOLT")), ..Choices::default() };
    let run = evaluate_with(TWO, "clearance\n0\n", &chosen, 1);
    assert!(
        run.findings[0].contains("error[D004 unknown-interaction] the deck does not define the chosen interaction")
    );
}

#[test]
fn something_must_say_which_interaction_governs_d001() {
    let findings = refused(TWO, "clearance\n0\n");
    assert!(findings[0].contains("error[D001 missing-column] column `interaction` is missing"), "{findings:?}");
    let chosen = Choices { interaction: Some(Name::new("other")), ..Choices::default() };
    assert_eq!(evaluate_with(TWO, "clearance\n0\n", &chosen, 1).column("conductance"), ["2"]);
    // The choice holds for every row, whatever the column says.
    let run = evaluate_with(TWO, "interaction,clearance\nSteel Gap,0\n", &chosen, 1);
    assert_eq!(run.csv, "interaction,WEIGHT,conductance,status\nOTHER,0.5,2,closed\n");
}

#[test]
fn a_law_that_lacks_a_column_says_so_d001() {
    let run = evaluate(DECK, "node,gap\n1,0\n");
    assert_eq!(
        run.findings,
        ["-:clearance: error[D001 missing-column] `clearance` is missing, which the electrical law of `GAP` needs"]
    );
    let empty = refused(DECK, "");
    assert!(empty[0].starts_with("-:-: error[D001 missing-column] the node table is empty"), "{empty:?}");
}

#[test]
fn two_headers_of_one_column_are_refused_d005() {
    let findings = refused(DECK, "clearance,copen,AREA,area\n0,0,1,1\n");
    assert!(findings[0].starts_with("1:copen: error[D005 duplicate-column] columns `clearance` and `copen` both mean"));
    assert!(findings[1].starts_with("1:area: error[D005 duplicate-column] column `area` stands twice in the header"));
}

#[test]
fn time_must_rise_within_a_node_d006() {
    let deck = TWO;
    let nodes = "node,interaction,time,clearance\n1,OTHER,0,0\n2,OTHER,0,0\n1,Steel Gap,0,0\n1,OTHER,1,0\n";
    // Another node, or the same node under another interaction, has a time of its own.
    assert_eq!(evaluate(deck, nodes).findings, Vec::<String>::new());
    for (time, shown) in [("1", "1.0"), ("0.5", "0.5"), ("nan", "NaN")] {
        let findings = refused(deck, &format!("{nodes} 1 ,other,{time},0\n"));
        let expected =
            format!("error[D006 time-not-ascending] `time` of node `1` is {shown} in row 5 and 1.0 in the row before");
        assert!(
            findings.iter().any(|found| found.starts_with("6:time: ") && found.contains(&expected)),
            "{findings:?}"
        );
    }
}

#[test]
fn what_cannot_be_negative_is_refused_d008_d009() {
    let findings = refused(DECK, "clearance,cnarea\n0,-0\n0,-1e-9\n");
    assert_eq!(findings.len(), 1);
    assert!(findings[0].starts_with("3:cnarea: error[D008 negative-area] `cnarea` of row 2 is -1e-9"), "{findings:?}");
    let deck = "*SURFACE INTERACTION, NAME=GAP\n*CONTACT PERMEABILITY\n1., 0.\n";
    let findings = refused(deck, "clearance,por_s,por_m,char_length\n0,1,1,-1\n");
    assert!(findings[0].starts_with("2:char_length: error[D009 negative-property]"), "{findings:?}");
}

#[test]
fn many_findings_of_one_rule_are_counted() {
    let mut nodes = "clearance\n".to_owned();
    for _ in 0..50 {
        nodes += "x\n";
    }
    let findings = refused(DECK, &nodes);
    assert_eq!(findings.len(), 20);
    assert!(findings[19].contains("30 more findings of this rule"), "{}", findings[19]);
}

#[test]
fn a_header_alone_gives_a_header() {
    let run = evaluate(DECK, "node,clearance,epot_jump\n");
    assert_eq!(run.csv, "node,ECD,SJD,WEIGHT,conductance,heat_s,heat_m,status\n");
}

#[test]
fn the_one_column_wins_over_those_of_the_sides() {
    let deck = "*SURFACE INTERACTION, NAME=GAP\n*GAP ELECTRICAL CONDUCTANCE\n1.,0.,0.\n101.,0.,100.\n";
    let nodes = "clearance,temp,temp_s,temp_m,epot_s,epot_m,epot_jump\n0,10,50,70,3,1,5\n0,,50,70,3,1,\n";
    let run = evaluate(deck, nodes);
    assert_eq!(run.column("conductance"), ["11", "61"]);
    assert_eq!(run.column("ECD"), ["55", "122"]);
}

#[test]
fn digits_lost_in_a_difference_are_counted() {
    let nodes = "clearance,epot_s,epot_m\n0,300,299.9999999\n0,300.000001,299.9999\n0,0,0\n";
    let tally = evaluate(DECK, nodes).tally.expect("counts");
    assert_eq!(tally.total(|of| of.lost_digits), 1);
    let with_jump = "clearance,epot_jump\n0,1e-30\n";
    assert_eq!(evaluate(DECK, with_jump).tally.expect("counts").total(|of| of.lost_digits), 0);
}

#[test]
fn a_table_may_be_wide() {
    let mut header = "clearance".to_owned();
    let mut row = "0".to_owned();
    for number in 1..=500 {
        write!(header, ",fv{number}_s,fv{number}_m").expect("a string takes all");
        row += ",1,2";
    }
    assert_eq!(evaluate(DECK, &format!("{header}\n{row}\n")).column("conductance"), ["20"]);
    assert_eq!(Column::named("fv500_m"), Some(Column::FieldVariable(500, Part::Master)));
}

#[test]
fn codes_and_names_of_the_rules_are_fixed() {
    let list: Vec<String> =
        DATA_RULES.iter().map(|rule| format!("{} {} {}", rule.code, rule.name, rule.severity)).collect();
    insta::assert_snapshot!(list.join("\n"));
}
