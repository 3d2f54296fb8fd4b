//! Result files of a mesh in rows of node tables: nodes of labels, precedence among several values, and notes on parts not used.

mod common;

use common::files::{Fil, W};
use common::{FLAT, INSTANCES, deck, messages};
use inpact_contact::{MatchedBy, State};
use inpact_evaluation::nodes::{Column, Part};
use std::fmt::Write;

/// Results of CalculiX: coordinates, then for each time blocks of named components with rows of nodes.
struct Frd(String);

impl Frd {
    fn new(nodes: &[(i64, [f64; 3])]) -> Self {
        let mut text = format!("    1C\n    2C{:30}{:37}1\n", nodes.len(), "");
        for (node, point) in nodes {
            writeln!(text, " -1{node:10}{}", point.map(e12).concat()).expect("a string");
        }
        Self(text + " -3\n")
    }

    fn block(
        mut self,
        (step, increment, time): (i64, i64, f64),
        name: &str,
        columns: &[&str],
        rows: &[(i64, &[f64])],
    ) -> Self {
        let text = &mut self.0;
        writeln!(text, "    1PSTEP{:26}{increment:12}{step:12}", 1).expect("a string");
        writeln!(text, "  100CL  101{time:12.9}{:12}{:20} 0{increment:5}{:10} 1", rows.len(), "", 1).expect("a string");
        writeln!(text, " -4  {name:8}{:5}    1", columns.len()).expect("a string");
        for column in columns {
            writeln!(text, " -5  {column:8}    1    1    1    0").expect("a string");
        }
        for (node, values) in rows {
            let values: String = values.iter().map(|value| e12(*value)).collect();
            writeln!(text, " -1{node:10}{values}").expect("a string");
        }
        *text += " -3\n";
        self
    }

    fn bytes(&self) -> Vec<u8> {
        format!("{} 9999\n", self.0).into_bytes()
    }
}

/// A number in Fortran's format 1PE12.5.
fn e12(value: f64) -> String {
    let text = format!("{value:.5e}");
    let (mantissa, exponent) = text.split_once('e').expect("an exponent");
    let exponent: i32 = exponent.parse().expect("an integer");
    format!("{:>12}", format!("{mantissa}E{}{:02}", if exponent < 0 { '-' } else { '+' }, exponent.abs()))
}

/// The nodes of [`FLAT`].
fn flat_nodes() -> Vec<(i64, [f64; 3])> {
    let corners = |x: [f64; 2], z: f64| [[x[0], 0.0, z], [x[1], 0.0, z], [x[1], 1.0, z], [x[0], 1.0, z]];
    let lower = corners([0.0, 2.0], 0.0).into_iter().chain(corners([0.0, 2.0], 1.0));
    let upper = corners([0.5, 1.0], 1.25).into_iter().chain(corners([0.5, 1.0], 2.25));
    (1..).zip(lower).chain((11..).zip(upper)).collect()
}

const CONTACT: [&str; 6] = ["COPEN", "CSLIP1", "CSLIP2", "CPRESS", "CSHEAR1", "CSHEAR2"];

