//! Grids of nodes of any size with one interface.

use crate::random::Random;
use inpact_network::linear::{LinearNetwork, Link};
use std::io::{self, Write};

/// A grid of unit conductances, jittered from 0.5 to 2, with an interface plane halfway along its first direction and held values at both ends.
#[derive(Debug, Clone, Copy)]
pub struct Grid {
    /// Nodes along each direction; 1 in the third is a plane grid.
    pub size: [u32; 3],
    /// The factor of the conductances of the interface; zero and infinity are allowed.
    pub contrast: f64,
}

impl Grid {
    /// The number of nodes without a held value.
    pub fn free(self) -> u32 {
        self.size.iter().product()
    }

    /// The network of the grid; the two held nodes, at 100 and 50, are the last.
    pub fn network(self) -> LinearNetwork {
        let [nx, ny, nz] = self.size;
        let free = self.free();
        let mut network = LinearNetwork::of_nodes(free as usize + 2);
        network.held[free as usize] = Some(100.0);
        network.held[free as usize + 1] = Some(50.0);
        network.links.reserve(3 * free as usize);
        let mut random = Random::new(1);
        let mut join = |a: u32, b: u32, factor: f64| {
            network.links.push(Link { nodes: [a, b], conductance: random.between(0.5, 2.0) * factor });
        };
        let number = |x: u32, y: u32, z: u32| x + nx * (y + ny * z);
        for z in 0..nz {
            for y in 0..ny {
                for x in 0..nx {
                    let here = number(x, y, z);
                    if x + 1 < nx {
                        join(here, number(x + 1, y, z), if x + 1 == nx / 2 { self.contrast } else { 1.0 });
                    }
                    if y + 1 < ny {
                        join(here, number(x, y + 1, z), 1.0);
                    }
                    if z + 1 < nz {
                        join(here, number(x, y, z + 1), 1.0);
                    }
                }
                join(number(0, y, z), free, 1.0);
                join(number(nx - 1, y, z), free + 1, 1.0);
            }
        }
        network
    }
}

/// The plainly assembled matrix of a network's free nodes, for other solvers.
///
/// The held nodes of the network are its last.
#[derive(Debug)]
pub struct Assembled {
    /// The diagonal.
    pub diagonal: Vec<f64>,
    /// Row, column and value below the diagonal.
    pub below: Vec<(usize, usize, f64)>,
    /// The flow from the held nodes into each free one at zero.
    pub right: Vec<f64>,
}

impl Assembled {
    /// Assembles a network.
    pub fn of(network: &LinearNetwork) -> Self {
        let free = network.held.iter().take_while(|held| held.is_none()).count();
        let mut assembled = Self { diagonal: vec![0.0; free], below: Vec::new(), right: vec![0.0; free] };
        for Link { nodes, conductance } in &network.links {
            let ends = nodes.map(|node| node as usize);
            for [end, other] in [ends, [ends[1], ends[0]]] {
                if end < free {
                    assembled.diagonal[end] += conductance;
                    assembled.right[end] += network.held[other].map_or(0.0, |held| conductance * held);
                }
            }
            if ends.iter().all(|end| *end < free) {
                assembled.below.push((ends[0].max(ends[1]), ends[0].min(ends[1]), -conductance));
            }
        }
        assembled
    }

    /// Writes the lower triangle in Matrix Market form.
    ///
    /// # Errors
    /// Those of writing.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let free = self.diagonal.len();
        writeln!(out, "%%MatrixMarket matrix coordinate real symmetric")?;
        writeln!(out, "{free} {free} {}", free + self.below.len())?;
        for (node, value) in self.diagonal.iter().enumerate() {
            writeln!(out, "{0} {0} {value:?}", node + 1)?;
        }
        for (row, column, value) in &self.below {
            writeln!(out, "{} {} {value:?}", row + 1, column + 1)?;
        }
        Ok(())
    }
}
