//! `docs/rules.md`: the page of every rule, to which the codes of findings in editors lead.

use crate::program::{inpact, root};

const HEAD: &str = "\
# Rules

What `inpact check` and the readers of node tables and scenes find, one section a rule.
Made by `inpact explain --all --format markdown`: `INPACT_UPDATE=1 cargo test -p inpact-tests --test whole_program rule_pages`.

";

#[test]
fn the_pages_of_rules_are_fresh() {
    let all = inpact(&["explain", "--all", "--format", "markdown"]);
    assert_eq!(all.code, 0, "{}", all.errors);
    let is_code = |title: &str| {
        let code = title.split(' ').next().unwrap_or_default();
        code.len() == 4
            && code.starts_with(|letter: char| letter.is_ascii_uppercase())
            && code[1..].bytes().all(|byte| byte.is_ascii_digit())
    };
    // A page begins with its title, outside of examples.
    let mut pages: Vec<String> = Vec::new();
    let mut is_example = false;
    for line in all.output.lines() {
        is_example ^= line.starts_with("```");
        if !is_example && line.starts_with("# ") {
            pages.push(String::new());
        }
        if let Some(page) = pages.last_mut() {
            let deeper = !is_example && line.starts_with('#');
            page.push_str(if deeper { "#" } else { "" });
            page.push_str(line);
            page.push('\n');
        }
    }
    let rules: Vec<&String> = pages.iter().filter(|page| page.strip_prefix("## ").is_some_and(is_code)).collect();
    assert!(rules.len() > 80, "{} rules", rules.len());
    let fresh = HEAD.to_owned()
        + &rules.into_iter().map(|page| page.trim_end().to_owned() + "\n").collect::<Vec<_>>().join("\n");
    let path = root().join("docs/rules.md");
    if std::env::var_os("INPACT_UPDATE").is_some() {
        std::fs::write(&path, fresh).expect("writable");
        return;
    }
    let written = std::fs::read_to_string(&path).expect("readable");
    assert!(fresh == written, "`docs/rules.md` is out of date: run this test again with INPACT_UPDATE=1");
}