#[test]
fn closed_nodes_have_what_calculix_says_and_open_ones_the_distance_of_the_moved_mesh() {
    let read = deck(FLAT);
    // The upper block comes down by 0.25 at x = 0.5 and by 0.125 at x = 1; the upper side of the lower one is 10 warmer at x = 2.
    let moved: Vec<(i64, [f64; 3])> = flat_nodes()
        .into_iter()
        .map(|(node, [x, ..])| (node, [0.0, 0.0, if node < 10 { 0.0 } else { -0.25 * (1.5 - x) }]))
        .collect();
    let moved: Vec<(i64, &[f64])> = moved.iter().map(|(node, vector)| (*node, vector.as_slice())).collect();
    let warm: Vec<(i64, [f64; 1])> =
        flat_nodes().into_iter().map(|(node, [x, ..])| (node, [100.0 + 5.0 * x])).collect();
    let warm: Vec<(i64, &[f64])> = warm.iter().map(|(node, value)| (*node, value.as_slice())).collect();
    let closed: &[f64] = &[-1e-4, 0.0, 0.0, 50.0, 3.0, 4.0];
    let frd = Frd::new(&flat_nodes())
        .block((1, 1, 0.5), "DISP", &["D1", "D2", "D3"], &moved)
        .block((1, 1, 0.5), "NDTEMP", &["T"], &warm)
        .block((1, 1, 0.5), "CONTACT", &CONTACT, &[(11, closed), (14, closed)])
        .block((1, 1, 0.5), "STRESS", &["SXX"], &warm)
        .block((1, 2, 1.0), "CONTACT", &CONTACT, &[(12, &[0.0; 6]), (1, &[0.0; 6])]);
    let joined = read.join(&[("job.frd", &frd.bytes())]).expect("of this mesh");
    assert_eq!((joined.states.len(), joined.files[0].matched_by), (2, MatchedBy::Labels));
    let table = read.table(&joined.states);
    for node in ["11", "14"] {
        assert_eq!((table.number(node, 0, "clearance"), table.number(node, 0, "pressure")), (-1e-4, 50.0));
        assert_eq!(table.number(node, 0, "shear"), 5.0);
        assert_eq!(
            table.text(node, 0, "source"),
            "clearance=COPEN pressure=CPRESS area=mesh+U shear=CSHEAR temp_s=NT11 temp_m=NT11"
        );
    }
    for node in ["12", "13"] {
        // Not in the list of what is in contact: open, without pressure.
        assert!((table.number(node, 0, "clearance") - 0.125).abs() < 1e-15);
        assert_eq!(table.number(node, 0, "pressure"), 0.0);
        assert_eq!(table.number(node, 0, "shear"), 0.0);
        assert!(table.text(node, 0, "source").starts_with("clearance=mesh+U pressure=CPRESS"));
    }
    for (node, x) in [("11", 0.5), ("12", 1.0), ("13", 1.0), ("14", 0.5)] {
        assert_eq!(table.number(node, 0, "temp_s"), 100.0 + 5.0 * x);
        // The weights of the master's nodes: linear along x.
        assert_eq!(table.number(node, 0, "temp_m"), 100.0 + 5.0 * x, "{node}");
        assert_eq!((table.number(node, 0, "time"), table.number(node, 0, "increment")), (0.5, 1.0));
        // All zeros are no contact either, and nothing says that nodes have moved.
        assert_eq!((table.number(node, 1, "clearance"), table.number(node, 1, "pressure")), (0.25, 0.0));
        // Nothing else says a temperature at that time.
        assert_eq!((table.number(node, 1, "temp_s"), table.number(node, 1, "temp_m")), (30.0, 20.0));
        assert!(table.text(node, 1, "source").contains("temp_s=initial temp_m=initial"));
    }
    // The area of the moved face: 1 by the length of its slope.
    let length = (0.5_f64 * 0.5 + 0.125 * 0.125).sqrt();
    assert!((table.number("11", 0, "area") - length / 4.0).abs() < 1e-15);
    assert!((table.number("11", 1, "area") - 0.125).abs() < 1e-15);
    let notes = messages(&joined);
    for said in [
        "job.frd: no node table has a place for STRESS: not used",
        "job.frd: no displacements (U): areas, the faces across and clearances that nothing else says are those of the undeformed mesh",
        "job.frd: no temp of nodes: that of *INITIAL CONDITIONS is taken",
    ] {
        assert!(notes.iter().any(|note| note == said), "{said}: {notes:#?}");
    }
}

