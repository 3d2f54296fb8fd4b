//! Reports in a real browser: Debian's chromium, headless.
//!
//! Without it the tests say that they are skipped, unless `INPACT_REQUIRE_CHROMIUM` is set. axe-core is used where `INPACT_AXE` names its built file.
#![expect(clippy::print_stderr, reason = "whoever runs the tests must learn that there was no browser")]

mod devtools;
mod vscode;

use devtools::{Browser, chromium};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn inpact(folder: &Path, arguments: &[&str]) -> String {
    let run = run(folder, arguments);
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    String::from_utf8(run.stdout).expect("text")
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let arguments = arguments.iter().map(|argument| argument.replace("ROOT", root.to_str().expect("text")));
    let run = Command::new(env!("CARGO_BIN_EXE_inpact-under-test")).args(arguments).current_dir(folder).output();
    run.expect("the program runs")
}

/// A report in a folder of its own, also of a deck with errors, which ends with 1.
fn report(arguments: &[&str]) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = report_in(folder.path(), arguments);
    (folder, path)
}

fn report_in(folder: &Path, arguments: &[&str]) -> PathBuf {
    let run = run(folder, &[&["report"], arguments, &["-o", "report.html"]].concat());
    assert!(matches!(run.status.code(), Some(0 | 1)), "{}", String::from_utf8_lossy(&run.stderr));
    folder.join("report.html")
}

const BUSBAR: &[&str] =
    &["ROOT/decks/busbar-joint/busbar-joint.inp", "--nodes", "ROOT/decks/busbar-joint/busbar-joint-nodes.csv"];

/// Makes a chart as soon as its figure is on the screen, and scrolls there.
fn show(browser: &mut Browser, figure: &str) {
    browser.value(&format!("document.querySelector('{figure}').scrollIntoView({{block: 'center'}})"));
    browser.until(&format!("Boolean(document.querySelector('{figure}').inpact)"));
}

/// Where a value is drawn, in pixels of the window.
fn place(browser: &mut Browser, figure: &str, side: usize, x: f64, y: f64) -> (f64, f64) {
    let expression = format!(
        "(() => {{ const chart = document.querySelector('{figure}').inpact; const plot = chart.plots[{side}]; \
         const box = plot.over.getBoundingClientRect(); const axes = chart.axes[{side}]; \
         return [box.left + plot.valToPos(axes.x.part({x:?}), 'x'), box.top + plot.valToPos(axes.y.part({y:?}), 'y')]; }})()"
    );
    let found = browser.value(&expression);
    (found[0].as_f64().expect("a place"), found[1].as_f64().expect("a place"))
}

fn read(browser: &mut Browser, figure: &str) -> String {
    browser.value(&format!("document.querySelector('{figure} output').textContent")).as_str().expect("text").to_owned()
}

