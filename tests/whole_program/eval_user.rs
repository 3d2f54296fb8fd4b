//! `--user-library`: a deck whose conductance comes from Fortran, compiled here by gfortran.
//!
//! Without gfortran these tests do nothing and say so; where `INPACT_REQUIRE_GFORTRAN` is set, as in the gate, they fail instead.

use crate::program::{Folder, root};
use std::io::Write;
use std::process::Command;

/// The sample, with its routine compiled; `None` without a compiler.
fn sample() -> Option<Folder> {
    let folder = Folder::with(&[]);
    for name in ["user-law.inp", "user-law-nodes.csv", "gapelectr.f", "ABA_PARAM.INC"] {
        let text = std::fs::read_to_string(root().join("decks/user-law").join(name)).expect("readable");
        folder.write(name, &text);
    }
    compile(&folder).then_some(folder)
}

/// Compiles as the manual page says.
fn compile(folder: &Folder) -> bool {
    let mut command = Command::new("gfortran");
    command.args(["-shared", "-fPIC", "-o", "gapelectr.so", "gapelectr.f"]);
    match command.current_dir(folder.path()).output() {
        Ok(output) if output.status.success() => true,
        Ok(output) => panic!("{}", String::from_utf8_lossy(&output.stderr)),
        Err(error) => {
            assert!(std::env::var_os("INPACT_REQUIRE_GFORTRAN").is_none(), "gfortran: {error}");
            let _ = writeln!(std::io::stderr(), "SKIPPED, no Fortran routine was evaluated: gfortran: {error}");
            false
        }
    }
}

const EVAL: [&str; 6] = ["eval", "user-law.inp", "--nodes", "user-law-nodes.csv", "--user-library", "gapelectr.so"];

/// Columns of a table, by name.
fn columns(csv: &str, names: &[&str]) -> Vec<Vec<f64>> {
    let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().expect("a header");
    let place = |name: &&str| header.iter().position(|column| column == name).unwrap_or_else(|| panic!("no {name}"));
    let places: Vec<usize> = names.iter().map(place).collect();
    lines.map(|cells| places.iter().map(|place| cells[*place].parse().expect("a number")).collect()).collect()
}

#[test]
fn the_sample_gives_what_its_formula_says() {
    let Some(folder) = sample() else { return };
    let run = folder.inpact(&[&EVAL[..], &["--derivatives", "-o", "result.csv"]].concat());
    assert_eq!((run.code, run.output.as_str()), (0, ""), "{}", run.errors);
    let nodes = folder.read("user-law-nodes.csv");
    let given = columns(
        &nodes,
        &[
            "step",
            "increment",
            "step_time",
            "clearance",
            "temp_s",
            "temp_m",
            "fv1_s",
            "fv1_m",
            "x_s",
            "y_s",
            "epot_s",
            "epot_m",
        ],
    );
    let found = columns(&folder.read("result.csv"), &["conductance", "dconductance_dtemp", "ECD", "SJDT"]);
    assert_eq!((found.len(), given.len()), (72, 72));
    let close =
        |found: f64, expected: f64| assert!((found - expected).abs() <= 1e-14 * expected.abs(), "{found} {expected}");
    for (given, found) in given.iter().zip(&found) {
        let &[step, increment, step_time, clearance, temp_s, temp_m, fv_s, fv_m, x, y, epot_s, epot_m] = &given[..]
        else {
            panic!("twelve columns")
        };
        let at_20_degrees = 8e8
            * (-clearance / 2e-6).exp()
            * (0.5 * (fv_s + fv_m))
            * if x.hypot(y) > 5e-3 { 0.5 } else { 1.0 }
            * if (step, increment) == (1.0, 1.0) { 0.1 } else { 1.0 }
            / if step == 2.0 { 1.0 + step_time / 1000.0 } else { 1.0 };
        let warmer = 1.0 + 4e-3 * (0.5 * (temp_s + temp_m) - 20.0);
        let conductance = at_20_degrees / warmer;
        close(found[0], conductance);
        close(found[1], -4e-3 * conductance / warmer);
        close(found[2], conductance * (epot_s - epot_m));
        assert!(found[3] >= 0.0);
    }
    let worn: Vec<f64> = found[..9].iter().map(|row| row[0]).collect();
    assert!(worn[0] > 0.0 && worn[4] > worn[1] && worn[1] > worn[0], "{worn:?}");
}