#[test]
fn labels_of_another_mesh_are_found_out_by_coordinates() {
    let read = deck(FLAT);
    let temperatures = |nodes: &[(i64, [f64; 3])]| {
        let rows: Vec<(i64, [f64; 1])> =
            nodes.iter().map(|(node, [x, y, z])| (*node, [x + 10.0 * y + 100.0 * z])).collect();
        let rows: Vec<(i64, &[f64])> = rows.iter().map(|(node, value)| (*node, value.as_slice())).collect();
        Frd::new(nodes).block((1, 1, 1.0), "NDTEMP", &["T"], &rows).bytes()
    };
    // Numbered anew, beginning from the end.
    let renumbered: Vec<(i64, [f64; 3])> = flat_nodes().into_iter().map(|(node, point)| (100 - node, point)).collect();
    let joined = read.join(&[("job.frd", &temperatures(&renumbered))]).expect("of this mesh");
    assert_eq!((joined.files[0].matched_by, joined.files[0].nodes), (MatchedBy::Coordinates, 8));
    let table = read.table(&joined.states);
    assert_eq!((table.number("12", 0, "temp_s"), table.number("13", 0, "temp_s")), (126.0, 136.0));
    assert_eq!((table.number("12", 0, "temp_m"), table.number("13", 0, "temp_m")), (101.0, 111.0));
    // Shifted by one: labels say other nodes than coordinates.
    let shifted: Vec<(i64, [f64; 3])> = flat_nodes().into_iter().map(|(node, point)| (node + 1, point)).collect();
    let joined = read.join(&[("job.frd", &temperatures(&shifted))]).expect("of this mesh");
    assert!(messages(&joined)[0].contains("there and at"), "{:?}", messages(&joined));
    assert_eq!(read.table(&joined.states).number("12", 0, "temp_s"), 126.0);
    // Of another mesh altogether.
    let elsewhere: Vec<(i64, [f64; 3])> =
        flat_nodes().into_iter().map(|(node, [x, y, z])| (node, [x + 0.1, y, z])).collect();
    let error = read.join(&[("job.frd", &temperatures(&elsewhere))]).expect_err("elsewhere").to_string();
    assert!(error.contains("it is of another mesh") && error.starts_with("job.frd: node "), "{error}");
    // Six digits are enough.
    let rounded: Vec<(i64, [f64; 3])> =
        flat_nodes().into_iter().map(|(node, [x, y, z])| (node, [x, y, z + 2e-6 * z])).collect();
    assert_eq!(
        read.join(&[("job.frd", &temperatures(&rounded))]).expect("of this mesh").files[0].matched_by,
        MatchedBy::Labels
    );
}

/// A `.fil` of [`INSTANCES`], numbered from `first` on, lower block first; touching nodes are at one place, but for the first, which is lifted.
fn fil_of_instances(first: i64, surfaces: bool, lift: f64) -> Vec<u8> {
    let mut fil = Fil::default();
    let corners = |z: f64| [[10.0, 0.0, z], [12.0, 0.0, z], [12.0, 1.0, z], [10.0, 1.0, z]];
    let mut points = [corners(0.0), corners(1.0), corners(1.0), corners(2.0)].concat();
    points[8][2] += lift;
    for (node, [x, y, z]) in (first..).zip(points) {
        fil.record(1901, &[W::I(node), W::D(x), W::D(y), W::D(z)]);
    }
    if surfaces {
        fil.record(1501, &[W::A("       7"), W::I(3), W::I(1), W::I(1), W::I(1), W::A("MAST")]);
        let face: Vec<W> = [1, 2, 4].into_iter().chain(first + 4..first + 8).map(W::I).collect();
        fil.record(1502, &face);
        fil.record(1940, &[W::I(7), W::A("ASSEMBLY"), W::A("_LOW-1_T"), W::A("OP")]);
    }
    fil.record(1940, &[W::I(8), W::A("ASSEMBLY"), W::A("_UP-1_BO"), W::A("TTOM")]);
    fil.end();
    fil.begin(1, 3, 0.75, 0.75);
    fil.record(1911, &[W::I(1), W::A(""), W::A("")]);
    for node in first..first + 16 {
        let lower = node < first + 8;
        fil.record(201, &[W::I(node), W::D(if lower { 20.0 } else { 90.0 })]);
        fil.record(105, &[W::I(node), W::D(if lower { 0.0 } else { 0.5 })]);
        fil.record(101, &[W::I(node), W::D(0.0), W::D(0.0), W::D(if lower { 0.0 } else { 0.125 })]);
    }
    if surfaces {
        fil.record(1503, &[W::I(0), W::A("       8"), W::A("       7"), W::A("")]);
        for (at, node) in (0_u32..).zip(first + 8..first + 12) {
            fil.record(1504, &[W::I(node), W::I(3)]);
            fil.record(1511, &[W::D(10.0 + f64::from(at)), W::D(3.0), W::D(4.0)]);
            fil.record(1521, &[W::D(-1e-6 * f64::from(at)), W::D(0.375), W::D(0.0)]);
            fil.record(1541, &[W::D(7.0)]);
        }
    }
    fil.end();
    fil.bytes()
}

