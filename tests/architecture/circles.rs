//! No circle of imports between modules, other than parent and child: what one module is made of can be read before the other.
//!
//! A module imports another where its code names something of it, by a `use` or by a path; a name that is shown elsewhere (`pub use`) counts for the module that defines it.
//! A `pub use` of a name that the module itself does not write is no import.
//! A circle that leaves a family counts too: from a parent to its child, from there to a stranger, from the stranger back to the parent.

use super::libraries::LIBRARIES;
use super::source::{ModulePath, modules, name};
use std::collections::{BTreeMap, BTreeSet};

/// The modules of a crate with what each imports.
type Imports = BTreeMap<ModulePath, BTreeSet<ModulePath>>;

/// A name that a `use` brings: the path to it, the name, and whether others see it.
struct Used {
    path: ModulePath,
    name: String,
    is_shown: bool,
}

/// A module: its imports by `use`, and the rest of its code.
struct Parsed {
    uses: Vec<Used>,
    body: String,
}

#[test]
fn no_modules_import_one_another_in_a_circle() {
    let mut circles = Vec::new();
    for library in LIBRARIES {
        for circle in circles_of(&imports(&modules(library))) {
            let members: Vec<String> = circle.iter().map(|path| name(path)).collect();
            circles.push(format!("{library}: {}", members.join(", ")));
        }
    }
    assert!(circles.is_empty(), "modules that import one another:\n{}", circles.join("\n"));
}

#[test]
fn a_circle_is_found_through_a_name_that_is_shown_elsewhere() {
    let of = |files: &[(&str, &str)]| {
        let modules = files.iter().map(|(path, code)| (split(path), (*code).to_owned())).collect();
        circles_of(&imports(&modules))
    };
    let root = ("", "mod a;\nmod b;\npub use b::Thing;\n");
    let circle =
        [root, ("a", "use crate::Thing;\npub struct Other(Thing);\n"), ("b", "pub struct Thing(crate::a::Other);\n")];
    assert_eq!(of(&circle), [vec![split("a"), split("b")]]);
    let chain = [root, ("a", "use crate::Thing;\npub struct Other(Thing);\n"), ("b", "pub struct Thing;\n")];
    assert!(of(&chain).is_empty());
    // Parent and child may know each other.
    let family = [
        ("", "mod a;\n"),
        ("a", "mod b;\nuse b::Thing;\npub struct Other(Thing);\n"),
        ("a::b", "pub struct Thing(super::Other);\n"),
    ];
    assert!(of(&family).is_empty());
    // Through a stranger they may not.
    let stranger = [
        ("", "mod a;\nmod c;\n"),
        ("a", "mod b;\nuse b::Thing;\npub struct Other(Thing);\npub struct Name;\n"),
        ("a::b", "pub struct Thing(crate::c::Rest);\n"),
        ("c", "use crate::a::Name;\npub struct Rest(Name);\n"),
    ];
    assert_eq!(of(&stranger), [vec![split("a"), split("a::b"), split("c")]]);
    // To show a name is not to use it.
    let shown = [
        ("", "mod a;\nmod b;\n"),
        ("a", "pub use crate::b::Thing;\npub struct Other;\n"),
        ("b", "use super::a::Other;\npub struct Thing(Other);\n"),
    ];
    assert!(of(&shown).is_empty());
}

fn split(path: &str) -> ModulePath {
    path.split("::").filter(|part| !part.is_empty()).map(str::to_owned).collect()
}

/// Whether one module holds the other.
fn are_of_one_line(one: &ModulePath, other: &ModulePath) -> bool {
    one.starts_with(other) || other.starts_with(one)
}

fn imports(modules: &BTreeMap<ModulePath, String>) -> Imports {
    let parsed: BTreeMap<&ModulePath, Parsed> =
        modules.iter().map(|(path, code)| (path, parse(path, code, modules))).collect();
    let of = |(path, module): (&&ModulePath, &Parsed)| {
        let used = module.uses.iter().filter(|used| !used.is_shown || has_word(&module.body, &used.name));
        let paths = used.map(|used| used.path.clone()).chain(paths_in(path, &module.body, modules));
        let found = paths.filter_map(|used| definition(&used, &parsed)).filter(|found| found != *path);
        ((*path).clone(), found.collect())
    };
    parsed.iter().map(of).collect()
}

/// The module in which the name at the end of a path is defined.
fn definition(path: &ModulePath, parsed: &BTreeMap<&ModulePath, Parsed>) -> Option<ModulePath> {
    let mut path = path.clone();
    // A name is shown through a handful of modules.
    for _ in 0..16 {
        let length = (0..=path.len()).rev().find(|length| parsed.contains_key(&path[..*length].to_vec()))?;
        let (module, rest) = (path[..length].to_vec(), path[length..].to_vec());
        let Some(first) = rest.first() else { return Some(module) };
        let shown = parsed[&module].uses.iter().find(|used| used.is_shown && used.name == *first);
        let Some(shown) = shown else { return Some(module) };
        path = shown.path.iter().cloned().chain(rest[1..].iter().cloned()).collect();
    }
    None
}

