//! Holds a committed JSON Schema against the types that it describes; with INPACT_UPDATE=1 it is written anew.

use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use schemars::{JsonSchema, Schema};
use serde_json::Value;
use std::path::Path;

/// Takes away what says more about Rust than about the file.
fn plain(schema: &mut Schema) {
    schema.remove("format");
    if let Some(description) = schema.get("description").and_then(Value::as_str).map(|text| text.replace('\n', " ")) {
        schema.insert("description".to_owned(), description.into());
    }
}

/// Compares the schema of `T` with `schema/` and this name.
pub(crate) fn check<T: JsonSchema>(name: &str, settings: SchemaSettings) {
    let schema = settings.with_transform(RecursiveTransform(plain)).into_generator().into_root_schema_for::<T>();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../schema").join(name);
    let written = serde_json::to_string_pretty(&schema).expect("a schema is JSON") + "\n";
    if std::env::var_os("INPACT_UPDATE").is_some() {
        std::fs::write(&path, &written).expect("schema/ can be written");
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(committed == written, "`schema/{name}` is out of date: run this test again with INPACT_UPDATE=1");
}
