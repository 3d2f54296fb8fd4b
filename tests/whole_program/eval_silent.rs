//! `inpact eval` says what it leaves out, and gives no result that lacks a part of what its name promises.

use crate::program::{Folder, Run, inpact};

/// A deck and a node table, and what a run on them gives.
struct Case {
    folder: Folder,
}

impl Case {
    fn new(deck: &str, nodes: &str) -> Self {
        Self { folder: Folder::with(&[("deck.inp", deck), ("nodes.csv", nodes)]) }
    }

    fn eval(&self, arguments: &[&str]) -> Run {
        self.folder.inpact(&[&["eval", "deck.inp", "--nodes", "nodes.csv"], arguments].concat())
    }

    fn plan(&self) -> String {
        self.folder.inpact(&["plan", "deck.inp", "--nodes", "nodes.csv"]).output
    }

    /// The cells of some columns, a line a row, of a run without errors.
    fn columns(&self, names: &[&str], arguments: &[&str]) -> Vec<String> {
        columns(&self.eval(arguments), names)
    }
}

/// The cells of some columns, a line a row, of a run without errors.
fn columns(run: &Run, names: &[&str]) -> Vec<String> {
    assert_eq!(run.code, 0, "{}", run.errors);
    let mut lines = run.output.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let place = |name: &&str| header.iter().position(|column| column == name);
    let places: Vec<usize> =
        names.iter().map(|name| place(name).unwrap_or_else(|| panic!("{name}: {header:?}"))).collect();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        places.iter().map(|place| cells[*place]).collect::<Vec<_>>().join(",")
    };
    lines.map(row).collect()
}

const HEATED: &str =
    "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., 1.\n*GAP CONDUCTANCE\n20., 0.\n10., 1.\n";
const ELECTRICAL_STEP: &str = "*STEP\n*COUPLED THERMAL-ELECTRICAL\n1., 1.\n*END STEP\n";
const THERMAL_STEP: &str = "*STEP\n*HEAT TRANSFER\n1., 1.\n*END STEP\n";

/// The heat of the current is a part of HFL (H-05): where it is not known, neither is HFL.
#[test]
fn heat_without_the_heat_of_the_current_is_left_out() {
    let user = HEATED.replace("*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., 1.\n", "*GAP ELECTRICAL CONDUCTANCE, USER\n");
    for (deck, nodes, reason) in [
        (
            HEATED.to_owned() + ELECTRICAL_STEP,
            "clearance,temp_s,temp_m,epot_s\n0.5,1,2,3\n",
            "`epot_m` (or `epot_jump`) is missing",
        ),
        (HEATED.to_owned(), "clearance,temp_s,temp_m\n0.5,1,2\n", "`epot_s` and `epot_m` (or `epot_jump`) are missing"),
        (user + ELECTRICAL_STEP, "clearance,temp_s,temp_m,epot_jump\n0.5,1,2,3\n", "needs user subroutine GAPELECTR"),
    ] {
        let case = Case::new(&deck, nodes);
        let run = case.eval(&[]);
        assert_eq!(columns(&run, &["heat_conduction"]), ["-15"]);
        let header = run.output.lines().next().expect("a header");
        for name in ["HFL", "total_heat_s", "total_heat_m"] {
            assert!(!header.split(',').any(|column| column == name), "{name}: {header}");
        }
        let said = format!(
            "`HFL`, `HFLA`, `HTL`, `HTLA`, `total_heat_s`, `total_heat_m`: the heat of the current is part of it and is not known: {reason}"
        );
        assert!(run.errors.contains(&said), "{}", run.errors);
        assert!(case.plan().contains(&said), "{}", case.plan());
        let json = case.eval(&["--format", "json"]);
        assert!(json.errors.contains("the heat of the current is part of it and is not known"), "{}", json.errors);
        for name in ["HFL", "total_heat_m"] {
            let requested = case.eval(&["--outputs", name]);
            assert_eq!((requested.code, requested.output.as_str()), (1, ""), "{}", requested.errors);
            assert!(
                requested.errors.contains(&format!("D001] `{name}` is asked for and cannot be given")),
                "{}",
                requested.errors
            );
        }
    }
}

