//! S006: items that are no numbers where numbers are due.

use super::s005_unterminated_quote::open_quote;
use inpact_diagnostics::{Edit, FixSafety};
use crate::invisible::{self, Hidden};
use crate::parameter::{self, substituted};
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::grammar::ParameterKind;
use inpact_parser::number::{NumberError, read_float};
use inpact_parser::ProblemKind;
use inpact_parser::span::Span;

declare_rule! {
    /// An item is no number where the option wants one.
    ///
    /// A number is a sign, digits with at most one point, and an exponent after `E` or `D`: `12`, `.5`, `-1.2E-3`, `1.D6`.
    /// Hexadecimal digits, digits in groups, `nan` and `inf` are no numbers, and nothing above 1.797E308 is.
    ///
    /// ## Why
    /// Abaqus refuses the row.
    /// inpact reads the rest of the deck and evaluates nothing that depends on the item.
    ///
    /// ## What to do
    /// Correct the number.
    /// An exponent without its letter, such as `1.5-3`, has a fix: it puts the letter in.
    /// The fix counts as one that changes the meaning, because `1.5-3` may also be a slip for something else.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.5+6, 0.
    /// 3.E7, 1.E7
    /// ```
    ///
    /// ```inp,fixed
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.5E+6, 0.
    /// 3.E7, 1.E7
    /// ```
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A, PAD THICKNESS=thin
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// 3.E7, 1_000_000
    /// nan, 2.E7
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A, PAD THICKNESS=1.D-3
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// 3.E7, 1000000
    /// ```
    "S006", "malformed-number", Error, fix: ChangesMeaning, source: "S-34, Q-17"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for problem in context.problems {
        if let ProblemKind::MalformedNumber { error, column } = &problem.kind
            && *error != NumberError::NotAnInteger
        {
            say(context, report, problem.span, *error, &format!("in column `{column}`"));
        }
    }
    for given in parameter::all_given(context).filter(|given| given.definition.kind == ParameterKind::Float) {
        if let (Some(value), Some(Err(error))) = (given.value(), given.number(context)) {
            say(context, report, value, error, &format!("as the value of `{}`", given.definition.name));
        }
    }
}

fn say(context: &Context<'_>, report: &mut Report<'_>, span: Span, error: NumberError, place: &str) {
    let written = context.deck.text(span);
    let Some(text) = substituted(context, span) else { return };
    if open_quote(written).is_some() && !context.is_for_calculix() {
        return;
    }
    let shown = context.shown(span);
    let is_symbolic = *text != *written;
    let item =
        if is_symbolic { format!("`{shown}`, which is `{}`,", text.escape_ascii()) } else { format!("`{shown}`") };
    match error {
        NumberError::ExponentWithoutLetter(at) => {
            let found = report.at(span, format!("{item} {place} has an exponent without its letter"));
            found.label("`E` or `D` is missing").note("an exponent must be introduced by `E` or `D`");
            let mended = format!("{}E{}", text[..at].escape_ascii(), text[at..].escape_ascii());
            found.help(format!("write `{mended}`"));
            if !is_symbolic {
                let sign = Span::new(span.source(), span.start() + at as u64, span.start() + at as u64);
                let edits = vec![Edit::new(sign, *b"E")];
                found.fix(FixSafety::ChangesMeaning, format!("write `{mended}`"), edits);
            }
        }
        NumberError::TooLarge => {
            report
                .at(span, format!("{item} {place} is above the greatest number, 1.797E308"))
                .label("too large")
                .help("check the exponent");
        }
        NumberError::Malformed | NumberError::NotAnInteger => {
            if let Some(hidden) = invisible::first(written)
                && read_float(invisible::plain(written).trim_ascii()).is_ok()
            {
                say_hidden(report, span, &hidden, written);
                return;
            }
            report.at(span, format!("{item} {place} is no number")).label("should be a number").help(help(&text));
        }
    }
}

/// A number that is one but for a character which is not what it looks like.
fn say_hidden(report: &mut Report<'_>, span: Span, hidden: &Hidden, written: &[u8]) {
    let edits = invisible::all(written).map(|hidden| Edit::new(hidden.span(span), hidden.plain));
    let mended = invisible::plain(written).escape_ascii().to_string();
    report
        .at(hidden.span(span), format!("{} in the number `{mended}`", hidden.name))
        .label("not what it looks like")
        .help(hidden.help())
        .fix(FixSafety::ChangesMeaning, format!("write `{mended}`"), edits.collect());
}

/// Whether the text is a number followed by a comment of some language.
fn has_comment(text: &[u8]) -> bool {
    const MARKS: [&[u8]; 6] = [b"**", b"!", b"#", b"//", b"$", b";"];
    let Some(end) = text.iter().position(|byte| byte.is_ascii_whitespace() || b"*!#/$;".contains(byte)) else {
        return false;
    };
    let after = text[end..].trim_ascii_start();
    read_float(&text[..end]).is_ok() && MARKS.iter().any(|mark| after.starts_with(mark))
}

/// The help for a text that is no number.
fn help(text: &[u8]) -> &'static str {
    let unsigned = text.strip_prefix(b"-").or(text.strip_prefix(b"+")).unwrap_or(text);
    let is_one_of = |names: &[&[u8]]| names.iter().any(|name| unsigned.eq_ignore_ascii_case(name));
    if is_one_of(&[b"nan", b"inf", b"infinity"]) {
        "write a finite number"
    } else if unsigned.first_chunk().is_some_and(|start: &[u8; 2]| start.eq_ignore_ascii_case(b"0x")) {
        "write the number in decimal digits"
    } else if has_comment(text) {
        "a comment has a line of its own that begins with `**`: move it there"
    } else if text.iter().any(u8::is_ascii_whitespace) {
        "put a comma between the items"
    } else if text.contains(&b'_') && text.iter().any(u8::is_ascii_digit) {
        "write the digits without `_` between them"
    } else if text.contains(&b'<') || text.contains(&b'>') {
        "write a parameter as `<name>`, with nothing around it"
    } else {
        "write digits with at most one point, and an exponent after `E` or `D`"
    }
}
