//! Decks from elsewhere: what they may make the program read, and what they may make a terminal do.

use crate::program::{Folder, Run, command, run};
use serde_json::Value;

/// A deck that takes its rows from a file.
fn deck_including(name: &str) -> String {
    format!("*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n*INCLUDE, INPUT={name}\n")
}

/// A repository with a deck below it, and a file beside it with a secret.
fn repository() -> Folder {
    let folder = Folder::with(&[
        ("secret.inp", "TOKEN=abc123\n"),
        ("repo/shared/rows.inp", "1., 0.\nx9, 1.\n"),
        ("repo/decks/rows.inp", "1., 0.\nx8, 1.\n"),
        ("repo/decks/out.inp", &deck_including("../../secret.inp")),
        ("repo/decks/shared.inp", &deck_including("../shared/rows.inp")),
        ("repo/decks/own.inp", &deck_including("rows.inp")),
    ]);
    std::fs::create_dir(folder.path().join("repo/.git")).expect("a folder");
    folder
}

fn check(folder: &Folder, arguments: &[&str]) -> Run {
    folder.inpact(&[&["check", "-q"], arguments].concat())
}

#[test]
fn files_that_the_system_makes_up_are_not_included() {
    let folder = Folder::with(&[]);
    std::fs::create_dir(folder.path().join("folder")).expect("a folder");
    let mut names = vec!["folder"];
    if cfg!(target_os = "linux") {
        names.extend(["/proc/self/environ", "/proc/self/cmdline", "/dev/zero", "/dev/stdin"]);
    }
    for name in names {
        folder.write("a.inp", &deck_including(name));
        for format in ["full", "concise", "json", "sarif", "github"] {
            let mut program = command(folder.path(), &["check", "--isolated", "--format", format, "a.inp"]);
            program.env("MY_TOKEN", "abc123");
            let run = run(program, b"abc123\n");
            assert_eq!(run.code, 1, "{name} {format}: {}", run.shown());
            assert!(!run.shown().contains("abc123"), "{name} {format}: {}", run.shown());
            let is_reported = run.output.contains("S012") || run.output.contains("S020");
            assert!(is_reported, "{name} {format}: {}", run.shown());
        }
    }
}

#[test]
fn lines_of_files_outside_of_the_folder_of_the_deck_are_not_quoted() {
    let folder = repository();
    let far = check(&folder, &["repo/decks/shared.inp"]);
    assert!(far.output.contains("at repo/decks/../shared/rows.inp:2:1"), "{}", far.shown());
    assert!(far.output.contains("S006") && !far.output.contains("x9, 1."), "{}", far.shown());
    let near = check(&folder, &["repo/decks/own.inp"]);
    assert!(near.output.contains("x8, 1."), "{}", near.shown());
    // Whoever names a root, or where included files are, means what lies there.
    for meant in [["--include-root", "repo"], ["--include-dir", "repo/shared"]] {
        let run = check(&folder, &[&meant[..], &["repo/decks/shared.inp"]].concat());
        assert!(run.output.contains("x9, 1."), "{meant:?}: {}", run.shown());
    }
}

#[test]
fn nothing_outside_of_the_root_is_read_and_s020_says_so() {
    let folder = repository();
    let absolute = folder.path().join("secret.inp");
    folder.write("repo/decks/absolute.inp", &deck_including(absolute.to_str().expect("UTF-8")));
    folder.write("repo/decks/nothing.inp", &deck_including("../../nothing.inp"));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&absolute, folder.path().join("repo/decks/link.inp")).expect("linked");
        folder.write("repo/decks/linked.inp", &deck_including("link.inp"));
    }
    let decks =
        if cfg!(unix) { &["out", "absolute", "nothing", "linked"][..] } else { &["out", "absolute", "nothing"] };
    for deck in decks {
        let deck = format!("repo/decks/{deck}.inp");
        for options in [
            &["--format", "concise", "--include-root", "repo"][..],
            &["--format", "full", "--include-root", "repo"],
            &["--format", "json", "--include-root", "repo/decks"],
            &["--format", "github"],
            &["--format", "sarif"],
        ] {
            let run = check(&folder, &[options, &[deck.as_str()]].concat());
            assert_eq!(run.code, 1, "{}", run.shown());
            assert!(run.output.contains("S020"), "{deck} {options:?}: {}", run.shown());
            let results = run.output.split("\"results\"").last().unwrap_or_default();
            assert!(!results.contains("abc123") && !results.contains("S012"), "{deck} {options:?}: {}", run.shown());
        }
    }
    // Inside of the repository everything is read as before.
    let run = check(&folder, &["--format", "github", "repo/decks/shared.inp"]);
    assert!(run.output.contains("S006") && !run.output.contains("S020"), "{}", run.shown());
    // Without a repository the folder of the deck is the root.
    let run = check(&folder, &["--format", "github", "--include-root", "repo/decks", "repo/decks/shared.inp"]);
    assert!(run.output.contains("S020"), "{}", run.shown());
    std::fs::remove_dir(folder.path().join("repo/.git")).expect("removed");
    let run = check(&folder, &["--format", "github", "repo/decks/shared.inp"]);
    assert!(run.output.contains("S020"), "{}", run.shown());
}

