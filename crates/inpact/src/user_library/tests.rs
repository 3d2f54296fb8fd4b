//! Real libraries, compiled by gfortran, and files that are not libraries.
//!
//! Without gfortran the tests of real libraries are skipped with a message; where `INPACT_REQUIRE_GFORTRAN` is set, as in CI, they fail instead.

use super::load;
use inpact_evaluation::law::{UserConductancePoint, UserConductanceValue, UserLaw, UserName, UserNames};
use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::process::Command;
use tempfile::TempDir;

const HEAD: &str = "
      SUBROUTINE GAPELECTR(SIGMA,D,TEMP,PREDEF,TIME,CINAME,SLNAME,
     1   MSNAME,COORDS,NODE,NPRED,KSTEP,KINC)
      INCLUDE 'ABA_PARAM.INC'
      CHARACTER*80 CINAME,SLNAME,MSNAME
      DIMENSION SIGMA(3),TEMP(2),PREDEF(2,*),TIME(2),COORDS(2,3)
";

/// Says which argument it was given: the one that KINC numbers.
const PROBE: &str = "
      SELECT CASE (KINC)
      CASE (1)
        SIGMA(1) = D
        SIGMA(2) = TEMP(1)
        SIGMA(3) = TEMP(2)
      CASE (2)
        SIGMA(1) = KSTEP
        SIGMA(2) = TIME(1)
        SIGMA(3) = TIME(2)
      CASE (3)
        SIGMA(1) = COORDS(1,1)
        SIGMA(2) = COORDS(1,2)
        SIGMA(3) = COORDS(1,3)
      CASE (4)
        SIGMA(1) = COORDS(2,1)
        SIGMA(2) = COORDS(2,2)
        SIGMA(3) = COORDS(2,3)
      CASE (5)
        SIGMA(1) = NPRED
        SIGMA(2) = PREDEF(1,NPRED)
        SIGMA(3) = PREDEF(2,NPRED)
      CASE (6)
        SIGMA(1) = LEN(CINAME) + LEN(SLNAME) + LEN(MSNAME)
        IF (CINAME.EQ.'WELD-FACE') SIGMA(2) = 1
        IF (SLNAME.EQ.'Tip \"A\"' .AND. MSNAME.EQ.' ') SIGMA(3) = 1
      CASE (7)
        SIGMA(1) = ICHAR(CINAME(80:80))
        SIGMA(2) = NODE
        SIGMA(3) = LEN_TRIM(CINAME)
      CASE (8)
C       What belongs to the caller may be written to.
        D = -1
        TEMP(2) = 0
        PREDEF(1,1) = 0
        TIME(1) = 0
        COORDS(2,3) = 0
        CINAME = 'X'
        NODE = 0
        KINC = 0
        SIGMA(1) = 8
      CASE (9)
        SIGMA(1) = 5
      END SELECT
      RETURN
      END
";

/// A folder with a library, if there is gfortran.
fn compile(options: &[&str], include: &str, body: &str) -> Option<(TempDir, PathBuf)> {
    let folder = tempfile::tempdir().expect("a folder");
    let library = folder.path().join("gapelectr.so");
    fs::write(folder.path().join("ABA_PARAM.INC"), include).expect("written");
    fs::write(folder.path().join("gapelectr.f"), format!("{HEAD}{body}")).expect("written");
    let mut command = Command::new("gfortran");
    command.current_dir(folder.path()).args(["-shared", "-fPIC", "-o", "gapelectr.so"]).args(options);
    match command.arg("gapelectr.f").output() {
        Ok(output) if output.status.success() => Some((folder, library)),
        Ok(output) => panic!("{}", String::from_utf8_lossy(&output.stderr)),
        Err(error) => {
            assert!(std::env::var_os("INPACT_REQUIRE_GFORTRAN").is_none(), "gfortran: {error}");
            let _ = writeln!(std::io::stderr(), "SKIPPED, no real Fortran routine was tested: gfortran: {error}");
            None
        }
    }
}

const DOUBLE: &str = "      IMPLICIT REAL*8 (A-H,O-Z)\n";

fn names(interaction: &str) -> UserNames {
    UserNames { interaction: UserName::new(interaction), slave: UserName::new("Tip \"A\""), master: UserName::blank() }
}

