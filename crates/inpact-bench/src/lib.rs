//! Deck generator and benchmarks of inpact.
//!
//! The generator writes decks and node tables of any size for measurements and tests.
//! It knows the layout of decks and node tables, and uses none of the other crates: what they read is
//! generated from the spec alone, so a mistake of theirs cannot hide in it.
//! The benchmarks measure the other crates.
//! The generator holds no more in memory than the interfaces of a node table, whatever the size of the output.
//! [`network`] makes networks of nodes, and measures how exact and how fast they are solved.
//! [`bodies`] measures what bodies take beside one linear solution.
//! [`checking`] measures `check` on large decks of tables.
//! [`editing`] measures the language server as an editor sees it.
//! [`extremes`] runs the other crates and writes the page of what they make of extreme numbers.

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
