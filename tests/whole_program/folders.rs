//! Folders: which decks of one count, in which order, what is judged where, what a branch changes, and watching.

use crate::program::{Folder, command};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

/// A project with decks in several folders.
fn project() -> Folder {
    let folder = Folder::with(&[]);
    for (name, text) in [
        ("b/second.inp", "*SURFACE INTERACTION\n"),
        ("a/main.inp", "*SURFACE INTERACTION, NAME=A\n*INCLUDE, INPUT=part.inp\n"),
        // By itself an interaction would be missing; where it is included nothing is.
        ("a/part.inp", "*CONTACT PAIR, INTERACTION=A\nS, S\n"),
        ("a/notes.txt", "*SURFACE INTERACTION\n"),
        ("a/loads.inc", "*SURFACE INTERACTION\n"),
        ("old/first.INP", "*SURFACE INTERACTION\n"),
        ("results/job.inp", "*SURFACE INTERACTION\n"),
        (".hidden/x.inp", "*SURFACE INTERACTION\n"),
        (".gitignore", "results/\n"),
    ] {
        std::fs::create_dir_all(folder.path().join(name).parent().expect("a folder")).expect("made");
        folder.write(name, text);
    }
    folder
}

#[test]
fn every_deck_of_a_folder_once_and_in_order() {
    let folder = project();
    let run = folder.inpact(&["check", "--format", "concise", "."]);
    assert_eq!(run.code, 1);
    assert_eq!(
        run.output,
        "./b/second.inp:1:1: error[K006] `*SURFACE INTERACTION` lacks its parameter `NAME`\n\
         ./old/first.INP:1:1: error[K006] `*SURFACE INTERACTION` lacks its parameter `NAME`\n"
    );
    assert_eq!(run.errors, "3 decks: 2 errors, 0 warnings, 0 notes\n");
    // A part that is named itself is a deck.
    let run = folder.inpact(&["check", "--format", "concise", "a", "a/part.inp"]);
    assert!(run.output.contains("a/part.inp:1:28: error[R001]"), "{}", run.output);
    let run = folder.inpact(&["check", "--format", "concise", "a/part.inp", "a"]);
    assert_eq!(run.output.matches("R001").count(), 1, "{}", run.output);
}

#[test]
fn the_configuration_includes_and_excludes() {
    let folder = project();
    folder.write("inpact.toml", "include = [\"**/*.inc\"]\nexclude = [\"old/**\", \"b/*.inp\"]\n");
    let run = folder.inpact(&["check", "--format", "concise", "."]);
    assert_eq!(run.output, "./a/loads.inc:1:1: error[K006] `*SURFACE INTERACTION` lacks its parameter `NAME`\n");
    // What somebody names is meant.
    let run = folder.inpact(&["check", "--format", "concise", "old/first.INP"]);
    assert_eq!(run.code, 1, "{}", run.output);
    folder.write("inpact.toml", "exclude = [\"[\"]\n");
    let run = folder.inpact(&["check", "."]);
    assert_eq!(run.code, 2);
    assert!(run.errors.contains("`exclude`: "), "{}", run.errors);
}

#[test]
fn a_folder_without_a_deck() {
    let folder = Folder::with(&[]);
    let run = folder.inpact(&["check", "."]);
    assert_eq!((run.code, run.output.as_str(), run.errors.as_str()), (0, "", "warning: there is no deck in `.`\n"));
}

#[test]
fn fixes_and_layout_of_a_folder() {
    let folder = project();
    folder.write("b/second.inp", "*surface interaction,name=B\n  ** indented\n");
    folder.write("results/job.inp", "*surface interaction,name=B\n");
    let run = folder.inpact(&["fmt", "."]);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert_eq!(run.errors, "4 files: 1 formatted, 3 left unchanged\n");
    assert_eq!(folder.read("b/second.inp"), "*SURFACE INTERACTION, NAME=B\n  ** indented\n");
    assert_eq!(folder.read("results/job.inp"), "*surface interaction,name=B\n", "it is ignored");
    let run = folder.inpact(&["check", "--fix", "."]);
    assert!(run.errors.starts_with("mended 1 finding in 1 file\n"), "{}", run.errors);
    assert_eq!(folder.read("b/second.inp"), "*SURFACE INTERACTION, NAME=B\n** indented\n");
}

