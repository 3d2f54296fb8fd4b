//! `inpact nodes --results`: what a solver wrote, beside an independent reading of it.
//!
//! Without ccx the comparison with it does nothing and says so; where `INPACT_REQUIRE_CCX` is set, as in the gate, it fails instead.

use crate::program::{Folder, Run};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A block on a block: pressed on three nodes of four in the first step, lifted off in the second.
pub(crate) const PRESSED: &str = "\
*NODE, NSET=NALL
1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.
5, 0., 0., 1.\n6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.
11, 0.1, 0.2, 1.\n12, 0.9, 0.2, 1.\n13, 0.9, 0.8, 1.02\n14, 0.1, 0.8, 1.
15, 0.1, 0.2, 2.\n16, 0.9, 0.2, 2.\n17, 0.9, 0.8, 2.\n18, 0.1, 0.8, 2.
*ELEMENT, TYPE=C3D8, ELSET=EALL
1, 1, 2, 3, 4, 5, 6, 7, 8
2, 11, 12, 13, 14, 15, 16, 17, 18
*NSET, NSET=NLOW
1, 2, 3, 4
*NSET, NSET=NUP
15, 16, 17, 18
*MATERIAL, NAME=M
*ELASTIC
1000., 0.3
*CONDUCTIVITY
2.
*EXPANSION
1.E-5
*SOLID SECTION, ELSET=EALL, MATERIAL=M
*SURFACE, NAME=UPPER
2, S1
*SURFACE, NAME=LOWER
1, S2
*SURFACE INTERACTION, NAME=I
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
10000.
*GAP CONDUCTANCE
5., 0.
5., 1000.
*CONTACT PAIR, INTERACTION=I, TYPE=NODE TO SURFACE
UPPER, LOWER
*INITIAL CONDITIONS, TYPE=TEMPERATURE
NALL, 20.
*STEP
*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE
1., 1.
*BOUNDARY
NLOW, 1, 3
NUP, 1, 2
NUP, 3, 3, -0.01
NLOW, 11, 11, 20.
5, 11, 11, 30.
NUP, 11, 11, 100.
*NODE PRINT, NSET=NALL
U, NT
*CONTACT PRINT
CDIS, CSTR
*NODE FILE
U, NT
*CONTACT FILE
CDIS, CSTR
*END STEP
*STEP
*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE
1., 1.
*BOUNDARY
NUP, 3, 3, 0.005
*NODE PRINT, NSET=NALL
U, NT
*CONTACT PRINT
CDIS, CSTR
*END STEP
";

/// A folder in which ccx has run the deck, named `job.inp`; `None` without ccx.
pub(crate) fn ccx(deck: &str) -> Option<Folder> {
    let folder = Folder::with(&[("job.inp", deck)]);
    match Command::new("ccx").arg("job").current_dir(folder.path()).output() {
        Ok(output) if output.status.success() => Some(folder),
        Ok(output) => panic!("{}", String::from_utf8_lossy(&output.stdout)),
        Err(error) => {
            assert!(std::env::var_os("INPACT_REQUIRE_CCX").is_none(), "ccx: {error}");
            let _ = writeln!(std::io::stderr(), "SKIPPED, nothing was compared with CalculiX: ccx: {error}");
            None
        }
    }
}

/// The rows of a `.dat` below titles that begin so: by time and node, the numbers of the row.
fn printed(dat: &str, title: &str) -> BTreeMap<(String, i64), Vec<f64>> {
    let mut found = BTreeMap::new();
    let mut time = None;
    for line in dat.lines().map(str::trim).filter(|line| !line.is_empty()) {
        if line.starts_with(|first: char| first.is_ascii_alphabetic()) {
            time = line.starts_with(title).then(|| line.rsplit(' ').next().expect("a time").to_owned());
        } else if let Some(time) = &time {
            let mut cells = line.split_whitespace();
            let node = cells.next().and_then(|cell| cell.parse().ok()).expect("a node");
            let values = cells.map(|cell| cell.parse().expect("a number")).collect();
            found.insert((format!("{:?}", time.parse::<f64>().expect("a time")), node), values);
        }
    }
    found
}

/// A node table by time and node: the cells by column.
fn table(run: &Run) -> BTreeMap<(String, i64), BTreeMap<String, String>> {
    assert_eq!(run.code, 0, "{}", run.errors);
    let mut lines = run.output.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let header = lines.next().expect("a header");
    let rows = lines.map(|cells| {
        let row: BTreeMap<String, String> = header.iter().cloned().zip(cells).collect();
        let time = format!("{:?}", row["time"].parse::<f64>().expect("a time"));
        ((time, row["node"].parse().expect("a node")), row)
    });
    rows.collect()
}

fn number(row: &BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("`{column}` is `{}`", row[column]))
}

/// Six digits in `.frd`, seven in `.dat`.
fn close(found: f64, printed: f64, scale: f64) -> bool {
    (found - printed).abs() <= 1e-5 * printed.abs().max(scale)
}

