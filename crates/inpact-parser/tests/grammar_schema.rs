//! `grammar/keyword.schema.json` describes exactly what the keyword files are read into.

use inpact_parser::grammar::{
    Column, ColumnKind, Counted, Data, Definition, Level, ParameterDefinition, ParameterKind, Product, Release,
    RowShape,
};
use serde::de::value::Error as ValueError;
use serde::de::{Deserialize, Deserializer, Error, Visitor};
use serde::forward_to_deserialize_any;
use serde_json::Value;
use std::collections::BTreeSet;

const SCHEMA: &str = include_str!("../grammar/keyword.schema.json");

/// Takes down the names that a type asks for when it is read.
struct NameRecorder<'a>(&'a mut &'static [&'static str]);

impl<'de> Deserializer<'de> for NameRecorder<'_> {
    type Error = ValueError;

    fn deserialize_any<V: Visitor<'de>>(self, _visitor: V) -> Result<V::Value, ValueError> {
        Err(ValueError::custom("neither a struct nor an enum"))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ValueError> {
        *self.0 = fields;
        self.deserialize_any(visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ValueError> {
        *self.0 = variants;
        self.deserialize_any(visitor)
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map identifier ignored_any
    }
}

/// The fields of a struct, or the variants of an enum, as they are written in a file.
fn names_of<'de, T: Deserialize<'de>>() -> BTreeSet<String> {
    let mut names: &'static [&'static str] = &[];
    // Reading fails, after it has said what it wants to read.
    let _ = T::deserialize(NameRecorder(&mut names));
    assert!(!names.is_empty());
    names.iter().map(|name| (*name).to_owned()).collect()
}

/// The object at `pointer` of the schema has exactly the fields of `T`, and no others are allowed.
fn check_struct<'de, T: Deserialize<'de>>(pointer: &str) {
    let schema: Value = serde_json::from_str(SCHEMA).unwrap();
    let object = schema.pointer(pointer).unwrap();
    let properties = object["properties"].as_object().unwrap();
    assert_eq!(properties.keys().cloned().collect::<BTreeSet<_>>(), names_of::<T>(), "{pointer}");
    assert_eq!(object["additionalProperties"], Value::Bool(false), "{pointer}");
    for (name, property) in properties {
        assert!(property["description"].is_string(), "{pointer}: {name}");
    }
}

/// The words that the schema allows at `pointer` are the variants of `T`.
fn check_enum<'de, T: Deserialize<'de>>(pointer: &str) {
    let schema: Value = serde_json::from_str(SCHEMA).unwrap();
    let names = schema.pointer(pointer).unwrap()["enum"].as_array().unwrap();
    let names: BTreeSet<String> = names.iter().map(|name| name.as_str().unwrap().to_owned()).collect();
    assert_eq!(names, names_of::<T>(), "{pointer}");
}

#[test]
fn the_schema_names_the_fields_that_are_read() {
    check_struct::<Definition>("");
    check_struct::<ParameterDefinition>("/$defs/parameter");
    check_struct::<Data>("/$defs/data");
    check_struct::<Column>("/$defs/column");
    check_struct::<Counted>("/$defs/counted");
}

#[test]
fn the_schema_has_the_names_that_are_read() {
    check_enum::<Level>("/properties/levels/items");
    check_enum::<Product>("/properties/products/items");
    check_enum::<ParameterKind>("/$defs/parameter/properties/kind");
    check_enum::<RowShape>("/$defs/data/properties/shape");
    check_enum::<ColumnKind>("/$defs/column/properties/kind");
}

#[test]
fn the_schema_names_the_releases() {
    let schema: Value = serde_json::from_str(SCHEMA).unwrap();
    let expected: Vec<Value> = Release::ALL.iter().map(|release| Value::from(release.to_string())).collect();
    assert_eq!(schema["$defs"]["release"]["enum"], Value::from(expected));
}

/// The schema requires the keys that reading requires.
#[test]
fn the_schema_requires_what_reading_requires() {
    let schema: Value = serde_json::from_str(SCHEMA).unwrap();
    let required = schema["required"].as_array().unwrap();
    let complete = "name = \"STEP\"\nsummary = \"x\"\nlevels = [\"model\"]\nparents = []\nproducts = [\"standard\"]\n\
                    source = \"x\"\nexample = \"*STEP\"\ndata = { shape = \"text\" }\n";
    assert!(Definition::parse(complete).is_ok());
    assert_eq!(required.len(), complete.lines().count());
    for field in required {
        let field = field.as_str().unwrap();
        let without: String =
            complete.lines().filter(|line| !line.starts_with(field)).map(|line| line.to_owned() + "\n").collect();
        let error = Definition::parse(&without).unwrap_err().to_string();
        assert!(error.contains(&format!("missing field `{field}`")), "{error}");
    }
}
