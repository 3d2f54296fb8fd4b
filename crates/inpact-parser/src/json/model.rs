//! The model view: the content of a deck as typed data.
//!
//! The structs of `document` are the JSON, field by field; the model itself is independent of JSON.
//! Places (`span`) are byte ranges of the deck the JSON was made from; they are optional on the way back.
//! `schema/model.schema.json` is generated from `document`, and a test keeps it up to date.

mod document;
mod read;
mod write;

pub use read::read;
pub use write::write;

/// The value of the `schema` field.
pub const SCHEMA: &str = "inpact/model/1";

#[cfg(test)]
mod tests {
    use super::document::Document;

    #[test]
    fn the_schema_is_fresh() {
        crate::json::schema::check::<Document>("model.schema.json");
    }
}
