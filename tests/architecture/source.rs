//! The source of a library, module by module, as text without comments and without its own tests.

use super::libraries::folder;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The path of a module in its crate, without the crate; empty for the root.
pub(crate) type ModulePath = Vec<String>;

/// What comes before a module that is compiled for tests alone.
const FOR_TESTS: &str = "#[cfg(test)]\nmod ";

/// The code of each module of a library that has a file of its own.
pub(crate) fn modules(library: &str) -> BTreeMap<ModulePath, String> {
    let mut modules = BTreeMap::new();
    add_modules(&folder(library).join("src"), &Vec::new(), &mut modules);
    let for_tests: Vec<ModulePath> = modules.iter().flat_map(|(path, code)| children_for_tests(path, code)).collect();
    modules.retain(|path, _| !for_tests.contains(path));
    modules
}

/// A module as it is written in Rust.
pub(crate) fn name(path: &[String]) -> String {
    if path.is_empty() { "the root".to_owned() } else { path.join("::") }
}

fn add_modules(folder: &Path, path: &ModulePath, modules: &mut BTreeMap<ModulePath, String>) {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    for entry in entries {
        let file = entry.expect("a folder that can be listed").path();
        let stem = file.file_stem().expect("a name").to_string_lossy().into_owned();
        let is_root = path.is_empty() && stem == "lib";
        let inner: ModulePath = path.iter().cloned().chain((!is_root).then(|| stem.clone())).collect();
        if file.is_dir() {
            add_modules(&file, &inner, modules);
        } else if file.extension().is_some_and(|extension| extension == "rs") && stem != "main" {
            let text = fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
            modules.insert(inner, code_of(&text));
        }
    }
}

/// The text of a file without comments, up to its tests.
fn code_of(text: &str) -> String {
    let without_comment = text.lines().map(|line| match line.find("//") {
        // Two slashes within a text are none.
        Some(at) if line[..at].matches('"').count() % 2 == 0 => &line[..at],
        _ => line,
    });
    let code: String = without_comment.flat_map(|line| [line, "\n"]).collect();
    let end = code.find("#[cfg(test)]\nmod tests {").unwrap_or(code.len());
    code[..end].to_owned()
}

fn children_for_tests(path: &ModulePath, code: &str) -> Vec<ModulePath> {
    let names = code.split(FOR_TESTS).skip(1).filter_map(|rest| rest.split_once(';'));
    names.map(|(name, _)| path.iter().cloned().chain([name.to_owned()]).collect()).collect()
}
