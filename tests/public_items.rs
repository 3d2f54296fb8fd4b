//! The public items of every library crate, as one list that a review sees grow: a curated root, a few named modules, the rest hidden.
//!
//! Read from the source as text: `pub mod`, `pub use` and public items at the outermost level; whatever a public item contains is public with it.

#[path = "support/libraries.rs"]
mod libraries;

use libraries::{LIBRARIES, folder};
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

/// The most public modules at the root of a crate.
const MAX_MODULES: usize = 8;

/// A module: its path, and the public names in it.
struct Module {
    path: String,
    names: BTreeSet<String>,
}

#[test]
fn public_items_are_those_of_the_list() {
    let mut list = String::new();
    for library in LIBRARIES {
        let source = source_of(library);
        let mut modules = Vec::new();
        let file = source.join("lib.rs");
        read_module(&read(&file), &source, &library.replace('-', "_"), &mut modules);
        let at_root = modules.iter().filter(|module| module.path.matches("::").count() == 1).count();
        assert!(at_root <= MAX_MODULES, "`{library}` has {at_root} public modules, more than {MAX_MODULES}");
        for Module { path, names } in modules {
            writeln!(list, "{path} ({})", names.len()).expect("a string takes all");
            for name in names {
                writeln!(list, "    {name}").expect("a string takes all");
            }
        }
    }
    insta::assert_snapshot!("public_items", list);
}

#[test]
fn every_root_has_an_example_that_is_run() {
    for library in LIBRARIES {
        let text = read(&source_of(library).join("lib.rs"));
        let has_example = text.lines().any(|line| line == "//! ```");
        assert!(has_example, "the root of `{library}` has no example");
    }
}

fn source_of(library: &str) -> PathBuf {
    folder(library).join("src")
}

fn read(file: &Path) -> String {
    fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// Adds a module and those public in it; `folder` holds the files of its modules.
fn read_module(text: &str, folder: &Path, path: &str, modules: &mut Vec<Module>) {
    let place = modules.len();
    modules.push(Module { path: path.to_owned(), names: BTreeSet::new() });
    let mut names = BTreeSet::new();
    let mut lines = text.lines();
    let mut is_exported = false;
    while let Some(line) = lines.next() {
        is_exported |= line == "#[macro_export]";
        if let Some(name) = line.strip_prefix("macro_rules! ").filter(|_| is_exported) {
            names.insert(format!("{}!", identifier(name)));
            is_exported = false;
        }
        let Some(item) = line.strip_prefix("pub ") else { continue };
        if let Some(item) = item.strip_prefix("use ") {
            let mut tree = item.to_owned();
            while !tree.contains(';') {
                tree.push_str(lines.next().expect("a use ends").trim());
            }
            names.extend(used_names(tree.trim_end_matches(';')));
        } else if let Some(item) = item.strip_prefix("mod ") {
            let name = identifier(item);
            let path = format!("{path}::{name}");
            if item.ends_with('{') {
                let inner: String = lines.by_ref().take_while(|line| *line != "}").map(dedented).collect();
                read_module(&inner, folder, &path, modules);
            } else {
                let file = folder.join(format!("{name}.rs"));
                read_module(&read(&file), &folder.join(name), &path, modules);
            }
        } else {
            let kinds = ["unsafe", "const", "async", "fn", "struct", "enum", "trait", "type", "static", "union", "mut"];
            let words = item.split(' ').skip_while(|word| kinds.contains(word));
            names.insert(identifier(words.clone().next().unwrap_or_default()).to_owned());
        }
    }
    modules[place].names = names;
}

fn dedented(line: &str) -> String {
    format!("{}\n", line.strip_prefix("    ").unwrap_or(line))
}

/// The identifier that a text begins with.
fn identifier(text: &str) -> &str {
    text.split(|character: char| !character.is_alphanumeric() && character != '_').next().unwrap_or_default()
}

/// The names that a `use` brings: `a::{b, c as d}` brings `b` and `d`.
fn used_names(tree: &str) -> Vec<String> {
    let tree = tree.trim();
    let Some((_, list)) = tree.split_once('{') else {
        let name = tree.rsplit_once(" as ").map_or_else(|| tree.rsplit("::").next().unwrap_or(tree), |(_, name)| name);
        return vec![name.trim().to_owned()];
    };
    let list = list.strip_suffix('}').expect("a list ends");
    assert!(!list.contains('{'), "expected a list without lists in `use {tree}`");
    list.split(',').filter(|name| !name.trim().is_empty()).flat_map(used_names).collect()
}
