//! Generated decks, streamed to a writer: one with a mesh and one of tables only.
//!
//! Both are valid by the spec, so that a check of them has nothing to report and a measurement of it
//! times the checking, not the reporting.
//! They are for measurements, not for solving: one deck holds the electrical and the pore law in every
//! interface, which no analysis needs together.

use std::io::{self, Write};

use crate::interface::Interface;
use crate::plate::{self, Plate};
use crate::size::{Counted, measure};

/// Parts of a deck besides its interactions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Content {
    /// Plates of elements with sets, surfaces, contact pairs and steps, `bytes` in all.
    Mesh {
        /// The size of the whole deck; it is met within 2 percent.
        bytes: u64,
    },
    /// Nothing: the size follows from the tables.
    Tables,
}

/// A deck to generate. Equal requests give equal bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DeckRequest {
    /// The parts besides the interactions.
    pub content: Content,
    /// Number of interactions.
    pub interactions: usize,
    /// Rows of each conductance table, two at least.
    pub rows: usize,
    /// The seed of all numbers.
    pub seed: u64,
}

impl DeckRequest {
    /// The interfaces of the deck, in deck order.
    pub fn interfaces(&self) -> impl Iterator<Item = Interface> + use<> {
        let Self { seed, rows, .. } = *self;
        (0..self.interactions).map(move |number| Interface::new(seed, number, rows))
    }
}

/// Writes the deck and gives its size in bytes.
///
/// # Errors
/// Those of the writer, and [`io::ErrorKind::InvalidInput`] where the interactions alone take more
/// than the size that was requested.
pub fn write(request: &DeckRequest, out: impl Write) -> io::Result<u64> {
    let mut out = Counted::new(out);
    match request.content {
        Content::Mesh { bytes } => write_meshed(request, bytes, &mut out)?,
        Content::Tables => write_tables(request, &mut out)?,
    }
    out.flush()?;
    Ok(out.bytes())
}

fn write_tables<W: Write>(request: &DeckRequest, out: &mut Counted<W>) -> io::Result<()> {
    write_heading(out, request)?;
    writeln!(out, "** INTERACTION PROPERTIES\n** ")?;
    for interface in request.interfaces() {
        write_interaction(out, &interface)?;
        write_conductances(out, &interface)?;
    }
    Ok(())
}

fn write_meshed<W: Write>(request: &DeckRequest, bytes: u64, out: &mut Counted<W>) -> io::Result<()> {
    let count = request.interactions + 1;
    let tail = measure(|out| write_tail(request, &vec![Plate::UNIT; count], out))?;
    let mut plates = Vec::with_capacity(count);
    write_heading(out, request)?;
    writeln!(out, "** PARTS\n**")?;
    for number in 0..count {
        let left = bytes.saturating_sub(out.bytes() + tail) / (count - number) as u64;
        // The lines of a part that do not depend on its plate take about 250 bytes.
        let plate = Plate::fitting(left.saturating_sub(250));
        plate::write_part(out, plate, number, request.seed)?;
        plates.push(plate);
        if out.bytes() + tail > bytes + bytes / 50 {
            let needed = (out.bytes() + tail).div_ceil(1000);
            return Err(io::Error::new(
                io::ErrorKind::InvalidInput,
                format!(
                    "{} interactions need more than {needed} kB, {} kB were requested",
                    request.interactions,
                    bytes / 1000
                ),
            ));
        }
    }
    write_tail(request, &plates, out)
}

fn write_heading(out: &mut impl Write, request: &DeckRequest) -> io::Result<()> {
    writeln!(out, "*Heading")?;
    writeln!(out, "{} generated contact interfaces, seed {}", request.interactions, request.seed)?;
    writeln!(out, "** Written by inpact-bench for measurements; SI units, temperatures in K\n**")
}

fn write_tail(request: &DeckRequest, plates: &[Plate], out: &mut impl Write) -> io::Result<()> {
    write_assembly(out, plates)?;
    out.write_all(MATERIAL.as_bytes())?;
    writeln!(out, "** INTERACTION PROPERTIES\n** ")?;
    for interface in request.interfaces() {
        write_interaction(out, &interface)?;
        write_mechanics(out, &interface)?;
        write_conductances(out, &interface)?;
        writeln!(out, "*Gap Heat Generation\n 1., {}", interface.slave_weight)?;
        write_permeability(out, &interface)?;
    }
    writeln!(out, "** \n** INTERACTIONS\n** ")?;
    for number in 1..=request.interactions {
        writeln!(out, "** Interaction: Int-{number}")?;
        writeln!(out, "*Contact Pair, interaction=IntProp-{number}, small sliding, type=SURFACE TO SURFACE")?;
        writeln!(out, "Top-{number}, Bottom-{}", number + 1)?;
    }
    out.write_all(STEPS.as_bytes())
}

fn write_assembly(out: &mut impl Write, plates: &[Plate]) -> io::Result<()> {
    writeln!(out, "**\n** ASSEMBLY\n**\n*Assembly, name=Assembly\n**  ")?;
    let mut height = 0.0;
    for (number, plate) in plates.iter().enumerate() {
        plate::write_instance(out, number, height)?;
        height += plate::height(*plate);
    }
    for (number, plate) in plates.iter().enumerate() {
        plate::write_surfaces(out, *plate, number)?;
    }
    writeln!(out, "*End Assembly")
}

fn write_interaction(out: &mut impl Write, interface: &Interface) -> io::Result<()> {
    writeln!(out, "*Surface Interaction, name={}\n1.,", interface.name)
}

