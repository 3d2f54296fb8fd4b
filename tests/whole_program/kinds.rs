//! A scene where a deck is expected, and one file under several names.

use crate::program::Folder;

const DECK: &str = "*SURFACE INTERACTION, NAME=A\n1.,\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n1., 0.\n*CONTACT PAIR, INTERACTION=A\nS, M\n";
const SCENE: &str = "deck = \"a.inp\"\n[[node]]\nname = \"x\"\n";
const NODES: &str = "pressure,epot_s,epot_m\n1,1,0\n";

/// A page of nothing, with 0, was made of it by `report`.
#[test]
fn no_command_takes_a_scene_for_a_deck() {
    let commands: [&[&str]; 15] = [
        &["eval", "{}", "--nodes", "n.csv"],
        &["eval", "{}"],
        &["plan", "{}", "--nodes", "n.csv"],
        &["nodes", "{}"],
        &["interfaces", "{}"],
        &["report", "{}"],
        &["report", "{}", "--nodes", "n.csv"],
        &["scene", "{}"],
        &["plot", "{}"],
        &["plot", "{}", "--nodes", "n.csv"],
        &["body", "{}", "--terminals", "S"],
        &["compare", "{}", "--results", "n.csv"],
        &["json", "{}"],
        &["json", "--view", "syntax", "{}"],
        &["fmt", "--diff", "{}"],
    ];
    for name in ["s.toml", "scene"] {
        for command in commands {
            let folder = Folder::with(&[("a.inp", DECK), (name, SCENE), ("n.csv", NODES), ("out.html", "before")]);
            let mut arguments: Vec<&str> = command.iter().map(|part| part.replace("{}", name).leak() as &str).collect();
            if arguments[0] != "fmt" {
                arguments.extend(["-o", "out.html"]);
            }
            let run = folder.inpact(&arguments);
            assert_eq!(run.code, 2, "{arguments:?}: {}", run.shown());
            let message = format!("`{name}` is a scene, where a deck is expected: `inpact solve {name}` solves it");
            assert!(run.errors.contains(&message), "{arguments:?}: {}", run.shown());
            assert_eq!(
                (folder.read("out.html"), folder.read(name)),
                ("before".to_owned(), SCENE.to_owned()),
                "{arguments:?}"
            );
        }
    }
}

/// Each of its lines was a finding.
#[test]
fn solve_takes_no_deck_for_a_scene() {
    for name in ["a.inp", "a.toml"] {
        let folder = Folder::with(&[(name, DECK), ("out", "before")]);
        let run = folder.inpact(&["solve", name, "-o", "out"]);
        assert_eq!(run.code, 2, "{}", run.shown());
        let message =
            format!("error: `{name}` is a deck, where a scene is expected: `inpact scene {name}` makes one of it");
        assert!(run.errors.starts_with(&message), "{}", run.shown());
        assert_eq!(folder.read("out"), "before");
    }
}

/// Definitions of parameters look like keys, and a deck may include them from a file of their own.
#[test]
fn definitions_of_parameters_are_no_scene() {
    let folder = Folder::with(&[("parameters.inc", "a = 3\nb = 2 * a\n")]);
    let run = folder.inpact(&["json", "--view", "syntax", "parameters.inc"]);
    assert_eq!(run.code, 0, "{}", run.shown());
}

#[cfg(unix)]
#[test]
fn a_file_is_judged_once_under_whatever_names() {
    let deck = DECK.replace("PRESSURE", "PRESURE");
    let folder = Folder::with(&[("a.inp", &deck), ("s.toml", SCENE), ("d/b.inp", "*STEP\n")]);
    for name in ["a.inp", "s.toml"] {
        std::os::unix::fs::symlink(folder.path().join(name), folder.path().join(format!("linked-{name}")))
            .expect("a link");
        std::fs::hard_link(folder.path().join(name), folder.path().join(format!("hard-{name}"))).expect("a link");
        let once = folder.inpact(&["check", "--format", "concise", name]);
        let (same, linked, hard) = (format!("./{name}"), format!("linked-{name}"), format!("hard-{name}"));
        for others in [&same, &linked, &hard, &name.to_owned()] {
            let twice = folder.inpact(&["check", "--format", "concise", name, others]);
            assert_eq!(twice.shown(), once.shown(), "{others}");
        }
    }
    let folder = Folder::with(&[("a.inp", "*HEADING\n"), ("d/b.inp", "*STEP\n")]);
    let all = folder.inpact(&["check", "--format", "concise", "d/b.inp", "d", "."]);
    assert!(all.errors.contains("2 decks"), "{}", all.shown());
}

/// A file that is replaced is linked no more, so that each name of it has to be written.
#[cfg(unix)]
#[test]
fn hard_links_are_mended_each() {
    let short = "*SURFACE INTERACTION, NAME=A\n*GAP COND\n1., 0.\n0., 1.\n";
    for command in [&["check", "--fix", "--exit-zero"][..], &["fmt"]] {
        let folder = Folder::with(&[("a.inp", &short.replace("COND", "cond"))]);
        let link = |name: &str| std::fs::hard_link(folder.path().join("a.inp"), folder.path().join(name));
        link("b.inp").expect("a link");
        std::os::unix::fs::symlink(folder.path().join("a.inp"), folder.path().join("c.inp")).expect("a link");
        let run = folder.inpact(&[command, &["a.inp", "b.inp", "c.inp"]].concat());
        assert_eq!(run.code, 0, "{}", run.shown());
        assert!(folder.read("a.inp") != short.replace("COND", "cond"), "{}", run.shown());
        assert_eq!(folder.read("a.inp"), folder.read("b.inp"), "{}", run.shown());
        assert!(folder.path().join("c.inp").is_symlink());
    }
}
