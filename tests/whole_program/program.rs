//! Starting the program and taking what it prints.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Result of a run of the program.
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) output: String,
    pub(crate) errors: String,
}

impl Run {
    /// All of it, for a snapshot.
    pub(crate) fn shown(&self) -> String {
        format!("exit code {}\n--- standard output\n{}--- standard error\n{}", self.code, self.output, self.errors)
    }
}

/// Runs the program in the root of the repository.
pub(crate) fn inpact(arguments: &[&str]) -> Run {
    inpact_with_input(arguments, b"")
}

/// Runs the program with `input` as its standard input.
pub(crate) fn inpact_with_input(arguments: &[&str], input: &[u8]) -> Run {
    run(command(&root(), arguments), input)
}

/// The program, to be started in a folder, without colours.
pub(crate) fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_inpact-under-test"));
    command.args(arguments).current_dir(folder).env_remove("CLICOLOR_FORCE").env("NO_COLOR", "1");
    command
}

/// Runs a command with `input` as its standard input.
pub(crate) fn run(mut command: Command, input: &[u8]) -> Run {
    let mut child = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut stdin = child.stdin.take().expect("standard input is piped");
    let input = input.to_vec();
    // A program that does not read its input closes the pipe: that is no failure of the test.
    let feeder = std::thread::spawn(move || drop(stdin.write_all(&input)));
    let output = child.wait_with_output().expect("the program ends");
    feeder.join().expect("the input was fed");
    Run {
        code: output.status.code().unwrap_or(-1),
        output: String::from_utf8_lossy(&output.stdout).into_owned(),
        errors: String::from_utf8_lossy(&output.stderr).into_owned(),
    }
}

/// A folder of its own for a test, deleted when the test ends.
pub(crate) struct Folder(tempfile::TempDir);

impl Folder {
    /// A folder that holds these files.
    pub(crate) fn with(files: &[(&str, &str)]) -> Self {
        let folder = Self(tempfile::tempdir().expect("a folder for the test"));
        for (name, text) in files {
            folder.write(name, text);
        }
        folder
    }

    pub(crate) fn path(&self) -> &Path {
        self.0.path()
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        let path = self.path().join(name);
        std::fs::create_dir_all(path.parent().expect("below the folder")).expect("a folder");
        std::fs::write(path, text).expect("writable");
    }

    pub(crate) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path().join(name)).expect("readable")
    }

    /// The names in the folder itself, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.path()).expect("readable");
        let mut names: Vec<String> =
            entries.map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// Runs the program in the folder.
    pub(crate) fn inpact(&self, arguments: &[&str]) -> Run {
        self.inpact_with_input(arguments, b"")
    }

    /// Runs the program in the folder with `input` as its standard input.
    pub(crate) fn inpact_with_input(&self, arguments: &[&str], input: &[u8]) -> Run {
        run(command(self.path(), arguments), input)
    }
}

/// The root of the repository.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The sample decks, as paths relative to the root.
pub(crate) fn sample_decks() -> Vec<String> {
    fn collect(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in std::fs::read_dir(folder).expect("a folder of decks").map(|entry| entry.expect("readable").path())
        {
            if entry.is_dir() {
                collect(&entry, found);
            } else if entry.extension().is_some_and(|extension| extension == "inp") {
                found.push(entry);
            }
        }
    }
    let mut found = Vec::new();
    collect(&root().join("decks"), &mut found);
    let relative = |path: &PathBuf| {
        let path = path.strip_prefix(root()).expect("below the root");
        path.to_string_lossy().replace('\\', "/")
    };
    let mut decks: Vec<String> = found.iter().map(relative).collect();
    decks.sort();
    assert!(!decks.is_empty());
    decks
}

/// The options for the language that a sample is in, where its folder says so and the sample is read elsewhere.
pub(crate) fn dialect_of(deck: &str) -> &'static [&'static str] {
    if deck.starts_with("decks/scenes/ccx/") { &["--dialect", "calculix"] } else { &[] }
}
