//! `inpact check --fix`, `--fix-also` and `--diff`: what is mended, and that nothing else changes.

use crate::program::{Folder, root, sample_decks};

const DECK: &str = "\
*Heading
 title, with  ** stars,
*surface interact ,name = A
*GAP ELECTRICAL CONDUCTANCE, PRESSURE,
1.,   0.
  ** indented

3., 2.
2., 1.
*GAP HEAT GENERATION
1.5-3, .5
";
/// As above, but for what the safe fixes change.
const FIXED: &str = "\
*Heading
 title, with  ** stars,
*surface interaction ,name = A
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
1.,   0.
** indented
3., 2.
2., 1.
*GAP HEAT GENERATION
1.5-3, .5
";
/// As above, sorted, and with the letter of the exponent.
const FIXED_ALL: &str = "\
*Heading
 title, with  ** stars,
*surface interaction ,name = A
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
1.,   0.
** indented
2., 1.
3., 2.
*GAP HEAT GENERATION
1.5E-3, .5
";

#[test]
fn safe_fixes_change_only_the_bytes_they_must() {
    let folder = Folder::with(&[("d.inp", DECK)]);
    let run = folder.inpact(&["check", "--fix", "--format", "concise", "d.inp"]);
    assert_eq!(folder.read("d.inp"), FIXED);
    // The findings left have the places of the mended file.
    assert_eq!(run.code, 1);
    let left: Vec<&str> = run.output.lines().filter_map(|line| line.split(' ').next()).collect();
    assert_eq!(left, ["d.inp:8:5:", "d.inp:10:1:"], "{}", run.output);
    assert!(run.errors.contains("mended 4 findings in 1 file"), "{}", run.errors);
    assert_eq!(folder.names(), ["d.inp"]);
}

#[test]
fn fixes_that_change_the_meaning_are_applied_by_name() {
    let folder = Folder::with(&[("d.inp", DECK)]);
    let run = folder.inpact(&["check", "--fix-also", "T001,S006", "--format", "concise", "d.inp"]);
    assert_eq!((run.code, run.output.as_str()), (0, ""), "{}", run.errors);
    assert_eq!(folder.read("d.inp"), FIXED_ALL);
}

#[test]
fn fixing_twice_changes_nothing() {
    let folder = Folder::with(&[("d.inp", DECK)]);
    folder.inpact(&["check", "--fix-also", "T001,S006", "d.inp"]);
    let path = folder.path().join("d.inp");
    let long_ago = std::time::SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(1_000_000_000);
    let file = std::fs::File::options().append(true).open(&path).expect("writable");
    file.set_modified(long_ago).expect("a time can be set");
    let run = folder.inpact(&["check", "--fix-also", "T001,S006", "d.inp"]);
    assert!(!run.errors.contains("mended"), "{}", run.errors);
    assert_eq!(folder.read("d.inp"), FIXED_ALL);
    let modified = std::fs::metadata(&path).and_then(|metadata| metadata.modified()).expect("a time");
    assert_eq!(modified, long_ago, "a file that does not change is not written");
}

#[test]
fn diff_shows_what_would_change_and_writes_nothing() {
    let folder = Folder::with(&[("d.inp", DECK)]);
    let run = folder.inpact(&["check", "--fix-also", "T001,S006", "--diff", "d.inp"]);
    assert_eq!(folder.read("d.inp"), DECK);
    assert!(run.errors.contains("would mend 6 findings in 1 file"), "{}", run.errors);
    insta::assert_snapshot!(run.output);
    let run = folder.inpact(&["check", "--fix", "--diff", "d.inp"]);
    assert_eq!(folder.read("d.inp"), DECK);
    assert!(!run.output.contains("1.5E-3"), "{}", run.output);
}

#[cfg(unix)]
#[test]
fn the_diff_is_a_patch() {
    let folder = Folder::with(&[("d.inp", DECK)]);
    let diff = folder.inpact(&["check", "--fix-also", "T001,S006", "--diff", "d.inp"]).output;
    let whole = |sign: char| -> String {
        let lines = diff.lines().skip(2).filter(|line| !line.starts_with("@@"));
        let kept = lines.filter(|line| line.starts_with(' ') || line.starts_with(sign));
        kept.map(|line| format!("{}\n", &line[1..])).collect()
    };
    // The deck is so short that one hunk holds all of it but the first lines.
    assert!(DECK.ends_with(&whole('-')), "{diff}");
    assert!(FIXED_ALL.ends_with(&whole('+')), "{diff}");
}