#[test]
fn the_configuration_names_a_root_and_cannot_widen_that_of_the_formats() {
    let folder = repository();
    for (root, shared_is_read) in [("true", true), ("\".\"", true), ("\"decks\"", false), ("false", true)] {
        folder.write("repo/inpact.toml", &format!("include-root = {root}\n"));
        let run = check(&folder, &["--format", "concise", "repo/decks/shared.inp"]);
        assert_eq!(run.output.contains("S006"), shared_is_read, "{root}: {}", run.shown());
        assert_eq!(run.output.contains("S020"), !shared_is_read, "{root}: {}", run.shown());
        let run = check(&folder, &["--format", "concise", "repo/decks/out.inp"]);
        assert_eq!(run.output.contains("S020"), root != "false", "{root}: {}", run.shown());
    }
    for wide in ["\"/\"", "false"] {
        folder.write("repo/inpact.toml", &format!("include-root = {wide}\n"));
        let run = check(&folder, &["--format", "github", "repo/decks/out.inp"]);
        assert!(run.output.contains("S020") && !run.output.contains("abc123"), "{}", run.shown());
    }
    folder.write("repo/inpact.toml", "include-root = 3\n");
    let run = check(&folder, &["repo/decks/own.inp"]);
    assert!(run.code == 2 && run.errors.contains("expected a folder, or `true` for the repository"), "{}", run.shown());
}

#[cfg(unix)]
#[test]
fn a_deck_that_is_a_link_out_of_the_root_is_not_read() {
    let folder = repository();
    let link = |target: &str, name: &str| {
        std::os::unix::fs::symlink(target, folder.path().join("repo/decks").join(name)).expect("linked");
    };
    link("../../secret.inp", "evil.inp");
    link("../shared/rows.inp", "kind.inp");
    let run = check(&folder, &["--format", "github", "repo/decks/evil.inp", "repo/decks/kind.inp"]);
    assert_eq!(run.code, 2, "{}", run.shown());
    assert!(
        run.errors.contains("`repo/decks/evil.inp` is not read: it is a link that leads out of"),
        "{}",
        run.shown()
    );
    assert!(!run.shown().contains("abc123") && run.output.contains("kind.inp"), "{}", run.shown());
    if cfg!(target_os = "linux") {
        link("/proc/self/environ", "environment.inp");
        let mut program = command(folder.path(), &["check", "repo/decks/environment.inp"]);
        program.env("MY_TOKEN", "abc123");
        let run = crate::program::run(program, b"");
        assert!(run.code == 2 && !run.shown().contains("abc123"), "{}", run.shown());
    }
}

#[cfg(target_os = "linux")]
#[test]
fn scenes_name_regular_files_inside_of_the_root() {
    let folder = repository();
    let scene = |deck: &str| format!("deck = \"{deck}\"\nfields = [\"potential\"]\n");
    for (deck, options, message) in [
        ("/proc/self/environ", &[][..], "made up by the system"),
        ("../secret.inp", &["--include-root", "repo"], "it lies outside of"),
    ] {
        folder.write("repo/scene.toml", &scene(deck));
        let run = folder.inpact(&[&["solve", "repo/scene.toml"], options].concat());
        assert!(run.code != 0 && !run.shown().contains("abc123"), "{}", run.shown());
        // Another fault of the scene may be reported first.
        assert!(run.errors.contains(message) || run.errors.contains("error[D0"), "{}", run.shown());
    }
}

