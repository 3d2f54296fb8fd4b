//! Whatever the bytes are, the deck gives them back, however they come in.

use inpact_parser::deck::{Keep, ScanOptions, Scanner, scan};
use inpact_parser::grammar::Grammar;
use inpact_parser::span::SourceId;
use inpact_parser::{json, model};
use proptest::prelude::*;

/// Bytes that look like a deck often enough to reach every branch.
fn deck_bytes() -> impl Strategy<Value = Vec<u8>> {
    let piece = prop_oneof![
        Just(b"*SURFACE INTERACTION, NAME=A".to_vec()),
        Just(b"*GAP ELECTRICAL CONDUCTANCE, DEPENDENCIES=6".to_vec()),
        Just(b"*CONTACT PERMEABILITY,".to_vec()),
        Just(b"CUTOFF GAP FILL=1.".to_vec()),
        Just(b"*GAP HEAT GENERATION".to_vec()),
        Just(b"*NODE".to_vec()),
        Just(b"*HEADING".to_vec()),
        Just(b"**".to_vec()),
        Just(b" ** x".to_vec()),
        Just(b"1., 2., 3".to_vec()),
        Just(b",,".to_vec()),
        Just(b"\"".to_vec()),
        Just(b"\n".to_vec()),
        Just(b"\r\n".to_vec()),
        Just(b"\r".to_vec()),
        Just(b"\xEF\xBB\xBF".to_vec()),
        Just(vec![b'7'; 300]),
        prop::collection::vec(any::<u8>(), 0..12),
    ];
    prop::collection::vec(piece, 0..40).prop_map(|pieces| pieces.concat())
}

proptest! {
    #[test]
    fn any_bytes_survive_scan_and_print(bytes in prop::collection::vec(any::<u8>(), 0..2000)) {
        prop_assert_eq!(scan("x", &bytes, Grammar::builtin()).print(SourceId::ROOT), bytes);
    }

    #[test]
    fn deck_like_bytes_survive_scan_and_print(bytes in deck_bytes()) {
        prop_assert_eq!(scan("x", &bytes, Grammar::builtin()).print(SourceId::ROOT), bytes);
    }

    #[test]
    fn pieces_of_any_size_give_the_same_deck(bytes in deck_bytes(), cuts in prop::collection::vec(1_usize..40, 1..60)) {
        for keep in [Keep::Everything, Keep::Interpreted] {
            let options = ScanOptions { grammar: Grammar::builtin(), keep };
            let mut whole = Scanner::new("x", options);
            whole.push(&bytes);
            let mut pieces = Scanner::new("x", options);
            let mut rest = &bytes[..];
            for cut in cuts.iter().cycle() {
                let (piece, after) = rest.split_at((*cut).min(rest.len()));
                pieces.push(piece);
                rest = after;
                if rest.is_empty() {
                    break;
                }
            }
            prop_assert_eq!(whole.finish(), pieces.finish());
        }
    }

    #[test]
    fn reading_never_fails_and_keeps_the_same_model(bytes in deck_bytes()) {
        let grammar = Grammar::builtin();
        let everything = scan("x", &bytes, grammar);
        let mut scanner = Scanner::new("x", ScanOptions { grammar, keep: Keep::Interpreted });
        scanner.push(&bytes);
        let interpreted = scanner.finish();
        let (full, full_problems) = model::read(&everything, grammar);
        let (lean, lean_problems) = model::read(&interpreted, grammar);
        // Compared as text: a cell that is no number is NaN, which equals nothing.
        prop_assert_eq!(format!("{full:?}{full_problems:?}"), format!("{lean:?}{lean_problems:?}"));
    }

    #[test]
    fn the_lossless_json_gives_the_bytes_back(bytes in deck_bytes()) {
        let grammar = Grammar::builtin();
        let text = json::syntax::write(&scan("x", &bytes, grammar), grammar);
        let files = json::syntax::read(&text, grammar);
        prop_assert_eq!(files, Ok(vec![("x".to_owned(), bytes)]));
    }
}
