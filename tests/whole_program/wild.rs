//! Decks as people write and post them: what Abaqus makes of each is what `check` says, and no more.

use crate::program::{Folder, Run};

/// Checks a deck; gives its findings, a line each.
fn check(deck: &str) -> (i32, Vec<String>) {
    let folder = Folder::with(&[("d.inp", deck)]);
    let run = folder.inpact(&["check", "--isolated", "--format", "concise", "d.inp"]);
    (run.code, run.output.lines().map(str::to_owned).collect())
}

/// The codes of the findings that are no notes.
fn codes(found: &[String]) -> Vec<&str> {
    let of_line = |line: &'_ str| -> Option<(usize, usize)> { Some((line.find('[')? + 1, line.find(']')?)) };
    let grave = found.iter().filter(|line| !line.contains(": note["));
    grave.filter_map(|line| of_line(line).map(|(start, end)| &line[start..end])).collect()
}

#[track_caller]
fn assert_codes(deck: &str, code: i32, expected: &[&str]) -> Vec<String> {
    let (exit, found) = check(deck);
    assert_eq!((exit, codes(&found).as_slice()), (code, expected), "{found:#?}");
    found
}

const EXPLICIT: &str = "\
*SURFACE INTERACTION, NAME=PIPE, USER=INTERACTION, DEPVAR=5, PROPERTIES=10
1., 2., 3., 4., 5., 6., 7., 8.
9., 10.
*STEP
*DYNAMIC, EXPLICIT
, 1.
*CONTACT
*CONTACT INCLUSIONS, ALL EXTERIOR
*CONTACT PROPERTY ASSIGNMENT
, , PIPE
*END STEP
";

#[test]
fn k_03_rows_of_a_user_interaction_in_explicit_are_its_properties() {
    assert_codes(EXPLICIT, 0, &[]);
    let folder = Folder::with(&[("d.inp", EXPLICIT)]);
    let json = folder.inpact(&["json", "--isolated", "d.inp", "-o", "d.json"]);
    assert_eq!(json.code, 0, "{}", json.errors);
    let text = folder.read("d.json");
    assert!(text.contains("\"properties\": [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0]"), "{text}");
    let deck = folder.inpact(&["inp", "d.json"]);
    assert!(deck.output.contains("PROPERTIES=10\n1., 2., 3., 4., 5., 6., 7., 8.\n9., 10.\n"), "{}", deck.output);
}

#[test]
fn k_02_the_number_of_properties_is_compared() {
    let deck = |stated: &str| format!("*SURFACE INTERACTION, NAME=A, USER, PROPERTIES={stated}\n1.,\n1., 2., 3.\n");
    assert_codes(&deck("3"), 0, &[]);
    let found = assert_codes(&deck("4"), 1, &["T007"]);
    assert!(found.iter().any(|line| line.contains("`PROPERTIES=4`, and 3 values are given")), "{found:#?}");
    assert_codes(&deck("2"), 1, &["T006"]);
    // K-02: the blank line stands for the thickness.
    assert_codes("*SURFACE INTERACTION, NAME=A, USER, PROPERTIES=2\n\n1., 2.\n", 0, &[]);
    // S-62: a parameter is a value as well.
    assert_codes("*PARAMETER\nt = 2.5\n*SURFACE INTERACTION, NAME=A\n<t>,\n", 0, &[]);
}

#[test]
fn parameters_of_release_2024_are_known() {
    let deck = "*SURFACE INTERACTION, NAME=GLUE, RATE FACTOR=0.9, RATE INTERPOLATION=LOGARITHMIC\n*FRICTION\n0.2,\n";
    assert_codes(deck, 0, &[]);
    let folder = Folder::with(&[("d.inp", deck)]);
    let run = folder.inpact(&["check", "--isolated", "--release", "2022", "--format", "concise", "d.inp"]);
    assert_eq!((run.code, run.output.matches("error[K015]").count()), (1, 2), "{}", run.output);
}

