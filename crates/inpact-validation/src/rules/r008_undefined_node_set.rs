//! R008: node sets that `ADJUST` names and the deck does not define.

use crate::assembly::defines_its_mesh;
use crate::parameter::given;
use crate::references::components;
use crate::rule::{Context, Report, declare_rule};
use crate::suggestion::did_you_mean;
use inpact_parser::deck::{KeywordLine, Parameter};
use inpact_parser::grammar::{Dialect, nearest_names};
use inpact_parser::model::Name;
use inpact_parser::number::{read_float, read_fortran};

declare_rule! {
    /// `ADJUST` of a *CONTACT PAIR names a node set that the deck does not define.
    ///
    /// The value of `ADJUST` is a distance where it reads as a number, and the name of a set otherwise.
    /// Reported only in decks that define nodes, and that are complete: without files that could not be read, imported parts or a restart.
    /// Of a dotted name such as `Plate-1.Top` only the last part is looked for.
    ///
    /// ## Why
    /// Abaqus and CalculiX stop: they do not know which nodes to move onto the master surface.
    ///
    /// ## What to do
    /// Correct the name, define the set by *NSET, or give a distance.
    ///
    /// ```inp,expect
    /// *NODE, NSET=TOP
    /// 1, 0., 0., 0.
    /// *SURFACE, NAME=BAR-1
    /// BAR-ELEMENTS, S1
    /// *SURFACE, NAME=BAR-2
    /// LUG-ELEMENTS, S2
    /// *SURFACE INTERACTION, NAME=BUSBAR
    /// 1.,
    /// *CONTACT PAIR, INTERACTION=BUSBAR, ADJUST=TOPP
    /// BAR-1, BAR-2
    /// ```
    ///
    /// ```inp
    /// *NODE, NSET=TOP
    /// 1, 0., 0., 0.
    /// *SURFACE, NAME=BAR-1
    /// BAR-ELEMENTS, S1
    /// *SURFACE, NAME=BAR-2
    /// LUG-ELEMENTS, S2
    /// *SURFACE INTERACTION, NAME=BUSBAR
    /// 1.,
    /// *CONTACT PAIR, INTERACTION=BUSBAR, ADJUST=Top
    /// BAR-1, BAR-2
    /// *CONTACT PAIR, INTERACTION=BUSBAR, ADJUST=0.01
    /// BAR-2, BAR-1
    /// ```
    "R008", "undefined-node-set", Error, fix: None, source: "C-02; CalculiX ccx 2.20, contactpairs.f"
}

/// The keywords that define node sets beside their own work, and the parameters that name them.
const DEFINING: [(&str, &str); 6] =
    [("NODE", "NSET"), ("NSET", "NSET"), ("NGEN", "NSET"), ("NFILL", "NSET"), ("NMAP", "NSET"), ("NCOPY", "NEWSET")];

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let pairs = context.defined_blocks().filter(|block| block.name == "CONTACT PAIR");
    let adjusted = pairs.flat_map(given).filter(|given| given.definition.name == "ADJUST");
    let named = adjusted.filter_map(|given| given.value()).filter(|value| {
        let text = context.value(*value);
        let is_number = match context.grammar.dialect() {
            Dialect::Abaqus => read_float(text.as_bytes()).is_ok(),
            Dialect::Calculix => read_fortran(text.as_bytes()).is_ok(),
        };
        // A `<parameter>` without a value has a finding of its own (S015).
        !is_number && !text.contains('<')
    });
    let named: Vec<_> = named.collect();
    if named.is_empty() || context.has_unread_files() || !defines_its_mesh(context) {
        return;
    }
    let sets: Vec<Name> = context.keyword_lines().flat_map(|line| sets_of(context, line)).collect();
    for value in named {
        let name = context.name(value);
        let last = match context.grammar.dialect() {
            Dialect::Abaqus => components(&name).pop(),
            Dialect::Calculix => None,
        };
        if sets.contains(last.as_ref().unwrap_or(&name)) {
            continue;
        }
        let near = nearest_names(name.canonical().as_bytes(), sets.iter().map(Name::canonical), 3);
        report
            .at(value, format!("node set `{name}` is not defined"))
            .label("named by `ADJUST`")
            .note("`ADJUST` gives a distance, or the node set whose nodes are moved onto the master surface")
            .help(did_you_mean(near).unwrap_or_else(|| format!("define it: `*NSET, NSET={name}`")));
    }
}

/// The node sets that a keyword line defines.
fn sets_of<'a>(context: &Context<'a>, line: &'a KeywordLine) -> impl Iterator<Item = Name> {
    let keyword = line.id().map_or("", |id| context.grammar.keyword(id).name.as_str());
    let defining = DEFINING.iter().find(|(name, _)| *name == keyword);
    let is_name = move |parameter: Parameter| {
        let written = context.deck.text(parameter.name).iter().filter(|byte| !byte.is_ascii_whitespace());
        let written: Vec<u8> = written.map(u8::to_ascii_uppercase).collect();
        defining.is_some_and(|(_, of)| written == of.as_bytes())
    };
    let values = line.parameters().filter_map(move |parameter| parameter.value.filter(|_| is_name(parameter)));
    values.map(|value| context.name(value)).collect::<Vec<_>>().into_iter()
}
