//! Points and vectors in three dimensions, and operations on them.

/// A point in space, in units of length; plane and axisymmetric meshes have 0 as the third coordinate.
pub type Point = [f64; 3];

/// A direction, or the difference of two points.
pub type Vector = [f64; 3];

pub(crate) fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(crate) fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn scale(s: f64, a: Vector) -> Vector {
    [s * a[0], s * a[1], s * a[2]]
}

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// The unit vector along `a`; `None` where `a` is zero or so short that its square is.
pub(crate) fn unit(a: Vector) -> Option<Vector> {
    let length = norm(a);
    (f64::MIN_POSITIVE <= length).then(|| scale(1.0 / length, a))
}
