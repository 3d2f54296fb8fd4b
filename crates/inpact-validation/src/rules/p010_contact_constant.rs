//! P010: constants of contact that CalculiX refuses.

use inpact_parser::model::OptionKind;
use crate::constants::{behavior, constants};
use crate::quantity::number;
use crate::rule::{Context, DefinedBlock, Report, declare_rule};
use inpact_parser::span::Span;

declare_rule! {
    /// A constant of *FRICTION or of an exponential *SURFACE BEHAVIOR is one that CalculiX refuses.
    ///
    /// ## Why
    /// CalculiX stops at a coefficient of friction that is not above zero, in whatever row.
    /// So it does at an exponential law whose clearance is not above zero or whose pressure is negative.
    /// An empty item is 0.
    ///
    /// ## What to do
    /// Give a positive value, or leave *FRICTION out where there is none.
    ///
    /// ```inp,expect,calculix
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
    /// *FRICTION
    /// 0., 1.E7
    /// ```
    ///
    /// ```inp,expect,calculix
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL
    /// 0., 300.
    /// ```
    ///
    /// ```inp,calculix
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL
    /// 0.001, 300.
    /// *FRICTION
    /// 0.3, 1.E7
    /// ```
    "P010", "contact-constant", Error, fix: None, source: "CalculiX ccx 2.20, frictions.f and surfacebehaviors.f"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    if !context.is_for_calculix() {
        return;
    }
    for block in context.defined_blocks() {
        match block.kind() {
            OptionKind::Friction => {
                let refused = constants(context, block, 0).into_iter().find(|(_, value)| *value <= 0.0);
                say(context, report, (block, refused), "coefficient of friction", "above zero");
            }
            OptionKind::SurfaceBehavior if behavior(context, block) == Some("EXPONENTIAL") => {
                let first = |index| constants(context, block, index).into_iter().next();
                let clearance = first(0).filter(|(_, value)| *value <= 0.0);
                say(context, report, (block, clearance), "clearance of the exponential law", "above zero");
                let pressure = first(1).filter(|(_, value)| *value < 0.0);
                say(context, report, (block, pressure), "pressure of the exponential law", "zero or above");
            }
            _ => {}
        }
    }
}

fn say(
    context: &Context<'_>,
    report: &mut Report<'_>,
    (block, refused): (DefinedBlock<'_>, Option<(Span, f64)>),
    what: &str,
    must: &str,
) {
    let Some((place, value)) = refused else { return };
    report
        .at(place, format!("{what} {}: CalculiX stops", number(value)))
        .label(format!("must be {must}"))
        .also(context.trimmed(block.keyword.span), "the option")
        .help(format!("give a value that is {must}"));
}