fn point<'a>(names: &'a UserNames, field_variables: &'a [[f64; 2]], increment: i32) -> UserConductancePoint<'a> {
    UserConductancePoint {
        clearance: 0.1,
        temperatures: [20.5, 30.25],
        field_variables,
        time: [0.3, 1.7],
        names,
        coordinates: [[1.5, 2.5, 3.5], [4.5, 5.5, 6.5]],
        node: -17,
        step: 3,
        increment,
    }
}

fn sigma(law: &UserLaw, fields: &[[f64; 2]], increment: i32) -> [f64; 3] {
    let names = names("WELD-FACE");
    let UserConductanceValue { conductance, slopes: [slave, master] } =
        law.conductance(&point(&names, fields, increment)).expect("a conductance");
    [conductance, slave, master]
}

#[test]
fn a_fortran_routine_sees_every_argument() {
    for options in [&["-O0", "-fcheck=all"][..], &["-O2"], &["-fdefault-integer-8"]] {
        let Some((_folder, library)) = compile(options, DOUBLE, PROBE) else { return };
        let law = load(&library).expect("loads");
        let fields = [[7.0, 8.0], [9.0, 10.0], [11.0, 12.0]];
        assert_eq!(sigma(&law, &fields, 1), [0.1, 20.5, 30.25]);
        assert_eq!(sigma(&law, &fields, 2), [3.0, 0.3, 1.7]);
        assert_eq!(sigma(&law, &fields, 3), [1.5, 2.5, 3.5]);
        assert_eq!(sigma(&law, &fields, 4), [4.5, 5.5, 6.5]);
        assert_eq!(sigma(&law, &fields, 5), [3.0, 11.0, 12.0]);
        assert_eq!(sigma(&law, &fields, 6), [240.0, 1.0, 1.0]);
        assert_eq!(sigma(&law, &fields, 7), [32.0, -17.0, 9.0]);
        assert_eq!(sigma(&law, &fields, 8), [8.0, 0.0, 0.0]);
        assert_eq!(sigma(&law, &fields, 1), [0.1, 20.5, 30.25], "what a routine overwrites is a copy");
        assert_eq!(sigma(&law, &fields, 9), [5.0, 0.0, 0.0], "items that it does not write are zero");
        assert_eq!(sigma(&law, &[], 1), [0.1, 20.5, 30.25], "no field variable");
        let many: Vec<[f64; 2]> = (1..=1000).map(|number| [f64::from(number), -f64::from(number)]).collect();
        assert_eq!(sigma(&law, &many, 5), [1000.0, 1000.0, -1000.0]);
    }
}

#[test]
fn a_long_name_fills_all_80_characters() {
    let Some((_folder, library)) = compile(&[], DOUBLE, PROBE) else { return };
    let law = load(&library).expect("loads");
    let long = names(&"N".repeat(100));
    let value = law.conductance(&point(&long, &[], 7)).expect("a conductance");
    assert_eq!(value, UserConductanceValue { conductance: f64::from(b'N'), slopes: [-17.0, 80.0] });
}

/// The fault in the answer of a routine with this body.
fn fault(include: &str, body: &str) -> Option<String> {
    let (_folder, library) = compile(&["-O0"], include, &format!("{body}      END\n"))?;
    let law = load(&library).expect("loads");
    let names = names("A");
    Some(law.conductance(&point(&names, &[], 1)).expect_err("no conductance").to_string())
}

#[test]
fn answers_that_are_no_conductance_are_faults() {
    let cases = [
        (DOUBLE, "      SIGMA(1) = SQRT(-D)\n", "gives SIGMA(1) = NaN"),
        (DOUBLE, "      SIGMA(1) = 1\n      SIGMA(3) = D/(TEMP(1)-20.5D0)\n", "gives SIGMA(3) = inf"),
        (DOUBLE, "      SIGMA(1) = -D\n", "gives a conductance below zero, SIGMA(1) = -0.1"),
        (DOUBLE, "      SIGMA(NPRED+5) = 1\n", "writes SIGMA(5), but SIGMA has three items"),
        (
            "C     nothing: reals that begin with S are REAL*4\n",
            "      SIGMA(1) = 1.5\n",
            "writes numbers of single precision",
        ),
    ];
    for (include, body, message) in cases {
        let Some(fault) = fault(include, body) else { return };
        assert!(fault.starts_with(message), "{body}: {fault}");
    }
}

