//! ASCII results files of Abaqus: written by the record descriptions of the manual, and real ones.

mod common;

use common::{Fil, W, contact_fil, of_d22, sample};
use inpact_results::{Format, NotRead, Results, Rows, read, read_fil};
use proptest::prelude::*;

fn name(name: Option<&inpact_results::Name>) -> &str {
    name.map_or("", |name| name)
}

fn column<'a>(results: &'a Results, frame: usize, column: &str) -> (&'a [i64], &'a [f64]) {
    let (field, column) = results.frames[frame].column(column).expect("the column is there");
    (field.rows.nodes().expect("nodes"), &column.values)
}

#[test]
fn contact_records_become_columns() {
    let results = read(&contact_fil().bytes()).expect("whole");
    assert_eq!((results.format, results.frames.len()), (Format::Fil, 2));
    for (frame, increment) in [(0, 1), (1, 2)] {
        let time = f64::from(increment) * 0.1;
        let found = &results.frames[frame];
        assert_eq!((found.step, found.increment), (Some(2), Some(i64::from(increment))));
        assert_eq!((found.total_time, found.step_time), (Some(of_d22(1.0 + time)), Some(of_d22(time))));
        let at = |factor: f64| [of_d22(factor * time), of_d22(factor * (2.0 * time))];
        assert_eq!(column(&results, frame, "CPRESS"), (&[1, 2][..], &at(10.0)[..]));
        assert_eq!(column(&results, frame, "CSHEAR2"), (&[1, 2][..], &at(-1.0)[..]));
        assert_eq!(column(&results, frame, "COPEN"), (&[1, 2][..], &at(-1e-6)[..]));
        let outputs = [
            "HFL", "HFLA", "HTL", "HTLA", "SFDR", "SFDRA", "SFDRT", "SFDRTA", "WEIGHT", "SJD", "SJDA", "SJDT", "SJDTA",
            "ECD", "ECDA", "ECDT", "ECDTA", "PFL", "PFLA", "PTL", "PTLA",
        ];
        for (key, output) in (1528..).zip(outputs) {
            assert_eq!(column(&results, frame, output), (&[1, 2][..], &at(f64::from(key))[..]), "{output}");
        }
        let (field, _) = found.column("ECD").expect("there");
        assert_eq!(name(field.region.slave.as_ref()), "ASSEMBLY_SLAVE_SURFACE");
        assert_eq!((name(field.region.master.as_ref()), field.region.set.as_ref()), ("MAST", None));
        let (field, area) = found.column("CAREA").expect("there");
        assert_eq!((&field.rows, &area.values[..]), (&Rows::Whole, &[2.25][..]));
        assert_eq!(found.column("CFN3").expect("there").1.values, [4.0]);
        assert_eq!(column(&results, frame, "NT11").1[2], of_d22(300.0 + 3.0 * time));
        assert_eq!(
            column(&results, frame, "U3"),
            (&[1, 2, 3][..], &[1.0, 2.0, 3.0].map(|n| of_d22(n * time * 1e-120))[..])
        );
        assert_eq!(column(&results, frame, "EPOT").1[0], of_d22(time / 7.0));
        assert_eq!(name(found.column("U1").expect("there").0.region.set.as_ref()), "ALL");
    }
}

#[test]
fn surfaces_and_coordinates_are_read() {
    let results = read_fil(&contact_fil().bytes()).expect("whole");
    let surface = &results.surfaces[0];
    assert_eq!(&*surface.name, "ASSEMBLY_SLAVE_SURFACE");
    assert_eq!(
        (surface.faces[0].element, surface.faces[0].face, &surface.faces[0].nodes[..]),
        (20, 5, &[1, 2, 3, 4][..])
    );
    let coordinates = results.coordinates.expect("there");
    assert_eq!(coordinates.rows, Rows::Nodes(vec![1, 2, 3, 4]));
    assert_eq!(coordinates.column("COOR2").expect("there").values[3], of_d22(-4.0 / 3.0));
    let passed_over = [("record 1921", 1), ("record 1999", 2)];
    assert_eq!(results.not_read, passed_over.map(|(what, count)| NotRead { what: what.to_owned(), count }));
}

