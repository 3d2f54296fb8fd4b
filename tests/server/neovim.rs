//! A real editor: Neovim without a screen attaches, gets findings, applies a fix, renames in two files, formats.
//!
//! Where Neovim is not installed the test says so and passes; with `INPACT_REQUIRE_NVIM` it fails.

use std::process::Command;

const MAIN: &str = "\
*SURFACE INTERACTION, NAME=JOINT
*GAP COND
20.,0.
10.5,.1
*INCLUDE, INPUT=pairs.inp
";

const PAIRS: &str = "*CONTACT PAIR, INTERACTION=joint\nA, A\n";

#[expect(clippy::print_stderr, reason = "whoever runs the tests must learn that there was no editor")]
#[test]
fn neovim_attaches_mends_renames_and_formats() {
    if Command::new("nvim").arg("--version").output().is_err() {
        assert!(std::env::var_os("INPACT_REQUIRE_NVIM").is_none(), "nvim is not installed");
        eprintln!("skipped: nvim is not installed");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("main.inp"), MAIN).expect("written");
    std::fs::write(path("pairs.inp"), PAIRS).expect("written");
    std::fs::write(path("script.lua"), include_str!("neovim.lua")).expect("written");
    let output = Command::new("nvim")
        .args(["--headless", "-u", "NONE", "-i", "NONE", "-n", "-c", "luafile script.lua", "main.inp"])
        .current_dir(folder.path())
        .env("INPACT", env!("CARGO_BIN_EXE_inpact-under-test"))
        .env("XDG_STATE_HOME", folder.path())
        .env("XDG_CACHE_HOME", folder.path())
        .output()
        .expect("nvim runs");
    let said = String::from_utf8_lossy(&output.stderr);
    let read =
        |name: &str| std::fs::read_to_string(path(name)).unwrap_or_else(|error| panic!("{name}: {error}\n{said}"));
    assert_eq!(
        read("report.txt"),
        "2:1 K003 `*GAP COND` is short for `*GAP CONDUCTANCE`\n\
         after the fix: 0 findings\n\
         symbols: *SURFACE INTERACTION JOINT\n"
    );
    assert_eq!(
        read("main.inp"),
        "*SURFACE INTERACTION, NAME=CONTACT-1\n*GAP CONDUCTANCE\n20.,  0.\n10.5,  .1\n*INCLUDE, INPUT=pairs.inp\n"
    );
    assert_eq!(read("pairs.inp"), "*CONTACT PAIR, INTERACTION=CONTACT-1\nA, A\n");
    assert!(output.status.success(), "{said}");
}
