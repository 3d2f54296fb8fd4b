//! C002: laws that user subroutines give.

use crate::parameter::{given, given_as};
use crate::rule::{Context, DefinedBlock, Report, declare_rule};
use inpact_parser::model::ElectricalConductance;
use inpact_parser::span::{SourceId, Span};
use std::collections::HashSet;

declare_rule! {
    /// A law of an interaction comes from a user subroutine.
    ///
    /// `USER` on *GAP ELECTRICAL CONDUCTANCE calls GAPELECTR, on *GAP CONDUCTANCE it calls GAPCON, and on *SURFACE INTERACTION it calls UINTER (VUINTER or VUINTERACTION in Abaqus/Explicit).
    ///
    /// Nothing is reported where something else is wrong with the law: rows or a table beside `USER`, ignored parameters.
    ///
    /// ## Why
    /// The deck is complete without the law, but nothing can be evaluated from the deck alone: the subroutine is a program of its own.
    ///
    /// ## What to do
    /// Give the subroutine to Abaqus with the deck.
    /// To evaluate the law by inpact, compile GAPELECTR with `gfortran -shared -fPIC -o gapelectr.so gapelectr.f` and name the library, `inpact eval --user-library gapelectr.so`; the laws of other subroutines have to be written as tables.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=WELD
    /// *GAP ELECTRICAL CONDUCTANCE, USER
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=WELD
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// ```
    "C002", "user-subroutine-needed", Note, fix: None, source: "U-3, 7.1, 7.2, K-05"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    // Beside rows or ignored parameters it is not clear yet that the subroutine is meant (T011, K011).
    let unclear: HashSet<_> = context.defined_blocks().filter(|block| is_unclear(context, *block)).map(start).collect();
    let mut say = |span: Span, subroutine: &str, law: &str| {
        if unclear.contains(&(span.source(), span.start())) {
            return;
        }
        report
            .at(span, format!("user subroutine {subroutine} gives {law}"))
            .label("not part of the deck")
            .note(match subroutine {
                "GAPELECTR" => "compiled to a shared library, it is evaluated with `--user-library FILE`",
                _ => "what this subroutine gives can be checked and not evaluated",
            });
    };
    for interaction in context.model.all_interactions() {
        let user = interaction.parameters.iter().find(|parameter| parameter.name == "USER");
        // With heat generation it is C004.
        if let Some(user) = user.filter(|_| interaction.gap_heat_generation.is_none()) {
            let subroutine = if user.value.is_some() { "VUINTERACTION" } else { "UINTER or VUINTER" };
            say(user.span, subroutine, "the interaction");
        }
        if let Some(span) = interaction.gap_electrical_conductance.as_deref().and_then(user_alone) {
            say(span, "GAPELECTR", "the electrical conductance");
        }
        let thermal = interaction.gap_conductance().filter(|thermal| thermal.tables.is_empty());
        for span in thermal.into_iter().flat_map(|thermal| thermal.users) {
            say(span, "GAPCON", "the thermal conductance");
        }
    }
}

/// The keyword line with USER, where there is no table beside it (C003).
fn user_alone(law: &ElectricalConductance) -> Option<Span> {
    law.user.filter(|_| law.clearance.is_none() && law.pressure.is_none())
}

/// Whether the block has an option that one of its parameters disables.
fn is_unclear(context: &Context<'_>, block: DefinedBlock<'_>) -> bool {
    let is_given = |name: &String| given_as(block, name).is_some();
    given(block).any(|parameter| parameter.definition.ignored_with.iter().any(is_given))
        || (block.definition.data.ignored_with.iter().any(is_given)
            && context.rows(block).next().is_some())
}

/// The start of the keyword line of a block.
fn start(block: DefinedBlock<'_>) -> (SourceId, u64) {
    (block.keyword.span.source(), block.keyword.span.start())
}