/// Everything that a terminal obeys or an eye misses, but line ends and tabs.
fn is_hidden(character: char) -> bool {
    character.is_control() && !matches!(character, '\n' | '\t')
        || matches!(character, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}')
}

#[test]
fn hidden_characters_are_written_out_in_messages_of_every_command() {
    const BAD: &str = "\u{1b}[31m\u{1b}]0;title\u{7}\u{9b}2J\u{202e}\u{200b}\u{7f}\u{8}";
    let folder = Folder::with(&[]);
    let deck = format!(
        "*SURFACE INTERACTION, NAME=\"I{BAD}\"\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n 1., 0.\n 2., {BAD}\n 3, 1\n\
         *CONTACT PAIR, INTERACTION=N{BAD}\n X{BAD}, S\n*PARAMETER\n a = b{BAD}\n** inpact: ignore T0{BAD}1\n*UNKNOWN{BAD}, P{BAD}=1\n\
         *INCLUDE, INPUT=no{BAD}.inp\n"
    );
    let sound =
        format!("*SURFACE INTERACTION, NAME=\"I{BAD}\"\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n 1., 0.\n 2., 1.\n");
    folder.write("bad.inp", &deck);
    folder.write("sound.inp", &sound);
    folder.write(&format!("named{BAD}.inp"), &deck);
    let named = format!("named{BAD}.inp");
    folder.write("bad.csv", &format!("node,pressure{BAD},pressure,pressure\n{BAD},1,x{BAD},2\n"));
    folder.write("unknown.csv", &format!("node,interaction,pressure\n1,{BAD},1\n"));
    folder.write("sound.csv", &format!("node,clearance,pressure,epot_s,epot_m,fv{BAD}\n1,0,1,1,0,1\n"));
    folder.write(
        "bad.json",
        &format!("{{\"schema\":\"inpact/model/1\",\"z{BAD}z\":1}}").replace(['\u{1b}', '\u{7}', '\u{8}'], "?"),
    );
    folder.write("escaped.json", "{\"schema\":\"inpact/model/1\",\"z\\u001b[2J\\u009b\\u202e\":1}");
    folder.write("scene.toml", &format!("deck = \"bad.inp\"\nfields = [\"{}\"]\n", "\\u001B[2J\\u202E"));
    folder.write("sub/inpact.toml", "dialect = \"\\u001B[2J\\u202E\"\n");
    folder.write("sub/a.inp", "*HEADING\n");
    let mut runs: Vec<(Vec<&str>, bool)> = Vec::new();
    for format in ["full", "concise", "json", "sarif", "github"] {
        runs.push((vec!["check", "--format", format, "bad.inp"], true));
        runs.push((vec!["check", "--format", format, &named], true));
    }
    for (deck, nodes) in
        [("bad.inp", "bad.csv"), ("sound.inp", "bad.csv"), ("sound.inp", "unknown.csv"), ("bad.inp", "sound.csv")]
    {
        runs.push((vec!["eval", deck, "--nodes", nodes], false));
        runs.push((vec!["eval", deck, "--nodes", nodes, "--format", "json"], false));
        runs.push((vec!["plan", deck, "--nodes", nodes], true));
        runs.push((vec!["plan", deck, "--nodes", nodes, "--format", "json"], true));
    }
    runs.push((vec!["plan", "sound.inp", "--nodes", "sound.csv"], true));
    runs.push((vec!["plan", "sound.inp", "--nodes", "sound.csv", "--format", "json"], true));
    runs.push((vec!["tradeoff", "sound.inp", "--nodes", "sound.csv", "--rounds", "1"], true));
    runs.extend([
        (vec!["json", "bad.inp"], false),
        (vec!["inp", "bad.json"], false),
        (vec!["inp", "escaped.json"], false),
        (vec!["solve", "scene.toml"], false),
        (vec!["check", "sub/a.inp"], true),
        (vec!["explain", BAD], true),
        (vec!["check", BAD], true),
        (vec!["fmt", BAD], false),
        (vec!["check", "--format", BAD, "bad.inp"], true),
        (vec![BAD], true),
    ]);
    for (arguments, output_is_for_people) in runs {
        let run = folder.inpact(&arguments);
        let shown = if output_is_for_people { run.shown() } else { run.errors.clone() };
        let hidden: Vec<char> = shown.chars().filter(|character| is_hidden(*character)).collect();
        assert!(hidden.is_empty(), "{arguments:?}: {hidden:?} in {shown:?}");
        if arguments.contains(&"json") && arguments[0] != "json" {
            for line in run.errors.lines().filter(|line| line.starts_with('{')) {
                serde_json::from_str::<Value>(line).unwrap_or_else(|error| panic!("{error}: {line}"));
            }
        }
    }
    // A finding is one line, whatever is in a name, and JSON says the name as it is.
    let run = folder.inpact(&["check", "-q", "--format", "json", "bad.inp"]);
    let findings: Vec<Value> = run.output.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert!(!findings.is_empty());
    // Results are bytes.
    let run = folder.inpact(&["fmt", "--check", "sound.inp"]);
    assert!(run.code <= 1, "{}", run.shown());
    let model = folder.inpact(&["json", "sound.inp"]).output;
    let model: Value = serde_json::from_str(&model).expect("JSON");
    let names: Vec<&String> = model["interactions"].as_object().expect("an object").keys().collect();
    assert_eq!(names, [&format!("\"I{BAD}\"")]);
}

