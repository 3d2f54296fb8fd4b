//! Files that are cut, damaged or of another kind: a problem with its place, the part before it unchanged, never a panic.

mod common;

use common::{contact_fil, dat, frd, rpt, sample};
use inpact_results::vtu::{Array, Cell, Grid, Space, write_grid};
use inpact_results::{Field, Read, Results, read, read_dat, read_fil, read_frd, read_rpt, read_vtu};
use proptest::prelude::*;

const READERS: [fn(&[u8]) -> Read; 6] = [read, read_fil, read_rpt, read_frd, read_dat, read_vtu];

fn by_all_readers(bytes: &[u8]) {
    for read in READERS {
        match read(bytes) {
            Ok(results) => assert!(rectangular(&results)),
            Err(failure) => {
                assert!(failure.problem().expect("a problem").place.byte <= bytes.len() as u64);
                assert!(failure.into_read().is_none_or(|results| rectangular(&results)));
            }
        }
    }
}

fn vtu() -> Vec<u8> {
    let grid = Grid {
        points: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.1], [1.0, 1.0, 0.0]],
        cells: vec![Cell::face(vec![0, 1, 2], Space::Solid)],
        point_data: vec![Array::reals("ECD", vec![1.5, 2.5, 3.5]), Array::integers("node", vec![1, 2, 3])],
        time: Some(1.0),
        ..Grid::default()
    };
    let mut bytes = Vec::new();
    write_grid(&grid, &mut bytes).expect("sound");
    bytes
}

fn files() -> [Vec<u8>; 5] {
    [contact_fil().bytes(), frd().into_bytes(), dat().into_bytes(), rpt().into_bytes(), vtu()]
}

/// Whatever is given is rectangular: each column has a value a row.
fn rectangular(results: &Results) -> bool {
    let fields = results.frames.iter().flat_map(|frame| &frame.fields).chain(&results.coordinates);
    fields
        .flat_map(|field| field.columns.iter().map(|column| (&field.rows, column)))
        .all(|(rows, column)| column.values.len() == rows.len())
}

/// Whether every row of a part is that of the whole, in its place.
fn begins(part: &Field, whole: &Field) -> bool {
    let labels = match (part.rows.nodes(), whole.rows.nodes()) {
        (Some(part), Some(whole)) => whole.starts_with(part),
        (None, None) => true,
        _ => false,
    };
    labels
        && part.columns.iter().zip(&whole.columns).all(|(part, whole)| {
            let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
            part.name == whole.name && bits(&whole.values).starts_with(&bits(&part.values))
        })
}

fn unchanged(part: &Results, whole: &Results) -> bool {
    part.frames.len() <= whole.frames.len()
        && part.frames.iter().zip(&whole.frames).all(|(part, whole)| {
            (part.step, part.increment, part.total_time.map(f64::to_bits))
                == (whole.step, whole.increment, whole.total_time.map(f64::to_bits))
                && part.fields.len() <= whole.fields.len()
                && part.fields.iter().zip(&whole.fields).all(|(part, whole)| begins(part, whole))
        })
}

/// Every place where a file may be cut. A value that is given is always the value of the whole file.
#[test]
fn a_cut_changes_no_value() {
    for whole in files() {
        let expected = read(&whole).expect("whole");
        let mut problems = 0;
        for end in 0..whole.len() {
            let part = &whole[..end];
            let (found, problem) = match read(part) {
                Ok(found) => (Some(found), None),
                Err(failure) => {
                    let problem = failure.problem().cloned();
                    (failure.into_read(), problem)
                }
            };
            if let Some(problem) = problem {
                problems += 1;
                assert!(problem.place.byte <= end as u64 && 1 <= problem.place.line, "{end}: {problem}");
                assert!(!problem.message.is_empty() && !problem.help.is_empty());
            }
            assert!(found.as_ref().is_none_or(rectangular), "{} cut at {end}", expected.format);
            if let Some(found) = found.filter(|found| found.format == expected.format) {
                // The time of a picture is in an array, which may come after the cut.
                let pictures = expected.format == inpact_results::Format::Vtu;
                assert!(pictures || unchanged(&found, &expected), "{} cut at {end}", expected.format);
            }
        }
        // Only a cut between two increments, two tables or two lines of a printed table leaves a file that is whole in itself.
        let least = 0.96;
        #[expect(clippy::cast_precision_loss, reason = "small")]
        let share = f64::from(problems) / whole.len() as f64;
        assert!(least <= share, "{}: {share}", expected.format);
    }
}

