//! The rows of an option: their shape, their columns, and how a row is split into lines (2.9).

use super::dimension::Dimension;
use serde::Deserialize;
use std::collections::HashSet;

/// The most items on a data line (K-50).
const ITEMS_ON_A_LINE: usize = 8;

/// The rows of an option.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Data {
    /// Their shape.
    pub shape: RowShape,
    /// Whether the option requires rows (K-11).
    #[serde(default)]
    pub required: bool,
    /// The least number of rows, where there are any (K-30).
    #[serde(default)]
    pub minimum_rows: usize,
    /// The parameters beside which the rows are ignored.
    #[serde(default)]
    pub ignored_with: Vec<String>,
    /// The items of the line before the rows of a [`RowShape::HeadedTable`].
    #[serde(default)]
    pub head: Vec<Column>,
    /// The items of a row, in their order.
    #[serde(default)]
    pub columns: Vec<Column>,
    /// Items after the columns, as many as a parameter says.
    pub counted: Option<Counted>,
}

/// Shapes of the rows of an option.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RowShape {
    /// There are no rows.
    None,
    /// One row at most, of the columns.
    Line,
    /// Rows of numbers: the first column depends on the others (T-03).
    Table,
    /// One line of other items, then rows of numbers (2.6).
    HeadedTable,
    /// Lines of items that are kept as text, such as the names of slave and master.
    Items,
    /// Free text, in which commas and quotes mean nothing (S-70).
    Text,
    /// Rows that are kept or skipped as bytes.
    Uninterpreted,
}

/// An item of a row.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Column {
    /// Its name in node tables, JSON and messages.
    pub name: String,
    /// The kind of its values.
    pub kind: ColumnKind,
    /// The dimension of a number.
    pub dimension: Option<Dimension>,
    /// The value of an empty item; 0 unless given (S-32).
    pub default: Option<f64>,
    /// The parameter that must be given for the column to be there.
    pub with: Option<String>,
    /// The parameter that must not be given for the column to be there.
    pub without: Option<String>,
    /// One sentence without a full stop.
    pub description: String,
    /// Manual section, rule number.
    pub source: String,
}

/// Kinds of columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum ColumnKind {
    /// A number (S-34).
    Float,
    /// A number without a fraction (S-35).
    Integer,
    /// A name (S-40).
    Label,
    /// Any other text.
    Text,
}

/// Columns whose number is the value of a parameter: field variables by DEPENDENCIES, constants by PROPERTIES.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Counted {
    /// The parameter that counts them.
    pub count: String,
    /// Their names begin so and end in 1, 2, 3, ….
    pub prefix: String,
    /// The number of them that fit on the first line, after the columns (K-52).
    pub first_line: usize,
    /// The number on every further line.
    pub following: usize,
    /// One sentence without a full stop.
    pub description: String,
    /// Manual section, rule number.
    pub source: String,
}

/// Layout of the rows of one block.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// The columns by name, the counted ones last.
    pub columns: Vec<String>,
    /// The values of empty items, column by column (S-32).
    pub defaults: Vec<f64>,
    /// The most items on the first line of a row.
    pub first_line: usize,
    /// The most items on every further line.
    pub following: usize,
    /// The number of counted columns after `columns` that no row of the block reaches.
    pub unwritten: usize,
}

impl RowShape {
    /// Whether the rows are numbers in columns.
    pub fn is_numbers(self) -> bool {
        matches!(self, Self::Line | Self::Table | Self::HeadedTable)
    }
}

impl Data {
    /// The columns of a row when these parameters are given, without the counted ones.
    pub fn columns_for(&self, given: impl Fn(&str) -> bool) -> impl Iterator<Item = &Column> {
        self.columns.iter().filter(move |column| {
            column.with.as_deref().is_none_or(&given) && !column.without.as_deref().is_some_and(&given)
        })
    }

    /// The layout of the rows, when there are rows of numbers and no given parameter makes them ignored (K-50 to K-52).
    ///
    /// `count` is the value of the parameter that counts columns, 0 where it is not given.
    pub fn layout(&self, given: impl Fn(&str) -> bool, count: usize) -> Option<Layout> {
        self.layout_of(given, count, count)
    }

    /// The same, with no more than the first `written` of the counted columns.
    pub fn layout_of(&self, given: impl Fn(&str) -> bool, count: usize, written: usize) -> Option<Layout> {
        if !self.shape.is_numbers() || self.ignored_with.iter().any(|parameter| given(parameter)) {
            return None;
        }
        let lead: Vec<&Column> = self.columns_for(given).collect();
        let counted = self.counted.as_ref().map(|counted| (counted, count));
        let numbers = counted.map_or(0..0, |(_, count)| 0..count.min(written));
        let names = numbers.clone().filter_map(|number| {
            let (counted, _) = counted?;
            Some(format!("{}{}", counted.prefix, number + 1))
        });
        Some(Layout {
            columns: lead.iter().map(|column| column.name.clone()).chain(names).collect(),
            defaults: lead.iter().map(|column| column.default.unwrap_or(0.0)).chain(numbers.map(|_| 0.0)).collect(),
            first_line: lead.len() + self.counted.as_ref().map_or(0, |counted| counted.first_line),
            following: self.counted.as_ref().map_or(ITEMS_ON_A_LINE, |counted| counted.following),
            unwritten: counted.map_or(0, |(_, count)| count.saturating_sub(written)),
        })
    }

