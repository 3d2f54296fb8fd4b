//! Libraries depend on those below them alone, read no clock, open no file, print nothing, and share work among threads only where a feature says so.

use super::libraries::{LIBRARIES, folder};
use super::source::{modules, name};
use std::fs;

/// Names of what no library uses but the front door: whoever embeds it decides about time, files, threads and the environment.
const NOT_IN_LIBRARIES: [&str; 12] = [
    "Instant",
    "SystemTime",
    "std::fs",
    "File::open",
    "File::create",
    "OpenOptions",
    "std::thread",
    "std::env",
    "std::process",
    "println!",
    "eprintln!",
    "dbg!",
];

/// The libraries but the front door.
fn below_the_front_door() -> impl Iterator<Item = &'static str> {
    LIBRARIES.into_iter().filter(|library| *library != "inpact")
}

#[test]
fn no_library_reads_a_clock_opens_a_file_or_prints() {
    let mut found = Vec::new();
    for library in below_the_front_door() {
        for (path, code) in modules(library) {
            let used = NOT_IN_LIBRARIES.into_iter().filter(|used| uses(&code, used));
            found.extend(used.map(|used| format!("`{used}` in `{}` of {library}", name(&path))));
        }
    }
    assert!(found.is_empty(), "no library but `inpact` may use these:\n{}", found.join("\n"));
}

#[test]
fn names_are_found_however_they_are_imported() {
    for code in ["use std::time::Instant;", "let a = std::time::Instant::now();", "use std::time::{Duration, Instant};"]
    {
        assert!(uses(code, "Instant"), "{code}");
    }
    for code in
        ["use std::fs::File;", "use std::{fs, io};", "use std::{\n    fs::File,\n    io,\n};", "std::fs::read(path)"]
    {
        assert!(uses(code, "std::fs"), "{code}");
    }
    assert!(uses("eprintln!(\"x\")", "eprintln!") && !uses("eprintln!(\"x\")", "println!"));
    for code in
        ["struct Instantaneous;", "let my_std::fs_like = 1;", "use std::{fmt, io};", "use std::io::{self, Write};"]
    {
        assert!(!uses(code, "Instant") && !uses(code, "std::fs"), "{code}");
    }
}

/// Whether code uses a path: as a whole, or the last part of it in a list of names imported from the part before.
fn uses(code: &str, path: &str) -> bool {
    let is_name = |character: char| character.is_alphanumeric() || character == '_';
    let has = |code: &str, name: &str| {
        code.match_indices(name).any(|(at, _)| {
            let (before, after) = (&code[..at], &code[at + name.len()..]);
            !before.ends_with(is_name) && (name.ends_with('!') || !after.starts_with(is_name))
        })
    };
    let in_list = || {
        path.rsplit_once("::").is_some_and(|(from, last)| {
            let begin = format!("use {from}::{{");
            let lists = code.split(&begin).skip(1).filter_map(|rest| rest.split_once(';'));
            lists.into_iter().any(|(list, _)| has(list, last))
        })
    };
    has(code, path) || in_list()
}

#[test]
fn libraries_depend_on_those_below_alone() {
    for (place, library) in LIBRARIES.into_iter().enumerate() {
        let manifest = manifest(library);
        let (_, dependencies) = manifest.split_once("[dependencies]\n").unwrap_or_else(|| panic!("{library}"));
        let dependencies = dependencies.split("\n[").next().unwrap_or_default();
        let names = dependencies.lines().filter_map(|line| line.split(['.', ' ']).next());
        for name in names.filter(|name| name.starts_with("inpact")) {
            assert!(LIBRARIES[..place].contains(&name), "{library} depends on {name}, which is not below it");
        }
    }
}

fn manifest(library: &str) -> String {
    let file = folder(library).join("Cargo.toml");
    fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// Rayon spawns threads: a library has it behind its feature `threads`, and the front door, which the program is made of, turns that on.
#[test]
fn threads_are_behind_a_feature_that_the_program_turns_on() {
    let program = manifest("inpact");
    let mut with_threads = 0;
    for library in below_the_front_door() {
        let manifest = manifest(library);
        let Some(rayon) = manifest.lines().find(|line| line.starts_with("rayon")) else { continue };
        assert_eq!(rayon, "rayon = { workspace = true, optional = true }", "{library}");
        assert!(manifest.lines().any(|line| line == r#"threads = ["dep:rayon"]"#), "{library}");
        let turned_on = format!("{library} = {{ workspace = true, features = [\"threads\"] }}");
        assert!(program.lines().any(|line| line == turned_on), "expected `{turned_on}` in the manifest of `inpact`");
        with_threads += 1;
    }
    assert!(with_threads > 0, "no library shares work among threads");
}
