//! Changes to a right deck: the kinds of spelling, order, names, numbers, rows and files that posted decks have.

mod cards;
mod heat;
mod includes;
mod names;
mod numbers;
mod parameters;
mod rows;

use crate::cubes::{Card, Cubes};
use crate::random::Random;

/// A kind of change: its name in the table, and what it does; it does nothing where the deck has no such card.
pub(crate) struct Change {
    pub(crate) name: &'static str,
    pub(crate) apply: fn(&mut Cubes, &mut Random),
}

/// Every kind.
pub(crate) fn all() -> Vec<&'static Change> {
    let groups = [
        parameters::CHANGES,
        cards::CHANGES,
        names::CHANGES,
        numbers::CHANGES,
        rows::CHANGES,
        heat::CHANGES,
        includes::CHANGES,
    ];
    groups.into_iter().flatten().collect()
}

/// The first card of a keyword, the pair among them.
fn card<'cubes>(cubes: &'cubes mut Cubes, of: &str) -> Option<&'cubes mut Card> {
    let Cubes { before, cards, pair, after, in_step, .. } = cubes;
    let mut all = before.iter_mut().chain(cards).chain(std::iter::once(pair)).chain(after).chain(in_step);
    all.find(|card| card.of == of)
}

/// Takes the first card of a keyword out of the interaction.
fn take(cubes: &mut Cubes, of: &str) -> Option<Card> {
    let place = cubes.cards.iter().position(|card| card.of == of)?;
    Some(cubes.cards.remove(place))
}

/// Writes other words into the keyword line of a card; gives whether it had the words.
fn reword(cubes: &mut Cubes, of: &str, from: &str, to: &str) -> bool {
    let Some(card) = card(cubes, of).filter(|card| card.line.contains(from)) else { return false };
    card.line = card.line.replacen(from, to, 1);
    true
}

/// Adds words to the keyword line of a card.
fn append(cubes: &mut Cubes, of: &str, parameters: &str) {
    if let Some(card) = card(cubes, of) {
        card.line += parameters;
    }
}

/// Replaces the rows of a card.
fn set_rows(cubes: &mut Cubes, of: &str, rows: &[&str]) {
    if let Some(card) = card(cubes, of) {
        card.rows = rows.iter().map(|row| (*row).to_owned()).collect();
    }
}

/// One of the keywords of the contact that the deck has.
fn any(cubes: &Cubes, random: &mut Random) -> &'static str {
    let of: Vec<&str> = cubes.cards.iter().map(|card| card.of).chain(["CONTACT PAIR"]).collect();
    random.of(&of)
}