/// Takes the `use` declarations out of the code of a module.
fn parse(path: &ModulePath, code: &str, modules: &BTreeMap<ModulePath, String>) -> Parsed {
    let (mut uses, mut body) = (Vec::new(), String::new());
    let mut lines = code.lines();
    while let Some(line) = lines.next() {
        let item = line.trim_start();
        let visibility =
            item.strip_prefix("pub").map(|rest| rest.split_once(") ").map_or(rest, |(_, rest)| rest).trim_start());
        let Some(tree) = visibility.unwrap_or(item).strip_prefix("use ") else {
            body.push_str(line);
            body.push('\n');
            continue;
        };
        let mut tree = tree.to_owned();
        while !tree.contains(';') {
            tree.push_str(lines.next().expect("a use ends"));
        }
        let tree = tree.split(';').next().unwrap_or_default();
        for (used, name) in leaves(tree) {
            if let Some(used) = absolute(path, &used, modules) {
                uses.push(Used { path: used, name, is_shown: visibility.is_some() });
            }
        }
    }
    Parsed { uses, body }
}

/// The paths that the tree of a `use` brings, with their names.
fn leaves(tree: &str) -> Vec<(String, String)> {
    let tree = tree.trim();
    let Some((before, list)) = tree.split_once('{') else {
        let (path, name) = tree.split_once(" as ").unwrap_or((tree, tree.rsplit("::").next().unwrap_or(tree)));
        return vec![(path.trim().to_owned(), name.trim().to_owned())];
    };
    let list = list.strip_suffix('}').expect("a list ends");
    let mut depth = 0;
    let items = list.split(|character: char| {
        depth += i32::from(character == '{') - i32::from(character == '}');
        character == ',' && depth == 0
    });
    items.filter(|item| !item.trim().is_empty()).flat_map(|item| leaves(&format!("{before}{}", item.trim()))).collect()
}

/// A path from the root of the crate; `None` for one that leads out of it.
fn absolute(module: &ModulePath, path: &str, modules: &BTreeMap<ModulePath, String>) -> Option<ModulePath> {
    let mut parts = path.split("::").map(str::to_owned).peekable();
    let mut from = module.clone();
    match parts.peek()?.as_str() {
        "crate" => {
            parts.next();
            from.clear();
        }
        "self" => {
            parts.next();
        }
        "super" => {
            while parts.next_if(|part| part == "super").is_some() {
                from.pop();
            }
        }
        first => {
            let child: ModulePath = from.iter().cloned().chain([first.to_owned()]).collect();
            if !modules.contains_key(&child) {
                return None;
            }
        }
    }
    from.extend(parts.filter(|part| part != "self"));
    Some(from)
}

/// The paths from the root, the module or its parent that code names.
fn paths_in(module: &ModulePath, code: &str, modules: &BTreeMap<ModulePath, String>) -> Vec<ModulePath> {
    let is_part = |character: char| character.is_alphanumeric() || character == '_' || character == ':';
    let words = code.split(|character: char| !is_part(character));
    let starts = |word: &&str| ["crate::", "super::", "self::"].iter().any(|start| word.starts_with(start));
    words.filter(starts).filter_map(|word| absolute(module, word.trim_end_matches(':'), modules)).collect()
}

fn has_word(code: &str, word: &str) -> bool {
    code.split(|character: char| !character.is_alphanumeric() && character != '_').any(|part| part == word)
}

/// Circles among modules none of which holds the other, and circles that leave a family; the root, which holds all, is in none.
fn circles_of(all: &Imports) -> Vec<Vec<ModulePath>> {
    let all: Imports =
        all.iter().filter(|(path, _)| !path.is_empty()).map(|(path, found)| (path.clone(), found.clone())).collect();
    let beside = |(path, found): (&ModulePath, &BTreeSet<ModulePath>)| {
        let strangers = found.iter().filter(|other| !are_of_one_line(other, path));
        (path.clone(), strangers.cloned().collect())
    };
    let mut circles = circles_in(&all.iter().map(beside).collect());
    let is_family = |circle: &[ModulePath]| circle.iter().any(|head| circle.iter().all(|one| one.starts_with(head)));
    let leaving = circles_in(&all).into_iter().filter(|circle| !is_family(circle));
    circles.extend(leaving.filter(|circle| !circles.contains(circle)).collect::<Vec<_>>());
    circles
}

/// The sets of modules of which each can be reached from every other.
fn circles_in(imports: &Imports) -> Vec<Vec<ModulePath>> {
    let reached: BTreeMap<&ModulePath, BTreeSet<&ModulePath>> =
        imports.keys().map(|from| (from, reached(from, imports))).collect();
    let mut circles: Vec<Vec<ModulePath>> = Vec::new();
    for path in imports.keys().filter(|path| reached[path].contains(path)) {
        if circles.iter().any(|circle| circle.contains(path)) {
            continue;
        }
        let members = imports.keys().filter(|other| reached[path].contains(other) && reached[other].contains(path));
        circles.push(members.cloned().collect());
    }
    circles
}

/// The modules that a module imports, and those that these import, and so on.
fn reached<'i>(from: &ModulePath, imports: &'i Imports) -> BTreeSet<&'i ModulePath> {
    let mut reached = BTreeSet::new();
    let mut next: Vec<&ModulePath> = imports[from].iter().collect();
    while let Some(path) = next.pop() {
        if reached.insert(path) {
            next.extend(imports.get(path).into_iter().flatten());
        }
    }
    reached
}