#[test]
fn a_report_asks_nothing_of_a_network_and_reads_values_where_one_points() {
    let Some(program) = chromium() else { return };
    let mut browser = Browser::start(program);
    let (folder, path) = report(BUSBAR);
    browser.open(&path);
    let figure = "figure.law[data-live]";
    show(&mut browser, figure);

    // A row of the table, to its last digit.
    let data = browser.value(&format!("document.querySelector('{figure}').inpact.data"));
    let curve = &data["curves"][1]["sides"][1];
    let (knot, row) = (curve["knots"][2].as_f64().expect("a row"), curve["rows"][2].as_u64().expect("a row"));
    let index = data["halves"][1]["x"].as_array().expect("numbers").iter().position(|x| x.as_f64() == Some(knot));
    let value = curve["y"][index.expect("the row is a sample")].as_f64().expect("a value");
    let (x, y) = place(&mut browser, figure, 1, knot, value);
    browser.point_at(x, y);
    browser.until(&format!("document.querySelector('{figure} output').textContent.includes('row')"));
    let said = read(&mut browser, figure);
    let number = |value: f64| browser_number(value);
    assert!(said.contains(&format!("pressure {}:", number(knot))), "{said}");
    assert!(said.contains(&format!("= {} (row {})", number(value), row + 1)), "{said}");

    // By keyboard: the next value, and a slider, whose curve is what `eval` gives.
    browser.value(&format!("document.querySelector('{figure} .plots').focus()"));
    browser.press("ArrowRight");
    assert_ne!(read(&mut browser, figure), said);
    browser.press("ArrowLeft");
    assert_eq!(read(&mut browser, figure), said);
    browser.value(&format!("document.querySelector('{figure} input[type=range]').focus()"));
    browser.press("ArrowRight");
    browser.until(&format!("document.querySelector('{figure} output').textContent.includes('sliders')"));
    let said = read(&mut browser, figure);
    let probe = &data["probe"]["axes"][0];
    assert_eq!(probe["column"], "fv1");
    let stop = probe["stops"][1].as_f64().expect("a stop");
    let table = format!("clearance,pressure,closed,fv1\n0,{knot:?},1,{stop:?}\n");
    std::fs::write(folder.path().join("one.csv"), table).expect("writable");
    let deck = BUSBAR[0];
    let evaluated = inpact(folder.path(), &["eval", deck, "--nodes", "one.csv", "--outputs", "conductance"]);
    let evaluated: f64 = evaluated.lines().nth(1).expect("a row").parse().expect("a number");
    assert!(said.contains(&format!("sliders, fv1 {} = {}", number(stop), number(evaluated))), "{said}: {evaluated}");

    // The legend switches a curve off, by keyboard too.
    let shown = format!("document.querySelector('{figure}').inpact.plots[1].series[1].show");
    assert_eq!(browser.value(&shown), true);
    browser.value(&format!("document.querySelector('{figure} .legend button').click()"));
    assert_eq!(browser.value(&shown), false);

    // Logarithmic axes and zoom.
    browser.value(&format!("document.querySelectorAll('{figure} .tools button').forEach((button) => button.click())"));
    assert_eq!(browser.faults(), Vec::<&Value>::new());
    assert_eq!(browser.requests(), Vec::<String>::new());
}

/// A number as the page writes it.
fn browser_number(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude == 0.0 || (1e-3..1e5).contains(&magnitude) { format!("{value}") } else { format!("{value:e}") }
}

#[test]
fn paper_has_every_panel() {
    let Some(program) = chromium() else { return };
    let mut browser = Browser::start(program);
    let (_folder, path) = report(&[
        "ROOT/decks/spot-weld/spot-weld.inp",
        "--nodes",
        "ROOT/decks/spot-weld/spot-weld-nodes.csv",
        "--tradeoff",
    ]);
    browser.open(&path);
    show(&mut browser, "figure.law[data-live]");
    browser.call("Emulation.setEmulatedMedia", &json!({"media": "print"}));
    let heights = browser.value(
        "[...document.querySelectorAll('figure.law:has(.chart)')].map((figure) => [figure.querySelector('svg').getBoundingClientRect().height, \
         figure.querySelector('.chart').getBoundingClientRect().height])",
    );
    let heights = heights.as_array().expect("figures");
    assert_eq!(heights.len(), 4);
    for height in heights {
        assert!(100.0 < height[0].as_f64().expect("a height"), "a drawing that is not printed");
        assert_eq!(height[1], 0, "a canvas that is printed");
    }
    // A sheet of A4 without its margins: what is wider would be cut off.
    let sheet = json!({"width": 718, "height": 1000, "deviceScaleFactor": 1, "mobile": false});
    browser.call("Emulation.setDeviceMetricsOverride", &sheet);
    let cut = browser.value(
        "[...document.querySelectorAll('body *')].filter((part) => !part.closest('svg') && part.clientWidth + 1 < part.scrollWidth)\
         .map((part) => part.tagName + ' ' + part.className + ' ' + part.textContent.slice(0, 40))",
    );
    assert_eq!(cut, json!([]), "cut off at the edge of the sheet");
    let printed = browser.call("Page.printToPDF", &json!({}));
    let pdf = printed["data"].as_str().expect("a file");
    assert!(pdf.starts_with("JVBERi0") && 20_000 < pdf.len(), "no PDF");
    if let Some(text) = text_of_pdf(pdf) {
        let titles = browser.value(
            "[...document.querySelectorAll('figure.law .static svg text')].map((text) => text.textContent.trim())",
        );
        let titles = titles.as_array().expect("texts");
        assert!(40 < titles.len(), "{}", titles.len());
        for title in titles {
            // Words: a line may be broken, and rotated text has lines of its own.
            for word in title.as_str().expect("text").split_whitespace() {
                assert!(text.contains(word), "`{word}` of `{title}` is not on paper");
            }
        }
    }
    let open = "document.querySelectorAll('details:not([open])').length";
    assert_ne!(browser.value(open), 0, "what was opened to be printed stays open");
    assert_eq!(browser.faults(), Vec::<&Value>::new());
}

