//! Files that `check --fix` and `fmt` touch: those that were read and are unchanged, once each, all of a run or none.

use crate::program::{Folder, Run, command, run};

/// A block with four things to mend.
const PART: &str =
    "*SURFACE INTERACT, NAME=A,\n 1.,\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n 1., 0.\n\n  ** c\n 2., 1.\n";
const MENDED: &str =
    "*SURFACE INTERACTION, NAME=A\n 1.,\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n 1., 0.\n** c\n 2., 1.\n";

fn mend(folder: &Folder, arguments: &[&str]) -> Run {
    folder.inpact(&[&["check", "--isolated", "--fix", "--format", "concise"], arguments].concat())
}

#[test]
fn a_file_outside_of_the_decks_folder_is_mended_only_on_demand() {
    let deck = "*INCLUDE, INPUT=../library/part.inp\n";
    let folder = Folder::with(&[("decks/d.inp", deck), ("library/part.inp", PART)]);
    let run = mend(&folder, &["decks/d.inp"]);
    assert_eq!(folder.read("library/part.inp"), PART);
    let said = "4 fixes are not applied to `decks/../library/part.inp`, which lies outside of the folder of `decks/d.inp` \
                (`--fix-included` applies them)";
    assert!(run.errors.contains(said), "{}", run.errors);
    assert!(!run.errors.contains("mended"), "{}", run.errors);
    assert!(run.output.contains("S003"), "what is left is reported: {}", run.output);
    // Named itself it is mended, also through the deck that includes it.
    let run = mend(&folder, &["decks/d.inp", "library/part.inp"]);
    assert_eq!(folder.read("library/part.inp"), MENDED);
    assert!(run.errors.contains("mended 4 findings in 1 file\n"), "{}", run.errors);
    folder.write("library/part.inp", PART);
    let run = mend(&folder, &["--fix-included", "decks/d.inp"]);
    assert_eq!((run.code, folder.read("library/part.inp").as_str()), (0, MENDED), "{}", run.errors);
}

#[cfg(unix)]
#[test]
fn a_link_below_the_decks_folder_does_not_lead_out_of_it() {
    let folder = Folder::with(&[("decks/d.inp", "*INCLUDE, INPUT=part.inp\n"), ("library/part.inp", PART)]);
    std::os::unix::fs::symlink("../library/part.inp", folder.path().join("decks/part.inp")).expect("a link");
    let run = mend(&folder, &["decks/d.inp"]);
    assert_eq!(folder.read("library/part.inp"), PART);
    assert!(run.errors.contains("not applied to `decks/part.inp`"), "{}", run.errors);
}

#[test]
fn a_file_that_is_included_twice_is_mended_once() {
    let deck = "*HEADING\nh\n*INCLUDE, INPUT=x.inp\n*INCLUDE, INPUT=sub/../x.inp\n";
    let folder = Folder::with(&[("d.inp", deck), ("x.inp", PART), ("sub/y.inp", "")]);
    let run = mend(&folder, &["d.inp"]);
    assert_eq!((folder.read("x.inp").as_str(), folder.read("d.inp").as_str()), (MENDED, deck));
    assert!(run.errors.contains("mended 4 findings in 1 file\n"), "{}", run.errors);
}

#[test]
fn a_deck_and_its_part_are_mended_together() {
    let main = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n*INCLUDE, INPUT=part.inp\n";
    let part = " 1., 0.\n\n 2., 1.\n*SURFACE INTERACT, NAME=B\n 1.,\n";
    for order in [["main.inp", "part.inp"], ["part.inp", "main.inp"]] {
        let folder = Folder::with(&[("main.inp", main), ("part.inp", part)]);
        let run = mend(&folder, &order);
        assert_eq!(folder.read("part.inp"), " 1., 0.\n 2., 1.\n*SURFACE INTERACTION, NAME=B\n 1.,\n", "{}", run.errors);
        assert!(run.errors.contains("mended 2 findings in 1 file\n"), "{}", run.errors);
        let again = folder.inpact(&["check", "--isolated", "--diff", "main.inp", "part.inp"]);
        assert_eq!(again.output, "");
        assert_eq!(folder.names(), ["main.inp", "part.inp"]);
    }
}