/// In a row without potentials HFL has no number, whatever other rows have.
#[test]
fn heat_of_a_row_without_potentials_has_no_number() {
    let case = Case::new(HEATED, "clearance,temp_s,temp_m,epot_jump\n0.5,1,2,3\n0.5,1,2,\n");
    // −15 conducted, half of 15 · 9 generated.
    assert_eq!(case.columns(&["HFL", "heat_conduction"], &[]), ["-82.5,-15", ",-15"]);
}

/// Without a procedure that solves for a current there is none (section 9.2): HFL is whole, and `eval` says so.
#[test]
fn without_an_electrical_procedure_there_is_no_heat_of_a_current() {
    let case = Case::new(&(HEATED.to_owned() + THERMAL_STEP), "clearance,temp_s,temp_m\n0.5,1,2\n");
    let run = case.eval(&[]);
    assert_eq!(columns(&run, &["HFL"]), ["-15"]);
    assert!(
        run.errors.contains("without the heat of a current: no procedure of the deck solves for one"),
        "{}",
        run.errors
    );
}

/// Every note of the plan is said by `eval`, as text and as JSON.
#[test]
fn eval_says_every_note_of_the_plan() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*FRICTION\n0.3,\n*GAP CONDUCTANCE\n20., 0.\n10., 1.\n*CONTACT PERMEABILITY\n1e-3, 0.\n*STEP\n*SOILS, CONSOLIDATION\n1., 1.\n*END STEP\n";
    let case = Case::new(deck, "clearance,temp_s,temp_m,por_s,por_m\n0.5,1,2,1,2\n,1,2,1,2\n");
    let (run, json, plan) = (case.eval(&[]), case.eval(&["--format", "json"]), case.plan());
    let notes: Vec<&str> = plan.lines().filter_map(|line| line.trim().strip_prefix("note: ")).collect();
    assert!(4 <= notes.len(), "{plan}");
    for note in notes {
        assert!(run.errors.contains(note), "{note}\n{}", run.errors);
        assert!(json.errors.contains(note), "{note}\n{}", json.errors);
    }
    assert!(run.errors.contains("without the heat of friction, which is left out"), "{}", run.errors);
    for lost in plan.lines().filter_map(|line| line.strip_prefix("  without ")) {
        assert!(run.errors.contains(lost), "{lost}\n{}", run.errors);
    }
}

/// Q-39: the last procedure that solves a law's field decides for all rows.
#[test]
fn eval_says_which_of_several_procedures_decides() {
    let steps = "*STEP\n*COUPLED THERMAL-ELECTRICAL, STEADY STATE\n1., 1.\n*END STEP\n".to_owned() + ELECTRICAL_STEP;
    let case = Case::new(
        &(HEATED.to_owned() + &steps),
        "node,time,clearance,epot_jump,temp_s,temp_m\n1,0,0.5,2,0,0\n1,1,0.5,5,0,0\n",
    );
    let run = case.eval(&[]);
    // The mean of a jump from 2 to 5, as A-21 has it: 15 · 39 / 3.
    assert_eq!(columns(&run, &["SJD"]), ["60", "195"]);
    let said = "electrical law, transient by *COUPLED THERMAL-ELECTRICAL of step 2, the last that solves its field; 1 procedure before it is of the other kind";
    assert!(run.errors.contains(said), "{}", run.errors);
    assert!(case.plan().contains(said));
    let of_json = said.strip_prefix("electrical law, ").expect("it begins so");
    assert!(case.eval(&["--format", "json"]).errors.contains(of_json));
}

