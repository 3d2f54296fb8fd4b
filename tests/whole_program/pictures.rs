//! `-o FILE.vtu`: the slave surfaces with every column, read back and compared with the table of the same run.

use crate::nodes_results::{PRESSED, ccx};
use crate::program::{Folder, Run, inpact, root};
use inpact_results::vtu::{CellKind, Grid, Values, read_grid};

const WELD: &str = "decks/weld-mesh/weld-mesh.inp";

fn grid(folder: &Folder, name: &str) -> Grid {
    let bytes = std::fs::read(folder.path().join(name)).expect("drawn");
    let (grid, problem) = read_grid(&bytes);
    assert_eq!(problem, None, "{name}");
    grid
}

fn reals<'a>(grid: &'a Grid, name: &str) -> &'a [f64] {
    let array = grid.point_data.iter().find(|array| array.name == name).unwrap_or_else(|| panic!("no `{name}`"));
    let Values::Reals(values) = &array.values else { panic!("`{name}` is of whole numbers") };
    values
}

fn integers<'a>(grid: &'a Grid, name: &str) -> &'a [i64] {
    let array = grid.point_data.iter().find(|array| array.name == name).unwrap_or_else(|| panic!("no `{name}`"));
    let Values::Integers(values) = &array.values else { panic!("`{name}` is of numbers that are not whole") };
    values
}

/// The columns of a table by their names.
fn columns(run: &Run) -> Vec<(String, Vec<String>)> {
    assert_eq!(run.code, 0, "{}", run.errors);
    let mut lines = run.output.lines().map(|line| line.split(','));
    let names: Vec<&str> = lines.next().expect("a header").collect();
    let rows: Vec<Vec<&str>> = lines.map(Iterator::collect).collect();
    let column = |at: usize| rows.iter().map(|row| row[at].to_owned()).collect();
    names.iter().enumerate().map(|(at, name)| ((*name).to_owned(), column(at))).collect()
}

/// Every column of numbers of some rows of a table is there, bit for bit.
fn compare(grid: &Grid, columns: &[(String, Vec<String>)], rows: std::ops::Range<usize>, texts: &[&str]) {
    let mut compared = 0;
    for (name, cells) in columns.iter().filter(|(name, _)| !texts.contains(&name.as_str())) {
        let values = reals(grid, name);
        assert_eq!(values.len(), rows.len(), "{name}");
        for (value, cell) in values.iter().zip(&cells[rows.clone()]) {
            let expected = match cell.as_str() {
                "" => f64::NAN,
                "open" => 0.0,
                "closed" => 1.0,
                "beyond_table" => 3.0,
                number => number.parse().expect("a number"),
            };
            assert!(
                value.to_bits() == expected.to_bits() || value.is_nan() && expected.is_nan(),
                "{name}: {value} for {cell}"
            );
            compared += 1;
        }
    }
    assert!(rows.len() < compared, "several columns");
}

