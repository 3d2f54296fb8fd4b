const MEASURED: &[Measured] = &[
    Measured { axes: 1, knots: 16, reference: 30.0, full: 20.0, slope: 1.2, single: 0.9, grid: f64::INFINITY },
    Measured { axes: 4, knots: 10, reference: 900.0, full: 600.0, slope: 80.0, single: 80.0, grid: 14.0 },
];