#[test]
fn the_plan_of_the_sample() {
    let Some(folder) = sample() else { return };
    let of = |more: &[&str]| {
        let run = folder.inpact(&[&["plan", "user-law.inp", "--nodes", "user-law-nodes.csv"], more].concat());
        assert_eq!(run.code, 0, "{}", run.errors);
        run.output
    };
    insta::assert_snapshot!("user_plan", of(&["--user-library", "./gapelectr.so", "--derivatives"]));
    let json = of(&["--user-library", "gapelectr.so", "--format", "json"]);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let expected = serde_json::json!({
        "subroutine": "GAPELECTR", "npred": 1, "ciname": "TINNED", "slname": "TERMINAL-FACE", "msname": "BAR-FACE",
    });
    assert_eq!(json["interactions"][0]["electrical"]["user"], expected);
    let without = of(&[]);
    let cure = "without electrical law: needs user subroutine GAPELECTR; give it with `--user-library FILE`";
    assert!(without.contains(cure), "{without}");
}

#[test]
fn without_the_library_nothing_is_evaluated_and_the_cure_is_named() {
    let name = "decks/user-law/user-law";
    let run = crate::program::inpact(&["eval", &format!("{name}.inp"), "--nodes", &format!("{name}-nodes.csv")]);
    assert_eq!((run.code, run.output.as_str()), (1, ""));
    assert!(
        run.errors.contains("needs user subroutine GAPELECTR; give it with `--user-library FILE`"),
        "{}",
        run.errors
    );
}

const HEAD: &str = "
      SUBROUTINE GAPELECTR(SIGMA,D,TEMP,PREDEF,TIME,CINAME,SLNAME,
     1   MSNAME,COORDS,NODE,NPRED,KSTEP,KINC)
      IMPLICIT REAL*8 (A-H,O-Z)
      CHARACTER*80 CINAME,SLNAME,MSNAME
      DIMENSION SIGMA(3),TEMP(2),PREDEF(2,*),TIME(2),COORDS(2,3)
";

/// Evaluates the sample with another routine.
fn eval_with(body: &str) -> Option<(crate::program::Run, Folder)> {
    let folder = sample()?;
    folder.write("gapelectr.f", &format!("{HEAD}{body}      END\n"));
    assert!(compile(&folder));
    let run = folder.inpact(&[&EVAL[..], &["-o", "result.csv"]].concat());
    Some((run, folder))
}

#[test]
fn answers_that_are_no_conductance_end_with_1_and_nothing_is_written() {
    let nan = "      SIGMA(1) = 1\n      IF (NODE.EQ.203) SIGMA(1) = SQRT(D-1)\n";
    let Some((run, folder)) = eval_with(nan) else { return };
    assert_eq!(run.code, 1, "{}", run.errors);
    let first = "user-law-nodes.csv:4: error[D010] user subroutine GAPELECTR gives SIGMA(1) = NaN in row 3";
    assert!(run.errors.starts_with(first), "{}", run.errors);
    assert!(run.errors.contains("(in 8 rows, all told: mend the routine, and compile it again)"), "{}", run.errors);
    assert!(run.errors.ends_with("error: the user subroutine fails, and no result is written\n"), "{}", run.errors);
    assert!(!folder.path().join("result.csv").exists());
    assert!(folder.names().iter().all(|name| !name.starts_with(".inpact")), "{:?}", folder.names());
}

#[test]
fn rows_that_went_out_before_a_routine_failed_are_counted() {
    let Some(folder) = sample() else { return };
    folder.write("gapelectr.f", &format!("{HEAD}      SIGMA(1) = -D\n      END\n"));
    assert!(compile(&folder));
    let run = folder.inpact(&EVAL);
    assert_eq!(run.code, 1, "{}", run.errors);
    let rows = run.output.lines().count() - 1;
    assert!(run.errors.contains(&format!("note: {rows} rows went out before this\n")), "{}", run.errors);
    let end = "error: the user subroutine fails, and the rows it fails in have no result\n";
    assert!(run.errors.ends_with(end), "{}", run.errors);
}

#[test]
fn a_routine_that_stops_is_reported_and_leaves_no_result() {
    // The routine takes down which files there are when it stops.
    let stop = "      SIGMA(1) = 1\n      IF (NODE.EQ.205) THEN\n      CALL SYSTEM('ls -a > seen.txt')\n      STOP\n      END IF\n";
    let Some((run, folder)) = eval_with(stop) else { return };
    assert_eq!(run.code, 2, "{}", run.errors);
    let message = "error: user subroutine GAPELECTR ended the program (by STOP or an error of the Fortran runtime) when it was called for node 205";
    assert!(run.errors.contains(message), "{}", run.errors);
    assert!(!folder.path().join("result.csv").exists());
    let seen = std::fs::read_to_string(folder.path().join("seen.txt")).expect("what the routine saw");
    assert!(seen.lines().any(|name| name.starts_with(".inpact-")), "{seen}");
    assert!(folder.names().iter().all(|name| !name.starts_with(".inpact-")), "{:?}", folder.names());
}