/// Q-40: every law has a status of its own, and `status` is the gravest.
#[test]
fn each_law_has_its_status() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., 0.1\n*GAP CONDUCTANCE\n20., 0.\n10., 0.01\n*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.05\n1\n";
    let nodes = "clearance,epot_jump,temp_s,temp_m,por_s,por_m\n0,1,2,1,2,1\n0.005,1,2,1,2,1\n0.02,1,2,1,2,1\n0.06,1,2,1,2,1\n0.2,1,2,1,2,1\n";
    let case = Case::new(deck, nodes);
    let expected = [
        "closed,closed,closed,closed",
        "open,open,open,open",
        "beyond_table,open,beyond_table,open",
        "beyond_table,open,beyond_table,cutoff",
        "beyond_table,beyond_table,beyond_table,cutoff",
    ];
    let names = ["status", "electrical_status", "thermal_status", "pore_status"];
    let run = case.eval(&[]);
    assert_eq!(columns(&run, &names), expected);
    assert!(run.errors.contains("3 beyond a table, 2 beyond the cutoff of flow across"), "{}", run.errors);
    assert_eq!(
        case.columns(&["pore_status"], &["--outputs", "pore_status"]),
        ["closed", "open", "open", "cutoff", "cutoff"]
    );
    // One law alone needs no column of its own, but may be asked for it.
    let alone =
        Case::new(&deck[..deck.find("*GAP CONDUCTANCE").expect("it is there")], "clearance,epot_jump\n0,1\n0.2,1\n");
    assert!(!alone.eval(&[]).output.contains("electrical_status"));
    assert_eq!(alone.columns(&["electrical_status"], &["--outputs", "electrical_status"]), ["closed", "beyond_table"]);
}

const TWO_TABLES: &str = "*SURFACE INTERACTION, NAME=Weld\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., 0.1\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n50., 0.\n70., 250.\n";

/// S-02: a line ends with LF, CRLF or a lone CR.
#[test]
fn lines_of_a_node_table_end_with_any_line_end() {
    for end in ["\n", "\r\n", "\r"] {
        for last in ["", end] {
            let text = ["clearance,pressure,epot_jump", "0.05,0,1", "0.06,0,1"].join(end) + last;
            let case = Case::new(TWO_TABLES, &text);
            assert_eq!(case.columns(&["ECD"], &[]), ["15", "14"], "{text:?}");
        }
    }
    let mixed =
        Case::new(TWO_TABLES, "node,clearance,pressure,epot_jump\r\"a\rb\",0.05,0,1\n2,0.06,0,1\r\n3,0.05,0,1\r");
    assert_eq!(mixed.columns(&["ECD"], &[]), ["15", "14", "15"].map(str::to_owned)[..], "quotes keep a CR");
}

/// A file that is no node table is named, with the remedy.
#[test]
fn files_that_are_no_node_table_are_called_by_their_name() {
    let folder = Folder::with(&[("deck.inp", TWO_TABLES)]);
    let wide = |first: &[u8], unit: fn(u8) -> [u8; 2]| -> Vec<u8> {
        first
            .iter()
            .copied()
            .chain(b"clearance,pressure,epot_jump\n0.05,0,1\n".iter().flat_map(|byte| unit(*byte)))
            .collect()
    };
    for (name, bytes, cause, cure) in [
        ("good.csv.gz", b"\x1F\x8B\x08\0\0\0\0\0\0\x03\x4B".to_vec(), "compressed with gzip", "gunzip"),
        ("x.xlsx", b"PK\x03\x04\x14\0\0\0".to_vec(), "workbooks (.xlsx, .ods)", "comma-separated values"),
        ("p.png", b"\x89PNG\r\n\x1A\n\0\0".to_vec(), "a picture (PNG)", "node table"),
        ("u16.csv", wide(b"\xFF\xFE", |byte| [byte, 0]), "text in UTF-16", "UTF-8"),
        ("u16le.csv", wide(b"", |byte| [byte, 0]), "text in UTF-16", "UTF-8"),
        ("u16be.csv", wide(b"", |byte| [0, byte]), "text in UTF-16", "UTF-8"),
        ("nodes.json", b"[{\"clearance\": 0.05}]".to_vec(), "JSON", "comma-separated values"),
        ("deck2.inp", TWO_TABLES.as_bytes().to_vec(), "a deck", "--nodes"),
    ] {
        std::fs::write(folder.path().join(name), bytes).expect("writable");
        let run = folder.inpact(&["eval", "deck.inp", "--nodes", name]);
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{name}: {}", run.errors);
        for said in [name, cause, cure] {
            assert!(run.errors.contains(said), "{name}: {said}\n{}", run.errors);
        }
    }
}

