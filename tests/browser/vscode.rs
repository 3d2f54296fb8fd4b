//! The packed extension in a real VS Code: code-server serves its workbench and runs its extension host, and a browser uses them.
//!
//! `editors/vscode/drive` installs code-server below `target/`, packs the extension and runs this test; where `INPACT_CODE_SERVER` and
//! `INPACT_VSIX` do not name them, the test says that it is skipped.

use super::devtools::{Browser, Modifier, chromium};
use serde_json::Value;
use std::net::{TcpListener, TcpStream};
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const DECK: &str = "\
*SURFACE INTERACTION, NAME=JOINT
*GAP COND
20., 0.
10.5, .1
*GAP ELECTRICAL CONDUCTANCE
4., 0.
2., 0.
";

/// How long the server may take until it listens.
const PATIENCE: Duration = Duration::from_secs(120);

/// A server with what it has started, in a process group of their own.
struct Server {
    process: Child,
    port: u16,
}

impl Server {
    fn start(command: &mut Command, port: u16) -> Self {
        let process = command.process_group(0).spawn().expect("the server starts");
        let server = Self { process, port };
        let end = Instant::now() + PATIENCE;
        while TcpStream::connect(("127.0.0.1", server.port)).is_err() {
            assert!(Instant::now() < end, "the server does not listen");
            std::thread::sleep(Duration::from_millis(100));
        }
        server
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // The group, as its extension hosts are processes of their own; they end in a moment where they are asked to.
        let group = format!("-{}", self.process.id());
        let _ = Command::new("kill").args(["-TERM", "--", &group]).status();
        let _ = self.process.wait();
    }
}

/// The server's settings and extensions in one folder.
fn code_server(program: &str, folder: &Path) -> Command {
    let mut command = Command::new(program);
    command.arg("--user-data-dir").arg(folder.join("user")).arg("--extensions-dir").arg(folder.join("extensions"));
    // It writes its settings once for all users otherwise.
    command.env("XDG_CONFIG_HOME", folder.join("config")).env("XDG_DATA_HOME", folder.join("data"));
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// Where a text of the editor is on the screen; it may be drawn later.
fn place_of(browser: &mut Browser, selector: &str, text: &str) -> (f64, f64) {
    let expression = format!(
        "(() => {{ for (const line of document.querySelectorAll('{selector}')) {{ \
           const walker = document.createTreeWalker(line, NodeFilter.SHOW_TEXT); \
           while (walker.nextNode()) {{ const node = walker.currentNode; const at = node.data.indexOf('{text}'); \
             if (0 <= at) {{ const range = document.createRange(); range.setStart(node, at); range.setEnd(node, at + {}); \
               const box = range.getBoundingClientRect(); \
               return [box.left + box.width / 2, box.top + box.height / 2]; }} }} }} return null; }})()",
        text.len()
    );
    browser.until(&format!("{expression} !== null"));
    let found = browser.value(&expression);
    (found[0].as_f64().expect("a place"), found[1].as_f64().expect("a place"))
}

#[expect(clippy::print_stderr, reason = "whoever runs the tests must learn that there was no VS Code")]
#[test]
fn the_extension_shows_findings_hover_and_curves() {
    let named = ["INPACT_CODE_SERVER", "INPACT_VSIX"].map(|name| std::env::var(name).ok());
    let [Some(program), Some(extension)] = named else {
        eprintln!("skipped: INPACT_CODE_SERVER and INPACT_VSIX name no VS Code; see editors/vscode/drive");
        return;
    };
    let browser = chromium().expect("a browser");
    let folder = tempfile::tempdir().expect("a folder");
    let decks = folder.path().join("decks");
    let user = folder.path().join("user/User");
    for made in [&decks, &user] {
        std::fs::create_dir_all(made).expect("a folder");
    }
    std::fs::write(decks.join("joint.inp"), DECK).expect("written");
    let settings = serde_json::json!({
        "inpact.path": env!("CARGO_BIN_EXE_inpact-under-test"),
        "security.workspace.trust.enabled": false,
        "workbench.startupEditor": "none",
    });
    std::fs::write(user.join("settings.json"), settings.to_string()).expect("written");
    let installed = code_server(&program, folder.path()).args(["--install-extension", &extension]).status();
    assert!(installed.expect("code-server runs").success(), "the extension cannot be installed");

    // A port that was free a moment ago.
    let port = TcpListener::bind("127.0.0.1:0").and_then(|listener| listener.local_addr()).expect("a port").port();
    let arguments = ["--auth", "none", "--disable-telemetry", "--disable-update-check", "--disable-workspace-trust"];
    let address = format!("127.0.0.1:{port}");
    let mut command = code_server(&program, folder.path());
    let _server = Server::start(command.args(arguments).args(["--bind-addr", &address]), port);

    let mut browser = Browser::start(browser);
    let decks = decks.display();
    let file = format!("%5B%5B%22openFile%22%2C%22vscode-remote%3A%2F%2F{address}{decks}%2Fjoint.inp%22%5D%5D");
    browser.go(&format!("http://{address}/?folder={decks}&payload={file}"));

    // Findings: a wavy line in the text, and the list of problems.
    browser.until(
        "document.querySelector('.squiggly-error') !== null && document.querySelector('.squiggly-info') !== null",
    );
    browser.chord("M", 77, &[Modifier::Control, Modifier::Shift]);
    let problems = "[...document.querySelectorAll('.markers-panel .monaco-list-row')].map((row) => row.getAttribute('aria-label') ?? '')";
    for said in ["is short for `*GAP CONDUCTANCE`", "occurs twice"] {
        browser.until(&format!("{problems}.some((label) => label.includes('{said}'))"));
    }

    // Hover on a cell: what column it is.
    let (x, y) = place_of(&mut browser, ".view-line", "10.5");
    browser.point_at(x, y);
    browser.until("[...document.querySelectorAll('.monaco-hover')].some((hover) => hover.innerText.includes('gap thermal conductance'))");
    let hover =
        browser.value("[...document.querySelectorAll('.monaco-hover')].map((hover) => hover.innerText).join(' ')");
    let hover = hover.as_str().expect("text");
    assert!(hover.contains("Row 2 of 2"), "{hover}");

    // The lens above the table opens the curves of that table.
    let (x, y) = place_of(&mut browser, ".codelens-decoration a", "2 clearances");
    browser.click(x, y);
    browser.until("[...document.querySelectorAll('.tab')].some((tab) => tab.textContent.includes('JOINT: thermal'))");
    browser.until("document.querySelector('iframe.webview') !== null");
    let complaints =
        browser.value("[...document.querySelectorAll('.notification-toast')].map((toast) => toast.innerText)");
    assert_eq!(complaints, Value::Array(Vec::new()));
}
