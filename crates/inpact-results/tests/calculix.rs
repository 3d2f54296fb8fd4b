//! Results of CalculiX, `.frd` and `.dat`: made up, and real ones.

mod common;

use common::{dat, frd, sample};
use inpact_results::{Field, Format, Frame, Rows, read, read_dat, read_frd};

fn values<'a>(frame: &'a Frame, name: &str) -> &'a [f64] {
    &frame.column(name).unwrap_or_else(|| panic!("no column `{name}`")).1.values
}

#[test]
fn frd_has_all_steps_and_components() {
    let results = read(frd().as_bytes()).expect("whole");
    assert_eq!((results.format, results.frames.len()), (Format::Frd, 2));
    for (frame, time, increment) in [(0, 0.5, 1), (1, 1.0, 2)] {
        let frame = &results.frames[frame];
        assert_eq!((frame.total_time, frame.step, frame.increment), (Some(time), Some(1), Some(increment)));
        assert_eq!((values(frame, "U1"), values(frame, "U3")), (&[1e-3, 4e-3][..], &[3e-3, -6e-100][..]));
        assert_eq!((values(frame, "C6"), values(frame, "C8")), (&[6.0][..], &[-8.0][..]));
        assert_eq!(frame.column("C8").expect("there").0.rows, Rows::Nodes(vec![2]));
        assert_eq!(frame.fields.len(), 2);
    }
    let coordinates = results.coordinates.expect("there");
    assert_eq!(coordinates.column("COOR3").expect("there").values, [-0.25, 0.0]);
    assert_eq!(results.not_read[0].what, "elements");
}

#[test]
fn the_short_format_has_labels_of_five_digits() {
    let long = frd();
    let short: String = long
        .lines()
        .map(|line| match line.get(..3) {
            Some(key @ (" -1" | " -2")) if 40 <= line.len() => format!("{key}{}\n", &line[8..]),
            _ if line.starts_with("    2C") || line.starts_with("  100C") => format!("{}0\n", &line[..line.len() - 1]),
            _ => format!("{line}\n"),
        })
        .collect();
    assert_ne!(short, long);
    // The second line of eight components is shorter than the rest.
    let short = short.replace(" -2           7.0", " -2      7.0");
    assert_eq!(read_frd(short.as_bytes()).expect("whole"), read_frd(long.as_bytes()).expect("whole"));
}

#[test]
fn an_unfinished_frd_gives_what_it_has() {
    let text = frd();
    let text = text.strip_suffix(" 9999\n").expect("the end");
    let failure = read_frd(text.as_bytes()).expect_err("cut");
    assert!(failure.problem().expect("a problem").message.contains("9999"), "{failure}");
    assert_eq!(failure.problem().expect("a problem").place.byte, text.len() as u64);
    assert_eq!(failure.into_read().expect("the part before").frames.len(), 2);
}

#[test]
fn binary_frd_says_what_to_do() {
    let text = frd().replacen("         1\n", "         2\n", 1);
    let text = text.replacen("                                     1\n", "                                     2\n", 1);
    let failure = read_frd(text.as_bytes()).expect_err("binary");
    assert!(failure.to_string().contains("`*CONTACT FILE`"), "{failure}");
}

#[test]
fn a_wrong_number_in_a_frd_has_its_place() {
    let text = frd().replacen("-2.00000E-03", "-2.0000oE-03", 1);
    let failure = read_frd(text.as_bytes()).expect_err("damaged");
    let at = text.find("-2.0000oE-03").expect("there");
    assert_eq!(failure.problem().expect("a problem").place.byte, at as u64, "{failure}");
    assert!(
        failure.problem().expect("a problem").message.contains("value 2 of 3 of node 1, found `-2.0000oE-03`"),
        "{failure}"
    );
}

#[test]
fn dat_has_contact_by_nodes_and_by_points() {
    let results = read(dat().as_bytes()).expect("whole");
    assert_eq!((results.format, results.frames.len()), (Format::Dat, 2));
    for (frame, time) in [(0, 0.5), (1, 1.0)] {
        let frame = &results.frames[frame];
        assert_eq!(frame.total_time, Some(time));
        let (field, opening) = frame.column("COPEN").expect("there");
        assert_eq!(
            (field.rows.nodes(), &opening.values[..]),
            (Some(&[65, 66][..]), &[-1.047_481e-4, -1.044_77e-4][..])
        );
        assert_eq!(values(frame, "CSLIP2"), [0.0, 1e-101]);
        let (field, pressure) = frame.column("CPRESS").expect("there");
        assert_eq!(field.rows, Rows::FacePoints { elements: vec![28, 28], faces: vec![3, 3] });
        assert_eq!(pressure.values, [101.7562, 100.0]);
        assert_eq!(values(frame, "CELS"), [8.096_094e-6]);
        assert_eq!((values(frame, "U2"), values(frame, "NT11")), (&[-1.5e-5][..], &[300.0][..]));
        let (field, area) = frame.column("CAREA").expect("there");
        assert_eq!((&field.rows, area.values[0]), (&Rows::Whole, 0.25));
        assert_eq!((field.region.slave.as_deref(), field.region.master.as_deref()), (Some("SSLAV"), Some("SMAST")));
        assert_eq!((values(frame, "CF3"), values(frame, "NORMAL_FORCE")), (&[3.0][..], &[-25.0][..]));
        assert!(values(frame, "NORMAL1")[0].is_nan());
    }
    let passed_over: Vec<_> = results.not_read.iter().map(|found| (found.what.as_str(), found.count)).collect();
    let stresses = "stresses (elem, integ.pnt.,sxx,syy,szz,sxy,sxz,syz) for set EALL";
    assert_eq!(passed_over, [(stresses, 2), ("total number of contact elements", 2)]);
}