/// A quote that is never closed is an error, and nothing is written.
#[test]
fn an_unclosed_quote_is_an_error() {
    let case = Case::new(TWO_TABLES, "node,clearance,pressure\n\"a,0.05,0\n2,0.05,0\n");
    let run = case.eval(&[]);
    assert_eq!((run.code, run.output.as_str()), (1, ""), "{}", run.errors);
    assert!(run.errors.contains("a quote in row 1 is not closed"), "{}", run.errors);
}

/// `--interaction` governs every row, and the result says so in every row.
#[test]
fn the_chosen_interaction_names_the_rows() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., 0.1\n*SURFACE INTERACTION, NAME=B\n*GAP ELECTRICAL CONDUCTANCE\n80., 0.\n70., 0.1\n";
    let case = Case::new(deck, "interaction,clearance,epot_jump\nA,0,1\nB,0,1\n");
    assert_eq!(case.columns(&["interaction", "ECD"], &[]), ["A,20", "B,80"]);
    assert_eq!(case.columns(&["interaction", "ECD"], &["--interaction", "b"]), ["B,80", "B,80"]);
    let plan = case.folder.inpact(&["plan", "deck.inp", "--nodes", "nodes.csv", "--interaction", "b"]).output;
    assert!(plan.contains("interaction  left out: `--interaction` has the say"), "{plan}");
}

/// S-41: the text of a quoted name names it; what an unquoted name of the deck matches is that one.
#[test]
fn a_quoted_name_is_matched_by_its_text() {
    let deck = "*SURFACE INTERACTION, NAME=Weld\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., 0.1\n*SURFACE INTERACTION, NAME=\"Steel Gap\"\n*GAP ELECTRICAL CONDUCTANCE\n40., 0.\n30., 0.1\n*SURFACE INTERACTION, NAME=Lap Joint\n*GAP ELECTRICAL CONDUCTANCE\n60., 0.\n50., 0.1\n*SURFACE INTERACTION, NAME=\"weld\"\n*GAP ELECTRICAL CONDUCTANCE\n80., 0.\n70., 0.1\n";
    for (cell, current) in [
        ("\"Steel Gap\"", "40"),
        ("\"\"\"Steel Gap\"\"\"", "40"),
        ("Steel Gap", "40"),
        ("STEEL gap", "40"),
        ("weld", "20"),
        ("WELD", "20"),
        ("\"\"\"weld\"\"\"", "80"),
        ("lapjoint", "60"),
    ] {
        let case = Case::new(deck, &format!("interaction,clearance,epot_jump\n{cell},0,1\n"));
        assert_eq!(case.columns(&["ECD"], &[]), [current], "{cell}");
    }
    for (chosen, current) in [("Steel Gap", "40"), ("\"weld\"", "80"), ("weld", "20")] {
        let case = Case::new(deck, "clearance,epot_jump\n0,1\n");
        assert_eq!(case.columns(&["ECD"], &["--interaction", chosen]), [current], "{chosen}");
    }
    let alike = "*SURFACE INTERACTION, NAME=\"Gap\"\n*GAP ELECTRICAL CONDUCTANCE\n1.,\n*SURFACE INTERACTION, NAME=\"gap\"\n*GAP ELECTRICAL CONDUCTANCE\n2.,\n";
    let case = Case::new(alike, "interaction,clearance,epot_jump\ngaP,0,1\n");
    let run = case.eval(&[]);
    assert_eq!(run.code, 1);
    assert!(run.errors.contains("`gaP`, which may be one of several"), "{}", run.errors);
}

