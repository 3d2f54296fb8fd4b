//! `inpact fmt`: in place, `--check`, `--diff`, standard input, exit codes.

use crate::program::{Folder, dialect_of, root, sample_decks};

const DECK: &str = "\
*heading
 some, Title
*surface interaction,name=A
1.
**  comment kept
*GAP ELECT, pressure
1.,0.
 22.5 , 1000.
*NODE
1,0.,0.
";
const FORMATTED: &str = "\
*heading
 some, Title
*SURFACE INTERACTION, NAME=A
1.
**  comment kept
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
 1.,     0.
22.5, 1000.
*NODE
1,0.,0.
";

fn set_time(folder: &Folder, name: &str) -> std::time::SystemTime {
    let long_ago = std::time::SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(1_000_000_000);
    let file = std::fs::File::options().append(true).open(folder.path().join(name)).expect("writable");
    file.set_modified(long_ago).expect("a time can be set");
    long_ago
}

fn time_of(folder: &Folder, name: &str) -> std::time::SystemTime {
    std::fs::metadata(folder.path().join(name)).and_then(|metadata| metadata.modified()).expect("a time")
}

#[test]
fn files_are_formatted_in_place_and_only_where_they_change() {
    let folder = Folder::with(&[("a.inp", DECK), ("b.inp", FORMATTED)]);
    let long_ago = set_time(&folder, "b.inp");
    let run = folder.inpact(&["fmt", "a.inp", "b.inp"]);
    assert_eq!((run.code, run.output.as_str()), (0, ""), "{}", run.errors);
    assert_eq!(run.errors, "2 files: 1 formatted, 1 left unchanged\n");
    assert_eq!(folder.read("a.inp"), FORMATTED);
    assert_eq!(time_of(&folder, "b.inp"), long_ago, "a file that does not change is not written");
    set_time(&folder, "a.inp");
    assert_eq!(folder.inpact(&["fmt", "a.inp"]).code, 0);
    assert_eq!(
        (folder.read("a.inp").as_str(), time_of(&folder, "a.inp")),
        (FORMATTED, long_ago),
        "twice changes nothing"
    );
    assert_eq!(folder.names(), ["a.inp", "b.inp"]);
}

#[test]
fn check_lists_the_files_and_ends_with_1() {
    let folder = Folder::with(&[("a.inp", DECK), ("b.inp", FORMATTED), ("c.inp", DECK)]);
    let run = folder.inpact(&["fmt", "--check", "a.inp", "b.inp", "c.inp"]);
    assert_eq!((run.code, run.output.as_str()), (1, "a.inp\nc.inp\n"), "{}", run.errors);
    assert_eq!(folder.read("a.inp"), DECK);
    let run = folder.inpact(&["fmt", "--check", "b.inp"]);
    assert_eq!((run.code, run.output.as_str()), (0, ""), "{}", run.errors);
}

#[test]
fn diff_shows_the_change_and_ends_with_1() {
    let folder = Folder::with(&[("a.inp", DECK), ("b.inp", FORMATTED)]);
    let run = folder.inpact(&["fmt", "--diff", "a.inp", "b.inp"]);
    assert_eq!((run.code, folder.read("a.inp").as_str()), (1, DECK));
    insta::assert_snapshot!(run.shown());
    assert_eq!(folder.inpact(&["fmt", "--diff", "b.inp"]).code, 0);
}

#[test]
fn standard_input_goes_to_standard_output() {
    let folder = Folder::with(&[]);
    for deck in [DECK, FORMATTED] {
        let run = folder.inpact_with_input(&["fmt", "-"], deck.as_bytes());
        assert_eq!((run.code, run.output.as_str()), (0, FORMATTED), "{}", run.errors);
    }
    let run = folder.inpact_with_input(&["fmt", "--check", "-"], DECK.as_bytes());
    assert_eq!((run.code, run.output.as_str()), (1, "-\n"));
    assert_eq!(folder.inpact_with_input(&["fmt", "--check", "-"], FORMATTED.as_bytes()).code, 0);
}

#[test]
fn what_cannot_be_read_or_written_ends_with_2_and_the_others_are_formatted() {
    let folder = Folder::with(&[("a.inp", DECK)]);
    let run = folder.inpact(&["fmt", "nothing.inp", "a.inp"]);
    assert_eq!((run.code, folder.read("a.inp").as_str()), (2, FORMATTED));
    assert!(run.errors.contains("cannot read `nothing.inp`"), "{}", run.errors);
    assert_eq!(folder.inpact(&["fmt"]).code, 2);
    assert_eq!(folder.inpact(&["fmt", "--colour", "a.inp"]).code, 2);
}

#[cfg(unix)]
#[test]
fn a_read_only_file_is_left_alone() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::with(&[("a.inp", DECK)]);
    std::fs::set_permissions(folder.path().join("a.inp"), PermissionsExt::from_mode(0o444)).expect("permissions");
    let run = folder.inpact(&["fmt", "a.inp"]);
    assert_eq!((run.code, folder.read("a.inp").as_str()), (2, DECK), "{}", run.errors);
}

#[test]
fn a_deck_with_errors_is_formatted_where_it_can_be() {
    let folder = Folder::with(&[("a.inp", &DECK.replace("1.,0.", "1.,zero").replace("*NODE", "*NOODLE"))]);
    let run = folder.inpact(&["fmt", "a.inp"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let text = folder.read("a.inp");
    assert!(text.contains("zero") && text.contains("*NOODLE\n1,0.,0.\n"), "{text}");
    assert_eq!(folder.inpact(&["fmt", "--check", "a.inp"]).code, 0);
}

#[test]
fn the_samples_mean_the_same_and_come_to_rest() {
    for deck in sample_decks().iter().filter(|deck| !deck.starts_with("decks/faulty/")) {
        let text = std::fs::read_to_string(root().join(deck)).expect("readable");
        let folder = Folder::with(&[("d.inp", &text)]);
        let dialect = dialect_of(deck);
        // The included files stay where they were.
        let beside = root().join(deck).parent().expect("a folder").to_string_lossy().into_owned();
        let model = || {
            let run = folder.inpact(&[&["json", "d.inp", "--include-dir", &beside], dialect].concat());
            assert_eq!(run.code, 0, "{deck}: {}", run.errors);
            // Places move.
            let spans = |line: &&str| !line.trim_start().starts_with("\"span\"");
            run.output.lines().filter(spans).map(str::to_owned).collect::<Vec<_>>()
        };
        let before = model();
        assert_eq!(folder.inpact(&[&["fmt", "d.inp"], dialect].concat()).code, 0, "{deck}");
        assert_eq!(model(), before, "{deck}");
        assert_eq!(folder.inpact(&[&["fmt", "--check", "d.inp"], dialect].concat()).code, 0, "{deck}");
    }
}
