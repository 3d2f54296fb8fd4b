//! R004: surfaces that are named and not defined.

use crate::assembly::{Assembly, has_mesh, is_whole};
use crate::quantity::and_more;
use crate::references::{Definitions, missing, suggestion, uses_of_surfaces};
use crate::rule::{Context, DefinedBlock, Report, declare_rule};

declare_rule! {
    /// A contact pair or a property assignment names a surface that the deck does not define.
    ///
    /// Reported only in decks that define surfaces or a mesh, and that are complete: without files that could not be read, imported parts or a restart.
    /// Of a dotted name such as `Plate-1.Top` only the last part is looked for, since it may be defined inside the part.
    ///
    /// ## Why
    /// Abaqus stops: it does not know what is in contact.
    ///
    /// ## What to do
    /// Correct the name, or define the surface by *SURFACE.
    ///
    /// ```inp,expect
    /// *SURFACE, NAME=BAR-1
    /// BAR-ELEMENTS, S1
    /// *SURFACE, NAME=BAR-2
    /// LUG-ELEMENTS, S2
    /// *SURFACE INTERACTION, NAME=BUSBAR
    /// 1.,
    /// *CONTACT PAIR, INTERACTION=BUSBAR
    /// BAR-1, BAR-3
    /// ```
    ///
    /// ```inp
    /// *SURFACE, NAME=BAR-1
    /// BAR-ELEMENTS, S1
    /// *SURFACE, NAME=BAR-2
    /// LUG-ELEMENTS, S2
    /// *SURFACE INTERACTION, NAME=BUSBAR
    /// 1.,
    /// *CONTACT PAIR, INTERACTION=BUSBAR
    /// Bar-1, Lug-1.Bar-2
    /// ```
    "R004", "undefined-surface", Error, fix: None, source: "C-01, C-02, S-44"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let has_uses = uses_of_surfaces(context).next().is_some();
    if !has_uses || context.has_unread_files() || !says_what_its_surfaces_are(context) {
        return;
    }
    let definitions = Definitions::surfaces(context);
    let assembly = Assembly::of(context);
    let uses: Vec<_> = uses_of_surfaces(context).filter(|used| !assembly.has(&used.name, &definitions)).collect();
    for (index, (first, more)) in missing(&uses, &definitions).into_iter().enumerate() {
        let found = report.at(first.span, format!("surface `{}` is not defined", first.name));
        let more = and_more(more, "place names it", "places name it");
        found.label(format!("named by `*{}`", first.keyword));
        found.note(format!("a contact surface must be defined by `*SURFACE`{more}"));
        let define = || format!("define it: `*SURFACE, NAME={}`", first.name);
        let help = assembly.help(&first.name, &definitions).or_else(|| suggestion(&definitions, &first.name, index));
        found.help(help.unwrap_or_else(define));
    }
}

/// Whether the deck has surfaces or a mesh, and the whole of it.
fn says_what_its_surfaces_are(context: &Context<'_>) -> bool {
    let is_surface = |block: &DefinedBlock<'_>| block.name == "SURFACE";
    let surfaces = context.defined_blocks().filter(is_surface).count();
    // A *SURFACE without a name (K006) may be the one that is meant.
    surfaces == context.model.surfaces.len() && (surfaces > 0 || has_mesh(context)) && is_whole(context)
}
