//! Runs the pages of the rules about data: the examples in a rule's documentation are its test.
//!
//! A fenced block with a file name after its language is that file; a `console` block is a command, and the findings with which its standard error begins.
//! Every rule has a command that brings up this rule and no other.

use crate::program::{Folder, Run};
use std::io::Write;
use std::process::Command;

/// A fenced block: what stands after the three marks, and the text between them.
struct Block {
    tags: String,
    text: String,
}

/// The fenced blocks of a page.
fn blocks(page: &str) -> Vec<Block> {
    let mut blocks: Vec<Block> = Vec::new();
    let mut is_open = false;
    for line in page.lines() {
        // A doc comment puts one blank before every line.
        let line = line.strip_prefix(' ').unwrap_or(line);
        match line.strip_prefix("```") {
            Some(_) if is_open => is_open = false,
            Some(tags) => {
                is_open = true;
                blocks.push(Block { tags: tags.to_owned(), text: String::new() });
            }
            None if is_open => {
                let block = blocks.last_mut().expect("a block is open");
                block.text += line;
                block.text.push('\n');
            }
            None => {}
        }
    }
    assert!(!is_open, "a block is not closed");
    blocks
}

/// Runs a command of a page in a folder; `None` where it needs a compiler that is not there.
fn run(folder: &Folder, command: &str) -> Option<Run> {
    let parts: Vec<&str> = command.split(' ').collect();
    if parts[0] == "inpact" {
        return Some(folder.inpact(&parts[1..]));
    }
    assert_eq!(parts[0], "gfortran", "commands of pages are the program and a compiler");
    match Command::new(parts[0]).args(&parts[1..]).current_dir(folder.path()).output() {
        Ok(output) => Some(Run {
            code: output.status.code().unwrap_or(-1),
            output: String::from_utf8_lossy(&output.stdout).into_owned(),
            errors: String::from_utf8_lossy(&output.stderr).into_owned(),
        }),
        Err(error) => {
            assert!(std::env::var_os("INPACT_REQUIRE_GFORTRAN").is_none(), "gfortran: {error}");
            let _ = writeln!(std::io::stderr(), "SKIPPED, an example needs Fortran: gfortran: {error}");
            None
        }
    }
}

/// The codes in brackets, `[D003]`.
fn codes(text: &str) -> Vec<&str> {
    let is_code = |code: &&str| code.len() == 4 && code[1..].bytes().all(|byte| byte.is_ascii_digit());
    text.split('[').filter_map(|rest| rest.split_once(']')).map(|(code, _)| code).filter(is_code).collect()
}

/// What is wrong with the examples of a page.
fn failures(code: &str, page: &str) -> String {
    let folder = Folder::with(&[]);
    let mut failures = String::new();
    let mut is_shown = false;
    for Block { tags, text } in blocks(page) {
        let Some((_, file)) = tags.split_once(' ') else {
            let is_console = tags == "console" && text.starts_with("$ ");
            assert!(is_console, "{code}: a block is a file, ```csv nodes.csv, or a command: found ```{tags}");
            let (command, expected) = text[2..].split_once('\n').expect("a line has an end");
            let Some(run) = run(&folder, command) else { return failures };
            let lines = |text: &str| text.lines().map(|line| line.trim_end().to_owned() + "\n").collect::<String>();
            if !lines(&run.errors).trim_start().starts_with(lines(expected).trim_start()) {
                failures += &format!("\n{code}: `{command}` says\n{}and not\n{expected}", run.errors);
            }
            let found = codes(&run.errors);
            if found.iter().any(|found| *found != code) {
                failures += &format!("\n{code}: `{command}` brings up {found:?}\n{}", run.errors);
            }
            is_shown |= codes(expected).contains(&code);
            // `check` finds it in a scene without solving, but for what only a solution shows.
            if command.starts_with("inpact solve scene.toml") && !["D010", "D019", "D022"].contains(&code) {
                let checked = folder.inpact(&["check", "scene.toml", "--format", "concise"]);
                if codes(&checked.output).iter().all(|found| *found != code) {
                    failures += &format!("\n{code}: `inpact check scene.toml` does not find it\n{}", checked.output);
                }
            }
            continue;
        };
        folder.write(file, &text);
    }
    if !is_shown && failures.is_empty() {
        failures += &format!("\n{code}: no example shows its finding");
    }
    failures
}

#[test]
fn every_rule_about_data_has_an_example_that_shows_its_finding() {
    let rules: Vec<_> = inpact::pages::rules().filter(|rule| rule.code.starts_with('D')).collect();
    assert!(rules.len() >= 22, "{}", rules.len());
    let failures: String = rules.iter().map(|rule| failures(rule.code, rule.documentation)).collect();
    assert!(failures.is_empty(), "{failures}");
}

/// The harness finds what is wrong with a page.
#[test]
fn a_page_without_its_finding_fails() {
    let deck = "```inp deck.inp\n*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE\n10., 0.\n0., 1.\n```\n";
    let eval = |table: &str, said: &str| {
        format!("{deck}```csv n.csv\n{table}```\n```console\n$ inpact eval deck.inp --nodes n.csv\n{said}\n```\n")
    };
    assert!(failures("D003", deck).contains("no example shows its finding"));
    let right = "n.csv:2: warning[D003]";
    let table = "node,clearance,temp_s,temp_m\n1,nan,20,30\n";
    assert!(failures("D003", &eval(table, "something else")).contains("and not\nsomething else"));
    assert!(failures("D002", &eval(table, right)).contains("brings up [\"D003\"]"));
}
