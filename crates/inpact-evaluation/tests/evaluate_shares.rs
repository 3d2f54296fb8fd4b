//! The same bytes for any number of threads, any size of batches, and rows that wait in memory or in a file.

mod evaluate_support;
#[allow(dead_code, reason = "the judge of the laws uses all of it")]
#[path = "evaluation_judge/scene.rs"]
mod scene;
mod table_judge;

use evaluate_support::{evaluate_kept, evaluate_with};
use inpact_evaluation::plan::{Choices, Derivatives};
use inpact_evaluation::{Accuracy, Wanted};
use scene::Scene;
use std::fmt::Write;
use table_judge::{Random, cases};

/// The rows of a scene, each for so many nodes: time after time, or node after node.
fn repeated(scene: &Scene, copies: usize, by_node: bool) -> String {
    let text = scene.nodes();
    let (header, rows) = text.split_once('\n').expect("a header");
    let rows: Vec<&str> = rows.lines().collect();
    let mut table = format!("{header}\n");
    let mut add = |copy: usize, row: &str| {
        let _ = writeln!(table, "{copy}.{row}");
    };
    if by_node {
        (0..copies).for_each(|copy| rows.iter().for_each(|row| add(copy, row)));
    } else {
        for row in rows {
            (0..copies).for_each(|copy| add(copy, row));
        }
    }
    table
}

#[test]
fn results_depend_neither_on_threads_nor_on_batches() {
    let mut random = Random::new(0x5aa5);
    let mut evaluated = 0;
    for round in 0..cases(40) {
        let scene = Scene::random(&mut random, round % 4 == 3);
        let deck = scene.deck();
        let nodes = if scene.has_nodes { repeated(&scene, 6, round % 2 == 0) } else { scene.nodes() };
        let accuracy = [Accuracy::Full, Accuracy::Reference, Accuracy::Fast][round % 3];
        let derivatives = [Derivatives::LeftOut, Derivatives::Given][round % 2];
        let choices = Choices { accuracy: Wanted::Mode(accuracy), derivatives, ..Choices::default() };
        let (expected, said) = evaluate_kept(&deck, &nodes, &choices, (8192, 1, usize::MAX));
        if !expected.is_empty() {
            let once_more = evaluate_with(&deck, &nodes, &choices, 8192);
            assert_eq!(once_more.csv, expected, "{deck}\n{nodes}");
            evaluated += 1;
        }
        for shares in [1, 2, 4] {
            for (rows, room) in [(1, 0), (7, 2000), (64, usize::MAX), (1024, 0)] {
                let found = evaluate_kept(&deck, &nodes, &choices, (rows, shares, room));
                assert_eq!(found, (expected.clone(), said.clone()), "{shares} shares, {rows} rows\n{deck}\n{nodes}");
            }
        }
    }
    assert!(evaluated > 20, "only {evaluated} scenes could be evaluated");
}
