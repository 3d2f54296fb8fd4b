//! Posted decks of CalculiX: what ccx 2.20 was seen to do with each, and what inpact says (semantics, section 12).

use crate::program::Folder;

const CALCULIX: [&str; 2] = ["--dialect", "calculix"];

/// The beginning of an interaction that ccx accepts.
const PAD: &str = "*SURFACE INTERACTION, NAME=PAD\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1.E7\n";

const NODES: &str = "area,clearance,pressure,temp_s,temp_m,shear,slip_rate\n1,0,250,300,400,125,7\n";

/// Severity and code of each finding in `d.inp`.
fn check(folder: &Folder) -> Vec<String> {
    let run = folder.inpact(&[&["check", "--format", "concise", "d.inp"], &CALCULIX[..]].concat());
    let found: Vec<String> =
        run.output.lines().map(|line| line.split(' ').nth(1).expect("a severity").to_owned()).collect();
    assert_eq!(run.code == 1, found.iter().any(|found| found.starts_with("error")), "{}{}", run.output, run.errors);
    found
}

fn check_deck(deck: &str, expected: &[&str]) {
    assert_eq!(check(&Folder::with(&[("d.inp", deck)])), expected, "{deck}");
}

/// Heat into the slave and into the master surface.
fn heats(folder: &Folder) -> [f64; 2] {
    folder.write("n.csv", NODES);
    let run = folder.inpact(&[&["eval", "d.inp", "--nodes", "n.csv"], &CALCULIX[..]].concat());
    assert_eq!(run.code, 0, "{}", run.errors);
    let mut lines = run.output.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let (header, row) = (lines.next().expect("a header"), lines.next().expect("a row"));
    ["total_heat_s", "total_heat_m"].map(|name| {
        let column = header.iter().position(|column| *column == name).expect("the column");
        row[column].parse().expect("a number")
    })
}

fn eval_deck(deck: &str, expected: [f64; 2]) {
    let found = heats(&Folder::with(&[("d.inp", deck)]));
    assert!(found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-9), "{deck}{found:?}");
}

/// CX-01: blank lines, and comments after blanks.
#[test]
fn cx_01_blanks_count_nowhere() {
    let deck = format!(
        "{}*GAP CONDUCTANCE\n100.\n\n**********\n** next section\n*STEP\n*COUPLED TEMPERATURE-DISPLACEMENT\n*END STEP\n",
        PAD.replace("1.E7", "   ** N/mm3\n1.E7")
    );
    check_deck(&deck, &[]);
    eval_deck(&deck, [1e4, -1e4]);
    check_deck(&format!("{PAD}*GAP CONDUCTANCE,\n100.\n"), &[]);
}

/// CX-02: the quotes of a name are letters of it, everything else is allowed.
#[test]
fn cx_02_names() {
    let deck = |defined: &str, used: &str| {
        format!(
            "{}*CONTACT PAIR, INTERACTION={used}, TYPE=SURFACE TO SURFACE\nSL, MA\n",
            PAD.replace("=PAD", &format!("={defined}"))
        )
    };
    for name in ["1PAD", "P.A", "P-1", "(PAD)", "P\"A", "__PAD__"] {
        check_deck(&deck(name, name), &[]);
    }
    check_deck(&deck("\"s i\"", "\"S I\""), &[]);
    check_deck(&deck("\"PAD\"", "PAD"), &["error[R006]"]);
    check_deck(&deck(&"N".repeat(81), &"N".repeat(81)), &["error[K014]"]);
}

/// CX-03, CX-07: nothing is abbreviated, and a pair has its type and both surfaces.
#[test]
fn cx_03_and_cx_07_what_ccx_does_not_recognise() {
    check_deck(
        "*SURFACE INTERACTION, N=PAD\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LIN\n1.E7\n*CONTACT PAIR, INT=PAD, TYPE=SURF\nSL, MA\n",
        &["error[K006]", "warning[K004]", "error[K010]", "error[R005]", "warning[K004]", "error[K010]"],
    );
    check_deck(&format!("{PAD}*CONTACT PAIR, INTERACTION=PAD\nSL, MA\n"), &["error[K006]"]);
    check_deck(&format!("{PAD}*CONTACT PAIR, INTERACTION=PAD, TYPE=SURFACE TO SURFACE\nSL\n"), &["error[R007]"]);
    // More letters than the name has are none.
    let longer = PAD.replace("BEHAVIOR", "BEHAVIORS").replace("LINEAR", "LINEARLY");
    check_deck(&format!("{longer}*GAP CONDUCTANCES\n100.\n"), &[]);
}

