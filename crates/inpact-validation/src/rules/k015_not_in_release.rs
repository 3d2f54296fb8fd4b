//! K015: keywords and parameters that the release does not have.

use crate::rule::{Context, DefinedBlock, Report, declare_rule};
use inpact_parser::deck::{KeywordLine, Parameter, Resolved};
use inpact_parser::grammar::{Dialect, Keyword, Lookup, ParameterDefinition, Release, lookup_name};

declare_rule! {
    /// A keyword or a parameter is not in the release that the deck is for (`--release`).
    ///
    /// ## Why
    /// The release stops at a keyword or a parameter that it does not know.
    ///
    /// ## What to do
    /// Leave it out, or ask for the release that has it.
    ///
    /// ```inp,expect,release-2016
    /// *SURFACE INTERACTION, NAME=A
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.1, CUTOFF GAP FILL=0.1, CONSTRAINT METHOD=DIRECT
    /// ```
    ///
    /// ```inp,release-2017
    /// *SURFACE INTERACTION, NAME=A
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.1, CUTOFF GAP FILL=0.1, CONSTRAINT METHOD=DIRECT
    /// ```
    "K015", "not-in-release", Error, fix: None, source: "2.8"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let release = context.grammar.release();
    for keyword in context.keyword_lines() {
        let Some(entry) = keyword_of_other_release(context, keyword) else { continue };
        let bounds = entry.definition().map_or((None, None), |definition| (definition.since, definition.until));
        report
            .at(keyword.name(), format!("`*{}` is not in release {release}", entry.name))
            .label(since_until(bounds))
            .help("leave it out, or check for the release that has it with `--release`");
    }
    for block in context.defined_blocks().filter(|block| block.definition.parameters_complete) {
        for parameter in block.keyword.parameters() {
            let Some(known) = parameter_of_other_release(context, block, parameter) else { continue };
            let (name, keyword) = (&known.name, block.name);
            report
                .at(parameter.span(), format!("`{name}` of `*{keyword}` is not in release {release}"))
                .label(since_until((known.since, known.until)))
                .help("leave it out, or check for the release that has it with `--release`");
        }
    }
}

/// The keyword that a line would mean in another release of Abaqus.
///
/// Only a name in full counts: what a piece of a word would mean in another release says nothing.
pub(crate) fn keyword_of_other_release<'a>(context: &Context<'a>, keyword: &KeywordLine) -> Option<&'a Keyword> {
    let grammar = context.grammar;
    if keyword.resolved != Resolved::Unknown || grammar.dialect() != Dialect::Abaqus {
        return None;
    }
    grammar.id_of(&context.deck.shown(keyword.name())).map(|id| grammar.keyword(id))
}

/// The parameter that is meant, in full, when only another release of Abaqus has it.
pub(crate) fn parameter_of_other_release<'a>(
    context: &Context<'a>,
    block: DefinedBlock<'a>,
    parameter: Parameter,
) -> Option<&'a ParameterDefinition> {
    if parameter.resolved != Resolved::Unknown || context.grammar.dialect() != Dialect::Abaqus {
        return None;
    }
    let written = context.deck.text(parameter.name);
    let release = context.grammar.release();
    let is_meant = |known: &&ParameterDefinition| {
        !release.is_within(known.since, known.until)
            && matches!(lookup_name(written, [known.name.as_str()]), Lookup::Exact(_))
    };
    block.definition.parameters.iter().find(is_meant)
}

fn since_until(bounds: (Option<Release>, Option<Release>)) -> String {
    match bounds {
        (Some(since), None) => format!("came with {since}"),
        (None, Some(until)) => format!("went after {until}"),
        (Some(since), Some(until)) => format!("from {since} to {until}"),
        (None, None) => "not there".to_owned(),
    }
}
