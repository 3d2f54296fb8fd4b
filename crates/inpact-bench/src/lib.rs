//! Deck generator and benchmarks of inpact.
//!
//! The generator writes decks and node tables of any size for measurements and tests.
//! It knows the layout of decks and node tables, and uses none of the other crates: their input is
//! generated from the spec alone, so that their mistakes cannot hide in it.
//! The benchmarks measure the other crates.
//! The generator holds only the interfaces of a node table in memory, whatever the size of the output.
//! [`network`] generates networks of nodes, and measures how accurately and how fast they are solved.
//! [`bodies`] measures the cost of lumping bodies against one linear solution.
//! [`checking`] measures `check` on large decks of tables.
//! [`editing`] measures the language server as an editor sees it.
//! [`extremes`] runs the other crates on extreme numbers and writes the page of results.

pub mod bodies;
pub mod checking;
pub mod deck;
pub mod editing;
pub mod extremes;
pub mod interface;
pub mod mesh;
pub mod network;
pub mod nodes;
pub mod plate;
pub mod random;
pub mod size;
