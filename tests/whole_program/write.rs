//! Where results go: a file keeps what it is, and a pipe gets the result instead of being replaced.

#![cfg(unix)]

use crate::program::Folder;
use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};

#[test]
fn a_named_pipe_stays_one() {
    let folder = Folder::with(&[]);
    let path = folder.path().join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&path).status().expect("mkfifo is there");
    assert!(made.success());
    let reader = {
        let path = path.clone();
        std::thread::spawn(move || std::fs::read_to_string(path).expect("readable"))
    };
    let run = folder.inpact(&["explain", "T001", "-o", "pipe"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert_eq!(reader.join().expect("read"), folder.inpact(&["explain", "T001"]).output);
    assert!(std::fs::metadata(&path).expect("there").file_type().is_fifo());
    assert_eq!(folder.names(), ["pipe"]);
}

#[test]
fn a_file_keeps_its_permissions_and_a_link_stays_a_link() {
    let folder = Folder::with(&[("page.txt", "old\n")]);
    let path = folder.path().join("page.txt");
    std::fs::set_permissions(&path, PermissionsExt::from_mode(0o600)).expect("permissions");
    symlink("page.txt", folder.path().join("link.txt")).expect("a link");
    let run = folder.inpact(&["explain", "T001", "-o", "link.txt"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(folder.path().join("link.txt").is_symlink());
    assert_eq!(folder.read("page.txt"), folder.inpact(&["explain", "T001"]).output);
    assert_eq!(std::fs::metadata(&path).expect("there").permissions().mode() & 0o777, 0o600);
}

#[test]
fn a_read_only_file_is_left_alone() {
    let folder = Folder::with(&[("page.txt", "old\n")]);
    let path = folder.path().join("page.txt");
    std::fs::set_permissions(&path, PermissionsExt::from_mode(0o400)).expect("permissions");
    let run = folder.inpact(&["explain", "T001", "-o", "page.txt"]);
    assert_eq!((run.code, folder.read("page.txt").as_str()), (2, "old\n"), "{}", run.errors);
}

/// A result never replaces what it is made from.
#[test]
fn the_inputs_are_not_overwritten() {
    let folder = Folder::with(&[]);
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n1., 0.\n";
    folder.write("a.inp", deck);
    folder.write("n.csv", "node,pressure,epot_s,epot_m\n1,2.,1.,0.\n");
    for arguments in [
        &["eval", "a.inp", "--nodes", "n.csv", "-o", "a.inp"][..],
        &["eval", "a.inp", "--nodes", "n.csv", "-o", "./n.csv"],
        &["check", "a.inp", "-o", "a.inp"],
        &["json", "a.inp", "-o", "a.inp"],
    ] {
        let run = folder.inpact(arguments);
        assert_eq!(run.code, 2, "{arguments:?}");
        assert!(run.errors.contains("which it is made from"), "{}", run.errors);
    }
    assert_eq!(folder.read("a.inp"), deck);
    assert_eq!(folder.inpact(&["check", "-", "-"]).code, 2);
}