/// Closed and open rows are counted once: the summary agrees with the plan.
#[test]
fn summary_and_plan_count_the_same_rows_as_closed() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n20., 0., 100.\n10., 0.1, 100.\n20., 0., 200.\n12., 0.1, 200.\n*SURFACE INTERACTION, NAME=B\n*FRICTION\n0.3,\n";
    let case = Case::new(
        deck,
        "interaction,clearance,pressure,temp,shear,slip_rate\nA,0.05,0,150,,\nA,0,0,150,,\nA,0,5,150,,\nB,0,5,,1,1\n",
    );
    let (run, plan) = (case.eval(&[]), case.plan());
    assert_eq!(run.code, 0, "{}", run.errors);
    for counts in ["A: 3 rows, 2 closed, 1 open", "B: 1 row, 1 closed, 0 open"] {
        assert!(plan.contains(counts), "{plan}");
        assert!(run.errors.contains(counts), "{}", run.errors);
    }
}

/// The bound that is said first is that of the measure that was requested.
#[test]
fn a_relative_tolerance_says_its_own_bound() {
    const DECK: &str = "decks/spot-weld/spot-weld.inp";
    const NODES: &str = "decks/spot-weld/spot-weld-nodes.csv";
    let eval = |arguments: &[&str]| inpact(&[&["eval", DECK, "--nodes", NODES], arguments].concat()).errors;
    let relative = eval(&["--tolerance-relative", "1e-9"]);
    let line = relative.lines().find(|line| line.contains("error at most")).expect("a bound");
    let (first, second) = (line.find("of the value itself"), line.find("of the largest value"));
    assert!(first.is_some() && (second.is_none() || first < second), "{line}");
    let missed = eval(&["--tolerance-relative", "1e-17"]);
    assert!(missed.contains("above the tolerance of 1e-17 of the value itself, which no form keeps"), "{missed}");
    let missed = eval(&["--tolerance", "1e-17"]);
    assert!(missed.contains("above the tolerance of 1e-17 of the largest value, which no form keeps"), "{missed}");
}

/// Q-36: a closed row reads tables against clearance at zero, whatever its clearance, and needs none.
#[test]
fn closed_rows_read_clearance_tables_at_zero() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., 0.1\n*GAP CONDUCTANCE\n8., 0.\n4., 0.1\n*GAP RADIATION\n1., 1.\n1., 0.\n0.5, 0.1\n*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0., STEFAN BOLTZMANN=1.\n";
    let names = ["conductance", "thermal_conductance", "heat_radiation"];
    let closed =
        Case::new(deck, "clearance,pressure,epot_jump,temp_s,temp_m\n0,5,1,2,1\n0.05,5,1,2,1\n,5,1,2,1\n0.3,5,1,2,1\n");
    assert_eq!(closed.columns(&names, &[]), ["20,8,15"; 4]);
    assert_eq!(closed.columns(&names, &["--accuracy", "reference"]), ["20,8,15"; 4]);
    let mixed = Case::new(
        deck,
        "clearance,pressure,closed,epot_jump,temp_s,temp_m\n0.05,5,,1,2,1\n0.05,0,,1,2,1\n0.05,0,1,1,2,1\n0.05,5,0,1,2,1\n-0.05,0,0,1,2,1\n",
    );
    assert_eq!(mixed.columns(&names, &[]), ["20,8,15", "15,6,11.25", "20,8,15", "15,6,11.25", "20,8,15"]);
    assert_eq!(mixed.columns(&["dconductance_dclearance"], &["--derivatives"]), ["0", "-100", "0", "-100", "0"]);
    let without_clearance = Case::new(deck, "pressure,epot_jump,temp_s,temp_m\n5,1,2,1\n");
    assert_eq!(without_clearance.columns(&names, &[]), ["20,8,15"]);
}