#[test]
fn nodes_of_instances_are_found_by_coordinates_and_distinguished_by_surfaces() {
    let read = deck(INSTANCES);
    // Whatever the solver numbers them, and whatever the deck does.
    for first in [1, 40] {
        let joined = read.join(&[("job.fil", &fil_of_instances(first, true, 0.0))]).expect("of this mesh");
        assert_eq!(joined.files[0].matched_by, MatchedBy::Coordinates);
        assert_eq!(messages(&joined), Vec::<String>::new());
        let table = read.table(&joined.states);
        assert_eq!(table.cells.len(), 4);
        for (at, node) in (0_u32..).zip(["Up-1.1", "Up-1.2", "Up-1.3", "Up-1.4"]) {
            let number = |column| table.number(node, 0, column);
            assert_eq!((number("temp_s"), number("temp_m")), (90.0, 20.0), "{node}");
            assert_eq!((number("epot_s"), number("epot_m")), (0.5, 0.0));
            assert_eq!((number("pressure"), number("clearance")), (10.0 + f64::from(at), -1e-6 * f64::from(at)));
            // Slip of 0.375 since the beginning, within 0.75.
            assert_eq!((number("shear"), number("slip_rate")), (5.0, 0.5));
            assert_eq!((number("step"), number("increment"), number("step_time")), (1.0, 3.0, 0.75));
        }
        let state = &joined.states[0];
        assert_eq!(state.outputs.len(), 1);
        assert_eq!(state.outputs[0].pair, Some(0));
    }
}

/// A file need not give surfaces by their faces, and may say contact in a later state only: that distinguishes the nodes of the states before.
#[test]
fn contact_of_a_later_state_distinguishes_nodes() {
    let read = deck(INSTANCES);
    let mut fil = Fil::default();
    let corners = |z: f64| [[10.0, 0.0, z], [12.0, 0.0, z], [12.0, 1.0, z], [10.0, 1.0, z]];
    for (node, [x, y, z]) in (1..).zip([corners(0.0), corners(1.0), corners(1.0), corners(2.0)].concat()) {
        fil.record(1901, &[W::I(node), W::D(x), W::D(y), W::D(z)]);
    }
    fil.record(1940, &[W::I(7), W::A("ASSEMBLY"), W::A("_LOW-1_T"), W::A("OP")]);
    fil.record(1940, &[W::I(8), W::A("ASSEMBLY"), W::A("_UP-1_BO"), W::A("TTOM")]);
    fil.end();
    for increment in 1..=2 {
        let time = 0.25 * f64::from(i32::try_from(increment).expect("small"));
        fil.begin(1, increment, time, time);
        for node in 1..=16 {
            fil.record(201, &[W::I(node), W::D(if node <= 8 { 20.0 } else { 90.0 })]);
        }
        if increment == 2 {
            fil.record(1503, &[W::I(0), W::A("       8"), W::A("       7"), W::A("")]);
            for node in 9..=12 {
                fil.record(1504, &[W::I(node), W::I(3)]);
                fil.record(1511, &[W::D(10.0), W::D(0.0), W::D(0.0)]);
            }
        }
        fil.end();
    }
    let joined = read.join(&[("job.fil", &fil.bytes())]).expect("of this mesh");
    assert_eq!((joined.files[0].matched_by, joined.files[0].nodes), (MatchedBy::Coordinates, 8));
    let table = read.table(&joined.states);
    for state in [0, 1] {
        for node in ["Up-1.1", "Up-1.2", "Up-1.3", "Up-1.4"] {
            let number = |column| table.number(node, state, column);
            assert_eq!((number("temp_s"), number("temp_m")), (90.0, 20.0), "{node} in state {state}");
        }
    }
}

#[test]
fn nodes_at_one_place_that_nothing_tells_apart_are_named_and_not_used() {
    let read = deck(INSTANCES);
    let error = read.join(&[("job.fil", &fil_of_instances(1, false, 0.0))]).expect_err("all of them touch").to_string();
    assert!(error.contains("none of its nodes"), "{error}");
    // Where one of them does not, that and the one below it are.
    let lifted = "*PART, NAME=UPPER\n*NODE\n1, 0., 0., 0.5";
    let open = deck(&INSTANCES.replace("*PART, NAME=UPPER\n*NODE\n1, 0., 0., 0.", lifted));
    let joined = open.join(&[("job.fil", &fil_of_instances(1, false, 0.5))]).expect("of this mesh");
    let notes = messages(&joined);
    assert!(notes[0].contains("could not be distinguished, the first of them Low-1.6:"), "{notes:?}");
    assert_eq!(joined.files[0].nodes, 2);
    assert_eq!(open.table(&joined.states).number("Up-1.1", 0, "temp_s"), 90.0);
}

