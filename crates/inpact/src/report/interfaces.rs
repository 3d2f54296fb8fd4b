//! The interfaces of a deck: the uses of each interaction, its content, its tables row by row, its curves.

use super::page::Page;
use super::{Report, charts};
use crate::curves::{LawKind, Panel, number};
use crate::text::counted;
use inpact_parser::model::{Interaction, Model, TableOf};
use inpact_parser::span::Span;

/// The maximum number of rows of a table shown.
const MAX_ROWS: usize = 200;

/// The maximum number of lines of another option.
const MAX_LINES: usize = 20;

/// The maximum number of interactions with a separate section.
const MAX_INTERACTIONS: usize = 400;

/// The location of a row of a table, in the deck and on the page.
pub(super) struct RowPlace {
    pub(super) span: Span,
    interaction: usize,
    table: usize,
    row: usize,
    name: String,
}

impl RowPlace {
    pub(super) fn id(&self) -> String {
        format!("row-{}-{}-{}", self.interaction + 1, self.table + 1, self.row + 1)
    }

    pub(super) fn in_words(&self) -> String {
        format!("row {} of a table of {}", self.row + 1, self.name)
    }
}

/// The rows of all tables that the page shows.
pub(super) fn row_places(model: &Model) -> Vec<RowPlace> {
    let interactions = model.interactions.values().take(MAX_INTERACTIONS).enumerate();
    let places = interactions.flat_map(|(interaction, of)| {
        let name = of.name.written().to_owned();
        of.tables().into_iter().enumerate().flat_map(move |(table, of)| {
            let name = name.clone();
            let rows = of.table.row_spans().take(MAX_ROWS).enumerate();
            rows.map(move |(row, span)| RowPlace { span, interaction, table, row, name: name.clone() })
                .collect::<Vec<_>>()
        })
    });
    places.collect()
}

impl Report<'_> {
    pub(super) fn interfaces(&self, page: &mut Page) {
        let model = self.deck.model();
        page.element("h2", &[("id", "interfaces")], "Interfaces");
        if model.interactions.is_empty() {
            page.element("p", &[], "The deck defines no *SURFACE INTERACTION.");
        }
        for (number, interaction) in model.interactions.values().take(MAX_INTERACTIONS).enumerate() {
            self.interaction(page, number, interaction);
        }
        if MAX_INTERACTIONS < model.interactions.len() {
            let more = model.interactions.len() - MAX_INTERACTIONS;
            page.element(
                "p",
                &[],
                &format!("{more} more interactions are not shown: choose some with `--interaction`."),
            );
        }
    }

    fn interaction(&self, page: &mut Page, number: usize, interaction: &Interaction) {
        let model = self.deck.model();
        let name = interaction.name.written();
        page.open("section", &[("aria-labelledby", &format!("interaction-{}", number + 1))]);
        page.element("h3", &[("id", &format!("interaction-{}", number + 1))], name);
        page.open("ul", &[]);
        for line in uses(model, interaction).into_iter().chain(options(interaction)) {
            page.element("li", &[], &line);
        }
        page.close("ul");
        for kind in LawKind::ALL {
            let of_law = |panel: &&Panel| panel.interaction == name && panel.law == kind;
            let panels: Vec<&Panel> = self.figure.panels.iter().filter(of_law).collect();
            if panels.is_empty() {
                continue;
            }
            let title = kind.name();
            page.element("h4", &[], &format!("{}{}, *{}", title[..1].to_uppercase(), &title[1..], kind.keyword()));
            charts::law(page, &format!("law-{}-{}", number + 1, kind as usize + 1), &panels);
        }
        for (table, of) in interaction.tables().into_iter().enumerate() {
            rows(page, &of, (number, table));
        }
        page.close("section");
    }
}