/// CX-04: an unknown parameter is warned of, and the evaluation goes on without it.
#[test]
fn cx_04_unknown_parameters() {
    let deck = format!("{PAD}*GAP CONDUCTANCE, PRESSURE\n100., 0.\n200., 500.\n");
    check_deck(&deck, &["warning[K004]"]);
    eval_deck(&deck, [1.5e4, -1.5e4]);
    let deck = format!("{PAD}*GAP CONDUCTANCE\n100., 0., , 5.\n200., 500., , x\n");
    check_deck(&deck, &["warning[T006]"]);
    eval_deck(&deck, [1.5e4, -1.5e4]);
}

/// CX-05: blanks inside numbers, bare exponents, 20 characters.
#[test]
fn cx_05_numbers() {
    let deck = |row: &str| format!("{PAD}*GAP CONDUCTANCE\n{row}\n2.+2, 500.\n");
    check_deck(&deck("1 00., 0."), &[]);
    eval_deck(&deck("1 00., 0."), [1.5e4, -1.5e4]);
    for (number, finding) in [
        ("5.0000000000000000e+01", "error[S008]"),
        ("0.00000000000000000000000001e+28", "error[S008]"),
        ("50.000000000000000000000", "warning[S008]"),
        ("1e", "error[S006]"),
        ("nan", "error[S006]"),
    ] {
        check_deck(&deck(&format!("{number}, 0.")), &[finding]);
    }
    let folder = Folder::with(&[("d.inp", &deck("0.00000000000000000000000001e+28, 0."))]);
    let run = folder.inpact(&[&["check", "d.inp"], &CALCULIX[..]].concat());
    assert!(run.output.contains("CalculiX reads the first 20 characters, and so 0"), "{}", run.output);
}

/// CX-06: nine levels, and names without their blanks.
#[test]
fn cx_06_includes() {
    let folder = Folder::with(&[("d.inp", "*INCLUDE, INPUT=l1.inc\n")]);
    for level in 1..9 {
        folder.write(&format!("l{level}.inc"), &format!("*INCLUDE, INPUT=l{}.inc\n", level + 1));
    }
    folder.write("l9.inc", &format!("{PAD}*GAP CONDUCTANCE\n100.\n"));
    assert_eq!(check(&folder), Vec::<String>::new());
    assert_eq!(heats(&folder), [1e4, -1e4]);
    folder.write("l9.inc", "*INCLUDE, INPUT=l10.inc\n");
    folder.write("l10.inc", "** deep\n");
    assert_eq!(check(&folder), ["error[S013]"]);
    let quoted = "*INCLUDE, INPUT=\"node sets.inc\"\n";
    let folder = Folder::with(&[("d.inp", quoted), ("node sets.inc", "** not this\n")]);
    assert_eq!(check(&folder), ["error[S012]"]);
    folder.write("nodesets.inc", "** this\n");
    assert_eq!(check(&folder), Vec::<String>::new());
    // Nothing counts behind the closing quote.
    folder.write("d.inp", "*INCLUDE, INPUT=\"node sets.inc\"x\n");
    assert_eq!(check(&folder), Vec::<String>::new());
    folder.write("d.inp", "*INCLUDE, INPUT=\"nodesets.inc\",1\n");
    assert_eq!(check(&folder), ["warning[K004]"]);
    folder.write("d.inp", "*INCLUDE, INPUT=x\"nodesets.inc\"\n");
    assert_eq!(check(&folder), ["error[S012]"]);
    // ccx cannot open `nodesets.inc,`.
    folder.write("d.inp", "*INCLUDE, INPUT=nodesets.inc,\n");
    assert_eq!(check(&folder), ["error[S012]"]);
    assert_eq!(check(&Folder::with(&[("d.inp", "*INCLUDE, INPUT\n")])), ["error[K007]"]);
    assert_eq!(check(&Folder::with(&[("d.inp", "*INCLUDE\n")])), ["error[S012]"]);
}