const REPORT: &str = "\
********************************************************************************
Field Output Report, written Mon Nov 30 00:00:00 2026

Source 1
---------

   ODB: /home/user/job.odb
   Step: Step-1
   Frame: Increment      3: Step Time =   0.7500

Loc 1 : Nodal values from source 1

Output sorted by column \"Node Label\".

Field Output reported at nodes for part: LOW-1

            Node            NT11
           Label          @Loc 1
---------------------------------
               5              20.
               6              20.
               7              40.
               8              40.


Field Output reported at nodes for part: UP-1

            Node            NT11   CPRESS  ASSEMBLY_UP-1_BOTTOM/ASSEMBLY_LOW-1_TOP
           Label          @Loc 1                                            @Loc 1
----------------------------------------------------------------------------------
               1             90.                                                5.
               2             91.                                                6.
               3             92.                                                7.
               4             93.                                                8.


";

#[test]
fn reports_name_the_instance_that_a_label_is_of() {
    let read = deck(INSTANCES);
    let joined = read.join(&[("job.rpt", REPORT.as_bytes())]).expect("of this mesh");
    assert_eq!((joined.files[0].matched_by, joined.files[0].nodes), (MatchedBy::InstancesAndLabels, 8));
    let table = read.table(&joined.states);
    let slave = |column| ["Up-1.1", "Up-1.2", "Up-1.3", "Up-1.4"].map(|node| table.number(node, 0, column));
    assert_eq!((slave("temp_s"), slave("temp_m")), ([90.0, 91.0, 92.0, 93.0], [20.0, 20.0, 40.0, 40.0]));
    assert_eq!((slave("pressure"), slave("time")), ([5.0, 6.0, 7.0, 8.0], [0.75; 4]));
}

#[test]
fn files_are_joined_by_their_times_and_the_first_counts() {
    let read = deck(INSTANCES);
    let fil = fil_of_instances(1, true, 0.0);
    let joined = read.join(&[("job.fil", &fil), ("job.rpt", REPORT.as_bytes())]).expect("of this mesh");
    assert_eq!(joined.states.len(), 1);
    let table = read.table(&joined.states);
    assert_eq!((table.number("Up-1.2", 0, "temp_s"), table.number("Up-1.2", 0, "pressure")), (90.0, 11.0));
    assert_eq!(
        table.text("Up-1.1", 0, "source").split(' ').next(),
        Some("clearance=COPEN@job.fil"),
        "with two files a cell says which"
    );
    let notes = messages(&joined);
    let said = "job.rpt: NT11 of job.rpt differs from NT11 of job.fil at 5 nodes, at Low-1.7 it is 40 where the other is 20: what was named first counts";
    assert!(notes.iter().any(|note| note == said), "{notes:#?}");
    // The other way round the report counts, and the file fills what it does not say.
    let joined = read.join(&[("job.rpt", REPORT.as_bytes()), ("job.fil", &fil)]).expect("of this mesh");
    let table = read.table(&joined.states);
    assert_eq!((table.number("Up-1.2", 0, "temp_s"), table.number("Up-1.2", 0, "pressure")), (91.0, 6.0));
    assert_eq!(table.number("Up-1.2", 0, "epot_s"), 0.5);
    assert_eq!(table.number("Up-1.2", 0, "time"), 0.75);
    // Another time is another state.
    let later = REPORT.replace("Increment      3: Step Time =   0.7500", "Increment      4: Step Time =   0.9000");
    let joined = read.join(&[("job.fil", &fil), ("job.rpt", later.as_bytes())]).expect("of this mesh");
    assert_eq!(joined.states.iter().map(|state| state.moment.time).collect::<Vec<_>>(), [Some(0.75), Some(0.9)]);
}

