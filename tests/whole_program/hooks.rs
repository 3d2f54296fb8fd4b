//! Hooks for pre-commit: the real one, from PyPI, on a repository made here.
//!
//! `INPACT_PRE_COMMIT` names the program `pre-commit`; without it the hooks are only held against the options of the program.

use crate::program::{Folder, command, inpact, root};
use std::path::{Path, PathBuf};
use std::process::Command;

#[test]
fn the_hooks_call_what_there_is() {
    let hooks = std::fs::read_to_string(root().join(".pre-commit-hooks.yaml")).expect("readable");
    let entries: Vec<&str> = hooks.lines().filter_map(|line| line.trim().strip_prefix("entry: inpact ")).collect();
    assert_eq!(entries, ["check", "check --fix", "fmt"]);
    for entry in entries {
        let deck = Folder::with(&[("a.inp", "*SURFACE INTERACTION, NAME=A\n")]);
        let arguments: Vec<&str> = entry.split(' ').chain(["a.inp"]).collect();
        assert_eq!(deck.inpact(&arguments).code, 0, "{entry}");
    }
    let action = std::fs::read_to_string(root().join("action.yml")).expect("readable");
    let help = inpact(&["check", "--help"]).output;
    for option in ["--format", "--exit-zero", "--quiet", "--output", "--since"] {
        assert!(action.contains(option) && help.contains(option), "{option}");
    }
}

fn git(folder: &Path, arguments: &[&str]) -> String {
    let identity = ["-c", "user.name=A", "-c", "user.email=a@example.org"];
    let output = Command::new("git").args(identity).args(arguments).current_dir(folder).output().expect("git runs");
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).trim().to_owned()
}

#[cfg(unix)]
#[test]
#[expect(clippy::print_stderr, reason = "whoever runs the tests must learn that no hook was run")]
fn pre_commit_runs_them() {
    let Some(program) = std::env::var_os("INPACT_PRE_COMMIT").map(PathBuf::from) else {
        assert!(std::env::var_os("INPACT_REQUIRE_PRE_COMMIT").is_none(), "`INPACT_PRE_COMMIT` names no program");
        eprintln!("skipped: `INPACT_PRE_COMMIT` names no program");
        return;
    };
    let hooks = Folder::with(&[]);
    std::fs::copy(root().join(".pre-commit-hooks.yaml"), hooks.path().join(".pre-commit-hooks.yaml")).expect("copied");
    git(hooks.path(), &["init", "-q"]);
    git(hooks.path(), &["add", "."]);
    git(hooks.path(), &["commit", "-qm", "hooks"]);
    let revision = git(hooks.path(), &["rev-parse", "HEAD"]);
    let configuration = format!(
        "repos:\n- repo: {}\n  rev: {revision}\n  hooks: [{{id: inpact-check}}, {{id: inpact-fmt}}]\n",
        hooks.path().display()
    );
    let decks = Folder::with(&[
        (".pre-commit-config.yaml", configuration.as_str()),
        ("a.inp", "*surface interaction,name=A\n"),
        ("b.inp", "*SURFACE INTERACTION\n"),
        ("notes.txt", "*SURFACE INTERACTION\n"),
    ]);
    // `inpact` on the search path.
    let programs = Folder::with(&[]);
    let under_test = command(decks.path(), &[]).get_program().to_owned();
    std::os::unix::fs::symlink(under_test, programs.path().join("inpact")).expect("linked");
    let path = format!("{}:{}", programs.path().display(), std::env::var("PATH").unwrap_or_default());
    git(decks.path(), &["init", "-q"]);
    git(decks.path(), &["add", "."]);
    let run = || {
        let output = Command::new(&program)
            .args(["run", "--all-files", "--color", "never"])
            .current_dir(decks.path())
            .env("PATH", &path)
            .env("PRE_COMMIT_HOME", programs.path().join("cache"))
            .output()
            .expect("pre-commit runs");
        (output.status.success(), String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let (is_good, said) = run();
    assert!(!is_good, "{said}");
    assert!(said.contains("K006") && said.contains("files were modified by this hook"), "{said}");
    assert_eq!(decks.read("a.inp"), "*SURFACE INTERACTION, NAME=A\n");
    decks.write("b.inp", "*SURFACE INTERACTION, NAME=B\n");
    git(decks.path(), &["add", "."]);
    let (is_good, said) = run();
    assert!(is_good, "{said}");
}
