//! Properties of materials: *CONDUCTIVITY, *ELECTRICAL CONDUCTIVITY, *DENSITY, *SPECIFIC HEAT and *JOULE HEAT FRACTION.

use super::condition_keywords::is_called;
use super::layout::{Entry, MaterialEntries};
use super::reader::Reader;
use super::rows::data_lines;
use crate::deck::items;
use crate::grammar::Dialect;
use crate::model::Name;
use crate::number::read_float;
use crate::span::Span;
use std::io;

/// A *MATERIAL: its properties for conduction and Joule heat.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyMaterial {
    /// NAME.
    pub name: Name,
    /// The keyword line.
    pub span: Span,
    /// *CONDUCTIVITY (M L T⁻³ θ⁻¹).
    pub conductivity: Option<MaterialProperty>,
    /// *ELECTRICAL CONDUCTIVITY (C T⁻¹ L⁻¹ φ⁻¹).
    pub electrical_conductivity: Option<MaterialProperty>,
    /// *DENSITY (M L⁻³).
    pub density: Option<MaterialProperty>,
    /// *SPECIFIC HEAT (L² T⁻² θ⁻¹).
    pub specific_heat: Option<MaterialProperty>,
    /// *JOULE HEAT FRACTION (1): the fraction of the energy dissipated by a current that becomes heat.
    pub joule_heat_fraction: Option<MaterialProperty>,
}

/// An option of a material.
#[derive(Debug, Clone, PartialEq)]
pub struct MaterialProperty {
    /// Its keyword, in capitals.
    pub keyword: &'static str,
    /// The keyword line.
    pub span: Span,
    /// Which values a row has.
    pub kind: TensorKind,
    /// The values and the temperature (θ) of each row.
    pub rows: Vec<(Vec<f64>, Option<f64>)>,
    /// DEPENDENCIES: the number of field variables the values depend on as well.
    pub dependencies: u32,
}

/// TYPE of a conductivity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TensorKind {
    /// One value: ISO, and properties without direction.
    Isotropic,
    /// k₁₁, k₂₂, k₃₃: ORTHO.
    Orthotropic,
    /// k₁₁, k₁₂, k₂₂, k₁₃, k₂₃, k₃₃: ANISO. In rows for CalculiX they come as k₁₁, k₂₂, k₃₃, k₁₂, k₁₃, k₂₃, and are put in this order.
    Anisotropic,
}

impl TensorKind {
    /// The number of values of a row.
    pub fn values(self) -> usize {
        match self {
            Self::Isotropic => 1,
            Self::Orthotropic => 3,
            Self::Anisotropic => 6,
        }
    }
}

impl<'deck> Reader<'deck, '_> {
    /// Reads all materials.
    pub(super) fn read_materials(&mut self) -> io::Result<Vec<BodyMaterial>> {
        let mut materials = Vec::new();
        for MaterialEntries { name, entry, properties } in std::mem::take(&mut self.layout.materials) {
            let mut property = |keyword: &'static str| -> io::Result<Option<MaterialProperty>> {
                let mut of_keyword = properties.iter().filter(|(name, _)| is_called(keyword, name));
                // Of duplicate options the last one applies.
                of_keyword.next_back().map_or(Ok(None), |(_, entry)| self.property(keyword, *entry))
            };
            materials.push(BodyMaterial {
                conductivity: property("CONDUCTIVITY")?,
                electrical_conductivity: property("ELECTRICAL CONDUCTIVITY")?,
                density: property("DENSITY")?,
                specific_heat: property("SPECIFIC HEAT")?,
                joule_heat_fraction: property("JOULE HEAT FRACTION")?,
                name,
                span: entry.span(),
            });
        }
        Ok(materials)
    }

    /// An option of a material; `None`, with a note, where something in it is not understood.
    fn property(&mut self, keyword: &'static str, entry: Entry<'deck>) -> io::Result<Option<MaterialProperty>> {
        let kind = match entry.choice("TYPE").as_deref() {
            None | Some("ISO" | "") => TensorKind::Isotropic,
            Some("ORTHO") => TensorKind::Orthotropic,
            Some("ANISO") => TensorKind::Anisotropic,
            Some(other) => {
                let message =
                    format!("expected TYPE=ISO, ORTHO or ANISO of *{keyword}, found `{other}`; it was not read");
                self.note(entry.span(), message);
                return Ok(None);
            }
        };
        let dependencies = match entry.parameter("DEPENDENCIES").map(str::trim) {
            None => 0,
            // Without a number it is not said how many.
            Some(count) => count.parse().unwrap_or(1),
        };
        let count = kind.values();
        let mut rows: Vec<(Vec<f64>, Option<f64>)> = Vec::new();
        let mut wrong: Option<(Span, String)> = None;
        data_lines(&mut *self.rows, entry.block, &mut |line, span| {
            let read = |item: std::ops::Range<usize>| read_float(&line[item]).ok();
            let filled: Vec<std::ops::Range<usize>> = items(line).collect();
            let values: Option<Vec<f64>> = filled.iter().take(count).cloned().map(read).collect();
            let temperature = filled.get(count).filter(|item| !item.is_empty()).cloned();
            match (values, temperature.map(read)) {
                (Some(values), None) if values.len() == count => rows.push((values, None)),
                (Some(values), Some(Some(temperature))) => rows.push((values, Some(temperature))),
                _ => {
                    let found = String::from_utf8_lossy(line).trim().to_owned();
                    wrong.get_or_insert((span, found));
                }
            }
        })?;
        if let Some((span, found)) = wrong {
            let values = if count == 1 { "a number".to_owned() } else { format!("{count} numbers") };
            let message = format!(
                "expected {values} and a temperature in a row of *{keyword}, found `{found}`; the option was not read"
            );
            self.note(span, message);
            return Ok(None);
        }
        if rows.is_empty() {
            self.note(entry.span(), format!("*{keyword} has no row, so that it was not read"));
            return Ok(None);
        }
        if kind == TensorKind::Anisotropic && self.dialect == Dialect::Calculix {
            for (values, _) in &mut rows {
                *values = [0, 3, 1, 4, 5, 2].map(|at| values[at]).to_vec();
            }
        }
        Ok(Some(MaterialProperty { keyword, span: entry.span(), kind, rows, dependencies }))
    }
}