#[test]
fn a_time_within_a_later_step_is_no_time() {
    let read = deck(FLAT);
    let report = |step: &str| {
        REPORT
            .replace("Step: Step-1", &format!("Step: {step}"))
            .replace("for part: LOW-1", "for part: PART-1-1")
            .into_bytes()
    };
    let joined = read.join(&[("job.rpt", &report("Press"))]).expect("the first step");
    assert_eq!((joined.states[0].moment.time, joined.states[0].moment.step), (Some(0.75), Some(1)));
    let error = read.join(&[("job.rpt", &report("Step-2"))]).expect_err("the second").to_string();
    assert!(error.contains("`job.rpt` says nothing of the nodes"), "{error}");
}

#[test]
fn history_of_values_by_node_has_a_state_a_row() {
    let text = "\
               X       CPRESS_n11      CPRESS_n12           NT11_n11

   0.0000000E+00   0.0000000E+00   0.0000000E+00   3.0000000E+01
   1.0000000E+00   1.0000000E+01   2.0000000E+01   3.5000000E+01

";
    let read = deck(FLAT);
    let joined = read.join(&[("xy.rpt", text.as_bytes())]).expect("of this mesh");
    let table = read.table(&joined.states);
    assert_eq!((table.number("11", 0, "pressure"), table.number("11", 1, "pressure")), (0.0, 10.0));
    assert_eq!((table.number("12", 1, "pressure"), table.number("11", 1, "temp_s")), (20.0, 35.0));
    assert_eq!(
        (table.text("12", 1, "temp_s"), table.text("11", 1, "temp_m"), table.text("13", 1, "pressure")),
        ("", "", "")
    );
    let notes = messages(&joined);
    assert!(
        notes.contains(&"xy.rpt: nothing is said of 6 of 8 nodes of contact surfaces, the first of them 5".to_owned()),
        "{notes:?}"
    );
}

#[test]
fn contact_of_a_pair_that_the_deck_does_not_have_is_named() {
    let read = deck(INSTANCES);
    let report = REPORT.replace("ASSEMBLY_UP-1_BOTTOM/ASSEMBLY_LOW-1_TOP", "ASSEMBLY_OTHER/ASSEMBLY_LOW-1_TOP");
    let joined = read.join(&[("job.rpt", report.as_bytes())]).expect("temperatures are there");
    assert!(!read.table(&joined.states).has(Column::Pressure));
    let notes = messages(&joined);
    let said =
        "job.rpt: CPRESS is of a pair `ASSEMBLY_OTHER` on `ASSEMBLY_LOW-1_TOP`, which the deck does not have: not used";
    assert!(notes.iter().any(|note| note == said), "{notes:#?}");
}

#[test]
fn a_node_that_two_pairs_have_gets_no_pressure_that_could_be_of_either() {
    // The slave touches a second master that lies where the first does.
    let two = FLAT.replace(
        "*CONTACT PAIR, INTERACTION=GAP\nSLAVE, MASTER\n",
        "*SURFACE, NAME=OTHER\nLOWER, S2\n*CONTACT PAIR, INTERACTION=GAP\nSLAVE, MASTER\nSLAVE, OTHER\n",
    );
    let read = deck(&two);
    let frd =
        Frd::new(&flat_nodes()).block((1, 1, 1.0), "CONTACT", &CONTACT, &[(11, &[-1e-4, 0.0, 0.0, 50.0, 0.0, 0.0])]);
    let joined = read.join(&[("job.frd", &frd.bytes())]).expect("of this mesh");
    let table = read.table(&joined.states);
    assert_eq!((table.text("11", 0, "pressure"), table.text("11:OTHER", 0, "pressure")), ("", ""));
    // Without contact it is without contact in both.
    assert_eq!((table.number("12", 0, "pressure"), table.number("12:OTHER", 0, "pressure")), (0.0, 0.0));
    let notes = messages(&joined);
    assert!(notes[0].contains("nodes that are slaves of several pairs, such as 11,"), "{notes:?}");
}

