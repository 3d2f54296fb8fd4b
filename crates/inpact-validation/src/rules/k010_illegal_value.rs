//! K010: values that a parameter must not have.

use crate::parameter::{GivenParameter, all_given, is_borrowed};
use crate::rule::{Context, Report, declare_rule};
use crate::suggestion::alternatives;
use inpact_parser::grammar::ParameterKind;

declare_rule! {
    /// A parameter has a value that is not legal: a number out of its bounds, or a word that it does not know.
    ///
    /// Words may be cut short as long as they begin one legal word only.
    ///
    /// ## Why
    /// Abaqus refuses the value.
    /// inpact reads no more than 1000 field variables: a larger DEPENDENCIES is taken for a slip.
    ///
    /// ## What to do
    /// Write a legal value; the message names them.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=-1
    /// 1.E6, 0.
    /// 3.E7, 1.E7
    /// ```
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.1, CUTOFF GAP FILL=0.2, CONSTRAINT METHOD=FOO
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.1, CUTOFF GAP FILL=0.2, CONSTRAINT METHOD=DIRECT
    /// ```
    "K010", "illegal-value", Error, fix: None, source: "Q-24, S-13"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for given in all_given(context).filter(|given| !is_borrowed(context, given.block)) {
        match given.definition.kind {
            ParameterKind::Choice => check_choice(context, &given, report),
            _ => check_bounds(context, &given, report),
        }
    }
}

fn check_choice(context: &Context<'_>, given: &GivenParameter<'_>, report: &mut Report<'_>) {
    let (Some(value), Some(text)) = (given.value(), given.text(context)) else { return };
    if given.definition.choice_named(&text).is_some() {
        return;
    }
    let (name, keyword) = (&given.definition.name, given.block.name);
    let shown = context.shown(value);
    let legal = alternatives(given.definition.choices.iter().map(String::as_str));
    report
        .at(value, format!("`{name}={shown}` of `*{keyword}` is not legal"))
        .label(format!("must be {legal}"))
        .help(format!("write {legal}"));
}

fn check_bounds(context: &Context<'_>, given: &GivenParameter<'_>, report: &mut Report<'_>) {
    let (Some(value), Some(Ok(number))) = (given.value(), given.number(context)) else { return };
    let Some(fault) = given.out_of_bounds(number) else { return };
    let (name, keyword) = (&given.definition.name, given.block.name);
    let shown = context.shown(value);
    report
        .at(value, format!("`{name}={shown}` of `*{keyword}` is {fault}"))
        .label(fault)
        .note(format!("`{name}`: {}", given.definition.description))
        .help("write a value within the bounds");
}