fn write_mechanics(out: &mut impl Write, interface: &Interface) -> io::Result<()> {
    writeln!(out, "*Friction, slip tolerance=0.005\n {},", interface.friction)?;
    writeln!(out, "*Surface Behavior, pressure-overclosure=HARD")
}

fn write_conductances(out: &mut impl Write, interface: &Interface) -> io::Result<()> {
    let branches =
        [("", &interface.clearances, &interface.open), (", pressure", &interface.pressures, &interface.closed)];
    for (parameter, abscissae, values) in branches {
        writeln!(out, "*Gap Electrical Conductance{parameter}")?;
        let groups = values.chunks(abscissae.len()).zip(&interface.temperatures);
        for (group, temperature) in groups {
            for (value, abscissa) in group.iter().zip(abscissae) {
                writeln!(out, " {value:>18.12e}, {abscissa:>18.12e}, {temperature:>7.2}")?;
            }
        }
    }
    Ok(())
}

fn write_permeability(out: &mut impl Write, interface: &Interface) -> io::Result<()> {
    let Interface { cutoff_flow_across, cutoff_gap_fill, .. } = interface;
    writeln!(
        out,
        "*Contact Permeability, cutoff flow across={cutoff_flow_across:.6e}, cutoff gap fill={cutoff_gap_fill:.6e}"
    )?;
    for (value, pressure) in interface.permeabilities.iter().zip(&interface.pressures) {
        writeln!(out, " {value:>18.12e}, {pressure:>18.12e}")?;
    }
    Ok(())
}

/// Typical values of a low-alloy steel, in SI.
const MATERIAL: &str = "\
** 
** MATERIALS
** 
*Material, name=Steel
*Conductivity
50.,
*Density
7850.,
*Elastic
 2.1e+11, 0.3
*Electrical Conductivity
 5e+06,
*Expansion
 1.2e-05,
*Permeability, specific=9810.
 1e-12, 0.1
*Specific Heat
470.,
** 
";

/// One step for each field the interactions have a law for, both transient.
const STEPS: &str = "\
** ----------------------------------------------------------------
** 
** STEP: Current
** 
*Step, name=Current, nlgeom=NO, inc=1000, unsymm=YES
*Coupled Temperature-displacement, electrical, deltmx=50.
0.001, 1., 1e-06, 0.1
** 
** OUTPUT REQUESTS
** 
*Output, field, variable=PRESELECT
*Output, history, variable=PRESELECT
*End Step
** ----------------------------------------------------------------
** 
** STEP: Seepage
** 
*Step, name=Seepage, nlgeom=NO, inc=1000
*Soils, consolidation, end=PERIOD, utol=10000.
1., 86400., 0.1, 3600.
*Output, field, variable=PRESELECT
*Output, history, variable=PRESELECT
*End Step
";

#[cfg(test)]
mod tests {
    use super::*;

    fn request(content: Content) -> DeckRequest {
        DeckRequest { content, interactions: 5, rows: 20, seed: 1 }
    }

    fn text(request: &DeckRequest) -> String {
        let mut text = Vec::new();
        let bytes = write(request, &mut text).expect("a vector takes all");
        assert_eq!(bytes, text.len() as u64);
        String::from_utf8(text).expect("ASCII")
    }

    fn size(request: &DeckRequest) -> u64 {
        write(request, io::sink()).expect("a sink takes all")
    }

    #[test]
    fn a_meshed_deck_has_the_requested_size() {
        for (bytes, interactions) in [(100_000, 0), (200_000, 2), (1_000_000, 50), (1_500_000, 1)] {
            let request = DeckRequest { interactions, ..request(Content::Mesh { bytes }) };
            let deviation = size(&request) as f64 / bytes as f64 - 1.0;
            assert!(deviation.abs() < 0.02, "{bytes} bytes, {interactions} interactions: {deviation}");
        }
    }

    #[test]
    fn ten_thousand_interactions_of_a_hundred_rows_take_a_hundred_megabytes() {
        let hundredth = DeckRequest { interactions: 100, rows: 100, ..request(Content::Tables) };
        let deviation = size(&hundredth) as f64 / 1e6 - 1.0;
        assert!(deviation.abs() < 0.02, "{deviation}");
    }

    #[test]
    fn a_request_gives_the_same_bytes_again_and_another_seed_others() {
        for content in [Content::Mesh { bytes: 100_000 }, Content::Tables] {
            let first = request(content);
            assert_eq!(text(&first), text(&first));
            assert_ne!(text(&first), text(&DeckRequest { seed: 2, ..first }));
        }
    }

    #[test]
    fn a_deck_too_small_for_its_interactions_is_refused() {
        let error = write(&request(Content::Mesh { bytes: 10_000 }), io::sink()).expect_err("10 kB are too few");
        assert_eq!(error.kind(), io::ErrorKind::InvalidInput);
        assert!(error.to_string().starts_with("5 interactions need more than"), "{error}");
    }

    #[test]
    fn pairs_name_surfaces_and_interactions_that_exist() {
        let deck = text(&request(Content::Mesh { bytes: 200_000 }));
        for number in 1..=5 {
            for line in [
                format!("*Surface Interaction, name=IntProp-{number}"),
                format!("*Surface, type=ELEMENT, name=Top-{number}"),
                format!("*Surface, type=ELEMENT, name=Bottom-{}", number + 1),
                format!("Top-{number}, Bottom-{}", number + 1),
            ] {
                assert_eq!(deck.lines().filter(|found| *found == line).count(), 1, "{line}");
            }
        }
        assert!(deck.lines().all(|line| line.len() <= 256));
        let fields = deck.lines().filter(|line| line.starts_with(' ')).flat_map(|line| line.split(','));
        assert!(fields.map(str::trim).all(|field| field.len() <= 20));
    }
}
