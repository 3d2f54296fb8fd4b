//! A report on a deck: one self-contained HTML file about its interfaces that opens from an e-mail and needs no network.
//!
//! Its content is decided here, section by section; [`page`] makes HTML of it, in which nothing from a deck can run:
//! text is escaped, data is JSON that cannot close its element, and the content security policy allows two scripts only, by their hashes.
//! Charts are drawn by uPlot 1.6.32, whose built file and licence are in `uplot/`, unchanged from its registry package.

mod charts;
mod inputs;
mod interfaces;
mod page;

pub(crate) use inputs::Input;

use crate::chart::surface::Surface;
use crate::curves::Figure;
use crate::deck::Deck;
use crate::render::Format;
use crate::text::counted;
use inpact_diagnostics::{Diagnostic, Severity};
use page::Page;

pub(crate) struct Report<'a> {
    pub(crate) deck: &'a Deck,
    /// The findings of a check of it.
    pub(crate) findings: &'a [Diagnostic],
    pub(crate) figure: &'a Figure,
    /// The plan of an evaluation of a node table, and its results.
    pub(crate) evaluation: Option<Evaluation>,
    /// The input files.
    pub(crate) inputs: Vec<Input>,
    /// The command line arguments.
    pub(crate) command: String,
}

/// An evaluation of a node table in words.
#[derive(Default)]
pub(crate) struct Evaluation {
    /// The name of the node table.
    pub(crate) nodes: String,
    /// The plan, as printed by `inpact plan`.
    pub(crate) plan: String,
    /// The summary, as printed by `inpact eval`.
    pub(crate) summary: Vec<String>,
    /// Sums over the nodes of an interface at each time.
    pub(crate) histories: Vec<History>,
    /// The interfaces coloured by results, where their geometry is known.
    pub(crate) surfaces: Vec<Surface>,
    /// The cost of accuracy on these rows, where it was measured.
    pub(crate) tradeoff: Option<Tradeoff>,
}

/// A measurement of the cost of accuracy: its diagram, and the same as text.
pub(crate) struct Tradeoff {
    pub(crate) svg: String,
    pub(crate) text: String,
}

/// Sums of an output over the nodes of an interface, time by time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct History {
    pub(crate) interaction: String,
    /// The output, such as `ECDA`.
    pub(crate) output: String,
    /// Times and sums; a table without times has one sum without one.
    pub(crate) points: Vec<(Option<f64>, f64)>,
}

/// The minimum number of values of a curve, so that hovering finds one nearby.
pub(crate) const VALUES: usize = 48;

/// The curves of decks as a page, with nothing else.
pub(crate) fn page_of_curves(figures: &[Figure]) -> String {
    let decks: Vec<&str> = figures.iter().map(|figure| figure.deck.as_str()).collect();
    let mut page = Page::new(&decks.join(", "));
    page.open("main", &[]);
    page.element("h1", &[], &decks.join(", "));
    for (deck, figure) in figures.iter().enumerate() {
        page.element("h2", &[], &figure.deck);
        let is_same =
            |a: &crate::curves::Panel, b: &crate::curves::Panel| a.interaction == b.interaction && a.law == b.law;
        for (law, panels) in figure.panels.chunk_by(is_same).enumerate() {
            page.element("h3", &[], &format!("{}: {}", panels[0].interaction, panels[0].law.name()));
            charts::law(&mut page, &format!("law-{}-{}", deck + 1, law + 1), &panels.iter().collect::<Vec<_>>());
        }
        for note in &figure.notes {
            page.element("p", &[], note);
        }
    }
    page.finish()
}

/// The maximum number of findings shown in full.
const MAX_FINDINGS: usize = 200;

