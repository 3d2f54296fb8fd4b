//! The values of a scene file, read by serde with the place of each number; a value of another type gives a finding.

use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;
use toml::Spanned;

/// A number, and where it is written.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(transparent)]
pub(crate) struct Number(Spanned<f64>);

impl Number {
    pub(crate) fn value(&self) -> f64 {
        *self.0.as_ref()
    }

    pub(crate) fn span(&self) -> Range<usize> {
        self.0.span()
    }
}

#[cfg(test)]
impl schemars::JsonSchema for Number {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        f64::schema_name()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        f64::json_schema(generator)
    }
}

/// Two names of nodes, no more and no less.
#[derive(Debug)]
pub(crate) struct Pair(pub(crate) [String; 2]);

impl<'de> Deserialize<'de> for Pair {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(PairVisitor)
    }
}

struct PairVisitor;

impl<'de> Visitor<'de> for PairVisitor {
    type Value = Pair;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("the names of two nodes such as [\"a\", \"b\"]")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut names: A) -> Result<Pair, A::Error> {
        let mut pair = [String::new(), String::new()];
        for (length, name) in pair.iter_mut().enumerate() {
            *name = names.next_element()?.ok_or_else(|| A::Error::invalid_length(length, &self))?;
        }
        let mut length = pair.len();
        while names.next_element::<IgnoredAny>()?.is_some() {
            length += 1;
        }
        if length == pair.len() { Ok(Pair(pair)) } else { Err(A::Error::invalid_length(length, &self)) }
    }
}

/// A value written as a table of keys.
pub(crate) trait Entry {
    /// One of them, for a message.
    const ONE: &'static str;
    /// Many of them, for a message.
    const MANY: &'static str;
}

/// A table of keys, and not a list of their values in order, which serde would take as well.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Keyed<T>(pub(crate) T);

impl<'de, T: Deserialize<'de> + Entry> Deserialize<'de> for Keyed<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(KeyedVisitor(PhantomData))
    }
}

struct KeyedVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de> + Entry> Visitor<'de> for KeyedVisitor<T> {
    type Value = Keyed<T>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(T::ONE)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Keyed<T>, A::Error> {
        T::deserialize(MapAccessDeserializer::new(map)).map(Keyed)
    }
}

/// An element of a list.
pub(crate) trait Listed {
    /// A list of them, for a message.
    const LIST: &'static str;
}

impl Listed for Number {
    const LIST: &'static str = "a list of numbers such as [1.0]";
}

impl<T: Entry> Listed for Spanned<Keyed<T>> {
    const LIST: &'static str = T::MANY;
}

/// A list; an empty one where none is given.
#[derive(Debug)]
pub(crate) struct List<T>(pub(crate) Vec<T>);

/// Entries, and where they are written.
pub(crate) type Entries<T> = List<Spanned<Keyed<T>>>;

impl<T> Default for List<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<'de, T: Deserialize<'de> + Listed> Deserialize<'de> for List<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(ListVisitor(PhantomData))
    }
}

struct ListVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de> + Listed> Visitor<'de> for ListVisitor<T> {
    type Value = List<T>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(T::LIST)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<List<T>, A::Error> {
        let mut list = Vec::new();
        while let Some(item) = items.next_element()? {
            list.push(item);
        }
        Ok(List(list))
    }
}