    /// A contradiction in the definition of these rows.
    pub(super) fn contradiction(&self, has_parameter: impl Fn(&str) -> bool) -> Option<String> {
        let is_numbers = self.shape.is_numbers();
        if is_numbers && self.columns.is_empty() {
            return Some("rows of numbers need columns".to_owned());
        }
        if !is_numbers && self.shape != RowShape::Items && !self.columns.is_empty() {
            return Some(format!("rows of shape {:?} have no columns", self.shape));
        }
        if self.head.is_empty() == (self.shape == RowShape::HeadedTable) {
            return Some(format!("rows of shape {:?} with {} items before them", self.shape, self.head.len()));
        }
        if self.required && self.shape == RowShape::None {
            return Some("rows are required and there are none".to_owned());
        }
        if let Some(counted) = &self.counted
            && (counted.following == 0 || counted.prefix.is_empty())
        {
            return Some("counted columns need a prefix and room on the further lines".to_owned());
        }
        let columns = || self.head.iter().chain(&self.columns);
        if let Some(name) = first_repeated(columns().map(|column| column.name.as_str())) {
            return Some(format!("duplicate column `{name}`"));
        }
        let of_columns = columns().flat_map(|column| [&column.with, &column.without]).flatten();
        let of_counted = self.counted.iter().map(|counted| &counted.count);
        let mut named = self.ignored_with.iter().chain(of_columns).chain(of_counted);
        if let Some(unknown) = named.find(|name| !has_parameter(name)) {
            return Some(format!("`{unknown}` is no parameter of the keyword"));
        }
        let counted = self.counted.iter().map(|counted| (&counted.description, &counted.source));
        let mut texts = columns().map(|column| (&column.description, &column.source)).chain(counted);
        if texts.any(|(description, source)| !is_description(description) || source.is_empty()) {
            return Some("a column without a description or a source".to_owned());
        }
        let wrong = columns().find(|column| column.dimension.is_some() != (column.kind == ColumnKind::Float));
        wrong.map(|column| format!("column `{}`: numbers have a dimension, everything else has none", column.name))
    }
}

impl Layout {
    /// The number of items of a complete row.
    pub fn width(&self) -> usize {
        self.columns.len() + self.unwritten
    }

    /// The number of lines of a row (K-52).
    pub fn lines_per_row(&self) -> usize {
        1 + self.width().saturating_sub(self.first_line).div_ceil(self.following)
    }
}

/// Whether a text is not empty and, being one sentence, ends without a full stop.
pub(super) fn is_description(text: &str) -> bool {
    !text.trim().is_empty() && !text.ends_with('.')
}

/// The first name that occurs a second time.
pub(super) fn first_repeated<'name>(mut names: impl Iterator<Item = &'name str>) -> Option<&'name str> {
    let mut seen = HashSet::new();
    names.find(|name| !seen.insert(*name))
}

#[cfg(test)]
mod tests {
    use super::super::Grammar;

    /// the number of items on each line of a row.
    fn check(keyword: &str, dependencies: usize, expected: usize) {
        let grammar = Grammar::builtin();
        let definition = grammar.keyword(grammar.id_of(keyword).unwrap()).definition().unwrap();
        let layout = definition.layout(|_| false, dependencies).unwrap();
        assert_eq!(layout.lines_per_row(), expected, "{keyword}, DEPENDENCIES={dependencies}");
        assert_eq!(layout.columns.len(), layout.defaults.len());
    }

    #[test]
    fn a_15_rows_go_over_lines() {
        for (dependencies, lines) in [(0, 1), (5, 1), (6, 2), (13, 2), (14, 3)] {
            check("GAP ELECTRICAL CONDUCTANCE", dependencies, lines);
        }
        for (dependencies, lines) in [(0, 1), (4, 1), (5, 2), (12, 2), (13, 3)] {
            check("CONTACT PERMEABILITY", dependencies, lines);
            check("GAP CONDUCTANCE", dependencies, lines);
        }
    }

    #[test]
    fn pressure_replaces_clearance() {
        let grammar = Grammar::builtin();
        let definition = |name: &str| grammar.keyword(grammar.id_of(name).unwrap()).definition().unwrap();
        let electrical = definition("GAP ELECTRICAL CONDUCTANCE");
        assert_eq!(electrical.layout(|_| false, 1).unwrap().columns, ["conductance", "clearance", "temp", "fv1"]);
        assert_eq!(
            electrical.layout(|name| name == "PRESSURE", 0).unwrap().columns,
            ["conductance", "pressure", "temp"]
        );
        assert_eq!(electrical.layout(|name| name == "USER", 0), None);
        let thermal = definition("GAP CONDUCTANCE").layout(|_| false, 1).unwrap();
        assert_eq!(thermal.columns, ["conductance", "clearance", "temp", "mass_flow", "fv1"]);
    }

    #[test]
    fn k_02_properties_have_lines_of_their_own() {
        let grammar = Grammar::builtin();
        let definition = grammar.keyword(grammar.id_of("SURFACE INTERACTION").unwrap()).definition().unwrap();
        let layout = definition.layout(|name| name == "USER", 9).unwrap();
        assert_eq!((layout.first_line, layout.following, layout.lines_per_row()), (1, 8, 3));
        assert_eq!(layout.defaults[..2], [1.0, 0.0]);
    }
}
