//! `check --fix`: applies the fixes of findings to the files they stand in, until nothing is left to mend.

use crate::failure::Failure;
use crate::files;
use crate::input::{self, Overlay};
use crate::settings::Settings;
use inpact_parser::deck::Keep;
use inpact_parser::model;
use inpact_parser::span::SourceId;
use inpact_validation::{Diagnostic, Edit, Fix, FixSafety, check, diagnostic};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// How often a deck is read again: a fix may bring another finding to light, but not for ever.
const MOST_ROUNDS: usize = 10;

/// Which fixes are applied.
#[derive(Debug, Clone, Default)]
pub(crate) struct FixSelection {
    /// The codes whose fixes are applied although they change the meaning of the deck.
    pub(crate) also: Vec<String>,
}

impl FixSelection {
    fn selects<'a>(&self, found: &'a Diagnostic) -> Option<&'a Fix> {
        let fix = found.fix.as_ref()?;
        let is_wanted = fix.safety == FixSafety::Safe || self.also.iter().any(|code| code == found.code);
        is_wanted.then_some(fix)
    }
}

/// What fixing a deck and what it includes came to.
#[derive(Debug, Default)]
pub(crate) struct Fixed {
    /// The files that change: before and after.
    pub(crate) files: BTreeMap<PathBuf, (Vec<u8>, Vec<u8>)>,
    /// How many findings were mended.
    pub(crate) findings: usize,
}

/// Applies the fixes in memory; nothing is written.
pub(crate) fn fix(path: &Path, settings: &Settings, selection: &FixSelection) -> Result<Fixed, Failure> {
    let mut fixed = Fixed::default();
    for _ in 0..MOST_ROUNDS {
        let overlay: Overlay = fixed.files.iter().map(|(path, (_, after))| (path.clone(), after.clone())).collect();
        let deck = input::read_deck_over(path, Keep::Interpreted, settings, &overlay)?;
        let (model, problems) = model::read(&deck, settings.grammar);
        let found = settings.apply(check(&deck, settings.grammar, &model, &problems), &deck);
        let mut edits: BTreeMap<SourceId, Vec<Edit>> = BTreeMap::new();
        let mut count = 0;
        for fix in found.iter().filter_map(|found| selection.selects(found)) {
            count += 1;
            for edit in &fix.edits {
                edits.entry(edit.span.source).or_default().push(edit.clone());
            }
        }
        if edits.is_empty() {
            break;
        }
        fixed.findings += count;
        for (source, edits) in edits {
            let file = PathBuf::from(deck.source(source).name());
            let (before, after) = match fixed.files.remove(&file) {
                Some(states) => states,
                None => {
                    let bytes = files::read_bytes(&file)?;
                    (bytes.clone(), bytes)
                }
            };
            let after = diagnostic::apply(&after, &edits);
            fixed.files.insert(file, (before, after));
        }
    }
    Ok(fixed)
}
