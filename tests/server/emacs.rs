//! A real editor: Emacs without a screen, set up by the lines of docs/editors.md, gets findings, applies a fix, renames in two files, formats.
//!
//! Where Emacs with Eglot is not installed the test says so and passes; with `INPACT_REQUIRE_EMACS` it fails.

use std::process::Command;

const MAIN: &str = "\
*SURFACE INTERACTION, NAME=JOINT
*GAP COND
20.,0.
10.5,.1
*INCLUDE, INPUT=pairs.inp
";

const PAIRS: &str = "*CONTACT PAIR, INTERACTION=joint\nA, A\n";

/// What docs/editors.md says that Emacs needs.
fn lines_of_the_manual() -> &'static str {
    let page = include_str!("../../docs/editors.md");
    let (_, block) = page.split_once("```elisp\n").expect("the page has lines for Emacs");
    block.split_once("```").expect("the block ends").0
}

#[expect(clippy::print_stderr, reason = "whoever runs the tests must learn that there was no editor")]
#[test]
fn emacs_attaches_mends_renames_and_formats() {
    let batch = ["--batch", "-f", "package-initialize", "-l", "eglot"];
    if !Command::new("emacs").args(batch).output().is_ok_and(|output| output.status.success()) {
        assert!(std::env::var_os("INPACT_REQUIRE_EMACS").is_none(), "emacs with eglot is not installed");
        eprintln!("skipped: emacs with eglot is not installed");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("main.inp"), MAIN).expect("written");
    std::fs::write(path("pairs.inp"), PAIRS).expect("written");
    std::fs::write(path("init.el"), lines_of_the_manual()).expect("written");
    std::fs::write(path("script.el"), include_str!("emacs.el")).expect("written");
    // The lines name the program as users have it, on the search path.
    std::fs::create_dir(path("bin")).expect("a folder");
    std::os::unix::fs::symlink(env!("CARGO_BIN_EXE_inpact-under-test"), path("bin/inpact")).expect("a link");
    let search = std::env::var("PATH").unwrap_or_default();
    let output = Command::new("emacs")
        .args(batch)
        .args(["-l", "init.el", "-l", "script.el"])
        .current_dir(folder.path())
        .env("PATH", format!("{}:{search}", path("bin").display()))
        .env("HOME", folder.path())
        .output()
        .expect("emacs runs");
    let said = String::from_utf8_lossy(&output.stderr);
    let read =
        |name: &str| std::fs::read_to_string(path(name)).unwrap_or_else(|error| panic!("{name}: {error}\n{said}"));
    assert_eq!(read("report.txt"), "2 inpact [K003]: `*GAP COND` is short for `*GAP CONDUCTANCE`\n");
    assert_eq!(
        read("main.inp"),
        "*SURFACE INTERACTION, NAME=CONTACT-1\n*GAP CONDUCTANCE\n20.,  0.\n10.5,  .1\n*INCLUDE, INPUT=pairs.inp\n"
    );
    assert_eq!(read("pairs.inp"), "*CONTACT PAIR, INTERACTION=CONTACT-1\nA, A\n");
    assert!(output.status.success(), "{said}");
}