#[test]
fn components_are_named_by_active_degrees_of_freedom() {
    let mut fil = Fil::default();
    fil.record(
        1902,
        &[W::I(1), W::I(2), W::I(0), W::I(0), W::I(0), W::I(3), W::I(0), W::I(0), W::I(0), W::I(0), W::I(4)],
    )
    .end();
    fil.begin(1, 1, 1.0, 1.0).record(101, &[W::I(5), W::D(1.0), W::D(2.0), W::D(3.0)]).end();
    let results = read_fil(&fil.bytes()).expect("whole");
    let names: Vec<_> = results.frames[0].fields[0].columns.iter().map(|column| &*column.name).collect();
    assert_eq!(names, ["U1", "U2", "UR3"]);
}

#[test]
fn two_pairs_are_two_fields() {
    let mut fil = Fil::default();
    fil.begin(1, 1, 1.0, 1.0);
    for (slave, value) in [("S1", 1.0), ("S2", 2.0)] {
        fil.record(1503, &[W::I(0), W::A(slave), W::A("M"), W::A("SOME")]);
        fil.record(1504, &[W::I(9), W::I(2)]).record(1511, &[W::D(value), W::D(0.0)]).record(1524, &[W::D(value)]);
    }
    fil.end();
    let results = read_fil(&fil.bytes()).expect("whole");
    let found: Vec<_> = results.frames[0]
        .columns("CPRESS")
        .map(|(field, column)| (name(field.region.slave.as_ref()), name(field.region.set.as_ref()), column.values[0]))
        .collect();
    assert_eq!(found, [("S1", "SOME", 1.0), ("S2", "SOME", 2.0)]);
    assert_eq!(results.frames[0].columns("CAREA").count(), 2);
}

#[test]
fn lines_that_lost_their_blanks_or_have_other_ends_are_read() {
    let whole = contact_fil().bytes();
    let expected = read_fil(&whole).expect("whole");
    let text = String::from_utf8(whole).expect("ASCII");
    let stripped: String = text.lines().map(|line| format!("{}\n", line.trim_end())).collect();
    assert_eq!(read_fil(stripped.as_bytes()).expect("whole"), expected);
    assert_eq!(read_fil(text.replace('\n', "\r\n").as_bytes()).expect("whole"), expected);
}

#[test]
fn an_increment_without_an_end_is_a_problem_and_is_given() {
    let mut fil = Fil::default();
    fil.begin(1, 3, 1.0, 1.0).record(201, &[W::I(4), W::D(300.0)]);
    let failure = read_fil(&fil.bytes()).expect_err("cut");
    assert!(failure.problem().expect("a problem").message.contains("increment 3 of step 1 has no end"), "{failure}");
    let read = failure.into_read().expect("the part before");
    assert_eq!(read.frames[0].column("NT11").expect("there").1.values, [300.0]);
}

/// A record of more words than any has is damaged; one of as many is as long as the file lets it be.
#[test]
fn words_of_a_record_have_a_greatest_number() {
    let message = |count: u32| {
        let text = format!("{:80}\n", format!("*I 7{count}I 41921"));
        read_fil(text.as_bytes()).expect_err("no whole record").problem().expect("a problem").message.clone()
    };
    assert_eq!(message(1_048_577), "expected the number of words of a record, 2 to 1048576, found `1048577`");
    assert!(!message(1_048_576).contains("number of words"), "{}", message(1_048_576));
}