/// The text that a reader of the file sees, in base64 before; `None` where there is no `pdftotext`.
fn text_of_pdf(base64: &str) -> Option<String> {
    let folder = tempfile::tempdir().expect("a folder");
    let decode = |from: &Path, to: &Path| {
        let encoded = std::fs::File::open(from).expect("a file");
        let decoded = std::fs::File::create(to).expect("a file");
        Command::new("base64").arg("-d").stdin(encoded).stdout(decoded).status().expect("base64 runs")
    };
    let (encoded, pdf) = (folder.path().join("page.txt"), folder.path().join("page.pdf"));
    std::fs::write(&encoded, base64).expect("writable");
    assert!(decode(&encoded, &pdf).success());
    match Command::new("pdftotext").args(["-layout"]).arg(&pdf).arg("-").output() {
        Ok(read) => {
            assert!(read.status.success(), "{}", String::from_utf8_lossy(&read.stderr));
            Some(String::from_utf8_lossy(&read.stdout).into_owned())
        }
        Err(_) if std::env::var_os("INPACT_REQUIRE_PDFTOTEXT").is_none() => {
            eprintln!("skipped: there is no pdftotext");
            None
        }
        Err(error) => panic!("pdftotext: {error}"),
    }
}

/// Names that would run are text, also where a script reads them from its data.
#[test]
fn nothing_of_a_deck_runs() {
    let Some(program) = chromium() else { return };
    let mut browser = Browser::start(program);
    let folder = tempfile::tempdir().expect("a folder");
    let hostile = "</script><script>window.ran=1</script><img src=x onerror=window.ran=1><svg onload=window.ran=1>";
    let deck = format!(
        "*SURFACE INTERACTION, NAME=\"{hostile}\"\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=1\n\
         1., 0., 20., 1.\n2., 5., 20., 1.\n3., 0., 90., 1.\n4., 5., 90., 1.\n2., 0., 20., 2.\n3., 5., 20., 2.\n\
         *CONTACT PAIR, INTERACTION=\"{hostile}\"\n\"{hostile}\", B\n"
    );
    std::fs::write(folder.path().join("a.inp"), deck).expect("writable");
    let units = "temp=</script><img src=x onerror=window.ran=1>";
    let page = report_in(folder.path(), &["a.inp", "--units", units]);
    browser.open(&page);
    show(&mut browser, "figure.law[data-live]");
    assert_eq!(browser.value("typeof window.ran"), "undefined");
    assert_eq!(browser.value("document.querySelectorAll('img').length"), 0);
    assert_eq!(browser.value("document.querySelector('h3').textContent.includes('<img src=x')"), true);
    // Were a script in it after all, the page's policy would refuse it.
    browser.value("(() => { const script = document.createElement('script'); script.textContent = 'window.ran = 1'; document.body.append(script); })()");
    assert_eq!(browser.value("typeof window.ran"), "undefined");
}

