//! Deck generator and benchmarks of inpact.
fn main() {}