/// CX-08: the order of *SURFACE BEHAVIOR and *GAP CONDUCTANCE.
#[test]
fn cx_08_conductance_without_behavior() {
    let interaction = "*SURFACE INTERACTION, NAME=PAD\n";
    check_deck(&format!("{interaction}*GAP CONDUCTANCE\n100.\n"), &["error[K018]"]);
    let after = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1.E7\n";
    check_deck(&format!("{interaction}*GAP CONDUCTANCE\n100.\n{after}"), &["error[K018]"]);
    check_deck(&format!("{interaction}*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR\n"), &["error[T009]"]);
    check_deck(&format!("{interaction}*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\nabc\n"), &["error[S006]"]);
}

/// CX-09: cards after the pair and inside a step.
#[test]
fn cx_09_cards_anywhere() {
    let pair = "*CONTACT PAIR, INTERACTION=PAD, TYPE=SURFACE TO SURFACE\nSL, MA\n";
    let conductance = "*GAP CONDUCTANCE\n100.\n";
    for deck in [
        format!("{PAD}{pair}{conductance}"),
        format!("{pair}{PAD}{conductance}"),
        format!("*STEP\n*COUPLED TEMPERATURE-DISPLACEMENT\n{PAD}{conductance}*END STEP\n"),
        format!("{PAD}*STEP\n*COUPLED TEMPERATURE-DISPLACEMENT\n{conductance}{pair}*END STEP\n"),
    ] {
        check_deck(&deck, &[]);
        eval_deck(&deck, [1e4, -1e4]);
    }
}

/// CX-10: the rows of *GAP HEAT GENERATION.
#[test]
fn cx_10_heat_generation() {
    let deck =
        |rows: &str| format!("{PAD}*GAP CONDUCTANCE\n100.\n*FRICTION\n0.5, 1.E7\n*GAP HEAT GENERATION\n{rows}\n");
    // Absent items are 0: no speed, no heat.
    for rows in ["0.8", "1., 0.5"] {
        check_deck(&deck(rows), &["warning[C004]"]);
        eval_deck(&deck(rows), [1e4, -1e4]);
    }
    // The last row counts: 0.4 * 125 * 3, a quarter of it into the slave.
    let rows = "0.8, 0.25, 3.\n0.4, 0.25, 3.";
    check_deck(&deck(rows), &["warning[T017]"]);
    eval_deck(&deck(rows), [1e4 + 37.5, -1e4 + 112.5]);
    // Below zero ccx computes the speed: the column counts.
    eval_deck(&deck("0.4, 0.25, -1."), [1e4 + 87.5, -1e4 + 262.5]);
    check_deck(&deck("0., 0.5, 3."), &["error[P004]"]);
    check_deck(&deck("0., 0.5, 3.\n0.4, 0.5, 3."), &["error[P004]", "warning[T017]"]);
    check_deck(&deck(", 0.5, 3."), &["error[P004]", "warning[T013]"]);
}

/// A pair whose keyword ccx passes over is no pair: it runs, and no heat flows; `check` and `eval` say so.
#[test]
fn a_deck_without_a_contact_pair_has_no_contact() {
    let deck = |keyword: &str, step: &str| {
        format!(
            "*NODE\n1, 0., 0., 0.\n*SURFACE, NAME=SL\nA, S1\n*SURFACE, NAME=MA\nB, S1\n{PAD}*GAP CONDUCTANCE\n100.\n\
             {keyword}, INTERACTION=PAD, TYPE=SURFACE TO SURFACE\nSL, MA\n{step}"
        )
    };
    let step = "*STEP\n*COUPLED TEMPERATURE-DISPLACEMENT\n*END STEP\n";
    check_deck(&deck("*CONTACT PAIR", step), &[]);
    // A part of a deck may be included beside the pair.
    check_deck(&deck("*CONTACT PAYR", ""), &["warning[K001]"]);
    let folder = Folder::with(&[("d.inp", &deck("*CONTACT PAYR", step)), ("n.csv", NODES)]);
    assert_eq!(check(&folder), ["warning[R009]", "warning[K001]"]);
    let run = folder.inpact(&[&["eval", "d.inp", "--nodes", "n.csv"], &CALCULIX[..]].concat());
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(
        run.errors.contains("warning[R009] the deck has no contact pair, so that `PAD` has no effect"),
        "{}",
        run.errors
    );
}

