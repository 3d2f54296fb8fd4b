//! The constants of *SURFACE BEHAVIOR and *FRICTION that CalculiX reads: which items must be numbers (CX-08).
//!
//! Their rows stay texts in the model; an item that is not a number is still a problem, because ccx stops at it.

use super::Reader;
use super::entry::Entry;
use crate::grammar::{ColumnKind, Dialect, RowShape};
use crate::model::rows::read_number;
use crate::problem::Problem;

impl Reader<'_> {
    /// Reports items that ccx reads as numbers and that are not.
    pub(super) fn check_constants(&mut self, option: Entry<'_>) {
        let dialect = self.grammar.dialect();
        if dialect != Dialect::Calculix || option.definition.rows() != RowShape::Items {
            return;
        }
        let columns = option.definition.data.columns.iter().filter(|column| column.kind == ColumnKind::Float);
        let columns: Vec<&str> = columns.map(|column| column.name.as_str()).collect();
        let (rows, items) = self.constants_read(option);
        let lines = self.deck.data_lines(option.block).filter(|line| !line.is_blank()).take(rows);
        let cells = lines.flat_map(|line| line.items().zip(&columns).take(items).collect::<Vec<_>>());
        let mut problems = Vec::new();
        for (item, column) in cells.filter(|(item, _)| !item.is_empty()) {
            if let (_, Some(kind)) = read_number(self.deck.text(item), item, dialect, column) {
                problems.push(Problem { kind, span: item, keyword: option.keyword.span });
            }
        }
        self.problems.append(&mut problems);
    }

    /// The number of rows that are read, and of items of each; ccx ignores further ones.
    fn constants_read(&self, option: Entry<'_>) -> (usize, usize) {
        let law = option.parameter("PRESSURE-OVERCLOSURE").and_then(|parameter| {
            let definition = &option.definition.parameters[parameter.index()?];
            definition.choice_named(self.deck.text(parameter.value?))
        });
        match law {
            Some("EXPONENTIAL") => (1, 2),
            Some("LINEAR" | "TIED" | "HARD") => (1, 3),
            _ => (usize::MAX, usize::MAX),
        }
    }
}
