//! Networks for measurements: random ones with their exact solutions, grids with one interface, and the page that says how exact the solvers are (docs/network.md).

pub mod accuracy;
pub mod exact;
pub mod grid;
pub mod plain;
pub mod random_networks;
pub mod run;
