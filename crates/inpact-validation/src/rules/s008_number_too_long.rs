//! S008: numbers with more characters than Abaqus reads.

use inpact_diagnostics::Severity;
use crate::parameter::{self, GivenParameter};
use crate::quantity::number;
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::grammar::ParameterKind;
use inpact_parser::number::{FLOAT_CHARACTERS, INTEGER_DIGITS, float_text, float_text_that_fits, read_float};
use inpact_parser::{LongNumber, ProblemKind};

declare_rule! {
    /// A number has more characters than Abaqus allows: 20 for a float with sign, point and exponent, 9 digits for an integer.
    ///
    /// inpact reads the number in full.
    /// One finding covers all such numbers of a block.
    ///
    /// ## Why
    /// Abaqus may read another number than the one written.
    ///
    /// ## What to do
    /// Write fewer digits: 17 significant digits distinguish any two numbers.
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
        ProblemKind::NumberTooLong { characters, read } => Some((*characters, *read)),
        _ => None,
    };
    // The problems of a block follow one another.
    for of_block in context.problems.chunk_by(|a, b| a.keyword == b.keyword) {
        let found = of_block.iter().filter_map(|problem| Some((problem.span, long(&problem.kind)?)));
        // One that is read as another number comes before those that are only long.
        let mut found: Vec<_> = found.collect();
        found.sort_by_key(|(_, (_, read))| matches!(read, LongNumber::Whole | LongNumber::SameValue));
        let Some(&(span, (characters, read))) = found.first() else { continue };
        let shown = context.shown(span);
        let diagnostic =
            report.at(span, format!("`{shown}` has {characters} characters: a float has {FLOAT_CHARACTERS} at most"));
        diagnostic.help(match read_float(context.deck.text(span)) {
            Ok(number) => shorter(number),
            Err(_) => "write fewer digits: 17 tell any two numbers apart".to_owned(),
        });
        match read {
            LongNumber::Whole => diagnostic.label("read in full here"),
            LongNumber::SameValue => diagnostic.label("CalculiX reads the first 20 characters, which are the same number"),
            LongNumber::OtherValue(value) => diagnostic
                .severity(Severity::Error)
                .label(format!("CalculiX reads the first 20 characters, and so {}", number(value))),
            LongNumber::Nothing => diagnostic
                .severity(Severity::Error)
                .label("CalculiX reads the first 20 characters, which are no number"),
        };
        if found.len() > 1 {
            diagnostic.note(format!("{} numbers of this block are too long; this is the first", found.len()));
        }
    }
    for given in parameter::all_given(context) {
        check_parameter(context, &given, report);
    }
}

/// The same number within the limit, or the nearest one that the limit allows (S-34).
fn shorter(number: f64) -> String {
    let text = float_text(number);
    if text.len() <= FLOAT_CHARACTERS {
        return format!("write `{text}`, which is the same number");
    }
    let nearest = float_text_that_fits(number);
    format!("no {FLOAT_CHARACTERS} characters say this number: `{nearest}` is the nearest that they do")
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
    let help = match given.definition.kind {
        ParameterKind::Float => shorter(number),
        _ => "write fewer digits".to_owned(),
    };
    report.at(value, message).label("read in full here").help(help);
}
