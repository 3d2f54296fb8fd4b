//! Targets of results: a file keeps its kind, and a pipe gets the result instead of being replaced.

#![cfg(unix)]

use crate::program::{Folder, command};
use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};

#[test]
fn a_named_pipe_stays_one() {
    let folder = Folder::with(&[]);
    let path = folder.path().join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&path).status().expect("mkfifo is there");
    assert!(made.success());
    let reader = {
        let path = path.clone();
        std::thread::spawn(move || std::fs::read_to_string(path).expect("readable"))
    };
    let run = folder.inpact(&["explain", "T001", "-o", "pipe"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert_eq!(reader.join().expect("read"), folder.inpact(&["explain", "T001"]).output);
    assert!(std::fs::metadata(&path).expect("there").file_type().is_fifo());
    assert_eq!(folder.names(), ["pipe"]);
}

#[test]
fn a_file_keeps_its_permissions_and_a_link_stays_a_link() {
    let folder = Folder::with(&[("page.txt", "old\n")]);
    let path = folder.path().join("page.txt");
    std::fs::set_permissions(&path, PermissionsExt::from_mode(0o600)).expect("permissions");
    symlink("page.txt", folder.path().join("link.txt")).expect("a link");
    let run = folder.inpact(&["explain", "T001", "-o", "link.txt"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(folder.path().join("link.txt").is_symlink());
    assert_eq!(folder.read("page.txt"), folder.inpact(&["explain", "T001"]).output);
    assert_eq!(std::fs::metadata(&path).expect("there").permissions().mode() & 0o777, 0o600);
}

#[test]
fn a_read_only_file_is_left_alone() {
    let folder = Folder::with(&[("page.txt", "old\n")]);
    let path = folder.path().join("page.txt");
    std::fs::set_permissions(&path, PermissionsExt::from_mode(0o400)).expect("permissions");
    let run = folder.inpact(&["explain", "T001", "-o", "page.txt"]);
    assert_eq!((run.code, folder.read("page.txt").as_str()), (2, "old\n"), "{}", run.errors);
}

#[test]
fn a_file_that_cannot_be_made_is_named_as_it_was_asked_for() {
    let folder = Folder::with(&[("a.inp", "*SURFACE INTERACTION, NAME=A\n"), ("file", "x\n")]);
    for (target, why) in
        [("no/such/a.out", "No such file or directory (os error 2)"), ("file/a.out", "Not a directory (os error 20)")]
    {
        for command in [["explain", "T001"], ["json", "a.inp"], ["check", "a.inp"]] {
            let run = folder.inpact(&[&command[..], &["-o", target]].concat());
            assert_eq!((run.code, run.errors), (2, format!("error: cannot write `{target}`: {why}\n")), "{command:?}");
        }
    }
}

/// A result never replaces what it is made from: the deck, what it includes, its configuration, tables, scenes, libraries, JSON.
#[test]
fn the_inputs_are_not_overwritten() {
    let part = "*SURFACE INTERACTION, NAME=A\n1.,\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n1., 0.\n2., 1.\n";
    let scene = "schema = \"inpact/scene/1\"\ndeck = \"a.inp\"\n";
    let files = [
        ("a.inp", "*INCLUDE, INPUT=part.inp\n"),
        ("part.inp", part),
        ("inpact.toml", "release = \"2022\"\n"),
        ("other.toml", "release = \"2022\"\n"),
        ("n.csv", "node,pressure,clearance,epot_s,epot_m\n1,1.,0.,1.,0.\n"),
        ("lib.so", "no library\n"),
        ("s.toml", scene),
    ];
    let folder = Folder::with(&files);
    std::fs::hard_link(folder.path().join("part.inp"), folder.path().join("hard.inp")).expect("a second name");
    symlink("part.inp", folder.path().join("soft.inp")).expect("a link");
    let json = folder.inpact(&["json", "--isolated", "--view", "syntax", "part.inp"]).output;
    folder.write("i.json", &json);
    let commands: [&[&str]; 7] = [
        &["check", "a.inp"],
        &["check", "--fix", "a.inp"],
        &["json", "a.inp"],
        &["json", "--view", "syntax", "a.inp"],
        &["eval", "a.inp", "--nodes", "n.csv"],
        &["plan", "a.inp", "--nodes", "n.csv"],
        &["tradeoff", "a.inp", "--nodes", "n.csv"],
    ];
    for command in commands {
        for target in ["a.inp", "part.inp", "./part.inp", "hard.inp", "soft.inp", "inpact.toml"] {
            let arguments = [command, &["-o", target]].concat();
            let run = folder.inpact(&arguments);
            assert_eq!(run.code, 2, "{arguments:?}: {}", run.errors);
            assert!(run.errors.contains("which it is made from"), "{arguments:?}: {}", run.errors);
        }
    }
    let others: [&[&str]; 9] = [
        &["eval", "a.inp", "--nodes", "n.csv", "-o", "./n.csv"],
        &["plan", "a.inp", "--nodes", "n.csv", "-o", "n.csv"],
        &["eval", "a.inp", "--nodes", "n.csv", "--user-library", "lib.so", "-o", "lib.so"],
        &["check", "a.inp", "--config", "other.toml", "-o", "other.toml"],
        &["inp", "i.json", "-o", "i.json"],
        &["inp", "i.json", "--into", "."],
        &["solve", "s.toml", "-o", "s.toml"],
        &["solve", "s.toml", "--interfaces", "s.toml"],
        &["tradeoff", "--scene", "s.toml", "-o", "s.toml"],
    ];
    // Written below the folder under the name of the JSON.
    folder.write("i.json", &json.replace("part.inp", "i.json"));
    for arguments in others {
        let run = folder.inpact(arguments);
        assert_ne!(run.code, 0, "{arguments:?}: {}", run.errors);
    }
    for (name, text) in files {
        assert_eq!(folder.read(name), text, "{name}");
    }
    assert_eq!(folder.read("i.json"), json.replace("part.inp", "i.json"));
    assert_eq!(folder.inpact(&["check", "-", "-"]).code, 2);
}

/// Standard input that is a file is read as any other.
#[test]
fn a_file_that_is_standard_input_is_not_overwritten() {
    let deck = "*HEADING\ntitle\n";
    let folder = Folder::with(&[("d.inp", deck)]);
    let mut program = command(folder.path(), &["json", "--isolated", "-", "-o", "d.inp"]);
    program.stdin(std::fs::File::open(folder.path().join("d.inp")).expect("there"));
    let ended = program.output().expect("the program starts");
    assert_eq!(ended.status.code(), Some(2), "{}", String::from_utf8_lossy(&ended.stderr));
    assert_eq!(folder.read("d.inp"), deck);
}

/// Standard output may be a file that others write to as well: it is written to, never replaced.
#[test]
fn standard_output_by_another_name_is_written_to() {
    use std::fs::File;
    use std::io::Write;
    let folder = Folder::with(&[("d.inp", "*HEADING\n")]);
    let expected = folder.inpact(&["json", "--isolated", "d.inp"]).output;
    for name in ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1", "out.txt", "-"] {
        if name.starts_with('/') && !std::path::Path::new(name).exists() {
            continue;
        }
        let mut file = File::create(folder.path().join("out.txt")).expect("writable");
        file.write_all(b"header\n").expect("writable");
        let mut program = command(folder.path(), &["json", "--isolated", "d.inp", "-o", name]);
        let status = program.stdout(file.try_clone().expect("a second handle")).status().expect("it starts");
        file.write_all(b"footer\n").expect("writable");
        assert!(status.success(), "{name}");
        assert_eq!(folder.read("out.txt"), format!("header\n{expected}footer\n"), "{name}");
    }
    let run = folder.inpact(&["json", "--isolated", "d.inp", "-o", "/dev/null"]);
    assert_eq!((run.code, run.output.as_str()), (0, ""));
    assert_eq!(folder.names(), ["d.inp", "out.txt"]);
}

#[test]
fn a_link_to_nothing_yet_leads_to_the_result() {
    let folder = Folder::with(&[("there/x", "")]);
    symlink("there/page.txt", folder.path().join("link.txt")).expect("a link");
    assert_eq!(folder.inpact(&["explain", "T001", "-o", "link.txt"]).code, 0);
    assert!(folder.path().join("link.txt").is_symlink());
    assert_eq!(folder.read("there/page.txt"), folder.inpact(&["explain", "T001"]).output);
}

#[test]
fn names_are_judged_before_the_first_file_is_written() {
    let file = |name: &str| format!(r#"{{"source":"{name}","line_end":"\n","blocks":[]}}"#);
    let folder = Folder::with(&[]);
    symlink("/", folder.path().join("root")).expect("a link");
    for bad in
        ["../out.inp", "/out.inp", "", ".", "sub/", "ok.inp", "./ok.inp", "ok.inp/below.inp", "sub/../../out.inp"]
    {
        let json = format!(r#"{{"schema":"inpact/syntax/1","files":[{},{}]}}"#, file("ok.inp"), file(bad));
        let run = folder.inpact_with_input(&["inp", "-", "--into", "o"], json.as_bytes());
        assert_eq!(run.code, 1, "`{bad}`: {}", run.errors);
        assert_eq!(folder.names(), ["root"], "`{bad}`");
    }
    // If writing fails, nothing is written either: here a folder has the name of a file, and a link leads out.
    for (bad, present) in [("taken", "o/taken/x"), ("link/tmp/out.inp", "o/x")] {
        folder.write(present, "");
        if bad.starts_with("link") {
            symlink("/", folder.path().join("o/link")).expect("a link");
        }
        let json = format!(r#"{{"schema":"inpact/syntax/1","files":[{},{}]}}"#, file("ok.inp"), file(bad));
        let run = folder.inpact_with_input(&["inp", "-", "--into", "o"], json.as_bytes());
        assert_ne!(run.code, 0, "`{bad}`: {}", run.errors);
        assert!(!folder.path().join("o/ok.inp").exists(), "`{bad}`: {}", run.errors);
    }
    let json = format!(r#"{{"schema":"inpact/syntax/1","files":[{},{}]}}"#, file("a.inp"), file("./sub/b.inp"));
    let run = folder.inpact_with_input(&["inp", "-", "--into", "new/folder"], json.as_bytes());
    assert_eq!(run.code, 0, "{}", run.errors);
    assert_eq!((folder.read("new/folder/a.inp"), folder.read("new/folder/sub/b.inp")), (String::new(), String::new()));
}