/// The program waits for a second deck, a named pipe, while another program saves the first.
#[cfg(unix)]
#[test]
fn an_edit_that_another_program_saves_meanwhile_is_kept_and_nothing_is_written() {
    use std::io::Write;
    let folder = Folder::with(&[("a.inp", PART), ("d.inp", PART)]);
    let pipe = folder.path().join("slow.inp");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().expect("mkfifo is there");
    assert!(made.success());
    let arguments = ["check", "--isolated", "--fix", "--format", "concise", "a.inp", "d.inp", "slow.inp"];
    let program = command(folder.path(), &arguments);
    let running = std::thread::spawn(move || run(program, b""));
    // Opening it waits for the program; the decks before it are read by the time it asks for more.
    let mut slow = std::fs::File::options().write(true).open(&pipe).expect("the program reads it");
    std::thread::sleep(std::time::Duration::from_millis(500));
    let edited = format!("{PART}** two hours of work\n");
    folder.write("d.inp", &edited);
    slow.write_all(b"*HEADING\n").expect("it is read");
    drop(slow);
    let run = running.join().expect("it ends");
    assert_eq!(folder.read("d.inp"), edited, "{}", run.errors);
    assert_eq!(run.code, 2, "{}", run.errors);
    assert!(run.errors.contains("cannot write `d.inp`: another program changed it"), "{}", run.errors);
    assert_eq!(folder.read("a.inp"), PART, "all files or none");
    // The findings are those of the file as it is, not as it could have been.
    assert!(run.output.contains("a.inp:1:26: warning[S003]"), "{}", run.output);
    assert_eq!(folder.names(), ["a.inp", "d.inp", "slow.inp"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_name_that_is_no_text_means_its_own_file() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = Folder::with(&[("d\u{FFFD}.inp", "another file\n")]);
    let path = folder.path().join(OsStr::from_bytes(b"d\xFF.inp"));
    for arguments in [&["check", "--isolated", "--fix"][..], &["fmt", "--isolated"]] {
        std::fs::write(&path, PART).expect("writable");
        let mut program = command(folder.path(), arguments);
        program.arg(OsStr::from_bytes(b"d\xFF.inp"));
        let run = run(program, b"");
        assert_eq!(run.code, 0, "{}", run.errors);
        assert_ne!(std::fs::read(&path).expect("there"), PART.as_bytes());
        assert_eq!(folder.read("d\u{FFFD}.inp"), "another file\n");
    }
    // An *INCLUDE of such a name does not read the other file either.
    std::fs::write(folder.path().join("main.inp"), b"*INCLUDE, INPUT=d\xFF.inp\n").expect("writable");
    let run = folder.inpact(&["check", "--isolated", "--format", "concise", "main.inp"]);
    assert!(run.output.contains("not UTF-8"), "{}", run.output);
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_does_not_keep_decks_from_being_mended() {
    use std::process::Stdio;
    let text = format!("{PART}{}", "*UNKNOWN KEYWORD\n".repeat(900));
    let names = ["d0.inp", "d1.inp", "d2.inp"];
    let folder = Folder::with(&names.map(|name| (name, text.as_str())));
    let arguments = [&["check", "--isolated", "--fix"][..], &names].concat();
    let mut child = command(folder.path(), &arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    let ended = child.wait_with_output().expect("it ends");
    for name in names {
        assert!(folder.read(name).starts_with(MENDED), "{}", String::from_utf8_lossy(&ended.stderr));
    }
    // `fmt` goes on with the files after standard input.
    let folder = Folder::with(&[("d.inp", PART)]);
    let mut child = command(folder.path(), &["fmt", "--isolated", "-", "d.inp"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    let input = "*SURFACE INTERACTION, NAME=A\n1.,\n".repeat(10_000);
    let mut stdin = child.stdin.take().expect("piped");
    std::io::Write::write_all(&mut stdin, input.as_bytes()).expect("it is read");
    drop(stdin);
    child.wait().expect("it ends");
    assert_ne!(folder.read("d.inp"), PART);
}

#[cfg(unix)]
#[test]
fn a_pipe_is_shown_mended_and_never_said_to_be() {
    let folder = Folder::with(&[("d.inp", PART)]);
    let pipe = folder.path().join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().expect("mkfifo is there");
    assert!(made.success());
    let feed = || {
        let pipe = pipe.clone();
        std::thread::spawn(move || std::fs::write(pipe, PART).expect("it is read"))
    };
    let without_names = |run: Run| run.output.lines().skip(2).map(|line| format!("{line}\n")).collect::<String>();
    let feeder = feed();
    let shown = folder.inpact(&["check", "--isolated", "--diff", "pipe"]);
    feeder.join().expect("it was read once");
    assert_eq!(shown.code, 0, "{}", shown.errors);
    let as_file = folder.inpact(&["check", "--isolated", "--diff", "d.inp"]);
    assert_eq!(without_names(shown), without_names(as_file));
    let feeder = feed();
    let run = mend(&folder, &["pipe"]);
    feeder.join().expect("it was read once");
    assert!(run.errors.contains("4 fixes are not applied to `pipe`, which is no file"), "{}", run.errors);
    assert_eq!((run.code, folder.names()), (2, vec!["d.inp".to_owned(), "pipe".to_owned()]), "{}", run.errors);
}

#[test]
fn more_fixes_than_are_shown_are_all_applied() {
    let rows = |between: &str| (0..15_000).map(|row| format!("{row}., {row}.\n{between}")).collect::<String>();
    let head = "*SURFACE INTERACTION, NAME=A\n1.,\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n";
    let folder = Folder::with(&[("d.inp", &format!("{head}{}", rows("\n")))]);
    let run = mend(&folder, &["d.inp"]);
    assert_eq!(folder.read("d.inp"), format!("{head}{}", rows("")));
    assert!(run.errors.contains("mended 15000 findings in 1 file\n"), "{}", run.errors);
}

#[cfg(unix)]
#[test]
fn one_file_that_is_read_only_keeps_all_from_being_mended() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::with(&[("a.inp", PART), ("b.inp", PART)]);
    std::fs::set_permissions(folder.path().join("b.inp"), PermissionsExt::from_mode(0o444)).expect("permissions");
    let run = mend(&folder, &["a.inp", "b.inp"]);
    assert_eq!((run.code, folder.read("a.inp"), folder.read("b.inp")), (2, PART.to_owned(), PART.to_owned()));
    assert!(run.errors.contains("cannot write `b.inp`: it is read-only"), "{}", run.errors);
    assert!(run.errors.contains("nothing is mended, since all files are or none"), "{}", run.errors);
    assert_eq!(folder.names(), ["a.inp", "b.inp"]);
    // `fmt` formats each file by itself.
    let run = folder.inpact(&["fmt", "--isolated", "b.inp", "a.inp"]);
    assert_eq!((run.code, folder.read("b.inp").as_str()), (2, PART), "{}", run.errors);
    assert_ne!(folder.read("a.inp"), PART);
}

/// Only the superuser can give files away.
#[cfg(unix)]
#[test]
fn owner_group_and_permissions_stay_and_the_right_to_act_as_the_owner_does_not() {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, chown};
    let folder = Folder::with(&[("d.inp", PART), ("f.inp", PART), ("o.json", "old\n")]);
    let path = |name: &str| folder.path().join(name);
    if chown(path("d.inp"), Some(1234), Some(2345)).is_err() {
        return;
    }
    for (name, mode) in [("d.inp", 0o640), ("f.inp", 0o660), ("o.json", 0o6755)] {
        chown(path(name), Some(1234), Some(2345)).expect("as before");
        std::fs::set_permissions(path(name), PermissionsExt::from_mode(mode)).expect("permissions");
    }
    assert_eq!(mend(&folder, &["d.inp"]).code, 0);
    assert_eq!(folder.inpact(&["fmt", "--isolated", "f.inp"]).code, 0);
    assert_eq!(folder.inpact(&["json", "--isolated", "d.inp", "-o", "o.json"]).code, 0);
    for (name, mode) in [("d.inp", 0o640), ("f.inp", 0o660), ("o.json", 0o755)] {
        let found = std::fs::metadata(path(name)).expect("there");
        assert_eq!((found.uid(), found.gid(), found.mode() & 0o7777), (1234, 2345, mode), "{name}");
    }
    assert_ne!(folder.read("o.json"), "old\n");
}
