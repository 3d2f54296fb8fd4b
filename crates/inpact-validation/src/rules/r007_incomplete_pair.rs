//! R007: contact pairs without both surfaces, in decks for CalculiX.

use crate::rule::{Context, Report, declare_rule};
use inpact_parser::span::Span;

declare_rule! {
    /// A *CONTACT PAIR of a deck for CalculiX lacks its rows, its slave or its master surface.
    ///
    /// ## Why
    /// CalculiX stops: it has no contact of a surface with itself, and a pair must name a slave and a master.
    ///
    /// ## What to do
    /// Name both surfaces in one row, the slave first.
    ///
    /// ```inp,expect,calculix
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
    /// *CONTACT PAIR, INTERACTION=JOINT, TYPE=SURFACE TO SURFACE
    /// BAR-1
    /// ```
    ///
    /// ```inp,calculix
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
    /// *CONTACT PAIR, INTERACTION=JOINT, TYPE=SURFACE TO SURFACE
    /// BAR-1, BAR-2
    /// ```
    "R007", "incomplete-pair", Error, fix: None, source: "CX-07"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    if !context.is_for_calculix() {
        return;
    }
    let has_unread_files = context.has_unread_files();
    for block in context.defined_blocks().filter(|block| block.name == "CONTACT PAIR") {
        let keyword = context.trimmed(block.keyword.span);
        let mut rows = 0;
        for line in context.rows(block) {
            rows += 1;
            let mut names = line.items().take(2);
            let lacking = ["slave", "master"].into_iter().find(|_| names.next().is_none_or(Span::is_empty));
            let Some(lacking) = lacking else { continue };
            report
                .at(context.trimmed(line.span), format!("contact pair without a {lacking} surface"))
                .label("CalculiX stops here")
                .also(keyword, "the pair")
                .help("write `SLAVE, MASTER`");
        }
        if rows == 0 && !has_unread_files {
            report
                .at(keyword, "contact pair without surfaces")
                .label("a row should follow")
                .help("write `SLAVE, MASTER` after it");
        }
    }
}