#[test]
fn a_library_that_cannot_be_loaded_is_a_wrong_use_with_its_cure() {
    let name = "decks/user-law/user-law";
    let with = |library: &str| {
        let (deck, nodes) = (format!("{name}.inp"), format!("{name}-nodes.csv"));
        crate::program::inpact(&["eval", &deck, "--nodes", &nodes, "--user-library", library])
    };
    let run = with("decks/user-law/gapelectr.f");
    let cure = "is a text, no shared library (if it is the source of the routine, compile it: `gfortran -shared -fPIC";
    assert!(run.code == 2 && run.errors.contains(cure), "{}", run.errors);
    let run = with("libc.so.6");
    assert!(run.code == 2 && run.errors.starts_with("error: cannot read `libc.so.6`"), "{}", run.errors);
}

#[test]
fn a_library_that_no_interaction_needs_is_not_loaded() {
    let folder = Folder::with(&[
        ("a.inp", "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n2., 0.\n"),
        ("n.csv", "clearance\n0\n"),
    ]);
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "n.csv", "--user-library", "none.so"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let message = "warning: no *GAP ELECTRICAL CONDUCTANCE of the deck has USER; `none.so` is not loaded\n";
    assert!(run.errors.starts_with(message), "{}", run.errors);
}

/// A routine of its own: the lines between the declarations and END, compiled with these options; `None` without a compiler.
fn routine(lines: &str, options: &[&str]) -> Option<Folder> {
    let fortran = format!(
        "      SUBROUTINE GAPELECTR(SIGMA,D,TEMP,PREDEF,TIME,CINAME,SLNAME,
     1   MSNAME,COORDS,NODE,NPRED,KSTEP,KINC)
      IMPLICIT REAL*8 (A-H,O-Z)
      CHARACTER*80 CINAME,SLNAME,MSNAME
      DIMENSION SIGMA(3),TEMP(2),PREDEF(2,*),TIME(2),COORDS(2,3)
{lines}      END
"
    );
    let deck = "*SURFACE INTERACTION, NAME=U\n 1.,\n*GAP ELECTRICAL CONDUCTANCE, USER\n";
    let nodes = "node,clearance,temp_s,temp_m,epot_s,epot_m\n1,0.,20.,30.,1,0\n2,0.,20.,30.,1,0\n";
    let folder = Folder::with(&[("gapelectr.f", &fortran), ("a.inp", deck), ("a.csv", nodes)]);
    let mut compiler = Command::new("gfortran");
    compiler.args(options).args(["-shared", "-fPIC", "-o", "gapelectr.so", "gapelectr.f"]).current_dir(folder.path());
    match compiler.output() {
        Ok(output) if output.status.success() => Some(folder),
        Ok(output) => panic!("{}", String::from_utf8_lossy(&output.stderr)),
        Err(error) => {
            assert!(std::env::var_os("INPACT_REQUIRE_GFORTRAN").is_none(), "gfortran: {error}");
            None
        }
    }
}

#[test]
fn a_routine_has_a_stack_of_more_than_eight_mebibytes() {
    // 12 MB of local numbers, all of which are written.
    let lines = "      DIMENSION W(1500000)
      DO I=1,1500000
        W(I)=NODE
      END DO
      SIGMA(1)=W(1)+W(750000)+W(1500000)
";
    let Some(folder) = routine(lines, &["-O0", "-frecursive"]) else { return };
    for threads in ["1", "2"] {
        let run = folder.inpact(&[
            "eval",
            "a.inp",
            "--nodes",
            "a.csv",
            "--user-library",
            "gapelectr.so",
            "--threads",
            threads,
        ]);
        assert_eq!(run.code, 0, "{}", run.shown());
        assert_eq!(columns(&run.output, &["conductance"])[1], [6.0], "{}", run.output);
    }
}

#[test]
fn a_routine_with_threads_of_its_own_does_not_end_the_program() {
    let lines = "      S=0.0D0
C$OMP PARALLEL DO REDUCTION(+:S)
      DO I=1,100
        S=S+1.0D4
      END DO
C$OMP END PARALLEL DO
      SIGMA(1)=S
";
    let Some(folder) = routine(lines, &["-fopenmp"]) else { return };
    // A library that was unloaded under its threads ended one run in three.
    for _ in 0..30 {
        let run = folder.inpact(&["eval", "a.inp", "--nodes", "a.csv", "--user-library", "gapelectr.so"]);
        assert_eq!(run.code, 0, "{}", run.shown());
        assert_eq!(columns(&run.output, &["conductance"])[0], [1.0e6], "{}", run.output);
    }
}
