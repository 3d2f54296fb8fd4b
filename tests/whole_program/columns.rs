//! The columns of node tables and results: their pages, and `docs/tables.md`, which holds them.

use crate::program::{Folder, inpact, root};

const BEGIN: &str = "<!-- columns:";
const END: &str = "<!-- end of columns -->";

#[test]
fn the_columns_in_docs_tables_are_fresh() {
    let page = inpact(&["explain", "columns", "--format", "markdown"]);
    assert_eq!(page.code, 0, "{}", page.errors);
    let path = root().join("docs/tables.md");
    let written = std::fs::read_to_string(&path).expect("readable");
    let begin = written.find(BEGIN).expect("the mark of its beginning");
    let begin = begin + written[begin..].find('\n').expect("a line") + 1;
    let end = written.find(END).expect("the mark of its end");
    let fresh = format!("{}\n{}\n{}", &written[..begin], page.output, &written[end..]);
    if std::env::var_os("INPACT_UPDATE").is_some() {
        std::fs::write(&path, fresh).expect("writable");
        return;
    }
    assert!(fresh == written, "`docs/tables.md` is out of date: run this test again with INPACT_UPDATE=1");
}

#[test]
fn every_column_is_explained_by_each_of_its_names() {
    for (name, parts) in [
        ("ECD", &["electric current per area", "C T⁻¹ L⁻²", "electrical law"][..]),
        ("ecd", &["electric current per area"]),
        ("epot_s", &["electric potential of the slave surface", "Unit: φ"]),
        ("COPEN", &["clearance d", "`copen`", "Q-36"]),
        ("fv7_m", &["field variable"]),
        ("dconductance_dtemp", &["slope of `conductance`"]),
        ("q_across", &["A column of node tables", "A column of results"]),
        ("temp", &["A column of node tables: mean temperature"]),
        ("step", &["*STEP", "A column of node tables: number of the step"]),
        ("electrical_status", &["Q-40"]),
        ("D020", &["unknown-column", "inpact explain columns"]),
    ] {
        let page = inpact(&["explain", name]);
        assert_eq!(page.code, 0, "{name}: {}", page.errors);
        for part in parts {
            assert!(page.output.contains(part), "{name}: {part}\n{}", page.output);
        }
    }
    let keyword = inpact(&["explain", "*STEP"]);
    assert!(!keyword.output.contains("A column"), "{}", keyword.output);
    let misspelt = inpact(&["explain", "clearence_rate"]);
    assert_eq!(misspelt.code, 2);
    assert!(misspelt.errors.contains("`clearance_rate`"), "{}", misspelt.errors);
}

#[test]
fn help_lists_the_columns() {
    for command in ["eval", "plan"] {
        let help = inpact(&[command, "--help"]).output;
        for name in ["epot_jump", "clearance_rate", "HTLA", "pore_status", "inpact explain columns"] {
            assert!(help.contains(name), "{command}: {name}");
        }
    }
}

/// D020: what nothing reads is said by `eval` and `plan`, with the name that is near.
#[test]
fn a_misspelt_column_is_a_warning_with_the_nearest_name() {
    let folder = Folder::with(&[
        (
            "deck.inp",
            "*SURFACE INTERACTION, NAME=P\n*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=1, CUTOFF GAP FILL=1\n1e-3,0.\n3e-3,10.\n*STEP\n*SOILS, CONSOLIDATION\n1,1\n*END STEP\n",
        ),
        (
            "nodes.csv",
            "clearance,pressure,por_s,por_m,clearence_rate,perm_slave,perm_master,set\n0.05,0,1,2,-1,1,3,A\n",
        ),
    ]);
    for command in ["eval", "plan"] {
        let run = folder.inpact(&[command, "deck.inp", "--nodes", "nodes.csv"]);
        assert_eq!(run.code, 0, "{}", run.errors);
        for (written, meant) in
            [("clearence_rate", "clearance_rate"), ("perm_slave", "perm_s"), ("perm_master", "perm_m")]
        {
            let warning = format!("warning[D020] a node table has no column `{written}`");
            let line = run.errors.lines().find(|line| line.contains(&warning));
            assert!(line.is_some_and(|line| line.contains(&format!("did you mean `{meant}`?"))), "{}", run.errors);
        }
        assert_eq!(run.errors.matches("D020").count(), 3, "{}", run.errors);
    }
    let plan = folder.inpact(&["plan", "deck.inp", "--nodes", "nodes.csv"]).output;
    assert!(plan.contains("a node table has no column of that name; did you mean `clearance_rate`?"), "{plan}");
}
