//! One deck that means two things: `--dialect` and `--release`.

use crate::program::{Folder, inpact};

const CONDUCTANCE: &str = "*SURFACE INTERACTION, NAME=A\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n*GAP CONDUCTANCE\n100., 0., 273.\n120., 1., 273.\n";

/// Checks `d.inp`; gives severity and code of each finding, and the exit code.
fn check(folder: &Folder, options: &[&str]) -> (Vec<String>, i32) {
    let run = folder.inpact(&[&["check", "--format", "concise", "d.inp"], options].concat());
    (run.output.lines().map(|line| line.split(' ').nth(1).expect("a severity").to_owned()).collect(), run.code)
}

#[test]
fn the_columns_of_gap_conductance() {
    let folder = Folder::with(&[("d.inp", CONDUCTANCE)]);
    let columns = |dialect| {
        let run = folder.inpact(&["json", "--dialect", dialect, "d.inp"]);
        let document: serde_json::Value = serde_json::from_str(&run.output).expect("JSON");
        let others = document["interactions"]["A"]["other"].as_array().expect("others").clone();
        let table = others.into_iter().find(|other| other["keyword"] == "GAP CONDUCTANCE").expect("the option");
        table["table"]["columns"].to_string()
    };
    assert_eq!(columns("abaqus"), r#"["conductance","clearance","temp","mass_flow"]"#);
    assert_eq!(columns("calculix"), r#"["conductance","pressure","temp"]"#);
}

#[test]
fn conductance_that_rises_is_odd_against_clearance_and_not_against_pressure() {
    let folder = Folder::with(&[("d.inp", CONDUCTANCE)]);
    assert_eq!(check(&folder, &[]), (vec!["warning[P005]".to_owned()], 0));
    assert_eq!(check(&folder, &["--dialect", "calculix"]), (vec![], 0));
}

#[test]
fn t_016_more_rows_than_calculix_has_room_for() {
    let deck = |rows: usize| {
        let rows: String = (0..rows).map(|row| format!("{}., {row}., 273.\n", 100 + row)).collect();
        format!(
            "*SURFACE INTERACTION, NAME=A\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n*GAP CONDUCTANCE, PRESSURE\n{rows}"
        )
    };
    let folder = Folder::with(&[("d.inp", &deck(21).replace(", PRESSURE\n", "\n"))]);
    assert_eq!(check(&folder, &["--dialect", "calculix"]), (vec!["warning[T016]".to_owned()], 0));
    folder.write("d.inp", &deck(20).replace(", PRESSURE\n", "\n"));
    assert_eq!(check(&folder, &["--dialect", "calculix"]), (vec![], 0));
    folder.write("d.inp", &deck(21));
    assert_eq!(check(&folder, &[]), (vec![], 0));
}

#[test]
fn keyword_lines_go_on_in_abaqus_only() {
    let deck = "*SURFACE INTERACTION,\nNAME=A\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n";
    let folder = Folder::with(&[("d.inp", deck)]);
    assert_eq!(check(&folder, &[]), (vec![], 0));
    let (found, code) = check(&folder, &["--dialect", "calculix"]);
    assert_eq!(code, 1);
    assert!(found.contains(&"warning[S003]".to_owned()) && found.contains(&"error[K006]".to_owned()), "{found:?}");
}

#[test]
fn an_unknown_keyword_is_an_error_in_abaqus_and_a_warning_in_calculix() {
    let folder = Folder::with(&[("d.inp", "*NODD PRINT\n*NODE\n1, 0.\n")]);
    assert_eq!(check(&folder, &[]), (vec!["error[K001]".to_owned()], 1));
    assert_eq!(check(&folder, &["--dialect", "calculix"]), (vec!["warning[K001]".to_owned()], 0));
    // Keywords of one of the two programs.
    folder.write("d.inp", "*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n");
    let (found, _) = check(&folder, &["--dialect", "calculix"]);
    assert!(found.contains(&"warning[K001]".to_owned()), "{found:?}");
}

#[test]
fn the_third_item_of_gap_heat_generation_and_the_file_of_include() {
    let heat = "*SURFACE INTERACTION, NAME=A\n*FRICTION\n.3, 1.E6\n*GAP HEAT GENERATION\n1., .5, 3.\n";
    let folder = Folder::with(&[("heat.inp", heat), ("d.inp", "*INCLUDE, FILE=heat.inp\n")]);
    assert_eq!(check(&folder, &["--dialect", "calculix"]), (vec![], 0));
    let (found, code) = check(&folder, &[]);
    assert_eq!((found, code), (vec!["note[K004]".to_owned(), "error[T006]".to_owned()], 1));
    folder.write("d.inp", heat);
    let (found, code) = check(&folder, &[]);
    assert_eq!(code, 1);
    assert!(found.contains(&"error[T006]".to_owned()), "{found:?}");
}

#[test]
fn releases_know_what_they_knew() {
    let deck = "*SURFACE INTERACTION, NAME=A\n\
                *CONTACT PERMEABILITY, CONSTRAINT METHOD=DIRECT, CUTOFF FLOW ACROSS=1., CUTOFF GAP FILL=1.\n1., 0.\n\
                *GAP DIFFUSIVITY, TYPE=ION CONCENTRATION, CUTOFF FLOW ACROSS=1., CUTOFF GAP FILL=1.\n1., 0.\n";
    let folder = Folder::with(&[("d.inp", deck)]);
    let errors =
        |release| check(&folder, &["--release", release]).0.iter().filter(|found| *found == "error[K015]").count();
    let counts: Vec<usize> = ["6.11", "6.14", "2016", "2017", "2022", "2024"].map(errors).to_vec();
    // CONSTRAINT METHOD is of 2017, *GAP DIFFUSIVITY of 2023.
    assert_eq!(counts, [2, 2, 2, 1, 1, 0]);
    assert_eq!(check(&folder, &[]).1, 0, "2024 is what counts unless another is named");
    assert_eq!(check(&folder, &["--release", "6.13"]).1, 2);
}

#[test]
fn abbreviations_follow_the_keywords_of_the_release() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAPC\n1., 0.\n.5, 1.\n";
    let folder = Folder::with(&[("d.inp", deck)]);
    assert_eq!(check(&folder, &["--release", "6.14"]), (vec!["note[K003]".to_owned()], 0));
    // *GAP CONVECTION came later.
    assert_eq!(check(&folder, &[]), (vec!["error[K002]".to_owned()], 1));
}

#[test]
fn every_command_reads_by_the_dialect_it_is_given() {
    let folder =
        Folder::with(&[("d.inp", "*SURFACE INTERACTION,NAME=A\n*GAP CONDUCTANCE\n100.,0.,273.\n120.,1.,273.\n")]);
    for command in [&["json"][..], &["fmt", "--check"]] {
        let run = folder.inpact(&[command, &["--dialect", "fortran", "d.inp"]].concat());
        assert_eq!(run.code, 2, "{}", run.errors);
    }
    let abaqus = folder.inpact(&["json", "d.inp"]).output;
    assert_ne!(abaqus, folder.inpact(&["json", "--dialect", "calculix", "d.inp"]).output);
}

/// The sample deck by both: what a user sees when one deck means two things.
#[test]
fn one_deck_evaluated_as_abaqus_and_as_calculix_have_it() {
    let eval = |dialect| {
        let (deck, nodes) = ("decks/dialects/two-meanings.inp", "decks/dialects/two-meanings-nodes.csv");
        let run = inpact(&["eval", deck, "--nodes", nodes, "--dialect", dialect]);
        assert_eq!(run.code, 0, "{}", run.errors);
        run.output
    };
    let both = format!("--- abaqus\n{}--- calculix\n{}", eval("abaqus"), eval("calculix"));
    insta::assert_snapshot!(both);
}

/// Tables that ccx takes without a word and reads wrongly are refused with codes of our own, and not evaluated.
#[test]
fn what_calculix_reads_wrongly_is_refused() {
    let row = |rows: &str| {
        format!("*SURFACE INTERACTION,NAME=SI\n*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=HARD\n*GAP CONDUCTANCE\n{rows}")
    };
    let cases = [
        ("100.,0.,293.\n400.,1000.,293.\n200.,500.,293.\n1000.,5000.,293.\n", "error[T001]"),
        ("1000.,5000.,293.\n400.,1000.,293.\n200.,500.,293.\n100.,0.,293.\n", "error[T001]"),
        ("100.,0.,293.\n200.,500.,293.\n300.,500.,293.\n1000.,5000.,293.\n", "error[T002]"),
        ("-100.,0.,293.\n200.,500.,293.\n", "error[P001]"),
        ("100.,0.,393.\n200.,500.,393.\n100.,0.,293.\n", "error[T003]"),
    ];
    for (rows, code) in cases {
        let folder =
            Folder::with(&[("d.inp", &row(rows)), ("n.csv", "clearance,pressure,temp_s,temp_m\n0,750,393,293\n")]);
        let (found, exit) = check(&folder, &["--dialect", "calculix"]);
        assert!(found.contains(&code.to_owned()) && exit == 1, "{rows}: {found:?}");
        let run = folder.inpact(&["eval", "d.inp", "--nodes", "n.csv", "--dialect", "calculix"]);
        assert_eq!((run.code, run.output.as_str()), (1, ""), "{}", run.errors);
    }
}

/// The dialect may occur in the configuration; with the third item of *GAP HEAT GENERATION as the speed.
#[test]
fn the_dialect_of_the_configuration_counts_for_eval() {
    let deck = "*SURFACE INTERACTION,NAME=SI\n*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=HARD\n*GAP CONDUCTANCE\n100.,0.,0.\n\
                *FRICTION\n0.5,1.E7\n*GAP HEAT GENERATION\n0.8,0.25,3.\n";
    let nodes = "closed,pressure,temp_s,temp_m,shear\n1,1000,303.8,306.2,500\n";
    let folder = Folder::with(&[("d.inp", deck), ("n.csv", nodes), ("inpact.toml", "dialect = \"calculix\"\n")]);
    let run = folder.inpact(&["eval", "d.inp", "--nodes", "n.csv"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let mut lines = run.output.lines();
    assert_eq!(
        lines.next(),
        Some("HFL,SFDR,WEIGHT,thermal_conductance,heat_conduction,total_heat_s,total_heat_m,status")
    );
    // The faces that the network of the reference run settles at: 540 into the one side, 660 into the other.
    let numbers: Vec<f64> = lines.next().expect("a row").split(',').filter_map(|cell| cell.parse().ok()).collect();
    let expected = [-540.0, 1200.0, 0.25, 100.0, -240.0, 540.0, 660.0];
    assert!(numbers.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-9), "{numbers:?}");
}
