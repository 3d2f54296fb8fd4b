//! The fuzz targets on a fixed set of inputs, without libFuzzer: every seed as it is, then seeds changed by chance.
//!
//! Chance begins at the same number in every run, so a failure comes back; the message gives the input.
//! The seeds are those of `fuzz/seeds` and the sample decks; the words that are put in are those of `fuzz/*.dict`.

#[path = "../fuzz/src/lib.rs"]
#[expect(unreachable_pub, reason = "the same file is the library of the fuzz targets")]
mod targets;

#[path = "support/mutation.rs"]
mod mutation;

use mutation::{Chance, files, project};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The most bytes of an input, so that none takes long.
const MAX_BYTES: usize = 3000;

fn decks() -> Vec<Vec<u8>> {
    [files(&project().join("fuzz/seeds/decks"), "inp"), files(&project().join("decks"), "inp")].concat()
}

/// The words of a dictionary of libFuzzer: in quotes, with `\\`, `\"` and `\xHH`.
fn tokens(name: &str) -> Vec<Vec<u8>> {
    let text = std::fs::read_to_string(project().join("fuzz").join(name)).expect("readable");
    let quoted = text.lines().filter(|line| !line.starts_with('#'));
    quoted
        .map(|line| unescaped(line.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).expect("quotes")))
        .collect()
}

fn unescaped(token: &str) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut rest = token.bytes();
    while let Some(byte) = rest.next() {
        match (byte, if byte == b'\\' { rest.next() } else { None }) {
            (b'\\', Some(b'x')) => {
                let digits = [rest.next().expect("a digit"), rest.next().expect("a digit")];
                let digits = str::from_utf8(&digits).expect("ASCII");
                bytes.push(u8::from_str_radix(digits, 16).expect("two hexadecimal digits"));
            }
            (_, Some(escaped)) => bytes.push(escaped),
            (plain, None) => bytes.push(plain),
        }
    }
    bytes
}

/// A few changes of the kinds that libFuzzer makes.
fn change(bytes: &mut Vec<u8>, seeds: &[Vec<u8>], tokens: &[Vec<u8>], chance: &mut Chance) {
    for _ in 0..=chance.below(5) {
        let at = chance.below(bytes.len() + 1);
        let end = (at + 1 + chance.below(40)).min(bytes.len());
        match chance.below(8) {
            0 if at < end => bytes[at] = chance.next().to_le_bytes()[0],
            1 => drop(bytes.drain(at..end)),
            2 => {
                let copied = bytes[at..end].to_vec();
                let to = chance.below(bytes.len() + 1);
                bytes.splice(to..to, copied);
            }
            3 => {
                let other = chance.one_of(seeds);
                bytes.truncate(at);
                bytes.extend_from_slice(&other[chance.below(other.len() + 1)..]);
            }
            4 => {
                let token = chance.one_of(tokens).repeat(1 + chance.below(30));
                bytes.splice(at..at, token);
            }
            5 => drop(bytes.splice(at..end, chance.one_of(tokens).iter().copied())),
            _ => drop(bytes.splice(at..at, chance.one_of(tokens).iter().copied())),
        }
        bytes.truncate(MAX_BYTES);
    }
}

/// Runs a target on every seed and on `number` changed ones.
#[track_caller]
fn run(target: fn(&[u8]), seeds: &[Vec<u8>], tokens: &[Vec<u8>], number: usize) {
    assert!(seeds.len() > 3 && tokens.len() > 3, "the seeds and tokens are not found");
    let mut chance = Chance(3);
    let changed = std::iter::repeat_with(|| {
        let mut bytes = chance.one_of(seeds).to_vec();
        change(&mut bytes, seeds, tokens, &mut chance);
        bytes
    });
    for bytes in seeds.iter().cloned().chain(changed.take(number)) {
        let outcome = catch_unwind(AssertUnwindSafe(|| target(&bytes)));
        assert!(outcome.is_ok(), "see above; the input was\n{}", bytes.escape_ascii());
    }
}

#[test]
fn decks_come_back_in_pieces_of_any_size() {
    run(targets::scan_and_print, &decks(), &tokens("decks.dict"), 500);
}

#[test]
fn decks_are_read() {
    run(targets::read, &decks(), &tokens("decks.dict"), 400);
}

#[test]
fn meshes_are_read() {
    run(targets::mesh, &decks(), &tokens("decks.dict"), 300);
}

#[test]
fn decks_are_checked() {
    run(targets::check, &decks(), &tokens("decks.dict"), 400);
}

#[test]
fn decks_are_formatted() {
    run(targets::format, &decks(), &tokens("decks.dict"), 500);
}

#[test]
fn expressions_are_executed() {
    run(
        targets::expressions,
        &files(&project().join("fuzz/seeds/expressions"), "txt"),
        &tokens("expressions.dict"),
        3000,
    );
}

#[test]
fn json_is_read() {
    run(targets::json_in, &files(&project().join("fuzz/seeds/json"), "json"), &tokens("json.dict"), 800);
}
