//! S019: integers divided by integers, whose quotient depends on the release.

use inpact_diagnostics::{Edit, FixSafety};
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::expression::{Division, IntegerDivision};
use inpact_parser::span::Span;

declare_rule! {
    /// A statement of *PARAMETER divides an integer by an integer, and a remainder is left.
    ///
    /// ## Why
    /// Up to release 2023 Abaqus carries Python 2, where 5/4 is 1; from 2024 on it carries Python 3, where 5/4 is 1.25.
    /// inpact takes the release given by `--release`, the newest one by default.
    /// The manual of 2024 still prints the old text, so the same deck is read in two ways.
    ///
    /// ## What to do
    /// Give one of the numbers its point, or write `//` for the quotient without its remainder.
    /// The fix writes the point, so that the quotient is the same in every release.
    ///
    /// ```inp,expect
    /// *PARAMETER
    /// sigma = 5/4
    /// half = (1 + 2)/2
    /// ```
    ///
    /// ```inp,fixed
    /// *PARAMETER
    /// sigma = 5./4
    /// half = (1 + 2)/2.
    /// ```
    ///
    /// Before 2024 as well, where it is the remainder that is lost:
    ///
    /// ```inp,expect,release-2022
    /// *PARAMETER
    /// parts = 5
    /// share = parts/parts*7/parts
    /// ```
    ///
    /// ```inp,fixed,release-2022
    /// *PARAMETER
    /// parts = 5
    /// share = float(parts/parts*7)/parts
    /// ```
    ///
    /// ```inp
    /// *PARAMETER
    /// sigma = 5./4
    /// whole = 8/4
    /// rows = 5//4
    /// ```
    "S019", "integer-division", Warning, fix: ChangesMeaning, source: "S-60, A-08"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let parameters = &context.model.parameters;
    for division in parameters.integer_divisions() {
        let IntegerDivision { span, floor, quotient, .. } = division;
        let shown = context.shown(*span);
        let here = match parameters.division() {
            Division::Floor => floor,
            Division::True => quotient,
        };
        let found = report.at(*span, format!("`{shown}` is {floor} before release 2024 and {quotient} from then on"));
        found
            .label(format!("read as {here} here"))
            .note("Python 2 divides an integer by an integer without the remainder, Python 3 does not")
            .help("give one of the numbers a point, or write `//` for the quotient without the remainder");
        if let Some(edits) = with_point(context, division) {
            found.fix(FixSafety::ChangesMeaning, "divide real numbers", edits);
        }
    }
}

/// Writes a point after one of two integers; where neither is written as one, makes the dividend a real number.
///
/// `None` where the statement goes over lines of several files.
fn with_point(context: &Context<'_>, division: &IntegerDivision) -> Option<Vec<Edit>> {
    let IntegerDivision { dividend, divisor, .. } = division;
    let is_integer = |span: Span| {
        let text = context.deck.text(span);
        !text.is_empty() && text.iter().all(u8::is_ascii_digit)
    };
    let insert = |at: u64, text: &str| Edit::new(Span::new(dividend.source(), at, at), text);
    if dividend.is_empty() || divisor.is_empty() || dividend.source() != divisor.source() || divisor.start() < dividend.end() {
        return None;
    }
    Some(match (is_integer(*dividend), is_integer(*divisor)) {
        (true, _) => vec![insert(dividend.end(), ".")],
        (false, true) => vec![insert(divisor.end(), ".")],
        (false, false) => vec![insert(dividend.start(), "float("), insert(dividend.end(), ")")],
    })
}