#[test]
fn real_files_may_be_cut_anywhere() {
    for file in
        ["abaqus/quad_CPS4.fil", "abaqus/indentation_core_step0_frame1_S11_nodes.rpt", "calculix/cubespring.dat.ref"]
    {
        let Some(whole) = sample(file) else { continue };
        let expected = read(&whole).expect("whole");
        for end in 0..whole.len() {
            match read(&whole[..end]) {
                Ok(found) => assert!(unchanged(&found, &expected), "{file} cut at {end}"),
                Err(failure) => {
                    assert!(failure.into_read().is_none_or(|read| unchanged(&read, &expected)), "{file} cut at {end}");
                }
            }
        }
    }
}

#[test]
fn other_kinds_of_files_are_named() {
    let utf16: Vec<u8> = rpt().encode_utf16().flat_map(u16::to_le_bytes).collect();
    let marked: Vec<u8> = [&b"\xFF\xFE"[..], &utf16].concat();
    let binary_fil = [&b"\x00\x10\x00\x00"[..], &[0; 4096]].concat();
    let cases: [(&[u8], &str); 12] = [
        (b"", "the file is empty"),
        (b" \n\n", "the file is empty"),
        (&marked, "UTF-16"),
        (&utf16, "UTF-16"),
        (&binary_fil, "`abaqus ascfil job=NAME`"),
        (b"\x89HDF\r\n\x1a\n", "HDF5"),
        (b"\x1f\x8b\x08", "gzip"),
        (b"*HEADING\n*NODE\n", "a deck, not results"),
        (b"1\n\n   Abaqus 2024   Date 30-Nov-2026\n", "printed by Abaqus"),
        (b"a,b,c\n1,2,3\n", "the kind of this file is unknown"),
        (b"# vtk DataFile Version 3.0\n", "`meshio convert`"),
        (b"\x01\x02\x00\xff\xff\x00\x07", "binary"),
    ];
    for (bytes, part) in cases {
        let failure = read(bytes).expect_err("no results");
        assert!(failure.to_string().contains(part), "{part}: {failure}");
        assert!(failure.into_read().is_none());
    }
}

#[test]
fn messages_hold_nothing_that_a_terminal_acts_on() {
    let text = frd().replacen("-2.00000E-03", "-2.\u{1b}[31mE-3", 1);
    let message = read(text.as_bytes()).expect_err("damaged").to_string();
    assert!(!message.contains('\u{1b}'), "{message:?}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes_make_no_reader_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        by_all_readers(&bytes);
    }

    #[test]
    fn random_text_makes_no_reader_panic(text in "[-+*0-9.EDIAXNode \n]{0,300}") {
        by_all_readers(text.as_bytes());
    }

    /// Bytes changed, lines lost, doubled or taken from another file.
    #[test]
    fn damaged_files_make_no_reader_panic(
        which in 0..5_usize,
        other in 0..5_usize,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..8),
        piece in any::<(prop::sample::Index, prop::sample::Index, prop::sample::Index)>(),
    ) {
        let files = files();
        let mut bytes = files[which].clone();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        let from = &files[other];
        let (begin, end) = (piece.0.index(from.len()), piece.1.index(from.len()));
        let at = piece.2.index(bytes.len());
        bytes.splice(at..at, from[begin.min(end)..begin.max(end)].iter().copied());
        by_all_readers(&bytes);
    }
}
