//! Reports of Abaqus/Viewer: made up, and real ones.

mod common;

use common::{rpt, sample};
use inpact_results::{Format, Rows, read, read_rpt};

#[test]
fn fields_of_several_parts_and_histories_stand_in_one_file() {
    let results = read(rpt().as_bytes()).expect("whole");
    assert_eq!((results.format, results.frames.len()), (Format::Rpt, 3));
    let frame = &results.frames[0];
    assert_eq!((frame.step_name.as_deref(), frame.increment, frame.step_time), (Some("WELD"), Some(10), Some(1.5)));
    assert_eq!(frame.total_time, None);
    let parts: Vec<_> =
        frame.columns("U1").map(|(field, column)| (field.region.set.as_deref(), &column.values[..])).collect();
    assert_eq!(parts, [(Some("A"), &[644.116e-6, 1.0926e-3][..]), (Some("B"), &[-15.4724e-6][..])]);
    let (field, pressure) = frame.column("cpress").expect("there");
    assert_eq!((field.rows.nodes(), &pressure.values[..]), (Some(&[1, 2][..]), &[0.125, 0.0][..]));
    assert_eq!(frame.column("U.Magnitude").expect("there").1.values[0].to_bits(), (-0.0_f64).to_bits());
    for (at, time, pressures, work) in [(1, 0.0, [1.0, -2.0], f64::NAN), (2, 0.1, [3.0, 4e-3], 5.0)] {
        let frame = &results.frames[at];
        assert_eq!(frame.total_time, Some(time));
        let (field, pressure) = frame.column("CPRESS").expect("there");
        assert_eq!((field.rows.nodes(), &pressure.values[..]), (Some(&[1, 12][..]), &pressures[..]));
        let (field, found) = frame.column("Wtot").expect("there");
        assert_eq!(field.rows, Rows::Whole);
        assert_eq!(found.values[0].to_bits(), work.to_bits());
    }
}

#[test]
fn names_with_blanks_are_what_stands_above_a_column() {
    let text = "
               X  CPRESS PI: A N: 3  CPRESS PI: B N: 4

              0.                1.5                2.5
              1.                3.5                4.5

";
    let results = read_rpt(text.as_bytes()).expect("whole");
    let found: Vec<_> = results.frames[1]
        .columns("CPRESS")
        .map(|(field, column)| (field.region.set.as_deref(), field.rows.nodes().map(<[_]>::to_vec), column.values[0]))
        .collect();
    assert_eq!(found, [(Some("A"), Some(vec![3]), 3.5), (Some("B"), Some(vec![4]), 4.5)]);
}

#[test]
fn a_table_of_elements_is_named_as_not_read() {
    let text = rpt().replacen("            Node           U.U1", "         Element           U.U1", 1);
    let results = read_rpt(text.as_bytes()).expect("whole");
    assert_eq!(results.not_read.len(), 1);
    assert!(results.not_read[0].what.contains("Element"), "{:?}", results.not_read);
    assert_eq!(results.frames[0].columns("U1").count(), 1);
}

#[test]
fn a_row_with_other_columns_has_its_place() {
    let text = rpt().replacen("        7.E+00              0.", "        7.E+00", 1);
    let failure = read_rpt(text.as_bytes()).expect_err("damaged");
    assert!(failure.problem().expect("a problem").message.contains("a row has 3 columns, its table 4"), "{failure}");
    let line = text.lines().position(|line| line.contains("1.09260E-03")).expect("there") as u64 + 1;
    assert_eq!(failure.problem().expect("a problem").place.line, line);
}

