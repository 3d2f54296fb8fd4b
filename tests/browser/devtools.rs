//! A browser driven by the DevTools protocol over two named pipes: one message of JSON after another, each ended by a zero byte.

use serde_json::{Value, json};
use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// How long an answer may take on a machine that builds at the same time.
const PATIENCE: Duration = Duration::from_secs(120);

/// A key that is held while another is pressed, as the protocol counts them.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Modifier {
    Control = 2,
    Shift = 8,
}

/// A browser with one page.
pub(crate) struct Browser {
    process: Child,
    to: File,
    from: Receiver<Value>,
    session: Value,
    sent: u64,
    /// What the browser told without being asked.
    pub(crate) events: Vec<Value>,
    _folder: tempfile::TempDir,
}

/// The program to drive; `None` where there is none, which fails where it is required.
pub(crate) fn chromium() -> Option<&'static str> {
    let found = ["chromium", "chromium-browser", "google-chrome"]
        .into_iter()
        .find(|name| Command::new(name).arg("--version").output().is_ok_and(|output| output.status.success()));
    if found.is_none() {
        assert!(std::env::var_os("INPACT_REQUIRE_CHROMIUM").is_none(), "no chromium, and it is required");
        eprintln!("skipped: no chromium");
    }
    found
}

impl Browser {
    pub(crate) fn start(program: &str) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let pipes = ["to", "from"].map(|name| folder.path().join(name));
        let made = Command::new("mkfifo").args(&pipes).status().expect("mkfifo runs");
        assert!(made.success());
        let script = "exec \"$0\" --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --no-first-run \
                      --disable-background-networking --remote-debugging-pipe --user-data-dir=\"$3\" \
                      --window-size=1200,900 about:blank 3<\"$1\" 4>\"$2\"";
        let process = Command::new("sh")
            .args(["-c", script, program])
            .args(&pipes)
            .arg(folder.path().join("profile"))
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the browser starts");
        // The shell opens them in this order, and each waits for the other end.
        let to = File::options().write(true).open(&pipes[0]).expect("a pipe");
        let reader = BufReader::new(File::open(&pipes[1]).expect("a pipe"));
        let (send, from) = channel();
        std::thread::spawn(move || {
            for message in reader.split(0) {
                let Ok(message) = message else { return };
                let Ok(message) = serde_json::from_slice(&message) else { return };
                if send.send(message).is_err() {
                    return;
                }
            }
        });
        let mut browser =
            Self { process, to, from, session: Value::Null, sent: 0, events: Vec::new(), _folder: folder };
        let target = browser.call("Target.createTarget", &json!({"url": "about:blank"}))["targetId"].clone();
        let attached = browser.call("Target.attachToTarget", &json!({"targetId": target, "flatten": true}));
        browser.session = attached["sessionId"].clone();
        for domain in ["Page", "Runtime", "Log", "Network"] {
            browser.call(&format!("{domain}.enable"), &json!({}));
        }
        browser
    }

    /// Asks for something and waits for the answer.
    pub(crate) fn call(&mut self, method: &str, parameters: &Value) -> Value {
        self.sent += 1;
        let mut message = json!({"id": self.sent, "method": method, "params": parameters});
        if !self.session.is_null() {
            message["sessionId"] = self.session.clone();
        }
        self.to.write_all(message.to_string().as_bytes()).and_then(|()| self.to.write_all(&[0])).expect("it listens");
        let id = self.sent;
        let answer = self.wait(|message| message["id"] == id);
        assert!(answer["error"].is_null(), "{method}: {}", answer["error"]);
        answer["result"].clone()
    }

    fn wait(&mut self, is_wanted: impl Fn(&Value) -> bool) -> Value {
        let end = Instant::now() + PATIENCE;
        loop {
            let left = end.saturating_duration_since(Instant::now());
            let message = self.from.recv_timeout(left).expect("the browser answers");
            let found = is_wanted(&message);
            if message["id"].is_null() {
                self.events.push(message.clone());
            }
            if found {
                return message;
            }
        }
    }

    /// Opens a file and waits until it is loaded.
    pub(crate) fn open(&mut self, path: &Path) {
        self.go(&format!("file://{}", path.display()));
    }

    /// Goes to an address and waits until it is loaded.
    pub(crate) fn go(&mut self, url: &str) {
        self.events.clear();
        self.call("Page.navigate", &json!({"url": url}));
        if !self.events.iter().any(|event| event["method"] == "Page.loadEventFired") {
            self.wait(|event| event["method"] == "Page.loadEventFired");
        }
    }

    /// The value of an expression in the page; a promise is waited for.
    pub(crate) fn value(&mut self, expression: &str) -> Value {
        let parameters = json!({"expression": expression, "returnByValue": true, "awaitPromise": true});
        let answer = self.call("Runtime.evaluate", &parameters);
        assert!(answer["exceptionDetails"].is_null(), "{expression}: {}", answer["exceptionDetails"]);
        answer["result"]["value"].clone()
    }

    /// Asks until the page says yes.
    pub(crate) fn until(&mut self, condition: &str) {
        let end = Instant::now() + PATIENCE;
        while self.value(condition) != true {
            assert!(Instant::now() < end, "never: {condition}");
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    pub(crate) fn point_at(&mut self, x: f64, y: f64) {
        // uPlot hears of a pointer only when it moves.
        for step in [3.0, 0.0] {
            self.call("Input.dispatchMouseEvent", &json!({"type": "mouseMoved", "x": x + step, "y": y}));
        }
    }

    pub(crate) fn click(&mut self, x: f64, y: f64) {
        self.point_at(x, y);
        for kind in ["mousePressed", "mouseReleased"] {
            let parameters = json!({"type": kind, "x": x, "y": y, "button": "left", "clickCount": 1});
            self.call("Input.dispatchMouseEvent", &parameters);
        }
    }

    /// Presses a letter while other keys are held.
    pub(crate) fn chord(&mut self, letter: &str, code: u32, held: &[Modifier]) {
        let held: u32 = held.iter().map(|modifier| *modifier as u32).sum();
        for kind in ["rawKeyDown", "keyUp"] {
            let key = format!("Key{letter}");
            let parameters =
                json!({"type": kind, "key": letter, "code": key, "windowsVirtualKeyCode": code, "modifiers": held});
            self.call("Input.dispatchKeyEvent", &parameters);
        }
    }

    pub(crate) fn press(&mut self, key: &str) {
        for kind in ["keyDown", "keyUp"] {
            let code = match key {
                "ArrowRight" => 39,
                "ArrowLeft" => 37,
                "Tab" => 9,
                _ => 0,
            };
            let parameters = json!({"type": kind, "key": key, "code": key, "windowsVirtualKeyCode": code});
            self.call("Input.dispatchKeyEvent", &parameters);
        }
    }

    /// What went wrong in the page: exceptions, errors on its console, what its policy refused.
    pub(crate) fn faults(&self) -> Vec<&Value> {
        let is_fault = |event: &&Value| match event["method"].as_str() {
            Some("Runtime.exceptionThrown") => true,
            Some("Runtime.consoleAPICalled") => event["params"]["type"] == "error",
            Some("Log.entryAdded") => event["params"]["entry"]["level"] == "error",
            _ => false,
        };
        self.events.iter().filter(is_fault).collect()
    }

    /// What the page asked for besides itself.
    pub(crate) fn requests(&self) -> Vec<String> {
        let sent = self.events.iter().filter(|event| event["method"] == "Network.requestWillBeSent");
        let urls = sent.map(|event| event["params"]["request"]["url"].as_str().unwrap_or_default().to_owned());
        urls.skip(1).collect()
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // Its own processes end with it; one that is gone already is no harm.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