#[test]
fn a_row_that_is_none_has_its_place() {
    let text = dat().replacen("-1.044770E-04", "-1.04477oE-04", 1);
    let failure = read_dat(text.as_bytes()).expect_err("damaged");
    assert_eq!(failure.problem().expect("a problem").place.byte, text.find("-1.04477oE-04").expect("there") as u64);
    let read = failure.into_read().expect("the part before");
    assert_eq!(values(&read.frames[0], "COPEN"), [-1.047_481e-4]);
}

/// An independent reading of a row: numbers may touch each other only at a minus sign.
fn numbers(row: &str) -> Vec<f64> {
    let mut apart = String::new();
    for (at, letter) in row.char_indices() {
        if letter == '-' && !row[..at].ends_with('E') {
            apart.push(' ');
        }
        apart.push(letter);
    }
    apart.split_whitespace().map(|cell| cell.parse().expect("a number")).collect()
}

/// Node by node and column by column, against the rows of a text.
#[expect(clippy::cast_precision_loss, reason = "labels are small")]
fn same(field: &Field, rows: &[Vec<f64>]) -> usize {
    let nodes = field.rows.nodes().expect("nodes");
    assert_eq!(nodes.len(), rows.len());
    for (at, (node, row)) in nodes.iter().zip(rows).enumerate() {
        let found: Vec<f64> = std::iter::once(*node as f64).chain(field.columns.iter().map(|c| c.values[at])).collect();
        assert_eq!(&found, row);
    }
    rows.len() * field.columns.len()
}

#[test]
fn real_frd_files_are_read_value_by_value() {
    for (file, fields, points) in [
        ("calculix/cubespring.frd.ref", &["U", "STRESS", "CONTACT"][..], 128),
        ("calculix/scheibe2n2f.frd.ref", &["U", "CONTACT"][..], 1156),
    ] {
        let Some(bytes) = sample(file) else { continue };
        let results = read(&bytes).expect("whole");
        assert_eq!((results.frames.len(), results.frames[0].total_time), (1, Some(1.0)), "{file}");
        assert_eq!((results.frames[0].step, results.frames[0].increment), (Some(1), Some(1)));
        let names: Vec<_> = results.frames[0].fields.iter().map(|field| &*field.name).collect();
        assert_eq!(names, fields, "{file}");
        // Blocks of rows, without that of the elements, which has lines ` -2`.
        let text = String::from_utf8(bytes).expect("ASCII");
        let blocks =
            text.split("\n -3").map(|block| -> Vec<_> { block.lines().filter(|l| l.starts_with(" -1")).collect() });
        let mut blocks: Vec<_> = blocks.filter(|rows| !rows.is_empty()).collect();
        blocks.remove(1);
        let read = std::iter::once(results.coordinates.as_ref().expect("there")).chain(&results.frames[0].fields);
        let mut compared = 0;
        for (field, rows) in read.zip(&blocks) {
            let rows: Vec<_> = rows.iter().map(|row| numbers(&row[3..])).collect();
            compared += same(field, &rows);
        }
        assert!(6 * points <= compared, "{file}: {compared}");
        assert_eq!(blocks.len(), fields.len() + 1);
    }
}

#[test]
fn a_real_dat_file_is_read_value_by_value() {
    let Some(bytes) = sample("calculix/cubespring.dat.ref") else { return };
    let results = read(&bytes).expect("whole");
    let text = String::from_utf8(bytes).expect("ASCII");
    let rows: Vec<_> = text.lines().filter(|line| line.contains('E') && !line.contains("time")).map(numbers).collect();
    assert_eq!(results.frames.len(), 1);
    assert_eq!(same(&results.frames[0].fields[0], &rows), 3 * 128);
    assert_eq!(results.frames[0].fields[0].region.set.as_deref(), Some("NALL"));
}
