//! Parameters: the definitions of *PARAMETER, and `<name>` in keyword values (S-60 to S-66).

use super::Reader;
use crate::deck::{Block, KeywordLine};
use crate::expression::{StatementLine, define, substitute};
use crate::model::rows::substitution_problem;
use crate::problem::{Problem, ProblemKind};
use crate::span::Span;

impl Reader<'_> {
    pub(super) fn define_parameters(&mut self, block: &Block) {
        let Some(keyword) = &block.keyword else { return };
        let Some(id) = keyword.id().filter(|id| self.grammar.keyword(*id).name == "PARAMETER") else { return };
        let definition = self.grammar.keyword(id).definition();
        if definition.is_some_and(|definition| keyword.given("TABLE", definition).is_some()) {
            let span = keyword.visible_span(self.deck);
            self.problems.push(Problem { kind: ProblemKind::UninterpretedParameters, span, keyword: keyword.span });
            return;
        }
        let lines = self.deck.data_lines(block).map(|line| StatementLine { span: line.span, text: line.text });
        let mut invalid = Vec::new();
        define(lines, &mut self.model.parameters, &mut invalid);
        self.problems.extend(invalid.into_iter().map(|problem| Problem {
            kind: ProblemKind::InvalidExpression {
                message: problem.message,
                help: problem.help,
                undefined: problem.undefined,
            },
            span: problem.span,
            keyword: keyword.span,
        }));
    }

    /// The text of a keyword value, its parameters replaced by their values (S-62).
    ///
    /// A parameter without a value stays a name; [`Reader::check_references`] reports it.
    pub(super) fn value_text(&self, value: Span) -> String {
        let text = self.deck.shown(value);
        match substitute(&text, &self.model.parameters) {
            Ok(replaced) => replaced.into_owned(),
            Err(_) => text,
        }
    }

    /// Reports the parameters without a definition in the values of a keyword line.
    pub(super) fn check_references(&mut self, keyword: &KeywordLine) {
        for value in keyword.parameters().filter_map(|parameter| parameter.value) {
            let text = self.deck.text(value);
            if !text.contains(&b'<') {
                continue;
            }
            let text = self.deck.shown(value);
            if let Err(error) = substitute(&text, &self.model.parameters) {
                self.problems.extend(substitution_problem(&error, &self.model.parameters, value, keyword.span));
            }
        }
    }
}
