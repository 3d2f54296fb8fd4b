//! The command line of inpact.
fn main() {}
