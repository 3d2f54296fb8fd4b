//! S008: numbers with more characters than Abaqus reads.

use crate::parameter::{self, GivenParameter};
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::grammar::ParameterKind;
use inpact_parser::number::{FLOAT_CHARACTERS, INTEGER_DIGITS};
use inpact_parser::problem::ProblemKind;

declare_rule! {
    /// A number has more characters than Abaqus allows: 20 for a float with sign, point and exponent, 9 digits for an integer.
    ///
    /// inpact reads the number in full.
    /// One finding stands for all such numbers of a block.
    ///
    /// ## Why
    /// Abaqus may read another number than the one that stands there.
    ///
    /// ## What to do
    /// Write fewer digits: 17 significant digits tell any two numbers apart.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1000000.00000000000000000, 0.
    /// 3.E7, 1.E7
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1000000.0000000001, 0.
    /// 3.E7, 1.E7
    /// ```
    "S008", "number-too-long", Warning, fix: None, source: "S-34, S-35, Q-18"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let long = |kind: &ProblemKind| match kind {
        ProblemKind::NumberTooLong { characters } => Some(*characters),
        _ => None,
    };
    // The problems of a block follow one another.
    for of_block in context.problems.chunk_by(|a, b| a.keyword == b.keyword) {
        let mut found = of_block.iter().filter_map(|problem| Some((problem.span, long(&problem.kind)?)));
        let Some((span, characters)) = found.next() else { continue };
        let count = 1 + found.count();
        let shown = context.shown(span);
        let diagnostic =
            report.at(span, format!("`{shown}` has {characters} characters: a float has {FLOAT_CHARACTERS} at most"));
        diagnostic.label("read in full here").help("write fewer digits: 17 tell any two numbers apart");
        if count > 1 {
            diagnostic.note(format!("{count} numbers of this block are too long; this is the first"));
        }
    }
    for given in parameter::all_given(context) {
        check_parameter(context, &given, report);
    }
}

fn check_parameter(context: &Context<'_>, given: &GivenParameter<'_>, report: &mut Report<'_>) {
    let (Some(value), Some(Ok(number))) = (given.value(), given.number(context)) else { return };
    // A value that is illegal anyhow has its own finding.
    if given.out_of_bounds(number).is_some() {
        return;
    }
    let text = context.deck.text(value);
    if text.contains(&b'<') {
        return;
    }
    let (name, shown) = (&given.definition.name, context.shown(value));
    let digits = text.iter().filter(|byte| byte.is_ascii_digit()).count();
    let message = match given.definition.kind {
        ParameterKind::Integer if digits > INTEGER_DIGITS => {
            format!("`{name}={shown}` has {digits} digits: an integer has {INTEGER_DIGITS} at most")
        }
        ParameterKind::Float if text.len() > FLOAT_CHARACTERS => {
            format!("`{name}={shown}` has {} characters: a float has {FLOAT_CHARACTERS} at most", text.len())
        }
        _ => return,
    };
    report.at(value, message).label("read in full here").help("write fewer digits");
}
