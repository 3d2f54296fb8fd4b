//! C007: cutoffs that are left to the element length.

use inpact_parser::model::OptionKind;
use crate::parameter::given_as;
use crate::rule::{Context, Report, declare_rule};
use crate::tables::has_unclear_parameters;

declare_rule! {
    /// *CONTACT PERMEABILITY gives only one of its two cutoffs, or none.
    ///
    /// ## Why
    /// A cutoff that is not given is the characteristic element length of the surfaces.
    /// The computation of that length by Abaqus is not documented, and it changes with the mesh.
    /// To evaluate the law by inpact the length must be given: by the column `char_length` or by `--char-length`.
    ///
    /// ## What to do
    /// Give `CUTOFF FLOW ACROSS` and `CUTOFF GAP FILL`, or the length when you evaluate.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=WALL
    /// *CONTACT PERMEABILITY, CUTOFF GAP FILL=0.01
    /// 1.E-9, 0.
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=WALL
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.002, CUTOFF GAP FILL=0.01
    /// 1.E-9, 0.
    /// ```
    "C007", "default-cutoff", Note, fix: None, source: "P-20, P-21"
}

const CUTOFFS: [&str; 2] = ["CUTOFF FLOW ACROSS", "CUTOFF GAP FILL"];

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for block in context.defined_blocks().filter(|block| block.kind() == OptionKind::ContactPermeability) {
        // A misspelt parameter (K004) may be a cutoff.
        if has_unclear_parameters(block.keyword) {
            continue;
        }
        let missing: Vec<String> =
            CUTOFFS.iter().filter(|name| given_as(block, name).is_none()).map(|name| format!("`{name}`")).collect();
        if missing.is_empty() {
            continue;
        }
        let message = format!("{} left to the characteristic element length", missing.join(" and "));
        report
            .at(context.trimmed(block.keyword.span), message)
            .label(if missing.len() == 1 { "one cutoff is not given" } else { "no cutoff is given" })
            .note("how Abaqus computes this length is not documented, and it changes with the mesh")
            .help("give both cutoffs, or the length when you evaluate: `--char-length`");
    }
}