/// The weights of the corners of a face that lies almost flat, below a point: bilinear in its own coordinates, found by Newton's method.
fn weights(corners: [[f64; 3]; 4], point: [f64; 3]) -> [f64; 4] {
    let of = |[u, v]: [f64; 2]| [(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v];
    let sum = |weights: [f64; 4], k: usize| (0..4).map(|i| weights[i] * corners[i][k]).sum::<f64>();
    let mut at = [0.5, 0.5];
    for _ in 0..20 {
        let [u, v] = at;
        let (along, across) = ([v - 1.0, 1.0 - v, v, -v], [u - 1.0, -u, u, 1.0 - u]);
        let rest = [0, 1].map(|k| sum(of(at), k) - point[k]);
        let [[a, b], [c, d]] = [0, 1].map(|k| [sum(along, k), sum(across, k)]);
        let determinant = a * d - b * c;
        at = [u - (d * rest[0] - b * rest[1]) / determinant, v - (a * rest[1] - c * rest[0]) / determinant];
    }
    of(at)
}

/// Compares every row of a node table with what the `.dat` of the same run says.
fn compare(found: &BTreeMap<(String, i64), BTreeMap<String, String>>, dat: &str) {
    let (gaps, stresses) = (printed(dat, "relative contact displacement"), printed(dat, "contact stress"));
    let (warm, moved) = (printed(dat, "temperatures"), printed(dat, "displacements"));
    assert_eq!((found.len(), gaps.len()), (8, 3), "two steps; three nodes of the first touch");
    let place = |node: i64| match node {
        11 => [0.1, 0.2, 1.0],
        12 => [0.9, 0.2, 1.0],
        13 => [0.9, 0.8, 1.02],
        14 => [0.1, 0.8, 1.0],
        5 => [0.0, 0.0, 1.0],
        6 => [1.0, 0.0, 1.0],
        7 => [1.0, 1.0, 1.0],
        _ => [0.0, 1.0, 1.0],
    };
    for (key, row) in found {
        let (time, node) = key;
        let of = |values: &BTreeMap<(String, i64), Vec<f64>>, node: i64, at: usize| values[&(time.clone(), node)][at];
        let now = |node: i64| [0, 1, 2].map(|k| place(node)[k] + of(&moved, node, k));
        assert!(close(number(row, "temp_s"), of(&warm, *node, 0), 0.0));
        let weights = weights([now(5), now(6), now(7), now(8)], now(*node));
        let master =
            |value: &dyn Fn(i64) -> f64| (5..).zip(weights).map(|(node, weight)| weight * value(node)).sum::<f64>();
        let temperature = master(&|node| of(&warm, node, 0));
        assert!((number(row, "temp_m") - temperature).abs() < 2e-3, "{} for {temperature}", row["temp_m"]);
        let [.., z] = now(*node);
        let source = row["source"].replace("@job.dat", "");
        match gaps.get(key) {
            Some(gap) => {
                assert!(close(number(row, "clearance"), gap[0], 0.0), "{} for {}", row["clearance"], gap[0]);
                assert!(close(number(row, "pressure"), stresses[key][0], 0.0));
                assert!(source.starts_with("clearance=COPEN pressure=CPRESS "), "{source}");
            }
            None => {
                let height = z - master(&|node| now(node)[2]);
                assert!((number(row, "clearance") - height).abs() < 1e-5, "{} for {height}", row["clearance"]);
                assert_eq!(row["pressure"], "0");
                assert!(source.starts_with("clearance=mesh+U pressure=CPRESS "), "{source}");
            }
        }
    }
}

#[test]
fn every_number_that_calculix_wrote_is_at_its_node() {
    let Some(folder) = ccx(PRESSED) else { return };
    let dat = folder.read("job.dat");
    for file in ["job.frd", "job.dat"] {
        let run = folder.inpact(&["nodes", "job.inp", "--dialect", "calculix", "--results", file]);
        compare(&table(&run), &dat);
        assert!(run.errors.contains("2 of 2 states, 8 nodes found by labels"), "{}", run.errors);
    }
    // Both: the numbers of the one that was named first.
    let both = |files: [&str; 2]| {
        folder.inpact(&["nodes", "job.inp", "--dialect", "calculix", "--results", files[0], "--results", files[1]])
    };
    let both = both(["job.dat", "job.frd"]);
    compare(&table(&both), &dat);
    assert!(both.output.contains("clearance=COPEN@job.dat"), "{}", both.output);
    assert!(!both.errors.contains("differs"), "{}", both.errors);
}

#[test]
fn eval_takes_the_table_of_results_as_it_is() {
    let Some(folder) = ccx(PRESSED) else { return };
    let made = folder.inpact(&["nodes", "job.inp", "--dialect", "calculix", "--results", "job.frd", "-o", "n.parquet"]);
    assert_eq!(made.code, 0, "{}", made.errors);
    let eval = folder.inpact(&["eval", "job.inp", "--dialect", "calculix", "--nodes", "n.parquet"]);
    assert_eq!(eval.code, 0, "{}", eval.errors);
    let rows = table(&eval);
    assert_eq!(rows.len(), 8);
    // Heat flows where the block touches, and out of the warm slave.
    assert!(0.0 < number(&rows[&("1.0".to_owned(), 11)], "HFL"), "{}", eval.output);
    assert_eq!(number(&rows[&("2.0".to_owned(), 11)], "HFL"), 0.0);
}

#[test]
fn a_file_that_cannot_be_used_says_where_and_why() {
    let Some(folder) = ccx(PRESSED) else { return };
    let frd = folder.read("job.frd");
    let half = frd.find("  100CL  102").expect("two steps") + 400;
    folder.write("cut.frd", &frd[..half]);
    folder.write("empty.frd", "");
    folder.write(
        "other.frd",
        &frd.replace(" 2.00000E+00\n", " 3.00000E+00\n").replace("1.00000E+00\n -1", "1.50000E+00\n -1"),
    );
    let cases = [
        ("cut.frd", 1, "cut.frd:", "2 states up to time 2.0 are before it, the last of which may not be whole"),
        ("empty.frd", 1, "empty.frd:1: the file is empty", "let the job run"),
        ("job.inp", 1, "job.inp:1: the file is a deck, not results", "name the results"),
        ("nowhere.frd", 2, "cannot read `nowhere.frd`", ""),
        ("other.frd", 1, "other.frd: node ", "it is of another mesh"),
    ];
    for (file, code, begin, end) in cases {
        let run = folder.inpact(&["nodes", "job.inp", "--dialect", "calculix", "--results", file, "-o", "n.csv"]);
        assert_eq!(run.code, code, "{file}: {}", run.errors);
        assert!(run.errors.contains(begin) && run.errors.contains(end), "{file}: {}", run.errors);
        assert!(!folder.names().contains(&"n.csv".to_owned()), "{file}");
    }
    // Nothing is written over what was read.
    let run = folder.inpact(&["nodes", "job.inp", "--dialect", "calculix", "--results", "job.frd", "-o", "job.frd"]);
    assert_eq!((run.code, folder.read("job.frd") == frd), (2, true), "{}", run.errors);
}

#[test]
fn notes_and_summary_of_results_as_json() {
    let Some(folder) = ccx(PRESSED) else { return };
    let arguments = ["nodes", "job.inp", "--dialect", "calculix", "--results", "job.frd", "--format", "json"];
    let run = folder.inpact(&arguments);
    let lines: Vec<serde_json::Value> =
        run.errors.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let summary = &lines.last().expect("a summary")["summary"];
    assert_eq!((summary["rows"].as_u64(), summary["results"][0]["used_states"].as_u64()), (Some(8), Some(2)));
    assert_eq!(summary["results"][0]["matched_by"], "labels");
    assert_eq!(summary["columns"][0]["source"], "COPEN of job.frd in 3, mesh moved by U of job.frd in 5 rows");
    assert!(lines.iter().any(|line| line["file"] == "job.frd" && line["severity"] == "note"), "{}", run.errors);
}

/// A real file, where the folder of them is at hand; they are no part of the project.
fn sample(name: &str) -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/results-samples");
    let path = std::env::var_os("INPACT_RESULTS").map_or(beside, PathBuf::from).join(name);
    let there = path.is_file();
    if !there {
        let _ = writeln!(std::io::stderr(), "no `{}`: set INPACT_RESULTS to a folder of results", path.display());
    }
    there.then_some(path)
}

