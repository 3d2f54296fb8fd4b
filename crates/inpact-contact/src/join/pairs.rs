//! Maps contact pairs of a result file to those of the deck.
//!
//! Abaqus writes names of surfaces in capitals, with the assembly and the instance before them: `ASSEMBLY_PLATE-1_TOP` for `Plate-1.Top`.

use super::nodes::{ends_with_name, plain};
use inpact_parser::mesh::Mesh;
use inpact_parser::model::Name;
use inpact_results::Region;

/// The names of the surfaces of all pairs, in the order of the deck.
#[derive(Debug)]
pub(super) struct PairNames(Vec<[String; 2]>);

/// The pair of a region.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PairOf {
    /// This one.
    Pair(usize),
    /// The region is no pair.
    Unsaid,
    /// A pair that the deck does not have, or that could be several of its.
    Unknown,
}

/// The sides of a pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Slave,
    Master,
}

impl PairNames {
    pub(super) fn new(mesh: &Mesh) -> Self {
        let name = |surface: usize| plain(mesh.surfaces[surface].name.canonical());
        Self(mesh.pairs.iter().map(|pair| [name(pair.slave), name(pair.master)]).collect())
    }

    pub(super) fn of_region(&self, region: &Region) -> PairOf {
        let Some(slave) = &region.slave else { return PairOf::Unsaid };
        let fits = |[of_slave, of_master]: &[String; 2]| {
            is(of_slave, slave) && region.master.as_ref().is_none_or(|master| is(of_master, master))
        };
        let mut found = (0..self.0.len()).filter(|pair| fits(&self.0[*pair]));
        match (found.next(), found.next()) {
            (Some(pair), None) => PairOf::Pair(pair),
            _ => PairOf::Unknown,
        }
    }

    /// The pair of a surface, by its name; `None` where it belongs to none, or to several.
    pub(super) fn of_surface(&self, region: &Region) -> Option<(usize, Side)> {
        let name = region.set.as_ref()?;
        let sides = self.0.iter().enumerate().flat_map(|(pair, [slave, master])| {
            [(slave, Side::Slave), (master, Side::Master)].map(|(deck, side)| (deck, (pair, side)))
        });
        let mut found = sides.filter(|(deck, _)| is(deck, name)).map(|(_, found)| found);
        found.next().filter(|_| found.next().is_none())
    }
}

/// Whether a name in a result file is that of a surface of the deck.
fn is(deck: &str, file: &str) -> bool {
    ends_with_name(&plain(Name::new(file).canonical()), deck)
}