#[test]
fn a_single_state_is_a_single_picture_with_every_output() {
    let folder = Folder::with(&[]);
    let deck = root().join(WELD).display().to_string();
    let table = columns(&inpact(&["eval", WELD]));
    let run = folder.inpact(&["eval", &deck, "-o", "weld.vtu"]);
    assert_eq!((run.code, run.output.as_str()), (0, ""), "{}", run.errors);
    assert!(run.errors.contains("25 rows in, 25 rows out"), "{}", run.errors);
    assert_eq!(folder.names(), ["weld.vtu"]);
    let drawn = grid(&folder, "weld.vtu");
    compare(&drawn, &table, 0..25, &["node", "interaction"]);
    // Four by four faces over their nodes, in the plane of the sheet.
    assert_eq!((drawn.cells.len(), drawn.time), (16, None));
    assert!(drawn.cells.iter().all(|cell| cell.kind == CellKind::Quadrilateral));
    let labels: Vec<String> = integers(&drawn, "node").iter().map(|label| format!("UPPER-1.{label}")).collect();
    assert_eq!(labels, table[0].1);
    // What the rows were made of is there too.
    let nodes = columns(&inpact(&["nodes", WELD]));
    compare(&drawn, &nodes, 0..25, &["node", "interaction", "area"]);
    let run = folder.inpact(&["nodes", &deck, "-o", "nodes.vtu"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    compare(&grid(&folder, "nodes.vtu"), &nodes, 0..25, &["node", "interaction"]);
}

#[test]
fn states_are_pictures_and_a_collection_over_time() {
    let Some(folder) = ccx(PRESSED) else { return };
    let arguments = ["eval", "job.inp", "--dialect", "calculix", "--results", "job.frd"];
    let table = columns(&folder.inpact(&arguments));
    let run = folder.inpact(&[&arguments[..], &["-o", "out.vtu"]].concat());
    assert_eq!(run.code, 0, "{}", run.errors);
    let names: Vec<String> = folder.names().into_iter().filter(|name| name.starts_with("out")).collect();
    assert_eq!(names, ["out-1.vtu", "out-2.vtu", "out.pvd"]);
    for (at, time) in [1.0, 2.0].into_iter().enumerate() {
        let drawn = grid(&folder, &format!("out-{}.vtu", at + 1));
        assert_eq!(drawn.time, Some(time));
        compare(&drawn, &table, 4 * at..4 * at + 4, &["node", "interaction", "time"]);
        assert_eq!((integers(&drawn, "node"), integers(&drawn, "pair")), (&[11, 12, 13, 14][..], &[1; 4][..]));
        // Points have moved: by what the job says of them.
        let lift = drawn.points[0][2] - 1.0;
        assert!(if at == 0 { lift < -1e-4 } else { 1e-3 < lift }, "{lift}");
    }
    let collection = folder.read("out.pvd");
    for entry in [r#"timestep="1.0" part="0" file="out-1.vtu""#, r#"timestep="2.0" part="0" file="out-2.vtu""#] {
        assert!(collection.contains(entry), "{collection}");
    }
    // A collection may be asked for by its name.
    let run = folder.inpact(&["nodes", "job.inp", "--dialect", "calculix", "--results", "job.frd", "-o", "n.pvd"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert_eq!(folder.names().iter().filter(|name| name.starts_with('n')).count(), 3);
    // What was drawn is where the nodes have moved to, which the deck does not say.
    let run = folder.inpact(&["nodes", "job.inp", "--dialect", "calculix", "--results", "out-1.vtu"]);
    assert_eq!(run.code, 1, "{}", run.errors);
    assert!(run.errors.contains("out-1.vtu: node 11 is at (0.0"), "{}", run.errors);
}

#[test]
fn surfaces_of_nodes_are_points() {
    let deck = "\
*NODE
1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 1.\n6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.
9, .5, .5, 1.25
*ELEMENT, TYPE=C3D8, ELSET=E
1, 1, 2, 3, 4, 5, 6, 7, 8
*SURFACE, NAME=M
E, S2
*SURFACE, NAME=S, TYPE=NODE
9, 2.
*SURFACE INTERACTION, NAME=I
*GAP CONDUCTANCE
10., 0.
0., 1.
*CONTACT PAIR, INTERACTION=I
S, M
";
    let folder = Folder::with(&[("a.inp", deck)]);
    let run = folder.inpact(&["eval", "a.inp", "-o", "a.VTU"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let drawn = grid(&folder, "a.VTU");
    assert_eq!((drawn.points.as_slice(), drawn.cells[0].kind), (&[[0.5, 0.5, 1.25]][..], CellKind::Vertex));
    assert_eq!((reals(&drawn, "clearance"), reals(&drawn, "thermal_conductance")), (&[0.25][..], &[7.5][..]));
}

#[test]
fn a_picture_needs_a_mesh_and_is_never_drawn_over_an_input() {
    let folder = Folder::with(&[
        ("a.inp", "*SURFACE INTERACTION, NAME=I\n*GAP CONDUCTANCE\n10., 0.\n0., 1.\n"),
        ("n.csv", "clearance\n0.5\n"),
    ]);
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "n.csv", "-o", "a.vtu"]);
    assert_eq!(run.code, 2, "{}", run.errors);
    assert!(run.errors.contains("a picture needs rows that are made of the deck's mesh"), "{}", run.errors);
    assert_eq!(folder.names(), ["a.inp", "n.csv"]);
    let Some(folder) = ccx(PRESSED) else { return };
    let arguments = ["nodes", "job.inp", "--dialect", "calculix", "--results", "out-1.vtu", "-o", "out.vtu"];
    folder.write("out-1.vtu", "");
    let run = folder.inpact(&arguments);
    assert_ne!(run.code, 0, "{}", run.errors);
    assert_eq!(folder.read("out-1.vtu"), "", "{}", run.errors);
}