#[test]
fn displacements_that_a_node_lacks_are_not_used() {
    let read = deck(FLAT);
    let moved: Vec<(i64, &[f64])> = vec![(5, &[0.0, 0.0, 0.1]), (11, &[0.0, 0.0, 0.2])];
    let frd = Frd::new(&flat_nodes()).block((1, 1, 1.0), "DISP", &["D1", "D2", "D3"], &moved);
    let joined = read.join(&[("job.frd", &frd.bytes())]).expect("of this mesh");
    assert_eq!(joined.states[0].displacements, None);
    assert_eq!(read.table(&joined.states).number("11", 0, "clearance"), 0.25);
    assert!(messages(&joined).iter().any(|note| note.contains("U1 of node 6 is not said")), "{:?}", messages(&joined));
}

#[test]
fn small_sliding_keeps_the_face_across_and_the_area_of_the_start() {
    let small = FLAT.replace("*CONTACT PAIR, INTERACTION=GAP", "*CONTACT PAIR, INTERACTION=GAP, SMALL SLIDING");
    let read = deck(&small);
    // The upper block moves half a length along x and comes down by 0.05; the lower one tilts about y, by 0.1 at x = 2.
    let moved: Vec<(i64, [f64; 3])> = flat_nodes()
        .into_iter()
        .map(|(node, [x, ..])| (node, if node < 10 { [0.0, 0.0, 0.05 * x] } else { [0.5, 0.0, -0.05] }))
        .collect();
    let moved: Vec<(i64, &[f64])> = moved.iter().map(|(node, vector)| (*node, vector.as_slice())).collect();
    let frd = Frd::new(&flat_nodes()).block((1, 1, 1.0), "DISP", &["D1", "D2", "D3"], &moved);
    let joined = read.join(&[("job.frd", &frd.bytes())]).expect("of this mesh");
    let table = read.table(&joined.states);
    for (node, x) in [("11", 0.5), ("12", 1.0)] {
        // Along the first normal, above the first place: what lies there has risen by 0.05 x.
        let clearance = 0.25 - 0.05 - 0.05 * x;
        assert!((table.number(node, 0, "clearance") - clearance).abs() < 1e-15, "{node}");
        assert!((table.number(node, 0, "area") - 0.125).abs() < 1e-15);
    }
    // In finite sliding the face across is that of the new place.
    let finite = deck(FLAT);
    let joined = finite.join(&[("job.frd", &frd.bytes())]).expect("of this mesh");
    let found = finite.table(&joined.states).number("11", 0, "clearance");
    let slope = (1.0_f64 + 0.05 * 0.05).sqrt();
    assert!((found - (0.25 - 0.05 - 0.05) / slope).abs() < 1e-12, "{found}");
}

#[test]
fn adjusted_nodes_move_on_from_the_master() {
    let adjusted = FLAT.replace("*CONTACT PAIR, INTERACTION=GAP", "*CONTACT PAIR, INTERACTION=GAP, ADJUST=0.3");
    let read = deck(&adjusted);
    let moved: Vec<(i64, [f64; 3])> =
        flat_nodes().into_iter().map(|(node, _)| (node, [0.0, 0.0, if node < 10 { 0.0 } else { 0.0625 }])).collect();
    let rows: Vec<(i64, &[f64])> = moved.iter().map(|(node, vector)| (*node, vector.as_slice())).collect();
    // CalculiX writes the places after ADJUST.
    let nodes: Vec<(i64, [f64; 3])> = flat_nodes()
        .into_iter()
        .map(|(node, [x, y, z])| (node, [x, y, if (11..15).contains(&node) { 1.0 } else { z }]))
        .collect();
    let frd = Frd::new(&nodes).block((1, 1, 1.0), "DISP", &["D1", "D2", "D3"], &rows);
    let joined = read.join(&[("job.frd", &frd.bytes())]).expect("of this mesh");
    assert_eq!(joined.files[0].matched_by, MatchedBy::Labels);
    let table = read.table(&joined.states);
    for node in ["11", "12", "13", "14"] {
        assert_eq!(table.number(node, 0, "clearance"), 0.0625, "{node}");
    }
    assert_eq!(read.table(&[State::initial(&read.mesh)]).number("11", 0, "clearance"), 0.0);
}

#[test]
fn what_nothing_says_has_no_column() {
    let read = deck(FLAT);
    let table = read.table(&[State::initial(&read.mesh)]);
    assert!(table.has(Column::Temperature(Part::Master)));
    for column in [Column::Pressure, Column::Potential(Part::Slave), Column::Source, Column::Time, Column::Step] {
        assert!(!table.has(column), "{column}");
    }
}