#[test]
fn real_files_of_calculix_value_by_value() {
    for (name, slaves) in [("cubespring", 16), ("scheibe2n2f", 34)] {
        let files = [format!("calculix/{name}.inp"), format!("calculix/{name}.frd.ref")];
        let [Some(deck), Some(frd)] = files.map(|name| sample(&name)) else { continue };
        let path = |path: &Path| path.to_str().expect("UTF-8").to_owned();
        let run = Folder::with(&[]).inpact(&["nodes", &path(&deck), "--dialect", "calculix", "--results", &path(&frd)]);
        let found = table(&run);
        assert_eq!(found.len(), slaves, "{name}");
        let text = std::fs::read_to_string(&frd).expect("readable");
        let contact = text.split_once(" -4  CONTACT").expect("contact").1;
        let mut compared = 0;
        for line in
            contact.lines().skip_while(|line| !line.starts_with(" -1")).take_while(|line| line.starts_with(" -1"))
        {
            let value = |at: usize| line[13 + 12 * at..25 + 12 * at].trim().parse::<f64>().expect("a number");
            let node: i64 = line[3..13].trim().parse().expect("a node");
            let Some(row) = found.get(&("1.0".to_owned(), node)) else { panic!("{node} is no slave") };
            assert_eq!((number(row, "clearance"), number(row, "pressure")), (value(0), value(3)), "{name} {node}");
            compared += 1;
        }
        assert_eq!(compared, slaves, "{name}");
    }
}
