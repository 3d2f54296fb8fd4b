//! S018: ignore comments that silence nothing.

use crate::directives::Directive;
use crate::rule::{Context, Report, declare_rule};

declare_rule! {
    /// A comment for inpact silences nothing, or says something that inpact does not know.
    ///
    /// `** inpact: ignore T005, P008 -- reason` silences the rules it names for the next block: the next keyword line and the rows after it.
    ///
    /// ## Why
    /// A comment that was right once and silences nothing any more hides the next finding of that rule.
    ///
    /// ## What to do
    /// Take it away, or name the rule that is meant.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// ** inpact: ignore T005 -- measured from 100 MPa upwards
    /// *GAP HEAT GENERATION
    /// 1., 0.5
    /// ** inpact: ignore T999
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 10., 0.
    /// 20., 100.
    /// ** inpact: be quiet
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A
    /// ** inpact: ignore T005 -- measured from 100 MPa upwards
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 10., 100.
    /// 20., 200.
    /// ```
    "S018", "ignore-without-effect", Warning, fix: None, source: "none: a comment of inpact's own"
}

/// The findings come from [`report`], which runs when all other rules have been.
fn check(_: &Context<'_>, _: &mut Report<'_>) {}

/// Reports what the directives of a deck did not do.
pub(crate) fn report(directives: &[Directive], report: &mut Report<'_>) {
    for directive in directives {
        let ignore = match directive {
            Directive::Ignore(ignore) => ignore,
            Directive::Unknown(span) => {
                let found = report.at(*span, "comment for inpact that says nothing inpact knows");
                found.help("write `** inpact: ignore T005 -- reason`");
                continue;
            }
        };
        for code in ignore.codes.iter().filter(|code| !code.is_used) {
            if code.is_known() {
                let found = report.at(code.span, format!("`{}` is ignored here, but nothing brings it up", code.code));
                found.help("take it out: the next block has no such finding");
            } else {
                let found = report.at(code.span, format!("there is no rule `{}`", code.code));
                found.help("name a rule by its code, such as T005");
            }
        }
    }
}