fn uses(model: &Model, interaction: &Interaction) -> Vec<String> {
    /// The maximum number of pairs named.
    const MOST: usize = 20;
    let pairs = model
        .contact_pairs
        .iter()
        .filter(|pair| pair.interaction.as_ref().is_some_and(|reference| reference.name == interaction.name));
    let pairs = pairs.flat_map(|pair| &pair.pairs).map(|pair| match &pair.master {
        Some(master) => format!("slave {}, master {}", pair.slave.name, master.name),
        None => format!("{} in contact with itself", pair.slave.name),
    });
    let assigned = model.property_assignments.iter().filter(|assignment| {
        assignment.interaction.as_ref().is_some_and(|reference| reference.name == interaction.name)
    });
    let assigned = assigned.map(|_| "assigned by *CONTACT PROPERTY ASSIGNMENT".to_owned());
    let all: Vec<String> = pairs.chain(assigned).collect();
    let more = all.len().saturating_sub(MOST);
    let mut uses: Vec<String> = all.into_iter().take(MOST).collect();
    if 0 < more {
        uses.push(format!("and {more} more"));
    }
    if uses.is_empty() {
        uses.push("used by no contact pair of the deck".to_owned());
    }
    uses
}

/// The options of the interaction besides its tables.
fn options(interaction: &Interaction) -> Vec<String> {
    let mut options = Vec::new();
    if interaction.thickness != 1.0 {
        options.push(format!("thickness {}", number(interaction.thickness)));
    }
    options.extend(interaction.parameters.iter().map(|given| match &given.value {
        Some(value) => format!("{}={value}", given.name),
        None => given.name.to_string(),
    }));
    if let Some(permeability) = &interaction.contact_permeability {
        let cutoffs = [
            ("CUTOFF FLOW ACROSS", permeability.cutoff_flow_across),
            ("CUTOFF GAP FILL", permeability.cutoff_gap_fill),
        ];
        let cutoffs = cutoffs.into_iter().filter_map(|(name, cutoff)| Some(format!("{name}={}", number(cutoff?))));
        let cutoffs: Vec<String> = cutoffs.collect();
        options.push(format!("*CONTACT PERMEABILITY {}", cutoffs.join(", ")).trim_end().to_owned());
    }
    if let Some(heat) = &interaction.gap_heat_generation {
        let (fraction, weight) = (number(heat.fraction), number(heat.slave_weight));
        options.push(format!("*GAP HEAT GENERATION: fraction {fraction}, of which the slave takes {weight}"));
    }
    for option in &interaction.other {
        let parameters = option.parameters.iter().map(|given| match &given.value {
            Some(value) => format!(", {}={value}", given.name),
            None => format!(", {}", given.name),
        });
        let head = format!("*{}{}", option.keyword, parameters.collect::<String>());
        let lines: Vec<String> = option.rows.iter().take(MAX_LINES).map(|row| row.join(", ")).collect();
        let more = if MAX_LINES < option.rows.iter().count() { "; …" } else { "" };
        let rows = if lines.is_empty() { String::new() } else { format!(": {}{more}", lines.join("; ")) };
        options.push(head + &rows);
    }
    options
}

/// A table row by row, as in the deck.
fn rows(page: &mut Page, of: &TableOf<'_>, (interaction, table): (usize, usize)) {
    let count = of.table.row_count();
    page.open("details", &[]);
    let against = of.table.columns.get(1).map_or("", String::as_str);
    page.element("summary", &[], &format!("*{} against {against}: {}", of.keyword, counted(count, "row")));
    let titles: Vec<&str> = std::iter::once("row").chain(of.table.columns.iter().map(String::as_str)).collect();
    page.table(&titles, |page| {
        for (row, cells) in of.table.row_values().take(MAX_ROWS).enumerate() {
            page.open("tr", &[("id", &format!("row-{}-{}-{}", interaction + 1, table + 1, row + 1))]);
            page.element("td", &[], &(row + 1).to_string());
            for (column, cell) in cells.iter().enumerate() {
                let index = row * of.table.width() + column;
                let text = of.table.texts.iter().find(|text| text.cell == index).map(|text| text.text.clone());
                page.element("td", &[], &text.unwrap_or_else(|| number(*cell)));
            }
            page.close("tr");
        }
    });
    if MAX_ROWS < count {
        page.element("p", &[], &format!("{} more rows.", count - MAX_ROWS));
    }
    page.close("details");
}