/// CX-10: in node-to-surface and massless contact the heat of ccx is another one, which `eval` says with its own.
#[test]
fn cx_10_contact_types_with_another_heat() {
    let deck = |kind: &str| {
        format!(
            "{PAD}*GAP CONDUCTANCE\n100.\n*FRICTION\n0.5, 1.E7\n*GAP HEAT GENERATION\n0.4, 0.25, 3.\n\
             *CONTACT PAIR, INTERACTION=PAD, TYPE={kind}\nSL, MA\n"
        )
    };
    check_deck(&deck("SURFACE TO SURFACE"), &[]);
    for kind in ["NODE TO SURFACE", "massless", "NODE TO SURFACES"] {
        check_deck(&deck(kind), &["warning[C009]", "warning[C009]"]);
    }
    let folder = Folder::with(&[("d.inp", &deck("NODE TO SURFACE")), ("n.csv", NODES)]);
    let run = folder.inpact(&[&["eval", "d.inp", "--nodes", "n.csv"], &CALCULIX[..]].concat());
    for said in
        ["node-to-surface contact reads the table at another pressure", "node-to-surface contact generates no heat"]
    {
        assert!(run.errors.contains(said), "{}", run.errors);
    }
}

/// ccx stops at a node set of ADJUST that is defined nowhere in the deck, whether another setting follows or not.
#[test]
fn the_node_set_of_adjust_is_defined() {
    let deck = |adjust: &str, after: &str| {
        format!(
            "*NODE, NSET=ALL\n1, 0., 0., 0.\n*SURFACE, NAME=SL\nA, S1\n*SURFACE, NAME=MA\nB, S1\n{PAD}\
             *CONTACT PAIR, INTERACTION=PAD, TYPE=SURFACE TO SURFACE, {adjust}\nSL, MA\n{after}"
        )
    };
    for adjust in ["ADJUST=all", "ADJUST=0.", "ADJUST=1.+2", "ADJUST=-1.", "ADJUST=", "ADJUST"] {
        check_deck(&deck(adjust, ""), &[]);
    }
    check_deck(&deck("ADJUST=LATE", "*NSET, NSET=LATE\n1\n"), &[]);
    for adjust in ["ADJUST=NOSET", "ADJUST=\"ALL\"", "ADJUST=1.E"] {
        check_deck(&deck(adjust, "*ELSET, ELSET=NOSET\n1\n"), &["error[R008]"]);
    }
    check_deck(&deck("ADJUST=NOSET, ADJUST=0.", ""), &["error[R008]", "error[K009]"]);
}

/// Of two names of an interaction the first counts, of two interactions of a pair the last.
#[test]
fn the_first_name_counts() {
    let deck = |names: &str, used: &str| {
        format!(
            "{}*GAP CONDUCTANCE\n100.\n*CONTACT PAIR, INTERACTION=TI, INTERACTION={used}, TYPE=SURFACE TO SURFACE\nSL, MA\n",
            PAD.replace("NAME=PAD", names)
        )
    };
    check_deck(&deck("NAME=SI, NAME=\"SI\"", "SI"), &["error[K009]", "error[K009]"]);
    check_deck(&deck("NAME=\"SI\", NAME=SI", "SI"), &["error[K009]", "error[K009]", "error[R006]"]);
    // `inp` writes the one that counts.
    let folder = Folder::with(&[("d.inp", &deck("NAME=SI, NAME=TI", "SI"))]);
    let json = folder.inpact(&[&["json", "d.inp"], &CALCULIX[..]].concat()).output;
    folder.write("m.json", &json);
    let written = folder.inpact(&["inp", "m.json"]);
    assert_eq!(written.code, 0, "{}", written.errors);
    assert!(written.output.contains("*SURFACE INTERACTION, NAME=SI, NAME=TI"), "{}", written.output);
}