#[test]
fn saved_variables_last_from_call_to_call_and_calls_never_overlap() {
    let body = "
      SAVE N
      DATA N /0/
      K = N
      DO I = 1, 1000
        K = K + MOD(I,2)
      END DO
      N = K - 499
      SIGMA(1) = N
      END
";
    let Some((_folder, library)) = compile(&["-O0"], DOUBLE, body) else { return };
    let law = load(&library).expect("loads");
    let names = names("A");
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| (0..500).for_each(|_| drop(law.conductance(&point(&names, &[], 1)))));
        }
    });
    assert_eq!(sigma(&law, &[], 1)[0], 2001.0);
}

#[test]
fn a_library_of_fast_mathematics_leaves_subnormal_numbers_alone() {
    let Some((_folder, library)) = compile(&["-Ofast"], DOUBLE, PROBE) else { return };
    let law = load(&library).expect("loads");
    assert_eq!(sigma(&law, &[], 9)[0], 5.0);
    let smallest = std::hint::black_box(f64::MIN_POSITIVE);
    assert!(smallest / 4.0 > 0.0);
}

#[test]
fn a_routine_that_only_abaqus_has_is_named() {
    let Some((_folder, library)) = compile(&[], DOUBLE, "      CALL XIT\n      END\n") else { return };
    let message = load(&library).expect_err("XIT is not there").to_string();
    assert!(message.contains("undefined symbol: xit_"), "{message}");
    assert!(message.contains("it calls `xit_`, which is not in it"), "{message}");
}

#[test]
fn a_library_without_the_routine_says_what_it_looked_for() {
    let other = |name: &str| {
        let body = format!("      SIGMA(1) = 1\n      END\n      SUBROUTINE {name}(X)\n      X = 1\n      END\n");
        compile(&["-fno-underscoring"], DOUBLE, &body)
    };
    let Some((_folder, library)) = other("OTHER") else { return };
    let message = load(&library).expect_err("it has `gapelectr`").to_string();
    assert!(message.contains("no symbol `gapelectr_` (it has one without the underscore"), "{message}");
    let (_folder, library) = other("gapelectr_x").expect("gfortran is here");
    assert!(load(&library).is_err());
}

/// An ELF header: class, byte order, type, machine.
fn elf(class: u8, order: u8, kind: u16, machine: u16) -> Vec<u8> {
    let half = |value: u16| if order == 2 { value.to_be_bytes() } else { value.to_le_bytes() };
    let mut head = vec![0x7F, b'E', b'L', b'F', class, order, 1];
    head.resize(16, 0);
    head.extend(half(kind));
    head.extend(half(machine));
    head.resize(64, 0);
    head
}

#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[test]
fn files_that_are_no_library_for_this_machine_are_refused_by_what_they_are() {
    let cases: [(&[u8], &str); 11] = [
        (b"", "is empty"),
        (b"      SUBROUTINE GAPELECTR(SIGMA)\n", "is a text, no shared library"),
        (b"!<arch>\n/0 ", "is a static library"),
        (b"MZ\x90\0\x03\0", "is a library or program of Windows"),
        (b"\xCF\xFA\xED\xFE\x07\0\0\x01", "is a library or program of macOS"),
        (b"\0\x01\x02\x03", "is no shared library"),
        (&elf(2, 1, 3, 183), "is compiled for AArch64, and this program for x86-64"),
        (&elf(1, 1, 3, 3), "is compiled for x86 (32 bit)"),
        (&elf(2, 2, 3, 21), "is compiled for PowerPC (64 bit)"),
        (&elf(2, 1, 1, 62), "is an object file that is not linked"),
        (&elf(2, 1, 2, 62), "is a program, no shared library"),
    ];
    for (bytes, message) in cases {
        let found = refused(bytes);
        assert!(found.contains(&format!("lib.so` {message}")), "{message}: {found}");
    }
    // Valid as far as checked here; the system loader decides.
    assert!(refused(&elf(2, 1, 3, 62)).starts_with("cannot load `"));
}

/// The message about a file with these bytes.
fn refused(bytes: &[u8]) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("lib.so");
    fs::write(&path, bytes).expect("written");
    load(&path).expect_err("no library").to_string()
}

#[test]
fn a_file_that_is_not_there_and_a_folder_are_unreadable() {
    let folder = tempfile::tempdir().expect("a folder");
    let missing = load(&folder.path().join("none.so")).expect_err("it is not there").to_string();
    assert!(missing.starts_with("cannot read `"), "{missing}");
    assert!(load(folder.path()).expect_err("a folder").to_string().starts_with("cannot read `"));
    // A bare name is a file of this folder, never a library of the system.
    assert!(load("libm.so.6".as_ref()).expect_err("not here").to_string().starts_with("cannot read `libm.so.6`"));
}
