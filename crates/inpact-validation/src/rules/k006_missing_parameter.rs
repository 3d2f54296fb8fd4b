//! K006: required parameters that are not given.

use crate::parameter::may_be_given;
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::grammar::{ParameterDefinition, ValueUse};

declare_rule! {
    /// A keyword line lacks a parameter that the keyword cannot do without.
    ///
    /// ## Why
    /// Abaqus refuses the line.
    /// A contact property without a name, for one, can be used nowhere.
    ///
    /// ## What to do
    /// Add the parameter.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION
    /// 1.,
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A
    /// 1.,
    /// ```
    "K006", "missing-parameter", Error, fix: None, source: "2.1"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for block in context.defined_blocks() {
        for required in block.definition.parameters.iter().filter(|parameter| parameter.required) {
            let is_alias = |other: &&ParameterDefinition| other.stands_for.as_ref() == Some(&required.name);
            let mut other_names = block.definition.parameters.iter().filter(is_alias);
            if may_be_given(context, block, &required.name)
                || other_names.any(|other| may_be_given(context, block, &other.name))
            {
                continue;
            }
            let name = &required.name;
            let example = if required.value_use() == ValueUse::Never { name.clone() } else { format!("{name}=…") };
            report
                .at(block.keyword.visible_span(context.deck), format!("`*{}` lacks its parameter `{name}`", block.name))
                .label(format!("`{name}` is required"))
                .note(format!("`{name}`: {}", required.description))
                .help(format!("add `{example}`"));
        }
    }
}