/// P-34: open rows are read at zero pressure, and need none.
#[test]
fn pore_fluid_of_open_rows_needs_no_pressure() {
    let deck = "*SURFACE INTERACTION, NAME=P\n*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=1., CUTOFF GAP FILL=1.\n1., 0.\n2., 1.\n";
    for nodes in ["clearance,por_s,por_m\n0.1,1,2\n", "clearance,por_s,por_m,pressure\n0.1,1,2,\n"] {
        assert_eq!(Case::new(deck, nodes).columns(&["q_across", "PFL"], &[]), ["1,-1"], "{nodes}");
    }
    // A closed row cannot do without.
    let closed = Case::new(deck, "clearance,por_s,por_m\n0,1,2\n").eval(&[]);
    assert_eq!(closed.code, 1);
    assert!(closed.errors.contains("`pressure` is missing"), "{}", closed.errors);
}

/// The difference of both sides is enough where nothing depends on their mean.
#[test]
fn differences_of_both_sides_stand_alone() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE\n20., 0.\n10., 0.1\n*SURFACE INTERACTION, NAME=P\n*CONTACT PERMEABILITY\n1e-3,0\n";
    let heat = Case::new(deck, "interaction,clearance,temp,temp_jump\nA,0,150,2\n");
    assert_eq!(heat.columns(&["heat_conduction", "HFL"], &[]), ["40,40"]);
    assert_eq!(heat.columns(&["heat_conduction", "HFL"], &["--accuracy", "reference"]), ["40,40"]);
    let fluid = Case::new(deck, "interaction,clearance,por_jump\nP,0,2\n");
    assert_eq!(fluid.columns(&["q_across", "PFL"], &[]), ["-0.002,0.002"]);
    let neither = Case::new(deck, "interaction,clearance,temp\nA,0,150\n").eval(&[]);
    assert!(neither.errors.contains("(or `temp_jump`) are missing"), "{}", neither.errors);
    // A mean that a table depends on needs both sides or itself.
    let with_mean = "*SURFACE INTERACTION, NAME=P\n*CONTACT PERMEABILITY\n1., 0., 0.\n2., 0., 10.\n";
    let fluid = Case::new(with_mean, "clearance,pressure,por_jump\n0,0,2\n").eval(&[]);
    assert_eq!(fluid.code, 1);
    assert!(fluid.errors.contains("`por_s` and `por_m` are missing"), "{}", fluid.errors);
    // The flow that the law leaves to the equations is a column of their solution.
    let solved = Case::new(
        "*SURFACE INTERACTION, NAME=P\n*CONTACT PERMEABILITY\n",
        "clearance,por_s,por_m,q_across\n0,1,1,0.25\n",
    );
    assert_eq!(solved.columns(&["q_across", "PFL", "status"], &[]), ["0.25,-0.25,constrained"]);
}

/// A row that lacks a number is no increment; an area that is missing once leaves the integrals of the whole node unknown.
#[test]
fn a_history_goes_on_after_a_missing_value() {
    let nodes = "node,time,clearance,pressure,epot_jump,area\n1,0,0,0,1,1\n1,1,0,0,1,1\n1,2,0,0,,1\n1,3,0,0,1,1\n1,4,0,0,1,\n1,5,0,0,1,1\n";
    let case = Case::new(TWO_TABLES, nodes);
    let run = case.eval(&[]);
    assert_eq!(columns(&run, &["ECDT", "ECDTA"]), ["0,0", "50,50", ",", "150,150", "200,", "250,"]);
    assert!(run.errors.contains("1 row without potentials"), "{}", run.errors);
}