#[test]
fn a_user_interaction_excludes_its_mechanical_options() {
    let deck =
        "*SURFACE INTERACTION, NAME=WELD, USER\n1.,\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n*FRICTION\n0.3,\n";
    assert_codes(deck, 1, &["K016", "K016"]);
}

#[test]
fn s_22_the_name_that_was_sought_is_said() {
    let folder = Folder::with(&[
        ("d.inp", "*INCLUDE, INPUT=node sets.inp\n"),
        ("node sets.inp", "*SURFACE INTERACTION, NAME=A\n"),
    ]);
    let run = folder.inpact(&["check", "--isolated", "--format", "concise", "d.inp"]);
    assert!(run.output.contains("`nodesets.inp` cannot be included"), "{}", run.output);
    let run = folder.inpact(&["check", "--isolated", "--format", "json", "d.inp"]);
    assert!(run.output.contains(r#"write `\"node sets.inp\"`"#), "{}", run.output);
}

#[test]
fn s_50_file_is_read_as_input() {
    let folder =
        Folder::with(&[("d.inp", "*INCLUDE, FILE=p.inp\n"), ("p.inp", "*SURFACE INTERACTION, NAME=A\n-1.,x\n")]);
    let run = folder.inpact(&["check", "--isolated", "--format", "concise", "d.inp"]);
    assert!(run.output.contains("note[K004] `FILE` of `*INCLUDE` is read as `INPUT`"), "{}", run.output);
    assert!(run.output.contains("p.inp:2:"), "the file is read: {}", run.output);
    assert!(!run.output.contains("K006"), "{}", run.output);
}

const INVISIBLE: &str = "\
*SURFACE\u{A0}INTERACTION, NAME=G
*SURFACE INTERACTION,\u{A0}NAME=H
*GAP CONDUCTANCE, PRESSURE
1., 0.
2., 1.e\u{2212}3
\u{FEFF}*SURFACE INTERACTION, NAME=K
";

#[test]
fn invisible_characters_are_named_and_mended() {
    let (code, found) = check(INVISIBLE);
    assert_eq!(code, 1);
    for (code, said) in [
        ("K001", "a no-break space (U+00A0) in `*SURFACE INTERACTION`"),
        ("K004", "a no-break space (U+00A0) in the parameter `NAME`"),
        ("S006", "a minus sign that is not `-` (U+2212) in the number `1.e-3`"),
        ("S021", "a byte order mark (U+FEFF) in front of `*SURFACE INTERACTION`"),
    ] {
        let line = format!("error[{code}] {said}");
        assert!(found.iter().any(|found| found.contains(&line)), "{line}: {found:#?}");
    }
    let folder = Folder::with(&[("d.inp", INVISIBLE)]);
    folder.inpact(&["check", "--isolated", "--fix-also", "K001,K004,S006,S021", "d.inp"]);
    assert!(folder.read("d.inp").is_ascii(), "{}", folder.read("d.inp"));
}

#[test]
fn a_comment_after_data_is_recognised() {
    let deck = "*SURFACE INTERACTION, NAME=G\n*GAP CONDUCTANCE\n3000., 0.   ** closed\n0., 0.1 ! open\n";
    let folder = Folder::with(&[("d.inp", deck)]);
    let run = folder.inpact(&["check", "--isolated", "--format", "json", "d.inp"]);
    assert_eq!(run.output.matches("a comment has a line of its own").count(), 2, "{}", run.output);
}

#[test]
fn a_keyword_without_its_asterisk_is_an_error() {
    assert_codes("SURFACE INTERACTION, NAME=A\n", 1, &["S021"]);
    let deck = "*SURFACE INTERACTION, NAME=A\n*FRICTION\n0.1,\nSURFACE INTERACTION, NAME=B\n*GAP CONDUCTANCE\n1., 0.\n0., 1.\n";
    assert_codes(deck, 1, &["S021"]);
    assert_codes("*SURFACE INTERACTION, NAME=A\nGAP CONDUCTANCE\n3., 0.\n0., 1.\n", 1, &["S021"]);
    // Names of sets and surfaces are rows.
    assert_codes("*CONTACT PAIR, INTERACTION=A\nSURFACE, STEP\n*SURFACE INTERACTION, NAME=A\n", 0, &[]);
}

#[test]
fn s_19_flags_on_a_line_of_their_own_stay_flags() {
    let deck = "*ELSET, ELSET=E,\nGENERATE\n1, 5, 1\n*NSET, NSET=N,\nGENERATE\n1, 5, 1\n*STEP, NAME=LOAD,\nNLGEOM\n*STATIC\n1., 1.\n\
                *BOUNDARY, TYPE=VELOCITY,\nFIXED\n*END STEP\n";
    assert_codes(deck, 0, &[]);
    let folder = Folder::with(&[("d.inp", deck)]);
    folder.inpact(&["check", "--isolated", "--fix", "d.inp"]);
    assert_eq!(folder.read("d.inp"), deck);
    let json = folder.inpact(&["json", "--isolated", "--view", "syntax", "d.inp"]);
    assert!(json.output.contains("NLGEOM"), "{}", json.output);
}

#[test]
fn s_70_indented_asterisks_in_a_title_are_text() {
    let deck = "*HEADING\nbrake disc, run 12\n   ** second line of the title\n*SURFACE INTERACTION, NAME=A\n";
    assert_codes(deck, 0, &[]);
    let folder = Folder::with(&[("d.inp", deck)]);
    folder.inpact(&["check", "--isolated", "--fix", "d.inp"]);
    assert_eq!(folder.read("d.inp"), deck);
}

#[test]
fn s_34_floats_are_written_within_twenty_characters_where_they_can_be() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n1.2345678901234568e-05, -1.2345678901234568e-150\n\
                1.2345678901234569e+23, 0.30000000000000004\n";
    let folder = Folder::with(&[("d.inp", deck)]);
    folder.inpact(&["json", "--isolated", "d.inp", "-o", "d.json"]);
    let run = folder.inpact(&["inp", "d.json"]);
    assert!(run.output.contains("12345678901234569E7, 0.30000000000000004"), "{}", run.output);
    let run = folder.inpact(&["check", "--isolated", "--format", "json", "d.inp"]);
    assert!(
        run.output.contains("no 20 characters say this number: `1.234567890123457E-5` is the nearest"),
        "{}",
        run.output
    );
    let long = "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n1.2345678901234569e+23, 0.\n2e23, 1.\n";
    let folder = Folder::with(&[("d.inp", long)]);
    let run = folder.inpact(&["check", "--isolated", "--format", "json", "d.inp"]);
    assert!(run.output.contains("write `12345678901234569E7`, which is the same number"), "{}", run.output);
}

#[test]
fn a_08_integers_divide_as_the_release_does() {
    let deck = "*PARAMETER\nsg = 5/4\n*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n<sg>, 0.\n0., 1.\n";
    let folder = Folder::with(&[("d.inp", deck), ("n.csv", "node,clearance,epot_jump\n1,0,1\n")]);
    for (release, value) in [("2024", "1.25"), ("2022", "1")] {
        let json = folder.inpact(&["json", "--isolated", "--release", release, "d.inp", "-o", "d.json"]);
        assert_eq!(json.code, 0, "{}", json.errors);
        let run = folder.inpact(&[
            "eval",
            "--isolated",
            "--release",
            release,
            "d.inp",
            "--nodes",
            "n.csv",
            "--outputs",
            "ECD",
        ]);
        assert!(run.output.lines().any(|line| line == format!("1,{value}")), "{release}: {}{}", run.output, run.errors);
        assert!(run.errors.contains("S019"), "{}", run.errors);
        // `inp` reads the output of `json`, in any release.
        assert_eq!(folder.inpact(&["inp", "d.json"]).code, 0);
    }
}

#[test]
fn r_004_the_instance_counts() {
    let deck = |slave: &str| {
        format!(
            "*PART, NAME=P\n*NODE\n1, 0., 0.\n*SURFACE, NAME=S\n*END PART\n*PART, NAME=Q\n*SURFACE, NAME=M\n*END PART\n\
             *ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n*INSTANCE, NAME=J, PART=Q\n*END INSTANCE\n\
             *SURFACE, NAME=T\n*END ASSEMBLY\n*SURFACE INTERACTION, NAME=X\n*CONTACT PAIR, INTERACTION=X\n{slave}, J.M\n"
        )
    };
    for right in ["I.S", "A.I.S", "A.T", "T"] {
        assert_codes(&deck(right), 0, &[]);
    }
    for wrong in ["J.S", "K.S", "B.I.S", "I.T"] {
        assert_codes(&deck(wrong), 1, &["R004"]);
    }
}

#[test]
fn json_that_says_a_key_twice_is_refused() {
    let interaction = |thickness: &str| {
        format!(
            r#""A":{{"name":"A","thickness":{thickness},"parameters":{{}},"properties":[],"gap_electrical_conductance":null,"contact_permeability":null,"gap_heat_generation":null,"other":[]}}"#
        )
    };
    let json = format!(
        r#"{{"schema":"inpact/model/1","source":"x","parameters":[],"interactions":{{{},{}}},"contact_pairs":[],"property_assignments":[],"procedures":[]}}"#,
        interaction("1.0"),
        interaction("2.0")
    );
    let folder = Folder::with(&[("i.json", json.as_str())]);
    let run: Run = folder.inpact(&["inp", "i.json"]);
    assert_eq!(run.code, 1, "{}", run.output);
    assert!(run.errors.contains("at `interactions`: duplicate key `A`"), "{}", run.errors);
}

#[test]
fn json_of_heat_without_a_number_and_of_procedures_between_steps_comes_back() {
    for deck in [
        "*SURFACE INTERACTION, NAME=A\n*GAP HEAT GENERATION\n<a>, 0.\n",
        "*STEP\n*FREQUENCY\n*END STEP\n*COMPLEX FREQUENCY\n*STEP\n*STATIC\n*END STEP\n",
    ] {
        let folder = Folder::with(&[("d.inp", deck)]);
        folder.inpact(&["json", "--isolated", "d.inp", "-o", "d.json"]);
        assert!(!folder.read("d.json").contains("\"fraction\": null"), "{}", folder.read("d.json"));
        let run = folder.inpact(&["inp", "d.json"]);
        assert_eq!((run.code, run.output.as_str()), (0, deck), "{}", run.errors);
    }
}

#[test]
fn what_feeds_an_evaluation_or_could_is_an_error_of_the_run() {
    let nodes = "node,clearance,epot_jump\n1,0,1\n";
    let law = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n";
    let mesh = "*INCLUDE, INPUT=mesh.inp\n*NODE\n1, 0., 0.\n";
    for (deck, code) in [
        // A statement that is not executed leaves a value that an earlier one gave.
        (format!("*PARAMETER\nsg = 5.\nsg == 7.\n{law}<sg>, 0.\n0., 1.\n"), 1),
        (format!("*PARAMETER\nsg = 5.\nother == 7.\n{law}5., 0.\n0., 1.\n"), 0),
        // Rows, or another option, may occur in a file that is not there.
        (format!("{law}5., 0.\n*INCLUDE, INPUT=rows.inp\n"), 1),
        (format!("{law}5., 0.\n0., 1.\n*INCLUDE, INPUT=heat.inp\n"), 1),
        (format!("{mesh}{law}5., 0.\n0., 1.\n"), 0),
        // So may the definition that counts.
        (format!("{mesh}*PARAMETER\nsg = 5.\n{law}<sg>, 0.\n0., 1.\n"), 1),
        // A misplaced option is likely meant for the interaction above it.
        (format!("{law}5., 0.\n0., 1.\n*NODE\n1, 0., 0.\n*GAP HEAT GENERATION\n0.5, 0.5\n"), 1),
    ] {
        let folder = Folder::with(&[("d.inp", deck.as_str()), ("n.csv", nodes)]);
        for command in ["eval", "plan"] {
            let run = folder.inpact(&[command, "--isolated", "d.inp", "--nodes", "n.csv"]);
            assert_eq!(run.code, code, "{command} of\n{deck}{}", run.errors);
        }
    }
}
