//! The interactions of a deck by name, in the order of the deck.
//!
//! An interaction holds its name already, so it is not stored a second time: a deck may have more interactions than anything else.

use super::{Interaction, Name};
use indexmap::IndexSet;
use indexmap::set::MutableValues;
use std::borrow::Borrow;
use std::hash::{Hash, Hasher};
use std::ops::Index;

/// Interactions by name, in the order of the deck; a later definition of a name replaces the earlier one in place.
#[derive(Debug, Clone, Default)]
pub struct Interactions {
    by_name: IndexSet<ByName>,
}

/// An interaction, known by its name alone.
#[derive(Debug, Clone)]
struct ByName(Interaction);

impl Hash for ByName {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.name.hash(state);
    }
}

impl PartialEq for ByName {
    fn eq(&self, other: &Self) -> bool {
        self.0.name == other.0.name
    }
}

impl Eq for ByName {}

impl Borrow<Name> for ByName {
    fn borrow(&self) -> &Name {
        &self.0.name
    }
}

impl Interactions {
    /// The number of interactions.
    pub fn len(&self) -> usize {
        self.by_name.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.by_name.is_empty()
    }

    /// The interaction of that name.
    pub fn get(&self, name: &Name) -> Option<&Interaction> {
        self.by_name.get(name).map(|of| &of.0)
    }

    /// Whether there is one of that name.
    pub fn contains_key(&self, name: &Name) -> bool {
        self.by_name.contains(name)
    }

    /// The interaction number `index`, counted from 0.
    pub fn get_index(&self, index: usize) -> Option<&Interaction> {
        self.by_name.get_index(index).map(|of| &of.0)
    }

    /// The number of the interaction of that name, counted from 0.
    pub fn get_index_of(&self, name: &Name) -> Option<usize> {
        self.by_name.get_index_of(name)
    }

    /// Appends an interaction, or replaces and returns the one of the same name.
    pub fn insert(&mut self, interaction: Interaction) -> Option<Interaction> {
        self.by_name.replace(ByName(interaction)).map(|of| of.0)
    }

    /// The interactions with their names.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (&Name, &Interaction)> + ExactSizeIterator + Clone {
        self.by_name.iter().map(|of| (&of.0.name, &of.0))
    }

    /// The names.
    pub fn keys(&self) -> impl DoubleEndedIterator<Item = &Name> + ExactSizeIterator + Clone {
        self.by_name.iter().map(|of| &of.0.name)
    }

    /// The interactions.
    pub fn values(&self) -> impl DoubleEndedIterator<Item = &Interaction> + ExactSizeIterator + Clone {
        self.by_name.iter().map(|of| &of.0)
    }

    /// The interactions, taken out.
    pub(super) fn into_values(self) -> impl Iterator<Item = Interaction> {
        self.by_name.into_iter().map(|of| of.0)
    }

    /// Mutable access to each interaction, whose name must not change.
    pub(super) fn for_each_mut(&mut self, mut change: impl FnMut(&mut Interaction)) {
        for index in 0..self.by_name.len() {
            if let Some(of) = self.by_name.get_index_mut2(index) {
                change(&mut of.0);
            }
        }
    }
}

/// Of several with the same name the last one is kept, in the place of the first.
impl FromIterator<Interaction> for Interactions {
    fn from_iter<I: IntoIterator<Item = Interaction>>(interactions: I) -> Self {
        let mut all = Self::default();
        for interaction in interactions {
            all.insert(interaction);
        }
        all
    }
}

impl PartialEq for Interactions {
    fn eq(&self, other: &Self) -> bool {
        self.len() == other.len() && self.iter().all(|(name, interaction)| other.get(name) == Some(interaction))
    }
}

impl Index<&Name> for Interactions {
    type Output = Interaction;

    fn index(&self, name: &Name) -> &Interaction {
        self.get(name).expect("an interaction of that name")
    }
}

impl Index<usize> for Interactions {
    type Output = Interaction;

    fn index(&self, index: usize) -> &Interaction {
        &self.by_name[index].0
    }
}

#[cfg(test)]
mod tests {
    use super::Interactions;
    use crate::model::{Interaction, Name};
    use crate::span::Span;

    #[test]
    fn a_later_interaction_takes_the_place_of_an_earlier_one() {
        let named = |name: &str, thickness: f64| Interaction {
            thickness,
            ..Interaction::new(Name::new(name), Span::default())
        };
        let mut interactions = Interactions::default();
        assert!(interactions.insert(named("A", 1.0)).is_none());
        assert!(interactions.insert(named("B", 2.0)).is_none());
        assert_eq!(interactions.insert(named("a", 3.0)).map(|earlier| earlier.thickness), Some(1.0));
        let found: Vec<_> = interactions.iter().map(|(name, of)| (name.written().to_owned(), of.thickness)).collect();
        assert_eq!(found, [("a".to_owned(), 3.0), ("B".to_owned(), 2.0)]);
        assert_eq!(interactions.get_index_of(&Name::new("b")), Some(1));
        assert!(!interactions.contains_key(&Name::new("C")));
    }
}
