//! K004: parameters that a keyword does not have.

use super::k015_not_in_release::parameter_of_other_release;
use super::s005_unterminated_quote::open_quote;
use inpact_diagnostics::{Diagnostic, Edit, FixSafety, Severity};
use crate::invisible;
use crate::parameter::{self, GivenParameter, given_as};
use crate::rule::{Context, DefinedBlock, Report, declare_rule};
use crate::suggestion::{alternatives, did_you_mean};
use inpact_parser::deck::{Parameter, Resolved};
use inpact_parser::grammar::{Lookup, ParameterDefinition, ValueUse};

declare_rule! {
    /// A keyword line gives a parameter that the keyword does not have.
    ///
    /// Only keywords whose parameters inpact knows completely are looked at.
    ///
    /// ## Why
    /// Abaqus refuses a parameter that the keyword does not have.
    /// inpact leaves it out, so the rows may be read in another way than they are meant.
    ///
    /// ## What to do
    /// Correct the spelling.
    /// Where one name is near, a fix puts it in.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESURE
    /// 1.E6, 0.
    /// 1.E6, 1.
    /// 0., 2.
    /// ```
    ///
    /// ```inp,fixed
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// 1.E6, 1.
    /// 0., 2.
    /// ```
    "K004", "unknown-parameter", Error, fix: ChangesMeaning, source: "S-23"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for given in parameter::all_given(context) {
        if let Some(meant) = &given.definition.stands_for {
            say_other_name(report, &given, meant);
        }
    }
    for block in context.defined_blocks().filter(|block| block.definition.parameters_complete) {
        for parameter in block.keyword.parameters() {
            let is_cut = open_quote(context.deck.text(parameter.span())).is_some();
            let is_of_other_release = parameter_of_other_release(context, block, parameter).is_some();
            if parameter.resolved == Resolved::Unknown && !is_cut && !is_of_other_release {
                say(context, report, block, parameter);
            }
        }
    }
}

fn say(context: &Context<'_>, report: &mut Report<'_>, block: DefinedBlock<'_>, parameter: Parameter) {
    let keyword = block.name;
    if parameter.name.is_empty() {
        let value = context.shown(parameter.value.unwrap_or(parameter.name));
        let found = report.at(parameter.span(), format!("the value `{value}` of `*{keyword}` belongs to no parameter"));
        found.label("a name is missing before `=`").help("write the name of the parameter before `=`");
        soften(context, found);
        return;
    }
    let written = context.deck.text(parameter.name);
    if let Some(first) = invisible::first(written) {
        let plain = invisible::plain(written);
        let plain = plain.trim_ascii();
        if context.grammar.parameter_named(block.definition, plain) != Lookup::Unknown {
            let plain = String::from_utf8_lossy(plain).into_owned();
            report
                .at(first.span(parameter.name), format!("{} in the parameter `{plain}` of `*{keyword}`", first.name))
                .label("not what it looks like")
                .help(first.help())
                .fix(FixSafety::ChangesMeaning, format!("write `{plain}`"), vec![Edit::new(parameter.name, plain)]);
            return;
        }
    }
    let message = format!("`*{keyword}` has no parameter `{}`", context.shown(parameter.name));
    // A suggestion costs a comparison with every name, and a finding that is only counted shows none.
    if report.is_full() {
        soften(context, report.at(parameter.name, message));
        return;
    }
    let release = context.grammar.release();
    let is_there = |known: &&ParameterDefinition| release.is_within(known.since, known.until);
    let is_there_by_name = |name: &&str| block.definition.parameter(name).as_ref().is_some_and(is_there);
    let near = block.definition.nearest_parameters(&context.deck.shown(parameter.name), 3);
    let near: Vec<&str> = near.into_iter().filter(is_there_by_name).collect();
    let names = block.definition.parameters.iter().filter(is_there).map(|known| known.name.as_str());
    let help = did_you_mean(near.iter().copied()).unwrap_or_else(|| match alternatives(names) {
        names if names.is_empty() => "it has no parameters: take it away".to_owned(),
        names => format!("the keyword has {names}"),
    });
    let found = report.at(parameter.name, message);
    found.label("unknown parameter").help(help);
    soften(context, found);
    if let Some(meant) = only_candidate(block, parameter, &near) {
        found.fix(FixSafety::ChangesMeaning, format!("write `{meant}`"), vec![Edit::new(parameter.name, meant)]);
    }
}

/// A parameter that the keyword does not have, and that decks use for one that it has, which ran all the same.
fn say_other_name(report: &mut Report<'_>, given: &GivenParameter<'_>, meant: &str) {
    let (name, keyword) = (&given.definition.name, given.block.name);
    report
        .at(given.parameter.name, format!("`{name}` of `*{keyword}` is read as `{meant}`"))
        .severity(Severity::Note)
        .label("not in the manual")
        .note(given.definition.description.clone())
        .help(format!("write `{meant}`"))
        .fix(FixSafety::ChangesMeaning, format!("write `{meant}`"), vec![Edit::new(given.parameter.name, meant)]);
}

/// The one name that is near, when it is not given already and wants a value just as this one has it.
fn only_candidate<'a>(block: DefinedBlock<'_>, parameter: Parameter, near: &[&'a str]) -> Option<&'a str> {
    let [meant] = near else { return None };
    let fits = match block.definition.parameter(meant)?.value_use() {
        ValueUse::Never => parameter.value.is_none(),
        ValueUse::Always => parameter.value.is_some(),
        ValueUse::Optional => true,
    };
    (fits && given_as(block, meant).is_none()).then_some(meant)
}

/// CalculiX warns of a parameter that it does not know, and goes on without it (CX-04).
fn soften(context: &Context<'_>, found: &mut Diagnostic) {
    if context.is_for_calculix() {
        found.severity(Severity::Warning).note("CalculiX goes on without the parameter");
    }
}
