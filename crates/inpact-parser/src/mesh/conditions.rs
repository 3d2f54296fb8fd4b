//! Conditions of steps: held values, fluxes and films, each with its nodes or faces.
//!
//! *BOUNDARY of the temperature (degree of freedom 11), the potential (9) and the pore pressure (8), *CFLUX, *CECURRENT, *DFLUX of faces, *DSFLUX, *DSECURRENT,
//! *FILM and *SFILM; other conditions on these fields, and those in a form that is not read, are listed in [`DeckConditions::not_taken`].
//! A condition lasts until a later step changes it (OP=MOD) or removes all of its kind (OP=NEW).

use super::MeshNote;
use super::amplitudes::Amplitude;
use super::condition_keywords::TAKEN;
use super::layout::{Entry, StepEntry};
use super::reader::{Context, Reader};
use super::rows::data_lines;
use super::surfaces::{Found, Picks};
use crate::deck::items;
use crate::grammar::Dialect;
use crate::model::{Name, Reference};
use crate::number::read_float;
use crate::span::Span;
use inpact_geometry::FaceLabel;
use std::collections::HashMap;
use std::io;
use std::mem::{Discriminant, discriminant};

/// The conditions that hold in a step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DeckConditions {
    /// The step, from 1.
    pub step: usize,
    /// The conditions, in the order of the deck.
    pub conditions: Vec<Condition>,
    /// The amplitudes of the deck.
    pub amplitudes: Vec<Amplitude>,
    /// AMPLITUDE of *STEP, in upper case: RAMP or STEP.
    pub step_amplitude: Option<String>,
    /// Conditions that are not supported, with the reason.
    pub not_taken: Vec<MeshNote>,
}

/// A condition.
#[derive(Debug, Clone, PartialEq)]
pub struct Condition {
    /// Its row.
    pub span: Span,
    /// Its keyword, without the asterisk.
    pub keyword: &'static str,
    /// The target of the row: a set, a surface, a number; with the face where it names one.
    pub target: String,
    /// Its nodes or faces: a position in [`Mesh::surfaces`](super::Mesh::surfaces); `None` where it was not found.
    pub on: Option<usize>,
    /// Its kind.
    pub kind: ConditionKind,
    /// The value, flow, flow per area or, for a film, sink temperature; without its amplitude.
    pub magnitude: f64,
    /// Its amplitude.
    pub amplitude: Option<Reference>,
    /// The step that gives it; 0 before the first.
    pub step: usize,
}

/// Kinds of conditions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ConditionKind {
    /// A prescribed value of the field.
    Held(ConditionField),
    /// A concentrated flux at each node: heat, current.
    Flow(ConditionField),
    /// A distributed flux through each face, per area.
    FlowPerArea(ConditionField),
    /// A film condition between each face and a sink.
    Film {
        /// The film coefficient, heat per time, area and temperature.
        coefficient: f64,
    },
}

/// The field of a condition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ConditionField {
    /// Electric potential (φ), degree of freedom 9.
    Potential,
    /// Temperature (θ), degree of freedom 11.
    Temperature,
    /// Pore pressure (F L⁻²), degree of freedom 8.
    PorePressure,
}

impl ConditionField {
    /// The field of a degree of freedom; CalculiX has no pore pressure, and its potentials are other quantities.
    fn of(freedom: i64, dialect: Dialect) -> Option<Self> {
        match (freedom, dialect) {
            (8, Dialect::Abaqus) => Some(Self::PorePressure),
            (9, Dialect::Abaqus) => Some(Self::Potential),
            (11, _) => Some(Self::Temperature),
            _ => None,
        }
    }
}

/// The mesh parts that are read beside those of contact pairs.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Target {
    /// A surface, by its name.
    Surface(Reference),
    /// The nodes of a set, or one node.
    Nodes(Reference),
    /// A face of the elements of a set, or of one element.
    Faces(Reference, FaceLabel),
}

/// The kind of a target, its name, and its face.
type TargetKey = (Discriminant<Target>, Name, Option<FaceLabel>);

/// Parts of the mesh, each once: a deck may name every node by itself.
#[derive(Debug, Default)]
pub(super) struct Targets {
    pub(super) list: Vec<Target>,
    positions: HashMap<TargetKey, usize>,
}

impl Targets {
    /// The position of a target, added if it is new.
    pub(super) fn position(&mut self, target: Target) -> usize {
        *self.positions.entry(target.key()).or_insert_with(|| {
            self.list.push(target);
            self.list.len() - 1
        })
    }

    pub(super) fn known(&self, target: &Target) -> Option<usize> {
        self.positions.get(&target.key()).copied()
    }
}