/// Numbers that charting libraries have no increments for: on linear and on logarithmic axes, to the last digit.
#[test]
fn the_largest_and_the_smallest_numbers_are_drawn() {
    let Some(program) = chromium() else { return };
    let mut browser = Browser::start(program);
    let folder = tempfile::tempdir().expect("a folder");
    let table = |name: &str, kind: &str, rows: &str| {
        format!("*SURFACE INTERACTION, NAME={name}\n*GAP ELECTRICAL CONDUCTANCE{kind}\n{rows}\n")
    };
    let deck = table("WIDE", ", PRESSURE", "1.e-300, 0.\n1., 1.e-300\n1.e300, 1.e300")
        + &table("ONE", ", PRESSURE", "1.e6, 0.")
        + &table("ALL", ", PRESSURE", "-1.7e308, -1.7e308\n1.7e308, 1.7e308")
        + &table("SMALL", "", "5.e-324, 0.\n0., 5.e-324");
    std::fs::write(folder.path().join("a.inp"), deck).expect("writable");
    let page = report_in(folder.path(), &["a.inp"]);
    browser.open(&page);
    for number in 1..=4 {
        let figure = format!("#law-{number}-1-1");
        show(&mut browser, &figure);
        for _ in 0..2 {
            let labels = format!(
                "document.querySelector('{figure}').inpact.plots.every((plot) => plot.data.flat().every((part) => part === null || part === undefined || Number.isFinite(part)))"
            );
            assert_eq!(browser.value(&labels), true, "{figure}");
            browser.value(&format!(
                "document.querySelectorAll('{figure} .tools button').forEach((button) => button.click())"
            ));
        }
        browser.value(&format!("document.querySelector('{figure} .plots').focus()"));
        browser.press("ArrowRight");
        assert!(read(&mut browser, &figure).contains("conductance = "), "{figure}");
    }
    let ticks = browser.value("document.querySelector('#law-1-1-1').inpact.axes[1].y.ticks(0, 1, 6)");
    assert!(3 < ticks.as_array().map_or(0, Vec::len), "{ticks}");
    assert_eq!(browser.faults(), Vec::<&Value>::new());
}

#[test]
fn a_hundred_interactions_open_at_once() {
    let Some(program) = chromium() else { return };
    let mut browser = Browser::start(program);
    let folder = tempfile::tempdir().expect("a folder");
    let mut deck = String::new();
    for index in 0..100 {
        let _ = write!(
            deck,
            "*SURFACE INTERACTION, NAME=I{index}\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n1., 0., 20.\n2., 5., 20.\n3., 0., 90.\n4., 5., 90.\n"
        );
    }
    std::fs::write(folder.path().join("a.inp"), deck).expect("writable");
    let page = report_in(folder.path(), &["a.inp"]);
    browser.open(&page);
    browser.until("Boolean(document.querySelector('figure.law[data-live]').inpact)");
    // Charts are made when they come near the screen: that is why the page opens as fast as one with a few.
    let made = browser
        .value("[...document.querySelectorAll('figure.law[data-live]')].filter((figure) => figure.inpact).length");
    assert!(made.as_u64().is_some_and(|made| (1..20).contains(&made)), "{made} charts");
    show(&mut browser, "#law-100-1-1");
    assert_eq!(browser.faults(), Vec::<&Value>::new());
}

/// axe-core finds no serious fault, in light and in dark.
#[test]
fn axe_finds_no_serious_fault() {
    let Some(program) = chromium() else { return };
    let Some(axe) = std::env::var_os("INPACT_AXE") else {
        assert!(std::env::var_os("INPACT_REQUIRE_CHROMIUM").is_none(), "axe-core is required with chromium");
        eprintln!("skipped: no axe-core");
        return;
    };
    let axe = std::fs::read_to_string(axe).expect("the built file of axe-core");
    let mut browser = Browser::start(program);
    for arguments in [BUSBAR, &["ROOT/decks/faulty/first-mistakes.inp"]] {
        let (_folder, path) = report(arguments);
        for scheme in ["light", "dark"] {
            let feature = json!({"features": [{"name": "prefers-color-scheme", "value": scheme}]});
            browser.call("Emulation.setEmulatedMedia", &feature);
            browser.open(&path);
            browser.until("document.documentElement.classList.contains('js')");
            browser.value(&format!("{axe}; null"));
            let found = browser.value(
                "axe.run().then((found) => found.violations.filter((of) => ['serious', 'critical'].includes(of.impact)) \
                 .map((of) => of.id + ': ' + of.nodes.map((node) => node.html.slice(0, 120) + ' ' + node.failureSummary).join(' | ')))",
            );
            assert_eq!(found, json!([]), "{arguments:?} in {scheme}: {found:#}");
        }
    }
}