#[cfg(unix)]
#[test]
fn a_deck_that_has_no_line_end_is_given_up() {
    let folder = Folder::with(&[]);
    std::os::unix::fs::symlink("/dev/zero", folder.path().join("evil.inp")).expect("linked");
    for arguments in [&["check", "evil.inp"][..], &["json", "evil.inp"], &["json", "--view", "syntax", "evil.inp"]] {
        let run = folder.inpact(arguments);
        assert_eq!(run.code, 2, "{arguments:?}: {}", run.shown());
        assert!(run.errors.contains("line 1 is longer than 16777216 bytes"), "{arguments:?}: {}", run.shown());
    }
}

/// A device without an end, in the place of every file that can be named, with less memory than it would soon take.
#[cfg(target_os = "linux")]
#[test]
fn a_file_without_an_end_is_given_up_by_every_command_that_can_name_it() {
    const SCENE: &str =
        "deck = \"a.inp\"\n[[node]]\nname = \"1\"\npotential = { fixed = 0.0 }\n[[link_file]]\nfile = \"evil\"\n";
    let folder = Folder::with(&[
        ("a.inp", "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n 20., 0.\n 10., 0.1\n"),
        ("user.inp", "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, USER\n"),
        ("a.csv", "node,clearance,epot_s,epot_m\n7,-1e-3,3,1\n"),
        ("names-deck.toml", "deck = \"evil\"\nfields = [\"potential\"]\n"),
        ("names-table.toml", SCENE),
        ("sub/a.inp", "*HEADING\n"),
    ]);
    for link in ["evil", "sub/inpact.toml"] {
        std::os::unix::fs::symlink("/dev/zero", folder.path().join(link)).expect("linked");
    }
    let line = "line 1 is longer than 16777216 bytes";
    let no_text = "it is no text: byte 1 is zero";
    let irregular = "only regular files are read";
    let device = "it is a device, and gives more than 67108864 bytes";
    let runs: &[(&[&str], &str)] = &[
        (&["check", "evil"], line),
        (&["check", "--fix", "evil"], line),
        (&["check", "--diff", "evil"], line),
        (&["json", "evil"], line),
        (&["json", "--view", "syntax", "evil"], line),
        (&["fmt", "evil"], line),
        (&["fmt", "--check", "evil"], line),
        (&["fmt", "--diff", "evil"], line),
        (&["inp", "evil"], no_text),
        (&["inp", "evil", "--into", "new"], no_text),
        (&["eval", "evil", "--nodes", "a.csv"], line),
        (&["eval", "a.inp", "--nodes", "evil"], device),
        (&["eval", "user.inp", "--nodes", "a.csv", "--user-library", "evil"], ""),
        (&["plan", "evil", "--nodes", "a.csv"], line),
        (&["plan", "a.inp", "--nodes", "evil"], device),
        (&["tradeoff", "evil", "--nodes", "a.csv"], line),
        (&["tradeoff", "a.inp", "--nodes", "evil"], device),
        (&["tradeoff", "--scene", "evil"], no_text),
        (&["solve", "evil"], no_text),
        (&["solve", "names-deck.toml"], irregular),
        (&["solve", "names-table.toml"], irregular),
        (&["check", "--config", "evil", "a.inp"], no_text),
        (&["solve", "--config", "evil", "names-deck.toml"], no_text),
    ];
    for (arguments, message) in runs {
        let plain = command(folder.path(), arguments);
        let mut limited = std::process::Command::new("sh");
        limited.args(["-c", "ulimit -v 1048576 && exec \"$0\" \"$@\""]).arg(plain.get_program()).args(*arguments);
        limited.current_dir(folder.path()).env("NO_COLOR", "1").env("RAYON_NUM_THREADS", "1");
        let run = run(limited, b"");
        assert_eq!(run.code, 2, "{arguments:?}: {}", run.shown());
        assert!(run.errors.contains("evil"), "{arguments:?}: {}", run.shown());
        assert!(run.errors.contains(message), "{arguments:?}: {}", run.shown());
    }
    // A folder with the name of a configuration is none.
    assert_eq!(folder.inpact(&["check", "sub/a.inp"]).code, 0);
    // The same without a name.
    for (arguments, message) in [(&["fmt", "-"][..], line), (&["inp", "-"], no_text), (&["solve", "-"], no_text)] {
        let plain = command(folder.path(), arguments);
        let mut limited = std::process::Command::new("sh");
        limited
            .args(["-c", "ulimit -v 1048576 && exec \"$0\" \"$@\" < /dev/zero"])
            .arg(plain.get_program())
            .args(arguments);
        let run = run(limited, b"");
        assert!(run.code == 2 && run.errors.contains(message), "{arguments:?}: {}", run.shown());
    }
}

