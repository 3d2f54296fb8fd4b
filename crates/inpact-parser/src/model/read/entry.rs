//! Any option: its parameters and its rows, as the grammar describes them.

use super::Reader;
use crate::deck::lines::lines;
use crate::deck::{Block, KeywordLine, Parameter, RowsKept};
use crate::grammar::{Definition, KeywordId, RowShape};
use crate::model::rows::{most_written, read_table, table_of_ends};
use crate::model::{GivenParameter, MAX_FIELD_VARIABLES, Name, Reference, SharedText, SubOption, Table, TextRows};
use crate::number::{read_float, read_integer};
use crate::span::Span;
use std::sync::Arc;

/// The number of kinds of tables whose column names are shared.
const MAX_KINDS: usize = 64;

/// A block whose keyword the grammar defines.
#[derive(Clone, Copy)]
pub(super) struct Entry<'a> {
    pub(super) id: KeywordId,
    pub(super) name: &'a str,
    pub(super) definition: &'a Definition,
    pub(super) keyword: &'a KeywordLine,
    pub(super) block: &'a Block,
}

impl Entry<'_> {
    /// The last setting of a parameter applies.
    pub(super) fn parameter(self, name: &str) -> Option<Parameter> {
        self.keyword.given(name, self.definition)
    }

    /// The first setting of a parameter.
    pub(super) fn first_parameter(self, name: &str) -> Option<Parameter> {
        self.keyword.parameters().find(|parameter| parameter.is(name, self.definition))
    }

    pub(super) fn is_given(self, name: &str) -> bool {
        self.parameter(name).is_some()
    }
}

impl Reader<'_> {
    /// The rows as a table; `None` when there are none, or USER makes them void.
    pub(super) fn table(&mut self, option: Entry<'_>) -> Option<Table> {
        let dependencies = self.dependencies(option);
        let data = &option.definition.data;
        let is_given = |name: &str| option.is_given(name);
        let written = most_written(self.deck, option.block, dependencies, || data.layout(is_given, 0))?;
        let layout = data.layout_of(is_given, dependencies, written)?;
        let mut table = if option.block.rows_kept == RowsKept::Ends {
            let table = table_of_ends(self.deck, option.block, layout);
            table.or_else(|| {
                self.deck.miss_rows(option.block);
                None
            })?
        } else {
            let in_dialect = (layout, self.grammar.dialect());
            read_table(self.deck, option.block, in_dialect, &self.model.parameters, &mut self.problems)
        };
        if table.row_count() == 0 {
            return None;
        }
        match self.columns.iter().find(|columns| **columns == table.columns) {
            Some(columns) => table.columns = Arc::clone(columns),
            // There are few kinds of tables, except invented ones.
            None if self.columns.len() < MAX_KINDS => self.columns.push(Arc::clone(&table.columns)),
            None => {}
        }
        Some(table)
    }

    pub(super) fn dependencies(&self, option: Entry<'_>) -> usize {
        let value = self.value_of(option, "DEPENDENCIES");
        let number = value.and_then(|value| read_integer(value.as_bytes()).ok()).unwrap_or(0);
        usize::try_from(number).unwrap_or(0).min(MAX_FIELD_VARIABLES)
    }

    pub(super) fn generic(&mut self, option: Entry<'_>) -> SubOption {
        self.check_constants(option);
        let is_table = matches!(option.definition.rows(), RowShape::Table) && !option.is_given("USER");
        let table = if is_table { self.table(option) } else { None };
        let rows = if table.is_some() || is_table { TextRows::default() } else { self.texts(option.block) };
        SubOption {
            keyword: self.shared(option.name),
            span: option.keyword.visible_span(self.deck),
            parameters: self.given_parameters(option).into(),
            table: table.map(Box::new),
            rows,
        }
    }

    /// The items of every line; empty ones at the end of a line left out.
    pub(super) fn texts(&self, block: &Block) -> TextRows {
        let lines = self.deck.data_lines(block).filter(|line| !line.is_blank());
        let items = lines.map(|line| {
            let mut items: Vec<String> = line.items().map(|item| self.deck.shown(item)).collect();
            let used = items.iter().rposition(|item| !item.is_empty()).map_or(0, |last| last + 1);
            items.truncate(used);
            items
        });
        items.collect()
    }

    pub(super) fn value_of(&self, option: Entry<'_>, name: &str) -> Option<String> {
        Some(self.value_text(option.parameter(name)?.value?))
    }

    pub(super) fn float_of(&self, option: Entry<'_>, name: &str) -> Option<f64> {
        read_float(self.value_of(option, name)?.as_bytes()).ok()
    }

    /// An interned name of the grammar.
    fn shared(&mut self, name: &str) -> SharedText {
        if let Some(shared) = self.names.get(name) {
            return shared.clone();
        }
        let shared = SharedText::from(name);
        self.names.insert(shared.clone());
        shared
    }

    pub(super) fn given_parameters(&mut self, option: Entry<'_>) -> Vec<GivenParameter> {
        let given = option.keyword.parameters().map(|parameter| GivenParameter {
            name: match parameter.index() {
                Some(index) => self.shared(&option.definition.parameters[index].name),
                None => on_one_line(&self.deck.shown(parameter.name)).into(),
            },
            value: parameter.value.map(|value| on_one_line(&self.deck.shown(value)).into()),
            span: parameter.span(),
        });
        given.collect()
    }

    /// The name of a value or an item in the dialect.
    pub(super) fn name(&self, span: Span) -> Name {
        Name::in_dialect(&self.value_text(span), self.grammar.dialect())
    }

    pub(super) fn reference(&self, span: Span) -> Option<Reference> {
        (!span.is_empty()).then(|| Reference { name: self.name(span), span })
    }
}

/// A keyword line over several lines, on one: line ends are blanks (S-11), comments between are dropped.
fn on_one_line(text: &str) -> String {
    if !text.contains(['\n', '\r']) {
        return text.to_owned();
    }
    let lines = lines(text.as_bytes()).map(|range| text[range].trim());
    lines.filter(|line| !line.starts_with("**")).collect::<Vec<_>>().join(" ")
}

/// Removes the last parameter of that name from the list.
pub(super) fn take(parameters: &mut Vec<GivenParameter>, name: &str) -> Option<GivenParameter> {
    let found = parameters.iter().rposition(|parameter| parameter.name == name)?;
    Some(parameters.remove(found))
}