/// CX-02: two names that only their quotes tell apart are two, in JSON and in the deck that is made of it.
#[test]
fn cx_02_names_that_quotes_tell_apart_survive_json() {
    let quoted = PAD.replace("=PAD", "=\"PAD\"").replace("1.E7", "2.E7");
    let folder = Folder::with(&[("d.inp", &format!("{PAD}{quoted}"))]);
    assert_eq!(check(&folder), Vec::<String>::new());
    let json = folder.inpact(&[&["json", "d.inp"], &CALCULIX[..]].concat()).output;
    folder.write("m.json", &json);
    let written = folder.inpact(&["inp", "m.json", "-o", "again.inp"]);
    assert_eq!(written.code, 0, "{}", written.errors);
    assert!(written.errors.contains("the deck says this in CalculiX alone"), "{}", written.errors);
    let again = folder.inpact(&[&["json", "again.inp"], &CALCULIX[..]].concat()).output;
    let interactions = |json: &str| {
        let document: serde_json::Value = serde_json::from_str(json).expect("JSON");
        let stiffness = |name: &str| document["interactions"][name]["other"][0]["rows"][0][0].clone();
        [stiffness("PAD"), stiffness("\"PAD\"")]
    };
    assert_eq!(interactions(&json), ["1.E7", "2.E7"]);
    assert_eq!(interactions(&again), interactions(&json));
    // Names that neither dialect tells apart stay refused.
    folder.write("m.json", &json.replace("\"\\\"PAD\\\"\"", "\"pad\""));
    let refused = folder.inpact(&["inp", "m.json"]);
    assert!(refused.code == 1 && refused.errors.contains("duplicate interaction"), "{}", refused.errors);
}

/// CX-05: what CalculiX cannot read in 20 characters is a text in JSON, and comes back.
#[test]
fn cx_05_numbers_that_are_none_survive_json() {
    let deck = format!("{PAD}*GAP CONDUCTANCE\n1.2345678901234568e-05, 0.\n2., 500.\n");
    let folder = Folder::with(&[("d.inp", &deck)]);
    let json = folder.inpact(&[&["json", "d.inp"], &CALCULIX[..]].concat()).output;
    assert!(json.contains("\"1.2345678901234568e-05\""), "{json}");
    folder.write("m.json", &json);
    let written = folder.inpact(&["inp", "m.json"]);
    assert!(
        written.code == 0 && written.output.contains("1.2345678901234568e-05"),
        "{}{}",
        written.output,
        written.errors
    );
}

/// K-06, CX-11: of two interactions of one name the first counts.
#[test]
fn cx_11_the_first_of_two_interactions() {
    let deck = format!("{PAD}*GAP CONDUCTANCE\n50.\n{PAD}*GAP CONDUCTANCE\n100.\n");
    let folder = Folder::with(&[("d.inp", &deck)]);
    let run = folder.inpact(&[&["check", "d.inp"], &CALCULIX[..]].concat());
    assert_eq!(run.code, 1);
    assert!(run.output.contains("CalculiX takes the first for a contact pair"), "{}", run.output);
    let document = folder.inpact(&[&["json", "d.inp"], &CALCULIX[..]].concat()).output;
    let document: serde_json::Value = serde_json::from_str(&document).expect("JSON");
    let others = document["interactions"]["PAD"]["other"].as_array().expect("others");
    let table = others.iter().find(|other| other["keyword"] == "GAP CONDUCTANCE").expect("the option");
    assert_eq!(table["table"]["rows"][0][0], 50.0);
}

/// Curves without pressures in common, and constants that ccx refuses.
#[test]
fn what_ccx_stops_at() {
    check_deck(
        &format!("{PAD}*GAP CONDUCTANCE\n100., 0., 293.\n200., 500., 293.\n150., 600., 393.\n300., 900., 393.\n"),
        &["error[T018]"],
    );
    check_deck(&format!("{PAD}*FRICTION\n0., 1.E7\n"), &["error[P010]"]);
}

/// The curves of CalculiX have no modes: `plan` says so, and the heat is the same whatever is asked for.
#[test]
fn accuracy_changes_nothing_and_the_plan_says_so() {
    const NOTE: &str = "the curves of CalculiX are no plain table";
    let deck = format!("{PAD}*GAP CONDUCTANCE\n100., 0., 293.\n300., 5000., 293.\n150., 0., 393.\n400., 5000., 393.\n");
    let folder = Folder::with(&[("d.inp", &deck), ("n.csv", NODES)]);
    let output = |command: &str, arguments: &[&str]| {
        let all = [&[command, "d.inp", "--nodes", "n.csv"], &CALCULIX[..], arguments].concat();
        let run = folder.inpact(&all);
        assert_eq!(run.code, 0, "{}", run.errors);
        run.output
    };
    let plain = output("eval", &[]);
    assert!(!output("plan", &[]).contains(NOTE));
    for accuracy in ["fast", "reference"] {
        let arguments = ["--accuracy", accuracy];
        assert_eq!(output("eval", &arguments), plain);
        assert!(output("plan", &arguments).contains(NOTE), "{accuracy}");
    }
}
