//! Safe HTML: elements are opened and closed here, and all text from a deck goes through one escape function.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use inpact_diagnostics::visible::visible;
use sha2::{Digest, Sha256};
use std::fmt::Write;

/// The scripts and styles of a report.
const UPLOT: &str = include_str!("uplot/uPlot.iife.min.js");
const UPLOT_STYLE: &str = include_str!("uplot/uPlot.min.css");
const UPLOT_LICENSE: &str = include_str!("uplot/LICENSE");
const SCRIPT: &str = include_str!("page.js");
const STYLE: &str = include_str!("page.css");

/// A page under construction.
pub(super) struct Page {
    text: String,
}

impl Page {
    /// An empty page of that title.
    pub(super) fn new(title: &str) -> Self {
        let scripts = [UPLOT, SCRIPT].map(|script| format!("'sha256-{}'", STANDARD.encode(Sha256::digest(script))));
        let policy = format!("default-src 'none'; style-src 'unsafe-inline'; script-src {}", scripts.join(" "));
        let text = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>{}</title>\n<style>{UPLOT_STYLE}\n{STYLE}</style>\n</head>\n<body>\n",
            escaped(title)
        );
        Self { text }
    }

    /// Opens an element; names are ours, values are escaped.
    pub(super) fn open(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.text += "<";
        self.text += name;
        for (attribute, value) in attributes {
            // Writing into a string cannot fail.
            let _ = write!(self.text, " {attribute}=\"{}\"", escaped(value));
        }
        self.text += ">";
    }

    pub(super) fn close(&mut self, name: &str) {
        let _ = writeln!(self.text, "</{name}>");
    }

    pub(super) fn text(&mut self, text: &str) {
        self.text += &escaped(text);
    }

    pub(super) fn element(&mut self, name: &str, attributes: &[(&str, &str)], text: &str) {
        self.open(name, attributes);
        self.text(text);
        self.close(name);
    }

    pub(super) fn drawing(&mut self, svg: &str) {
        self.text += svg;
    }

    /// A table that scrolls by itself, where it is too wide or long.
    pub(super) fn table(&mut self, titles: &[&str], rows: impl FnOnce(&mut Self)) {
        self.open("div", &[("class", "scroll"), ("tabindex", "0")]);
        self.open("table", &[]);
        self.open("thead", &[]);
        self.open("tr", &[]);
        for title in titles {
            self.element("th", &[("scope", "col")], title);
        }
        self.close("tr");
        self.close("thead");
        self.open("tbody", &[]);
        rows(self);
        self.close("tbody");
        self.close("table");
        self.close("div");
    }

    /// Data for the page's script: JSON that cannot end its element.
    pub(super) fn data(&mut self, json: &str) {
        self.text += "<script type=\"application/json\">";
        self.text += &harmless(json);
        self.text += "</script>\n";
    }

    /// The page as a whole.
    pub(super) fn finish(mut self) -> String {
        self.text += "</main>\n<footer>";
        self.element("p", &[("class", "quiet")], "Made by inpact; every number in the curves is one that it computed.");
        self.open("details", &[]);
        self.element("summary", &[], "Licence of uPlot");
        self.element("pre", &[("tabindex", "0")], UPLOT_LICENSE.trim_end());
        self.close("details");
        self.text += "</footer>\n";
        for script in [UPLOT, SCRIPT] {
            let _ = writeln!(self.text, "<script>{script}</script>");
        }
        self.text += "</body>\n</html>\n";
        self.text
    }
}

/// A text for an element or a quoted attribute, with invisible characters made visible.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in visible(text).chars() {
        match character {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\'' => out += "&#39;",
            character => out.push(character),
        }
    }
    out
}

/// Equivalent JSON without characters that are special in HTML or old JavaScript.
fn harmless(json: &str) -> String {
    let mut out = String::with_capacity(json.len());
    for character in json.chars() {
        match character {
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => {
                let _ = write!(out, "\\u{:04x}", u32::from(character));
            }
            character => out.push(character),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_text() {
        assert_eq!(escaped("</script><b a='\"&"), "&lt;/script&gt;&lt;b a=&#39;&quot;&amp;");
        assert_eq!(escaped("a\u{202e}b\u{0}"), "a\\u{202e}b\\u{0}");
    }

    #[test]
    fn data_cannot_end_its_element() {
        let json = serde_json::json!({"name": "</script><!--\u{2028}&"}).to_string();
        let written = harmless(&json);
        assert!(!written.contains(['<', '>', '&', '\u{2028}']));
        assert_eq!(
            serde_json::from_str::<serde_json::Value>(&written).unwrap(),
            serde_json::from_str::<serde_json::Value>(&json).unwrap()
        );
    }

    /// The built file is unchanged from its registry package.
    #[test]
    fn the_charting_library_is_the_pinned_one() {
        let hash = |text: &str| Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect::<String>();
        assert!(UPLOT.starts_with("/*! https://github.com/leeoniya/uPlot (v1.6.32) */"));
        assert_eq!(hash(UPLOT), "19c8d4c6ad88929a79f4ae49d6f7161566dfd0ba3d15cc495e974f787eb78f1f");
        assert_eq!(hash(UPLOT_STYLE), "df630c6a8d6f8eeaff264b50f73ce5b114f646ffd9a0bb74f049b0a00135fa04");
        assert!(!UPLOT.contains("</script") && !SCRIPT.contains("</script"));
    }
}