/// A row with its cells.
struct Cells {
    texts: Vec<String>,
    span: Span,
}

impl Cells {
    fn text(&self, at: usize) -> &str {
        self.texts.get(at).map_or("", String::as_str)
    }

    /// The number of a cell; an empty one is 0.
    fn number(&self, at: usize) -> Result<f64, String> {
        match self.text(at) {
            "" => Ok(0.0),
            text => read_float(text.as_bytes()).map_err(|_| format!("expected a number, found `{text}`")),
        }
    }

    fn integer(&self, at: usize) -> Option<i64> {
        self.text(at).parse().ok()
    }
}

/// A row, read.
struct Said {
    kind: ConditionKind,
    magnitude: f64,
    face: Option<FaceLabel>,
}

impl<'deck> Reader<'deck, '_> {
    /// The conditions of a step, and their parts of the mesh, which have no positions yet.
    pub(super) fn conditions(&mut self, step: usize) -> io::Result<(DeckConditions, Vec<Target>)> {
        let amplitudes = self.amplitudes()?;
        let step_amplitude = step.checked_sub(1).and_then(|at| self.layout.steps.get(at));
        let step_amplitude = step_amplitude.and_then(|entry| entry.choice("AMPLITUDE"));
        let mut read = DeckConditions { step, amplitudes, step_amplitude, ..DeckConditions::default() };
        let mut targets = Targets::default();
        for StepEntry { step: of, keyword, entry } in std::mem::take(&mut self.layout.conditions) {
            if step < of {
                continue;
            }
            if !TAKEN.contains(&keyword) {
                // One of an earlier step may have been taken away again, which is not followed up.
                read.not_taken.push(MeshNote { span: entry.span(), message: format!("*{keyword} is not taken over") });
                continue;
            }
            if entry.choice("OP").as_deref() == Some("NEW") {
                read.conditions.retain(|condition| condition.keyword != keyword || condition.step == of);
            }
            self.read_condition(keyword, entry, of, (&mut read, &mut targets))?;
        }
        Ok((read, targets.list))
    }

    fn read_condition(
        &mut self,
        keyword: &'static str,
        entry: Entry<'deck>,
        step: usize,
        (read, targets): (&mut DeckConditions, &mut Targets),
    ) -> io::Result<()> {
        let dialect = self.dialect;
        let mut refuse = |span: Span, message: String| read.not_taken.push(MeshNote { span, message });
        let rows = self.cells(entry)?;
        let elsewhere = ["USER", "FILE", "FIXED", "INPUT", "SUBMODEL", "FILMAMPLITUDE", "LOADCASE"];
        if let Some(parameter) = elsewhere.into_iter().find(|name| entry.parameter(name).is_some()) {
            let is_mechanical = keyword == "BOUNDARY" && rows.iter().all(|row| fields_held(row, dialect).is_empty());
            if !is_mechanical {
                refuse(entry.span(), format!("*{keyword} with {parameter} is not taken over"));
            }
            return Ok(());
        }
        let amplitude =
            entry.parameter("AMPLITUDE").map(|name| Reference { name: Name::new(name), span: entry.span() });
        for row in rows {
            let said = match said(keyword, &row, dialect) {
                Ok(said) => said,
                Err(reason) => {
                    refuse(row.span, format!("the row of *{keyword} is not taken over: {reason}"));
                    continue;
                }
            };
            for Said { kind, magnitude, face } in said {
                let named = Reference { name: Name::new(row.text(0)), span: row.span };
                let target = match (face, keyword) {
                    (Some(face), _) => Target::Faces(named, face),
                    (None, "DSFLUX" | "DSECURRENT" | "SFILM") => Target::Surface(named),
                    (None, _) => Target::Nodes(named),
                };
                let of_face = face.map_or_else(String::new, |face| format!(", {face}"));
                let on = Some(targets.position(target));
                read.conditions.push(Condition {
                    span: row.span,
                    keyword,
                    target: format!("{}{of_face}", row.text(0)),
                    on,
                    kind,
                    magnitude,
                    amplitude: amplitude.clone(),
                    step,
                });
            }
        }
        Ok(())
    }

    fn cells(&mut self, entry: Entry<'_>) -> io::Result<Vec<Cells>> {
        let mut rows = Vec::new();
        data_lines(&mut *self.rows, entry.block, &mut |line, span| {
            let texts = items(line).map(|item| String::from_utf8_lossy(&line[item]).trim().to_owned()).collect();
            rows.push(Cells { texts, span });
        })?;
        Ok(rows)
    }

    /// Resolves a target; `None` where it is a surface that is not read.
    pub(super) fn pick_target(
        &mut self,
        surface: usize,
        target: &Target,
        picks: &mut Picks,
    ) -> io::Result<Option<Found>> {
        let (name, of_nodes) = match target {
            Target::Surface(name) => return self.pick_surface(surface, name, picks),
            Target::Nodes(name) => {
                self.pick_nodes(surface, Context::Top, (name.name.written(), None), name.span, picks)?;
                (name, true)
            }
            Target::Faces(name, face) => {
                let face = face.to_string();
                self.pick_faces(surface, Context::Top, (name.name.written(), Some(&face)), name.span, picks)?;
                (name, false)
            }
        };
        Ok(Some(Found { span: name.span, of_nodes }))
    }
}

