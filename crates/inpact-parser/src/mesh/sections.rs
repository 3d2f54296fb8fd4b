//! Thickness and offset of the sections of plane elements, shells and membranes.

use super::elements::RawFace;
use super::layout::{Entry, canonical};
use super::reader::{Context, Reader};
use super::rows::data_lines;
use super::selected::{Kind, Selection};
use crate::deck::items;
use crate::number::read_float;
use std::io;

/// The geometry of a section.
#[derive(Debug, Clone)]
pub(super) struct Section {
    elements: Selection,
    pub(super) thickness: Option<f64>,
    /// The offset of the nodes from the midsurface, as a fraction of the thickness, along the normal.
    pub(super) offset: f64,
}

impl Section {
    pub(super) fn holds(&self, face: &RawFace) -> bool {
        self.elements.contains(face.element, face.option)
    }
}

impl Reader<'_, '_> {
    /// The sections of a instance.
    pub(super) fn sections(&mut self, instance: usize) -> io::Result<Vec<Section>> {
        let mut sections = Vec::new();
        for entry in self.entries_of(instance, |definitions| &definitions.sections) {
            let Some(set) = entry.parameter("ELSET") else { continue };
            let selected = self.select(Kind::Elements, Context::Instance(instance), set, entry.span())?;
            let Some(elements) = selected.get(&instance).cloned() else { continue };
            let thickness = self.thickness(entry)?;
            let offset = self.offset(entry);
            sections.push(Section { elements, thickness, offset });
        }
        Ok(sections)
    }

    /// The first item of the first row; of a composite the sum of its layers.
    fn thickness(&mut self, entry: Entry<'_>) -> io::Result<Option<f64>> {
        let mut rows: Vec<Option<f64>> = Vec::new();
        data_lines(&mut *self.rows, entry.block, &mut |line, _| {
            let first = items(line).next().and_then(|item| read_float(&line[item]).ok());
            rows.push(first);
        })?;
        for parameter in ["NODALTHICKNESS", "SHELLTHICKNESS", "MEMBRANETHICKNESS"] {
            if entry.parameter(parameter).is_some() {
                self.note(entry.span(), "a thickness that varies over the section is not read".to_owned());
                return Ok(None);
            }
        }
        if entry.parameter("COMPOSITE").is_some() {
            return Ok(rows.into_iter().sum());
        }
        Ok(rows.first().copied().flatten())
    }

    fn offset(&mut self, entry: Entry<'_>) -> f64 {
        let Some(written) = entry.parameter("OFFSET") else { return 0.0 };
        match canonical(written.as_bytes()).as_str() {
            "SPOS" => 0.5,
            "SNEG" => -0.5,
            number => read_float(number.as_bytes()).unwrap_or_else(|_| {
                self.note(
                    entry.span(),
                    format!(
                        "expected a number, SPOS or SNEG as OFFSET, found `{written}`, which was not read; 0 was taken"
                    ),
                );
                0.0
            }),
        }
    }
}
