//! Lists the keyword files of `grammar/keywords/` and `grammar/calculix/` for [`include_str!`], so that a new one needs no line of code.
//!
//! Reads no more of a file than the name in its first line; a test loads the files strictly.

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let grammar = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("grammar").canonicalize()?;
    println!("cargo::rerun-if-changed=build.rs");
    list_folder(&grammar.join("keywords"), "keyword_files.rs")?;
    list_folder(&grammar.join("calculix"), "calculix_files.rs")
}

/// Writes the names and texts of a folder's keyword files as a list of Rust.
fn list_folder(folder: &Path, list_file: &str) -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            files.push(path);
        }
    }
    files.sort();
    let mut list = String::from("&[\n");
    for path in &files {
        println!("cargo::rerun-if-changed={}", path.display());
        let name = keyword_name(path).map_err(|reason| format!("{}: {reason}", path.display()))?;
        let path = path.to_str().ok_or("the path of the repository is not UTF-8")?;
        writeln!(list, "    ({name:?}, include_str!({path:?})),")?;
    }
    list.push_str("]\n");
    fs::write(PathBuf::from(env::var("OUT_DIR")?).join(list_file), list)?;
    Ok(())
}

/// The keyword that a file defines: its first line is `name = "…"`, and the file is named after it.
fn keyword_name(path: &Path) -> Result<String, Box<dyn Error>> {
    let text = fs::read_to_string(path)?;
    let first = text.lines().next().unwrap_or_default();
    let name = first.strip_prefix("name = \"").and_then(|rest| rest.strip_suffix('"'));
    let name = name.ok_or("the first line must be `name = \"KEYWORD\"`")?;
    let file = format!("{}.toml", name.to_ascii_lowercase().replace(' ', "_"));
    if path.file_name().is_some_and(|actual| actual == file.as_str()) {
        Ok(name.to_owned())
    } else {
        Err(format!("the file of `{name}` must be called `{file}`").into())
    }
}