#[test]
fn real_field_reports_are_read_value_by_value() {
    for (file, rows, names, step_time) in [
        ("abaqus/indentation_core_step0_frame1_U1_nodal.rpt", 19, &["U1"][..], 1.0),
        ("abaqus/indentation_core_step0_frame1_S11_nodes.rpt", 19, &["S11"][..], 1.0),
        (
            "abaqus/Traction_2D_Sim1_instance-I_SAMPLE_step-LOADING1_frame-18_var-S.frpt",
            3504,
            &["S11", "S22", "S33", "S12"][..],
            0.4167,
        ),
    ] {
        let Some(bytes) = sample(file) else { continue };
        let results = read(&bytes).expect("whole");
        assert_eq!((results.frames.len(), results.frames[0].step_time), (1, Some(step_time)), "{file}");
        let text = String::from_utf8(bytes).expect("ASCII");
        let expected: Vec<Vec<f64>> = text
            .lines()
            .filter_map(|line| line.split_whitespace().map(|cell| cell.parse().ok()).collect())
            .filter(|row: &Vec<f64>| !row.is_empty())
            .collect();
        assert_eq!(expected.len(), rows, "{file}");
        for (at, name) in names.iter().enumerate() {
            let (field, column) = results.frames[0].column(name).expect("there");
            #[expect(clippy::cast_precision_loss, reason = "labels are small")]
            let nodes: Vec<f64> = field.rows.nodes().expect("nodes").iter().map(|node| *node as f64).collect();
            assert_eq!(nodes, expected.iter().map(|row| row[0]).collect::<Vec<_>>(), "{file}");
            assert_eq!(column.values, expected.iter().map(|row| row[at + 1]).collect::<Vec<_>>(), "{file} {name}");
            let region = if file.contains("U1") { "I_SAMPLE" } else { "I_SAMPLE.Region_1" };
            assert_eq!(field.region.set.as_deref(), Some(region), "{file}");
        }
    }
}

#[test]
fn a_real_history_is_read_value_by_value() {
    let Some(bytes) = sample("abaqus/hist_abq2018.hrpt") else { return };
    let results = read(&bytes).expect("whole");
    let text = String::from_utf8(bytes).expect("ASCII");
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let names: Vec<&str> = lines.next().expect("names").split_whitespace().collect();
    let number = |cell: &str| if cell == "NoValue" { f64::NAN } else { cell.parse().expect("a number") };
    let rows: Vec<Vec<f64>> = lines.map(|line| line.split_whitespace().map(number).collect()).collect();
    assert_eq!(results.frames.len(), rows.len());
    for (frame, row) in results.frames.iter().zip(&rows) {
        assert_eq!((frame.total_time, frame.fields.len()), (Some(row[0]), names.len() - 1));
        for (name, value) in names.iter().zip(row).skip(1) {
            let found = &frame.column(name).expect("there").1.values;
            assert_eq!((found.len(), found[0].to_bits()), (1, value.to_bits()), "{name}");
        }
    }
}

/// A head as high as its table is wide would cost the product of both.
#[test]
fn a_high_head_over_a_wide_row_costs_no_product() {
    let mut text = "X\n".repeat(60_000);
    text.push('\n');
    text.push_str(&"1 ".repeat(60_000));
    text.push_str("\n\n");
    let failure = read_rpt(text.as_bytes()).expect_err("no table");
    assert!(failure.problem().expect("a problem").message.contains("no table of nodes and no XY data"), "{failure}");
}

#[test]
fn names_that_go_on_in_the_next_line_are_joined() {
    let text = "Field Output reported at nodes for part: A

            Node          CPRESS           COPEN
                      A_S1/A_M1       A_S1/A_M1
           Label          @Loc 1          @Loc 1
------------------------------------------------
               7     1.09260E-03        -2.E-06

";
    let results = read_rpt(text.as_bytes()).expect("whole");
    for (name, value) in [("CPRESS", 1.0926e-3), ("COPEN", -2e-6)] {
        let (field, column) = results.frames[0].column(name).expect("there");
        assert_eq!((field.rows.nodes(), column.values[0]), (Some(&[7][..]), value));
        let region = [&field.region.slave, &field.region.master, &field.region.set].map(Option::as_deref);
        assert_eq!(region, [Some("A_S1"), Some("A_M1"), Some("A")]);
    }
}
