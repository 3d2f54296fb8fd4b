//! The latency of `inpact server`: from a keystroke to its findings, of hover and of completion.
//!
//! Speaks to the program over pipes as an editor does, so that transport and JSON are part of the times.

use std::fmt::Write as _;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::deck::{self, Content, DeckRequest};

/// The name of the document.
const URI: &str = "untitled:deck";

/// Times of one deck.
#[derive(Debug)]
struct Measured {
    bytes: usize,
    lines: usize,
    opened: Duration,
    /// The request measured, and its times in ascending order.
    times: Vec<(&'static str, Vec<Duration>)>,
    /// Resident memory in bytes: now, and at most; where the system says so.
    memory: Option<(u64, u64)>,
}

/// Measures the program on decks of 1 kB, 1 MB and 100 MB, with this many rounds each, and returns a page of Markdown.
///
/// # Errors
/// A program that cannot be started, or that ends too early.
pub fn page(program: &Path, rounds: usize) -> io::Result<String> {
    let mut page = "# Speed in editors\n\n\
        Times of `inpact server` from a message to its answer, transport included: after a keystroke the findings of the deck, hover on a cell of a table, completion of keywords.\n\
        Made by `inpact-bench editing PROGRAM`; the decks are those of `inpact-bench generate`, mostly mesh.\n\n\
        | deck | lines | opening | what | p50 in ms | p99 in ms | memory by the size of the deck: now, at most |\n|---|---|---|---|---|---|---|\n"
        .to_owned();
    for bytes in [1_000, 1_000_000, 100_000_000] {
        let measured = measure(program, &text(bytes)?, if bytes < 100_000_000 { rounds } else { rounds.div_ceil(4) })?;
        let memory = measured.memory.map_or_else(String::new, |(now, most)| {
            let by_size = |memory: u64| memory as f64 / measured.bytes as f64;
            if measured.bytes < 1_000_000 {
                format!("{:.0} MB, {:.0} MB in all", now as f64 / 1e6, most as f64 / 1e6)
            } else {
                format!("{:.2}, {:.2}", by_size(now), by_size(most))
            }
        });
        for (what, times) in &measured.times {
            let percentile = |percent: usize| milliseconds(times[(times.len() * percent / 100).min(times.len() - 1)]);
            let size = if measured.bytes < 100_000 {
                format!("{} kB", measured.bytes.div_ceil(1000))
            } else {
                format!("{} MB", measured.bytes / 1_000_000)
            };
            let _ = writeln!(
                page,
                "| {size} | {} | {:.1} ms | {what} | {:.2} | {:.2} | {memory} |",
                measured.lines,
                milliseconds(measured.opened),
                percentile(50),
                percentile(99),
            );
        }
    }
    Ok(page)
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

/// A deck of about that size.
fn text(bytes: u64) -> io::Result<String> {
    let (content, interactions, rows) = match bytes {
        ..10_000 => (Content::Tables, 1, 4),
        _ => (Content::Mesh { bytes }, 10, 20),
    };
    let mut text = Vec::new();
    deck::write(&DeckRequest { content, interactions, rows, seed: 1 }, &mut text)?;
    String::from_utf8(text).map_err(io::Error::other)
}

fn measure(program: &Path, text: &str, rounds: usize) -> io::Result<Measured> {
    let mut editor = Editor::start(program)?;
    let document = json!({"uri": URI, "languageId": "abaqus-inp", "version": 1, "text": text});
    let start = Instant::now();
    editor.notify("textDocument/didOpen", &json!({"textDocument": document}))?;
    editor.wait_for_findings(1)?;
    let opened = start.elapsed();
    let lines: Vec<&str> = text.lines().collect();
    let table = lines.iter().position(|line| line.starts_with("*GAP ELECTRICAL CONDUCTANCE")).unwrap_or(0);
    // The row after the middle of the deck: mesh, in a deck that has one.
    let middle = (lines.len() / 2..lines.len()).find(|line| !lines[*line].starts_with('*')).unwrap_or(0);
    let mut version = 1;
    let mut times = vec![
        ("keystroke in a table", Vec::new()),
        ("keystroke in the middle", Vec::new()),
        ("hover", Vec::new()),
        ("completion", Vec::new()),
    ];
    for _ in 0..rounds {
        for (index, line) in [(0, table + 1), (1, middle)] {
            // Adds and removes a blank at the end of the line.
            let end = lines[line].len();
            for (from, to, new) in [(end, end, " "), (end, end + 1, "")] {
                version += 1;
                let range = json!({"start": {"line": line, "character": from}, "end": {"line": line, "character": to}});
                let document = json!({"uri": URI, "version": version});
                let params = json!({"textDocument": document, "contentChanges": [{"range": range, "text": new}]});
                let start = Instant::now();
                editor.notify("textDocument/didChange", &params)?;
                editor.wait_for_findings(version)?;
                times[index].1.push(start.elapsed());
            }
        }
        for (index, method, line, character) in
            [(2, "textDocument/hover", table + 1, 1), (3, "textDocument/completion", table, 1)]
        {
            let position = json!({"line": line, "character": character});
            let start = Instant::now();
            editor.request(method, &json!({"textDocument": {"uri": URI}, "position": position}))?;
            times[index].1.push(start.elapsed());
        }
    }
    for (_, times) in &mut times {
        times.sort_unstable();
    }
    let memory = editor.memory();
    Ok(Measured { bytes: text.len(), lines: lines.len(), opened, times, memory })
}

/// A minimal editor for measurements.
struct Editor {
    server: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
    next_id: i32,
}

impl Editor {
    fn start(program: &Path) -> io::Result<Self> {
        let mut command = Command::new(program);
        let mut server = command.arg("server").stdin(Stdio::piped()).stdout(Stdio::piped()).spawn()?;
        let (Some(input), Some(output)) = (server.stdin.take(), server.stdout.take()) else {
            return Err(io::Error::other("the program has no pipes"));
        };
        let mut editor = Self { server, input, output: BufReader::new(output), next_id: 1 };
        editor.request("initialize", &json!({"capabilities": {}}))?;
        editor.notify("initialized", &json!({}))?;
        Ok(editor)
    }

    fn send(&mut self, message: &Value) -> io::Result<()> {
        let text = message.to_string();
        write!(self.input, "Content-Length: {}\r\n\r\n{text}", text.len())?;
        self.input.flush()
    }

    fn notify(&mut self, method: &str, params: &Value) -> io::Result<()> {
        self.send(&json!({"jsonrpc": "2.0", "method": method, "params": params}))
    }

    fn request(&mut self, method: &str, params: &Value) -> io::Result<Value> {
        let id = self.next_id;
        self.next_id += 1;
        self.send(&json!({"jsonrpc": "2.0", "id": id, "method": method, "params": params}))?;
        loop {
            let message = self.read()?;
            if message["id"] == id {
                return Ok(message["result"].clone());
            }
        }
    }

    fn wait_for_findings(&mut self, version: i32) -> io::Result<()> {
        loop {
            if self.read()?["params"]["version"] == version {
                return Ok(());
            }
        }
    }

    fn read(&mut self) -> io::Result<Value> {
        let mut length = 0;
        loop {
            let mut line = String::new();
            if self.output.read_line(&mut line)? == 0 {
                return Err(io::ErrorKind::UnexpectedEof.into());
            }
            if line.trim().is_empty() {
                break;
            }
            if let Some(value) = line.trim().strip_prefix("Content-Length: ") {
                length = value.parse().map_err(io::Error::other)?;
            }
        }
        let mut body = vec![0; length];
        self.output.read_exact(&mut body)?;
        serde_json::from_slice(&body).map_err(io::Error::other)
    }

    /// Resident memory of the server: now, and at most.
    fn memory(&self) -> Option<(u64, u64)> {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.server.id())).ok()?;
        let kilobytes = |key: &str| {
            let line = status.lines().find_map(|line| line.strip_prefix(key))?;
            line.trim().trim_end_matches("kB").trim().parse::<u64>().ok()
        };
        Some((kilobytes("VmRSS:")? * 1024, kilobytes("VmHWM:")? * 1024))
    }
}

impl Drop for Editor {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}