impl Target {
    fn key(&self) -> TargetKey {
        let face = if let Self::Faces(_, face) = self { Some(*face) } else { None };
        (discriminant(self), self.reference().name.clone(), face)
    }

    /// Its name, and the place of the reference.
    pub(super) fn reference(&self) -> &Reference {
        match self {
            Self::Surface(name) | Self::Nodes(name) | Self::Faces(name, _) => name,
        }
    }
}

/// The fields that a row of *BOUNDARY holds.
fn fields_held(row: &Cells, dialect: Dialect) -> Vec<ConditionField> {
    let Some(first) = row.integer(1) else { return Vec::new() };
    let last = row.integer(2).unwrap_or(first);
    (first..=last.min(first + 30)).filter_map(|freedom| ConditionField::of(freedom, dialect)).collect()
}

/// Reads a row of a keyword; `None` where it concerns other fields.
fn said(keyword: &str, row: &Cells, dialect: Dialect) -> Result<Vec<Said>, String> {
    let nodal = |field| {
        let magnitude = row.number(2)?;
        Ok(vec![Said { kind: ConditionKind::Flow(field), magnitude, face: None }])
    };
    match keyword {
        "BOUNDARY" => {
            let fields = fields_held(row, dialect);
            if fields.is_empty() {
                return Ok(Vec::new());
            }
            let magnitude = row.number(3)?;
            Ok(fields
                .into_iter()
                .map(|field| Said { kind: ConditionKind::Held(field), magnitude, face: None })
                .collect())
        }
        "CFLUX" => match row.text(1) {
            "" | "11" | "0" => nodal(ConditionField::Temperature),
            freedom => Err(format!("expected degree of freedom 11, found `{freedom}`")),
        },
        "CECURRENT" => match row.text(1) {
            "" | "9" => nodal(ConditionField::Potential),
            freedom => Err(format!("expected degree of freedom 9, found `{freedom}`")),
        },
        "DSFLUX" => surface_flow(row, "S", ConditionField::Temperature),
        "DSECURRENT" => surface_flow(row, "CS", ConditionField::Potential),
        "DFLUX" => {
            let face = face_of(row.text(1), 'S')?;
            let kind = ConditionKind::FlowPerArea(ConditionField::Temperature);
            Ok(vec![Said { kind, magnitude: row.number(2)?, face: Some(face) }])
        }
        "FILM" => {
            let face = Some(face_of(row.text(1), 'F')?);
            film(row, face)
        }
        _ => match row.text(1).to_ascii_uppercase().as_str() {
            "F" => film(row, None),
            other => Err(format!("expected `F`, found `{other}`")),
        },
    }
}

fn surface_flow(row: &Cells, label: &str, field: ConditionField) -> Result<Vec<Said>, String> {
    if row.text(1).eq_ignore_ascii_case(label) {
        let kind = ConditionKind::FlowPerArea(field);
        return Ok(vec![Said { kind, magnitude: row.number(2)?, face: None }]);
    }
    Err(format!("expected `{label}`, found `{}`", row.text(1)))
}

fn film(row: &Cells, face: Option<FaceLabel>) -> Result<Vec<Said>, String> {
    let coefficient = match row.text(3) {
        "" => return Err("it has no film coefficient".to_owned()),
        _ => row.number(3).map_err(|reason| format!("{reason} as film coefficient"))?,
    };
    if coefficient < 0.0 {
        return Err(format!("its film coefficient is {coefficient:?}, below zero"));
    }
    Ok(vec![Said { kind: ConditionKind::Film { coefficient }, magnitude: row.number(2)?, face }])
}

/// The face of a label such as `S2` or `F2`.
fn face_of(label: &str, letter: char) -> Result<FaceLabel, String> {
    let rest = label.strip_prefix([letter, letter.to_ascii_lowercase()]);
    let face = rest.and_then(|rest| format!("S{rest}").parse().ok());
    face.ok_or_else(|| format!("expected a face such as `{letter}1`, found `{label}`"))
}
