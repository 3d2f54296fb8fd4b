//! Which numbers of an interface can be used.

use super::SceneInterface;

/// A number that cannot be used.
pub(super) struct Unusable {
    pub(super) key: String,
    pub(super) value: f64,
    must: Must,
}

/// What a number must do.
#[derive(Debug, Clone, Copy)]
enum Must {
    BeFinite,
    NotBeNegative,
    ExceedZero,
}

/// The numbers of an interface that cannot be used.
pub(super) fn unusable_numbers(interface: &SceneInterface) -> Vec<Unusable> {
    let SceneInterface { area, characteristic_length, bulk_permeabilities, .. } = interface;
    let given = [
        ("area", Some(*area), Must::ExceedZero),
        ("char_length", *characteristic_length, Must::NotBeNegative),
        ("perm_s", bulk_permeabilities[0], Must::NotBeNegative),
        ("perm_m", bulk_permeabilities[1], Must::NotBeNegative),
        ("temperature", interface.temperature, Must::BeFinite),
        ("mass_flow", interface.mass_flow, Must::BeFinite),
        ("shear", interface.shear, Must::BeFinite),
        ("slip_rate", interface.slip_rate, Must::BeFinite),
        ("clearance_rate", interface.clearance_rate, Must::BeFinite),
    ];
    let given = given.into_iter().filter_map(|(key, value, must)| Some((key.to_owned(), value?, must)));
    let of_field = |(&value, number): (&f64, i32)| (format!("fv{number}"), value, Must::BeFinite);
    let all = given.chain(interface.field_variables.iter().zip(1..).map(of_field));
    all.filter(|(_, value, must)| !must.allows(*value))
        .map(|(key, value, must)| Unusable { key, value, must })
        .collect()
}

impl Must {
    fn allows(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::BeFinite => true,
                Self::NotBeNegative => value >= 0.0,
                Self::ExceedZero => value > 0.0,
            }
    }
}

impl Unusable {
    /// What to give instead.
    pub(super) fn help(&self) -> &'static str {
        match self.must {
            Must::BeFinite => "give a finite number",
            Must::NotBeNegative => "give a finite number of zero or above",
            Must::ExceedZero => "give a finite number above zero",
        }
    }
}
