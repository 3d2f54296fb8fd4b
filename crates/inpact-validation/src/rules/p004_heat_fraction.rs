//! P004: fractions of dissipated energy below 0 or above 1.

use crate::heat::items;
use inpact_diagnostics::Severity;
use crate::quantity::number;
use crate::rule::{Context, Report, declare_rule};

declare_rule! {
    /// The first item of *GAP HEAT GENERATION is below 0, an error, or above 1, a note.
    ///
    /// It is the fraction of the dissipated energy that becomes heat.
    ///
    /// ## Why
    /// A negative fraction would cool the interface by friction.
    /// A fraction above 1 is legal: it may hold the factor between the units of energy and of heat.
    ///
    /// ## What to do
    /// Correct a negative value; check that a value above 1 is a factor between units.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=BRAKE
    /// *FRICTION
    /// 0.3,
    /// *GAP HEAT GENERATION
    /// -0.9, 0.5
    /// ```
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=BRAKE
    /// *FRICTION
    /// 0.3,
    /// *GAP HEAT GENERATION
    /// 9.8, 0.5
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=BRAKE
    /// *FRICTION
    /// 0.3,
    /// *GAP HEAT GENERATION
    /// 0.9, 0.5
    /// ```
    "P004", "heat-fraction", Error, fix: None, source: "K-35, Q-13"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for (place, fraction) in items(context, 0) {
        // CalculiX refuses zero, which an empty item is there (CX-10).
        if context.is_for_calculix() && fraction == 0.0 {
            report
                .at(place, "heat fraction 0: CalculiX stops")
                .label("the fraction of the dissipated energy that becomes heat")
                .note("CalculiX wants a fraction above zero, and reads an empty item as 0")
                .help("give a value above 0, or take `*GAP HEAT GENERATION` out");
        } else if fraction < 0.0 {
            report
                .at(place, format!("heat fraction {} is negative", number(fraction)))
                .label("the fraction of the dissipated energy that becomes heat")
                .note("a negative fraction would cool the interface by what it dissipates")
                .help("give a value from 0 to 1");
        } else if fraction > 1.0 {
            report
                .at(place, format!("heat fraction {} is above 1", number(fraction)))
                .severity(Severity::Note)
                .label("the fraction of the dissipated energy that becomes heat")
                .note("a value above 1 makes sense only as a factor between the units of energy and of heat")
                .help("check the units, or give a value from 0 to 1");
        }
    }
}
