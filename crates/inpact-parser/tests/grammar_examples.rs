//! The example of every keyword file is read without a problem, every word of it known and in full.

use inpact_parser::deck::{Resolved, scan};
use inpact_parser::grammar::Grammar;
use inpact_parser::model::read;

#[test]
fn every_example_is_read_without_a_problem() {
    let grammar = Grammar::builtin();
    let mut examples = 0;
    for (_, keyword) in grammar.keywords() {
        let Some(definition) = keyword.definition() else { continue };
        let name = &definition.name;
        let deck = scan(name, definition.example.as_bytes(), grammar);
        let (_, problems) = read(&deck, grammar);
        assert!(problems.is_empty(), "*{name}: {problems:?}");
        for line in deck.blocks().iter().map(|block| block.keyword.as_ref().unwrap()) {
            let written = deck.shown(line.name());
            let Resolved::Exact(id) = line.resolved else { panic!("*{name}: *{written} is not in full") };
            let known = grammar.keyword(id).definition().filter(|known| known.parameters_complete);
            for parameter in line.parameters().filter(|_| known.is_some()) {
                let written = deck.shown(parameter.name);
                assert!(matches!(parameter.resolved, Resolved::Exact(_)), "*{name}: {written} is not in full");
            }
        }
        examples += 1;
    }
    assert!(examples > 50, "{examples}");
}
