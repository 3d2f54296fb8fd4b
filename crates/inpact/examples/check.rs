//! Checks a deck, shows what its fixes would change, and prints it as JSON.
//!
//! `cargo run -p inpact --example check -- joint.inp`; without a file it checks a deck of its own.

use inpact::{Deck, Error, Fixes, Format, ReadOptions};
use std::io::Write;

const JOINT: &str = "\
*SURFACE INTERACTION, NAME=JOINT
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
1000., 0.
  ** measured on the second of May
3000., 2.E7
2000., 1.E7
";

fn main() -> Result<(), Error> {
    let options = ReadOptions::new();
    let deck = match std::env::args_os().nth(1) {
        Some(path) => Deck::read(path, &options)?,
        None => Deck::parse("joint.inp", JOINT, &options.isolated())?,
    };
    report(&deck, &mut std::io::stdout())
}

fn report(deck: &Deck, output: &mut dyn Write) -> Result<(), Error> {
    let found = deck.check();
    let mut text = deck.render(&found, Format::Full);
    // The order of the rows changes what the deck means, and is mended only because it is asked for.
    let fixed = deck.fix(&Fixes::safe().also(["T001"]))?;
    text += &format!("{} of {} findings can be mended:\n", fixed.findings(), found.len());
    for file in fixed.files() {
        text += &file.difference();
    }
    text += &fixed.deck()?.to_json();
    // Whoever reads the output may stop reading.
    let _ = output.write_all(text.as_bytes());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_findings_are_mended() {
        let deck = Deck::parse("joint.inp", JOINT, &ReadOptions::new().isolated()).expect("a deck");
        let mut output = Vec::new();
        report(&deck, &mut output).expect("it is fixed");
        let text = String::from_utf8(output).expect("UTF-8");
        assert!(text.contains("2 of 2 findings can be mended"), "{text}");
        assert!(text.contains("+** measured on the second of May"), "{text}");
    }
}
