//! Decks that are cut, changed by chance, or come in small pieces: a mesh comes out, the same for any pieces, and never a panic.

use inpact_parser::deck::{Deck, scan};
use inpact_parser::grammar::Grammar;
use inpact_parser::mesh::{KeptRows, Mesh, RowBytes, read};
use inpact_parser::model;
use inpact_parser::span::Span;
use proptest::prelude::*;
use std::io;

/// One of everything that is read.
const DECK: &str = "*PART, NAME=PLATE
*NODE, NSET=ALL
1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 1.\n6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.
*NODE, SYSTEM=C
9, 1., 90., 0.
*ELEMENT, TYPE=C3D8RT, ELSET=SOLID
1, 1, 2, 3, 4,
 5, 6, 7, 8
*ELEMENT, TYPE=S4R, ELSET=SHEET
2, 1, 2, 3, 4
*ELSET, ELSET=SOME, GENERATE
1, 9, 4
*ELSET, ELSET=MORE
SOME, 3
*NSET, NSET=UPPER, GENERATE
5, 8, 1
*SURFACE, NAME=TOP
SOLID, S2
*SURFACE, NAME=SKIN
MORE
*SURFACE, NAME=POINTS, TYPE=NODE
UPPER, 0.25
9
*SHELL SECTION, ELSET=SHEET, MATERIAL=STEEL, OFFSET=0.25
0.1, 5
*SURFACE, NAME=SIDE
SHEET, SNEG
*END PART
*ASSEMBLY, NAME=A
*INSTANCE, NAME=ONE, PART=PLATE
*END INSTANCE
*INSTANCE, NAME=TWO, PART=PLATE
0., 0., 1.5
0., 0., 0., 0., 1., 0., 5.
*END INSTANCE
*ELSET, ELSET=BOTTOM, INSTANCE=TWO
SOLID
*SURFACE, NAME=BELOW
BOTTOM, S1
TWO.2, SPOS
*END ASSEMBLY
*SURFACE INTERACTION, NAME=GAP
*CONTACT PAIR, INTERACTION=GAP, TYPE=SURFACE TO SURFACE, ADJUST=0.01
BELOW, ONE.TOP
ONE.SKIN, BELOW
*CONTACT PAIR, INTERACTION=GAP, SMALL SLIDING
TWO.POINTS, ONE.SIDE
TWO.SIDE, A.BELOW
*CLEARANCE, SLAVE=TWO.SIDE, MASTER=A.BELOW, VALUE=0.1
";

fn mesh(text: &[u8], rows: impl for<'a> Fn(&'a Deck) -> Box<dyn RowBytes + 'a>) -> Mesh {
    let grammar = Grammar::builtin();
    let deck = scan("a.inp", text, grammar);
    let (model, _) = model::read(&deck, grammar);
    read(&deck, grammar, &model, &mut *rows(&deck)).expect("rows")
}

fn kept(deck: &Deck) -> Box<dyn RowBytes + '_> {
    Box::new(KeptRows(deck))
}

/// The kept rows in pieces of so many bytes.
struct Pieces<'deck>(&'deck Deck, usize);

impl RowBytes for Pieces<'_> {
    fn read(&mut self, span: Span, take: &mut dyn FnMut(&[u8])) -> io::Result<()> {
        self.0.text(span).chunks(self.1).for_each(take);
        Ok(())
    }
}

/// All of a mesh and of its pairs, as text: what is not a number is equal to itself there.
fn said(mesh: &Mesh) -> String {
    let contacts: Vec<String> = mesh.pairs.iter().map(|pair| format!("{:?}", mesh.contact(pair, 1.0))).collect();
    format!("{mesh:?} {contacts:?}")
}

#[test]
fn the_deck_itself_is_read() {
    let mesh = mesh(DECK.as_bytes(), kept);
    assert_eq!(mesh.notes, []);
    assert_eq!((mesh.surfaces.len(), mesh.pairs.len()), (7, 4));
    for pair in &mesh.pairs {
        assert!(!mesh.contact(pair, 1.0).expect("a geometry").is_empty());
    }
}

#[test]
fn pieces_of_any_size_give_the_same_mesh() {
    for ends in ["\n", "\r\n", "\r"] {
        let text = DECK.replace('\n', ends).into_bytes();
        let whole = said(&mesh(&text, kept));
        for size in (1..20).chain([100, 1000]) {
            assert_eq!(said(&mesh(&text, |deck| Box::new(Pieces(deck, size)))), whole, "{size} {ends:?}");
        }
    }
}

#[test]
fn a_deck_may_be_cut_anywhere() {
    for end in 0..DECK.len() {
        said(&mesh(&DECK.as_bytes()[..end], kept));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_deck_may_be_changed_anywhere(
        changes in prop::collection::vec((0..DECK.len(), 0..DECK.len(), 0_usize..40, prop::sample::select(b"0123456789.,-*=\n AES\"\xff".to_vec())), 1..8),
    ) {
        let mut text = DECK.as_bytes().to_vec();
        for (at, from, length, byte) in changes {
            let at = at.min(text.len() - 1);
            match length {
                0..8 => text[at] = byte,
                8..16 => drop(text.drain(at..(at + length).min(text.len() - 1))),
                _ => {
                    let copied = DECK.as_bytes()[from..(from + length).min(DECK.len())].to_vec();
                    drop(text.splice(at..at, copied));
                }
            }
        }
        let whole = said(&mesh(&text, kept));
        prop_assert_eq!(said(&mesh(&text, |deck| Box::new(Pieces(deck, 7)))), whole);
    }
}