#[test]
fn line_ends_and_bytes_that_are_no_text_stay() {
    let folder = Folder::with(&[]);
    let before =
        b"** caf\xE9\r\n*SURFACE INTER, NAME=A,\r\n1.,\r\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\r\n1., 0.\r\n2., 1.";
    let after = b"** caf\xE9\r\n*SURFACE INTERACTION, NAME=A\r\n1.,\r\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\r\n1., 0.\r\n2., 1.";
    let path = folder.path().join("d.inp");
    std::fs::write(&path, before).expect("writable");
    let run = folder.inpact(&["check", "--fix", "d.inp"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert_eq!(std::fs::read(&path).expect("readable"), after);
}

#[test]
fn standard_input_cannot_be_mended() {
    let folder = Folder::with(&[]);
    for options in [&["--fix"][..], &["--diff"], &["--fix-also", "T001"]] {
        let run = folder.inpact_with_input(&[&["check", "-"], options].concat(), DECK.as_bytes());
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{options:?}: {}", run.errors);
        assert!(run.errors.contains("standard input cannot be mended"), "{}", run.errors);
    }
}

#[test]
fn a_code_that_does_not_exist_is_refused_before_anything_is_written() {
    let folder = Folder::with(&[("d.inp", DECK)]);
    let run = folder.inpact(&["check", "--fix", "--fix-also", "T001,T999", "d.inp"]);
    assert_eq!((run.code, run.output.as_str()), (2, ""));
    assert!(run.errors.contains("there is no rule `T999`"), "{}", run.errors);
    assert_eq!(folder.read("d.inp"), DECK);
}

#[test]
fn an_included_file_is_mended_where_it_stands() {
    let main = "*SURFACE INTERACTION, NAME=A\n*INCLUDE, INPUT=parts/table.inp\n";
    let table = "*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n  ** kept\n1., 0.\n3., 2.\n2., 1.\n";
    let folder = Folder::with(&[("d.inp", main), ("parts/table.inp", table)]);
    let run = folder.inpact(&["check", "--fix-also", "T001", "d.inp"]);
    assert_eq!(run.code, 0, "{}{}", run.output, run.errors);
    assert_eq!(folder.read("d.inp"), main);
    let mended = "*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n** kept\n1., 0.\n2., 1.\n3., 2.\n";
    assert_eq!(folder.read("parts/table.inp"), mended);
}

#[cfg(unix)]
#[test]
fn permissions_and_links_stay_and_a_read_only_file_is_left_alone() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = Folder::with(&[("d.inp", DECK)]);
    let path = folder.path().join("d.inp");
    let mode = |mode: u32| std::fs::set_permissions(&path, PermissionsExt::from_mode(mode)).expect("permissions");
    mode(0o640);
    symlink("d.inp", folder.path().join("link.inp")).expect("a link");
    folder.inpact(&["check", "--fix", "link.inp"]);
    assert_eq!(folder.read("d.inp"), FIXED);
    assert_eq!(std::fs::metadata(&path).expect("there").permissions().mode() & 0o777, 0o640);
    assert!(folder.path().join("link.inp").is_symlink());
    mode(0o440);
    let run = folder.inpact(&["check", "--fix-also", "T001", "d.inp"]);
    assert_eq!((run.code, folder.read("d.inp").as_str()), (2, FIXED), "{}", run.errors);
    assert!(run.errors.contains("cannot write"), "{}", run.errors);
}

#[test]
fn the_samples_stay_right_after_every_fix() {
    let codes = "T001,S006,T003,K004";
    for deck in sample_decks() {
        let text = std::fs::read_to_string(root().join(&deck)).expect("readable");
        let folder = Folder::with(&[("d.inp", &text)]);
        let errors = |run: &crate::program::Run| run.output.lines().filter(|line| line.contains(": error[")).count();
        let before = folder.inpact(&["check", "--format", "concise", "d.inp"]);
        let after = folder.inpact(&["check", "--fix-also", codes, "--format", "concise", "d.inp"]);
        assert!(errors(&after) <= errors(&before), "{deck}: {}", after.output);
        let again = folder.inpact(&["check", "--fix-also", codes, "--diff", "d.inp"]);
        assert_eq!(again.output, "", "{deck}");
    }
}