#[test]
fn too_many_files_are_not_called_too_deep() {
    let folder = Folder::with(&[("n2.inp", "*NODE\n"), ("n1.inp", &"*INCLUDE, INPUT=n2.inp\n".repeat(200_002))]);
    let run = folder.inpact(&["check", "-q", "--format", "concise", "n1.inp"]);
    assert_eq!(run.output.matches("error[S013]").count(), 2, "{}", run.shown());
    assert!(
        run.output.starts_with("n1.inp:200001:17: error[S013] `n2.inp` is not read: 200000 files"),
        "{}",
        run.output
    );
}

/// The program under a limit of processes that it has reached already; root has none, and so it runs as nobody.
#[cfg(target_os = "linux")]
#[test]
fn without_another_thread_the_work_is_done_on_one() {
    use std::os::unix::fs::PermissionsExt;
    let open = |path: &std::path::Path, mode| std::fs::set_permissions(path, std::fs::Permissions::from_mode(mode));
    let folder = Folder::with(&[
        ("a.inp", "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n 20., 0.\n 10., 0.1\n"),
        ("a.csv", "node,clearance,epot_s,epot_m\n7,-1e-3,3,1\n"),
    ]);
    open(folder.path(), 0o755).expect("opened");
    std::fs::copy(env!("CARGO_BIN_EXE_inpact-under-test"), folder.path().join("program")).expect("copied");
    for arguments in [
        &["check", "a.inp", "a.inp"][..],
        &["eval", "a.inp", "--nodes", "a.csv"],
        &["plan", "a.inp", "--nodes", "a.csv"],
    ] {
        let expected = folder.inpact(arguments);
        let limited = |with: &[&str]| {
            let mut program = std::process::Command::new("prlimit");
            program.args(["--nproc=1:1", "setpriv"]).args(with).arg("./program").args(arguments);
            program.current_dir(folder.path()).env("NO_COLOR", "1").output()
        };
        let Ok(run) = limited(&["--reuid", "65534", "--regid", "65534", "--clear-groups"]) else { return };
        let message = String::from_utf8_lossy(&run.stderr).into_owned();
        if message.starts_with("setpriv") || message.starts_with("prlimit") {
            // Only root may become nobody.
            return;
        }
        assert_eq!(run.status.code(), Some(expected.code), "{arguments:?}: {message}");
        assert_eq!(String::from_utf8_lossy(&run.stdout), expected.output, "{arguments:?}: {message}");
    }
}
