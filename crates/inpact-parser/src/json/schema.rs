//! The JSON Schemas of both views: generated here, and compared with the committed ones.
//!
//! They describe the written form; reading accepts whatever they allow, and checks in addition what a schema cannot express.

use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use schemars::{JsonSchema, Schema};
use serde_json::{Value, json};
use std::path::Path;

/// Holds the committed schema of a view against its types.
///
/// With the environment variable INPACT_UPDATE set, the committed schema is written anew instead.
pub(super) fn check<T: JsonSchema>(file: &str) {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    let settings = settings.with_transform(RecursiveTransform(plain));
    let schema = settings.into_generator().into_root_schema_for::<T>();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../schema").join(file);
    if std::env::var_os("INPACT_UPDATE").is_some() {
        std::fs::write(&path, super::layout::to_string(&schema)).unwrap();
    }
    let committed: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
    assert!(committed == schema.to_value(), "`schema/{file}` is out of date: run this test again with INPACT_UPDATE=1");
}

/// Takes away what says more about Rust than about JSON.
fn plain(schema: &mut Schema) {
    // `double` and `uint64` are not formats of JSON Schema.
    schema.remove("format");
    if let Some(description) = schema.get("description").and_then(Value::as_str).map(|text| text.replace('\n', " ")) {
        schema.insert("description".to_owned(), description.into());
    }
    // A property with a default may be left out.
    let Some(properties) = schema.get("properties").and_then(Value::as_object).cloned() else { return };
    let is_due = |name: &Value| {
        let property = name.as_str().and_then(|name| properties.get(name));
        property.is_none_or(|property| property.get("default").is_none())
    };
    if let Some(required) = schema.get_mut("required").and_then(Value::as_array_mut) {
        required.retain(is_due);
    }
}

/// The fields of a table whose first columns have these names; field variables may follow.
pub(super) fn columns(names: &[&str]) -> Value {
    let first: Vec<Value> = names.iter().map(|name| json!({"const": name})).collect();
    json!({"columns": {"prefixItems": first, "minItems": names.len(), "items": {"pattern": "^fv[1-9][0-9]*$"}}})
}

/// An electrical conductance has a user subroutine, or says of both branches which table they have.
pub(super) fn user_or_both_branches() -> Value {
    json!([
        {"properties": {"user": {"const": true}}, "required": ["user"]},
        {"required": ["clearance", "pressure"]},
    ])
}
