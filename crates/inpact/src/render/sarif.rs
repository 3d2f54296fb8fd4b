//! SARIF 2.1.0: findings for code scanning, with fingerprints that do not depend on line numbers.

use super::{Document, Sources};
use crate::rules;
use inpact_diagnostics::Extent;
use inpact_parser::deck::lines::count_line_ends;
use inpact_parser::span::Position;
use inpact_validation::{Diagnostic, Label};
use serde_json::{Value, json};

/// The name of the fingerprint; its number is increased when its computation changes.
const FINGERPRINT: &str = "inpact/v1";

/// The frame around the results of a check.
pub(super) fn document() -> Document {
    with("")
}

/// A run with data besides its findings.
#[derive(Debug, Default)]
pub(crate) struct Run {
    /// The notes and the summary, one line each.
    pub(crate) notes: Vec<String>,
    /// The reason why it could not continue.
    pub(crate) failure: Option<String>,
}

/// The frame around the results of such a run.
pub(super) fn frame(run: &Run) -> Document {
    let note = |level: &str, text: &String| json!({"level": level, "message": {"text": text}});
    let notes = run.notes.iter().map(|text| note("note", text));
    let notes: Vec<Value> = notes.chain(run.failure.iter().map(|text| note("error", text))).collect();
    let invocation = json!({"executionSuccessful": run.failure.is_none(), "toolExecutionNotifications": notes});
    with(&format!("\"invocations\": [{invocation}],\n"))
}

/// The tool with its rules.
fn driver() -> Value {
    let rules: Vec<Value> = rules::all()
        .map(|rule| {
            json!({
                "id": rule.code,
                "name": rule.name,
                "shortDescription": {"text": first_line(rule.documentation)},
                "fullDescription": {"text": rule.documentation.trim()},
                "help": {"text": rule.documentation.trim(), "markdown": rule.documentation.trim()},
                "defaultConfiguration": {"level": rule.severity.name()},
            })
        })
        .collect();
    json!({
        "name": "inpact",
        "version": env!("CARGO_PKG_VERSION"),
        "informationUri": env!("CARGO_PKG_REPOSITORY"),
        "rules": rules,
    })
}

/// The frame with further properties of the run, each with its comma.
fn with(properties: &str) -> Document {
    let driver = driver();
    Document {
        head: format!(
            "{{\"$schema\": \"https://json.schemastore.org/sarif-2.1.0.json\", \"version\": \"2.1.0\", \"runs\": [{{\n\
             \"tool\": {{\"driver\": {driver}}},\n{properties}\"columnKind\": \"unicodeCodePoints\",\n\"results\": [\n"
        ),
        separator: ",\n",
        tail: "\n]}]}\n".to_owned(),
    }
}

fn first_line(documentation: &str) -> &str {
    documentation.trim().lines().next().unwrap_or_default()
}

/// The results of a deck or of data, separated by commas.
pub(super) fn results(diagnostics: &[Diagnostic], sources: Sources<'_>) -> String {
    let mut occurrences = std::collections::HashMap::new();
    let results = diagnostics.iter().map(|found| {
        let mut print = fingerprint(found, sources);
        // Equal findings are distinguished by their count.
        let count = occurrences.entry(print).or_insert(0_u64);
        *count += 1;
        print = hash(print, &count.to_le_bytes());
        result(found, sources, print).to_string()
    });
    results.collect::<Vec<_>>().join(",\n")
}

fn result(found: &Diagnostic, sources: Sources<'_>, fingerprint: u64) -> Value {
    let related: Vec<Value> = found
        .secondary
        .iter()
        .map(|label| {
            let mut location = location(label, sources);
            location["message"] = json!({"text": label.text});
            location
        })
        .collect();
    let parts = [Some(&found.message), found.note.as_ref(), found.help.as_ref()];
    let chain = sources.include_chain(found).into_iter().map(|place| format!("included at {place}"));
    let text: Vec<String> = parts.into_iter().flatten().cloned().chain(chain).collect();
    json!({
        "ruleId": found.code,
        "ruleIndex": rules::all().position(|rule| rule.code == found.code),
        "level": found.severity.name(),
        "message": {"text": text.join("\n")},
        "locations": [location(&found.primary, sources)],
        "relatedLocations": related,
        "partialFingerprints": {FINGERPRINT: format!("{fingerprint:016x}")},
    })
}

/// A region where line or bytes are known; a file without lines has none.
fn location(label: &Label, sources: Sources<'_>) -> Value {
    let artifact = json!({"uri": uri(sources.file(label))});
    let region = match label.extent {
        Extent::File => return json!({"physicalLocation": {"artifactLocation": artifact}}),
        Extent::Line => json!({"startLine": label.position.line}),
        Extent::Span => {
            let mut region = json!({
                "startLine": label.position.line,
                "startColumn": label.position.column,
                "byteOffset": label.span.start(),
                "byteLength": label.span.len(),
            });
            if let Some(end) = end(label, sources) {
                region["endLine"] = end.line.into();
                region["endColumn"] = end.column.into();
            }
            region
        }
    };
    json!({"physicalLocation": {"artifactLocation": artifact, "region": region}})
}

/// The position after the last character of a label; without it a region extends to the end of its line (SARIF 3.30.8).
///
/// `None` where the scan did not keep the text.
fn end(label: &Label, sources: Sources<'_>) -> Option<Position> {
    let text = sources.text(label);
    if text.len() as u64 != label.span.len() {
        return None;
    }
    let last_line = text.iter().rposition(|byte| matches!(byte, b'\n' | b'\r')).map(|at| &text[at + 1..]);
    let characters = last_line.unwrap_or(text).iter().filter(|byte| **byte & 0xC0 != 0x80).count() as u64;
    let first_column = if last_line.is_some() { 1 } else { label.position.column };
    Some(Position { line: label.position.line + count_line_ends(text), column: first_column + characters })
}

/// A path as a relative reference, percent-encoded.
fn uri(path: &str) -> String {
    let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-._~/+@=".contains(&byte);
    let encode = |byte: u8| if is_plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") };
    path.bytes().map(encode).collect()
}

/// The identity of a finding without its line number: rule, file, and the text at its place.
fn fingerprint(found: &Diagnostic, sources: Sources<'_>) -> u64 {
    let file = sources.file(&found.primary);
    let parts = [found.code.as_bytes(), file.as_bytes(), found.message.as_bytes(), sources.text(&found.primary)];
    parts.iter().fold(FNV_OFFSET, |state, part| hash(hash(state, part), &[0xFF]))
}

const FNV_OFFSET: u64 = 0xCBF2_9CE4_8422_2325;

/// FNV-1a: the same on every machine and in every release, which the hash of the standard library is not.
fn hash(state: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(state, |state, byte| (state ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01B3))
}