pub(crate) fn git(folder: &Path, arguments: &[&str]) {
    let options = ["-c", "user.name=A", "-c", "user.email=a@example.org", "-c", "init.defaultBranch=main"];
    let output = Command::new("git").args(options).args(arguments).current_dir(folder).output().expect("git runs");
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn decks_that_a_branch_changes() {
    let folder = project();
    let path = folder.path();
    git(path, &["init", "-q"]);
    git(path, &["add", "."]);
    git(path, &["commit", "-qm", "first"]);
    git(path, &["checkout", "-qb", "work"]);
    let decks = |folder: &Folder| folder.inpact(&["check", "--format", "concise", "--since", "main", "."]);
    let run = decks(&folder);
    assert_eq!((run.code, run.errors.as_str()), (0, "0 decks: nothing to report\n"));
    // A part: the deck that includes it is checked, and no other.
    folder.write("a/part.inp", "*CONTACT PAIR, INTERACTION=OTHER\nS, S\n");
    let run = decks(&folder);
    assert_eq!(
        run.output,
        "./a/part.inp:1:28: error[R001] interaction `OTHER` is not defined (included at ./a/main.inp:2)\n"
    );
    assert_eq!(run.errors, "1 deck: 1 error, 0 warnings, 0 notes\n");
    git(path, &["commit", "-qam", "second"]);
    // New files count, and what the other branch does meanwhile does not.
    folder.write("b/new.inp", "*SURFACE INTERACTION, NAME=N\n");
    git(path, &["stash", "-qu"]);
    git(path, &["checkout", "-q", "main"]);
    folder.write("b/second.inp", "*SURFACE INTERACTION, NAME=B\n");
    git(path, &["commit", "-qam", "elsewhere"]);
    git(path, &["checkout", "-q", "work"]);
    git(path, &["stash", "pop", "-q"]);
    assert_eq!(decks(&folder).errors, "2 decks: 1 error, 0 warnings, 0 notes\n");
    // From a folder below the top as well.
    let below = command(&path.join("b"), &["check", "--since", "main", "-q", "."]).output();
    assert_eq!(below.expect("run").status.code(), Some(0));
    for wrong in ["no-such-branch", "--output=x"] {
        let run = folder.inpact(&["check", &format!("--since={wrong}"), "."]);
        assert_eq!(run.code, 2);
        assert!(run.errors.starts_with("error: `--since`: "), "{}", run.errors);
    }
    assert!(!folder.path().join("x").exists());
}

#[test]
fn what_changes_is_checked_again() {
    let folder = project();
    let mut program = command(folder.path(), &["check", "--watch", "--format", "concise", "a", "b"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("started");
    let mut errors = BufReader::new(program.stderr.take().expect("a pipe"));
    let mut output = BufReader::new(program.stdout.take().expect("a pipe"));
    let line = |from: &mut dyn BufRead| {
        let mut line = String::new();
        from.read_line(&mut line).expect("readable");
        line
    };
    assert_eq!(line(&mut errors), "2 decks: 1 error, 0 warnings, 0 notes\n");
    assert_eq!(line(&mut errors), "watching for changes; Ctrl-C ends it\n");
    assert!(line(&mut output).starts_with("b/second.inp:1:1: error[K006]"));
    // The deck that includes what changed, and only that.
    folder.write("a/part.inp", "*CONTACT PAIR, INTERACTION=OTHERS\nS, S\n");
    assert!(line(&mut errors).starts_with("1 deck: 1 error"));
    assert!(line(&mut output).starts_with("a/part.inp:1:28: error[R001]"));
    // A new deck, and a configuration.
    folder.write("b/third.inp", "*SURFACE INTERACTION, NAME=C\n");
    assert_eq!(line(&mut errors), "1 deck: nothing to report\n");
    folder.write("b/inpact.toml", "[rules]\nK006 = \"off\"\n");
    assert_eq!(line(&mut errors), "2 decks: nothing to report\n");
    program.kill().expect("killed");
    program.wait().expect("ended");
}