#[test]
fn a_damaged_word_has_its_place() {
    let text = String::from_utf8(contact_fil().bytes())
        .expect("ASCII")
        .replace("D 1.000000000000000D+00A", "D 1.0000?0000000000D+00A");
    let text = text.replacen("D-3.333333333333333D-01", "D-3.3333x3333333333D-01", 1);
    let failure = read_fil(text.as_bytes()).expect_err("damaged");
    let at = usize::try_from(failure.problem().expect("a problem").place.byte).expect("small");
    assert_eq!(text.as_bytes()[at], b'D', "{failure}");
    assert!(failure.problem().expect("a problem").message.contains("expected a number"), "{failure}");
    assert_eq!(failure.problem().expect("a problem").place.line, 1 + text[..at].matches('\n').count() as u64);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    /// Every value comes back to the 16 digits that are written, whatever its exponent.
    #[test]
    fn every_value_comes_back(
        rows in prop::collection::vec((1..999_999_999_i64, any::<f64>(), any::<f64>()), 1..20),
        time in 0.0..1e6_f64,
    ) {
        let finite = |value: f64| if value.is_finite() { value } else { 0.0 };
        let mut fil = Fil::default();
        fil.begin(1, 1, time, time).record(1503, &[W::I(0), W::A("S"), W::A("M"), W::A("")]);
        for (node, first, second) in &rows {
            fil.record(1504, &[W::I(*node), W::I(2)]);
            fil.record(1521, &[W::D(finite(*first)), W::D(finite(*second))]);
            fil.record(1541, &[W::D(finite(*second))]);
        }
        fil.end();
        let results = read_fil(&fil.bytes()).expect("whole");
        let nodes: Vec<i64> = rows.iter().map(|row| row.0).collect();
        let firsts: Vec<u64> = rows.iter().map(|row| of_d22(finite(row.1)).to_bits()).collect();
        let seconds: Vec<u64> = rows.iter().map(|row| of_d22(finite(row.2)).to_bits()).collect();
        for (output, expected) in [("COPEN", &firsts), ("CSLIP1", &seconds), ("ECD", &seconds)] {
            let (labels, values) = column(&results, 0, output);
            prop_assert_eq!(labels, &nodes[..]);
            let bits: Vec<u64> = values.iter().map(|value| value.to_bits()).collect();
            prop_assert_eq!(&bits, expected);
        }
    }
}

/// An independent reading: all words of all records as texts, from the joined lines.
fn records(bytes: &[u8]) -> Vec<Vec<String>> {
    let text = String::from_utf8(bytes.to_vec()).expect("ASCII");
    let joined: String = text.lines().map(|line| format!("{line:80}")).collect();
    let mut records: Vec<Vec<String>> = Vec::new();
    let mut rest = joined.trim_end();
    while !rest.is_empty() {
        let (word, after) = match &rest[..1] {
            "I" => {
                let length: usize = rest[1..3].trim().parse().expect("a count");
                (&rest[3..3 + length], &rest[3 + length..])
            }
            "D" => (&rest[1..23], &rest[23..]),
            "A" => (&rest[1..9.min(rest.len())], &rest[9.min(rest.len())..]),
            _ => {
                if rest.starts_with('*') {
                    records.push(Vec::new());
                }
                rest = &rest[1..];
                continue;
            }
        };
        records.last_mut().expect("a record").push(word.trim().to_owned());
        rest = after;
    }
    records
}

#[test]
fn real_files_are_read_value_by_value() {
    for (file, dimensions) in [("abaqus/quad_CPS4.fil", 2), ("abaqus/hex_C3D8.fil", 3)] {
        let Some(bytes) = sample(file) else { continue };
        let results = read(&bytes).expect("whole");
        assert_eq!(results.frames.len(), 1);
        let frame = &results.frames[0];
        assert_eq!((frame.step, frame.increment, frame.total_time), (Some(1), Some(1), Some(1.0)));
        let records = records(&bytes);
        let number = |text: &String| text.replace('D', "E").parse::<f64>().expect("a number");
        let mut compared = 0;
        for (key, prefix) in [("101", "U"), ("107", "COOR"), ("1901", "COOR")] {
            let rows: Vec<_> = records.iter().filter(|record| record[1] == key).collect();
            assert!(4 <= rows.len(), "{file} {key}");
            for at in 1..=dimensions {
                let name = format!("{prefix}{at}");
                let (field, column) = match key {
                    "1901" => {
                        let field = results.coordinates.as_ref().expect("there");
                        (field, field.column(&name).expect("there"))
                    }
                    _ => frame.column(&name).expect("there"),
                };
                let nodes: Vec<i64> = rows.iter().map(|record| record[2].parse().expect("a label")).collect();
                let values: Vec<f64> = rows.iter().map(|record| number(&record[2 + at])).collect();
                assert_eq!((field.rows.nodes(), &column.values), (Some(&nodes[..]), &values), "{file} {key} {name}");
                compared += values.len();
            }
        }
        assert_eq!(compared, 3 * dimensions * if dimensions == 2 { 4 } else { 8 }, "{file}");
    }
}
