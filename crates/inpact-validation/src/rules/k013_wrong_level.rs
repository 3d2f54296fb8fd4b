//! K013: keywords in a part of the deck where they may not occur.

use crate::placement::{runs, visible};
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::grammar::Level;
use inpact_parser::ProblemKind;

declare_rule! {
    /// A keyword is inside a *STEP, *PART, *INSTANCE or *ASSEMBLY, where it may not occur.
    ///
    /// ## Why
    /// In Abaqus/Standard contact properties are model data: they come before the first *STEP, and outside parts, instances and the assembly.
    /// Abaqus refuses them elsewhere.
    ///
    /// ## What to do
    /// Move the block before the first *STEP, and after *END ASSEMBLY when the deck has an assembly.
    ///
    /// ```inp,expect
    /// *STEP
    /// *STATIC
    /// 1., 1.
    /// *SURFACE INTERACTION, NAME=A
    /// 1.,
    /// *END STEP
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A
    /// 1.,
    /// *STEP
    /// *STATIC
    /// 1., 1.
    /// *END STEP
    /// ```
    "K013", "wrong-level", Error, fix: None, source: "S-71, S-73"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for run in runs(context, |kind| matches!(kind, ProblemKind::WrongLevel { .. })) {
        let ProblemKind::WrongLevel { keyword, level, opened_by } = run.first.kind else { continue };
        let entry = context.grammar.keyword(keyword);
        let allowed = entry.definition().map(|definition| &definition.levels[..]).unwrap_or_default();
        let found = report.at(run.first.span, format!("{} {}", run.subject(&entry.name), place(level)));
        found.label("not allowed here");
        if let Some(opened_by) = opened_by {
            found.also(visible(context, opened_by), format!("{} begins here", begin(level)));
        }
        let places: Vec<&str> = allowed.iter().map(|level| place(*level)).collect();
        found.note(format!("it may be {}", places.join(", ")));
        found.help(match (level, allowed.contains(&Level::Model)) {
            (Level::Step, true) => "move it before the first `*STEP`",
            (_, true) => "move it out of the part, instance or assembly, and before the first `*STEP`",
            (_, false) => "move it to where it is allowed",
        });
    }
}

fn place(level: Level) -> &'static str {
    match level {
        Level::Model => "outside of `*STEP`, `*PART`, `*INSTANCE` and `*ASSEMBLY`",
        Level::Part => "inside a `*PART`",
        Level::Instance => "inside an `*INSTANCE`",
        Level::Assembly => "inside the `*ASSEMBLY`",
        Level::Step => "inside a `*STEP`",
    }
}

fn begin(level: Level) -> &'static str {
    match level {
        Level::Model => "the model",
        Level::Part => "the part",
        Level::Instance => "the instance",
        Level::Assembly => "the assembly",
        Level::Step => "the step",
    }
}
