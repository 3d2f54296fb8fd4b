//! The properties of a material at a temperature.

use crate::error::BodyFault;
use crate::rules::UNUSABLE_PROPERTY;
use inpact_geometry::Conductivity;
use inpact_parser::mesh::{BodyMaterial, MaterialProperty, TensorKind};
use inpact_parser::model::Name;
use std::fmt;

/// Fields that a body conducts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BodyField {
    /// Heat, by *CONDUCTIVITY.
    Thermal,
    /// Current, by *ELECTRICAL CONDUCTIVITY.
    Electrical,
}

impl BodyField {
    /// The keyword of its conductivity.
    pub fn keyword(self) -> &'static str {
        match self {
            Self::Thermal => "CONDUCTIVITY",
            Self::Electrical => "ELECTRICAL CONDUCTIVITY",
        }
    }

    /// The conductivity of a material; `None` where it has none.
    pub fn of(self, material: &BodyMaterial) -> Option<&MaterialProperty> {
        match self {
            Self::Thermal => material.conductivity.as_ref(),
            Self::Electrical => material.electrical_conductivity.as_ref(),
        }
    }
}

impl fmt::Display for BodyField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Thermal => "thermal",
            Self::Electrical => "electrical",
        })
    }
}

/// The values of a property at a temperature: linear between rows, and constant before the first and after the last.
pub(crate) fn values_at(
    property: &MaterialProperty,
    material: &Name,
    temperature: Option<f64>,
) -> Result<Vec<f64>, BodyFault> {
    let MaterialProperty { keyword, span, rows, dependencies, .. } = property;
    let fault = |message: String| BodyFault::at(&UNUSABLE_PROPERTY, *span, message);
    let (first, _) = &rows[0];
    if rows.iter().all(|(values, _)| values == first) {
        return Ok(first.clone());
    }
    if 0 < *dependencies {
        return Err(fault(format!("*{keyword} of `{material}` depends on field variables, of which nothing is known")));
    }
    let mut points: Vec<(f64, &[f64])> = Vec::new();
    for (values, at) in rows {
        let Some(at) = *at else {
            return Err(fault(format!(
                "*{keyword} of `{material}` has {} rows, one of them without a temperature",
                rows.len()
            )));
        };
        if let Some((before, _)) = points.last().filter(|(before, _)| at <= *before) {
            let message =
                format!("the temperatures of *{keyword} of `{material}` must ascend: found {at:?} after {before:?}");
            return Err(fault(message));
        }
        points.push((at, values));
    }
    let (lowest, highest) = (points[0].0, points[points.len() - 1].0);
    let Some(temperature) = temperature else {
        return Err(fault(format!(
            "*{keyword} of `{material}` depends on temperature, from {lowest:?} to {highest:?}: a body is lumped at one temperature, which must be given"
        )));
    };
    let after = points.partition_point(|(at, _)| *at <= temperature);
    let (below, above) = (points[after.saturating_sub(1)], points[after.min(points.len() - 1)]);
    if below.0 == above.0 {
        return Ok(below.1.to_vec());
    }
    let share = ((temperature - below.0) / (above.0 - below.0)).clamp(0.0, 1.0);
    Ok(below.1.iter().zip(above.1).map(|(a, b)| (1.0 - share) * a + share * b).collect())
}

/// The tensor of a conductivity.
pub(crate) fn tensor(property: &MaterialProperty, material: &Name, values: &[f64]) -> Result<Conductivity, BodyFault> {
    let k = match (property.kind, values) {
        (TensorKind::Isotropic, &[k]) => [[k, 0.0, 0.0], [0.0, k, 0.0], [0.0, 0.0, k]],
        (TensorKind::Orthotropic, &[a, b, c]) => [[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]],
        (TensorKind::Anisotropic, &[a, ab, b, ac, bc, c]) => [[a, ab, ac], [ab, b, bc], [ac, bc, c]],
        _ => unreachable!("rows have as many values as their kind"),
    };
    let minor = k[0][0] * k[1][1] - k[0][1] * k[1][0];
    let determinant = k[0][0] * (k[1][1] * k[2][2] - k[1][2] * k[2][1])
        - k[0][1] * (k[1][0] * k[2][2] - k[1][2] * k[2][0])
        + k[0][2] * (k[1][0] * k[2][1] - k[1][1] * k[2][0]);
    let is_positive = [k[0][0], minor, determinant].iter().all(|minor| 0.0 < *minor && *minor < f64::INFINITY);
    if is_positive {
        return Ok(k);
    }
    let (keyword, found) = (property.keyword, values.iter().map(|value| format!("{value:?}")).collect::<Vec<_>>());
    let message = format!("*{keyword} of `{material}` must be above 0 in every direction: found {}", found.join(", "));
    Err(BodyFault::at(&UNUSABLE_PROPERTY, property.span, message))
}