impl Report<'_> {
    pub(crate) fn html(&self) -> String {
        let mut page = Page::new(&format!("{}: contact interfaces", self.deck.name()));
        self.head(&mut page);
        self.interfaces(&mut page);
        self.findings(&mut page);
        self.evaluation(&mut page);
        self.reproduction(&mut page);
        page.finish()
    }

    fn head(&self, page: &mut Page) {
        page.open("header", &[]);
        page.element("h1", &[], self.deck.name());
        let model = self.deck.model();
        let interactions = model.interactions.len();
        let pairs: usize = model.contact_pairs.iter().map(|pair| pair.pairs.len()).sum();
        let count = |severity: Severity| self.findings.iter().filter(|found| found.severity == severity).count();
        let line = format!(
            "{}, {}; {}, {}, {}",
            counted_or_no(interactions, "surface interaction"),
            counted_or_no(pairs, "contact pair"),
            counted_or_no(count(Severity::Error), "error"),
            counted_or_no(count(Severity::Warning), "warning"),
            counted_or_no(count(Severity::Note), "note"),
        );
        page.element("p", &[], &line);
        page.open("nav", &[("aria-label", "Sections")]);
        page.open("ul", &[]);
        let mut sections = vec![("interfaces", "Interfaces"), ("findings", "Findings"), ("plan", "Plan")];
        sections.extend(self.evaluation.as_ref().map(|_| ("results", "Results")));
        let tradeoff = self.evaluation.as_ref().and_then(|evaluation| evaluation.tradeoff.as_ref());
        sections.extend(tradeoff.map(|_| ("tradeoff", "Speed for accuracy")));
        sections.push(("reproduction", "Inputs and versions"));
        for (id, title) in sections {
            page.open("li", &[]);
            page.element("a", &[("href", &format!("#{id}"))], title);
            page.close("li");
        }
        page.close("ul");
        page.close("nav");
        page.close("header");
        page.open("main", &[]);
    }

    fn findings(&self, page: &mut Page) {
        page.element("h2", &[("id", "findings")], "Findings");
        if self.findings.is_empty() {
            page.element("p", &[], "None.");
        }
        let rows = interfaces::row_places(self.deck.model());
        for (number, found) in self.findings.iter().take(MAX_FINDINGS).enumerate() {
            let class = format!("finding {}", found.severity.name());
            let id = format!("finding-{}", number + 1);
            page.open("article", &[("class", &class), ("id", &id)]);
            page.open("h3", &[]);
            page.element("span", &[("class", "word")], &format!("{} {}", found.severity.name(), found.code));
            page.text(&format!(" {}: {}", found.name, found.message));
            page.close("h3");
            if let Some(place) = rows.iter().find(|place| place.span.contains(found.primary.span)) {
                page.open("p", &[]);
                page.element("a", &[("href", &format!("#{}", place.id()))], &place.in_words());
                page.close("p");
            }
            page.element(
                "pre",
                &[("tabindex", "0")],
                self.deck.render(std::slice::from_ref(found), Format::Full).trim_end(),
            );
            if let Some(fix) = &found.fix {
                page.element("p", &[], &format!("Fix: {}", fix.title));
            }
            page.close("article");
        }
        if MAX_FINDINGS < self.findings.len() {
            let more = self.findings.len() - MAX_FINDINGS;
            page.element("p", &[], &format!("{more} more: see `inpact check`."));
        }
    }

    fn evaluation(&self, page: &mut Page) {
        page.element("h2", &[("id", "plan")], "Plan, and what is left out");
        for note in &self.figure.notes {
            page.element("p", &[], note);
        }
        let Some(evaluation) = &self.evaluation else {
            page.element("p", &[], "No node table was given: nothing was evaluated (`--nodes TABLE`).");
            return;
        };
        page.element("pre", &[("tabindex", "0")], evaluation.plan.trim_end());
        page.element("h2", &[("id", "results")], "Results");
        page.element("p", &[], &format!("Of the node table {}:", evaluation.nodes));
        page.element("pre", &[("tabindex", "0")], &evaluation.summary.join("\n"));
        charts::surfaces(page, &evaluation.surfaces);
        charts::histories(page, &evaluation.histories);
        if let Some(tradeoff) = &evaluation.tradeoff {
            page.element("h2", &[("id", "tradeoff")], "Speed for accuracy");
            page.open("figure", &[("class", "law")]);
            page.drawing(&tradeoff.svg);
            page.close("figure");
            page.element("pre", &[("tabindex", "0")], tradeoff.text.trim_end());
        }
    }

    fn reproduction(&self, page: &mut Page) {
        page.element("h2", &[("id", "reproduction")], "Inputs and versions");
        let grammar = self.deck.grammar();
        let language = match grammar.dialect() {
            inpact_parser::grammar::Dialect::Abaqus => format!("Abaqus {}", grammar.release()),
            inpact_parser::grammar::Dialect::Calculix => "CalculiX".to_owned(),
        };
        let versions =
            format!("inpact {}, charts by uPlot 1.6.32; keyword language of {language}", env!("CARGO_PKG_VERSION"));
        page.element("p", &[], &versions);
        page.element("pre", &[("tabindex", "0")], &self.command);
        page.table(&["file", "bytes", "SHA-256"], |page| {
            for input in &self.inputs {
                page.open("tr", &[]);
                page.element("td", &[("class", "text")], &input.name);
                page.element("td", &[], &input.bytes.map_or_else(|| "unknown".to_owned(), |bytes| bytes.to_string()));
                page.element("td", &[("class", "text")], input.hash.as_deref().unwrap_or("not a file that stays"));
                page.close("tr");
            }
        });
    }
}

/// `1 error`, `2 errors`, `no error`.
fn counted_or_no(count: usize, singular: &str) -> String {
    if count == 0 { format!("no {singular}") } else { counted(count, singular) }
}
