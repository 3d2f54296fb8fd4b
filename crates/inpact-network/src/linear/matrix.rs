//! The symmetric matrix of the scaled jumps: its pattern and its values, in faer's format.

use super::core::Core;
use super::edges::Edges;
use super::relative::Form;
use super::sets::index;
use faer::sparse::{Argsort, Pair, SparseColMat, SymbolicSparseColMat, SymbolicSparseColMatRef};
use inpact_evaluation::numbers::{exponent_of, scale_by_power};

/// The sparsity pattern of the lower triangle of the matrix of some edges, and the positions of the contributions of each element.
#[derive(Debug)]
pub(crate) struct Pattern {
    symbolic: SymbolicSparseColMat<u32>,
    order: Argsort<u32>,
}

/// A symmetric matrix: its lower triangle in compressed sparse column format.
#[derive(Debug)]
pub(crate) struct Matrix<'a> {
    pub(crate) pattern: SymbolicSparseColMatRef<'a, u32>,
    pub(crate) values: Vec<f64>,
}

impl Pattern {
    /// The pattern of the matrix of `edges`.
    ///
    /// # Panics
    /// Beyond 2³¹ parts, which no scene in memory reaches.
    pub(crate) fn of(core: &Core, edges: &Edges) -> Self {
        let mut places = Vec::with_capacity(edges.form.count() + 3 * edges.elements.len());
        each_part(core, edges, |row, column, _| places.push(Pair { row, col: column }));
        let count = edges.form.count();
        let (symbolic, order) = SymbolicSparseColMat::try_new_from_indices(count, count, &places)
            .expect("every part is that of an unknown, and there are fewer than 2^31");
        Self { symbolic, order }
    }

    /// The matrix of edges that have this pattern.
    ///
    /// # Panics
    /// For other edges.
    pub(crate) fn matrix(&self, core: &Core, edges: &Edges) -> Matrix<'_> {
        let mut parts = Vec::with_capacity(edges.form.count() + 3 * edges.elements.len());
        each_part(core, edges, |_, _, part| parts.push(part));
        let matrix = SparseColMat::new_from_argsort(self.symbolic.clone(), &self.order, &parts)
            .expect("the same edges give as many parts");
        Matrix { pattern: self.symbolic.as_ref(), values: matrix.into_parts().1 }
    }

    /// Whether another pattern has the same entries.
    pub(crate) fn has_entries_of(&self, other: SymbolicSparseColMatRef<'_, u32>) -> bool {
        self.symbolic.col_ptr() == other.col_ptr() && self.symbolic.row_idx() == other.row_idx()
    }

    pub(crate) fn symbolic(&self) -> SymbolicSparseColMatRef<'_, u32> {
        self.symbolic.as_ref()
    }
}

impl Matrix<'_> {
    /// Calls `take` with row, column and value of every entry on and below the diagonal, column by column.
    pub(crate) fn each(&self, mut take: impl FnMut(usize, usize, f64)) {
        let (starts, rows) = (self.pattern.col_ptr(), self.pattern.row_idx());
        for column in 0..self.pattern.ncols() {
            let range = starts[column] as usize..starts[column + 1] as usize;
            for (&row, &value) in rows[range.clone()].iter().zip(&self.values[range]) {
                take(row as usize, column, value);
            }
        }
    }

    /// The largest sum of the magnitudes of a row.
    pub(crate) fn norm(&self) -> f64 {
        let mut sums = vec![0.0; self.pattern.ncols()];
        self.each(|row, column, value| {
            sums[row] += value.abs();
            if row != column {
                sums[column] += value.abs();
            }
        });
        sums.into_iter().fold(0.0, f64::max)
    }
}

/// Calls `take` with row, column and part of every entry on and below the diagonal.
pub(crate) fn each_part(core: &Core, edges: &Edges, mut take: impl FnMut(u32, u32, f64)) {
    let Edges { form, elements, .. } = edges;
    for unknown in 0..index(form.count()) {
        // An unknown whose conductances all underflow still has a diagonal.
        take(unknown, unknown, 0.0);
    }
    let mut way: Vec<(u32, f64, i32)> = Vec::new();
    for &number in elements {
        let element = &core.elements[number as usize];
        let conductance = element.conductance.to_f64();
        way.clear();
        form.on_way(form.ends(core, element), |unknown, sign| way.push((unknown, sign, form.scale(unknown) / 2)));
        for (place, &(first, sign, half)) in way.iter().enumerate() {
            let scaled = sign * scale_by_power(conductance, -half);
            for &(second, other_sign, other_half) in &way[..=place] {
                take(first.max(second), first.min(second), other_sign * scale_by_power(scaled, -other_half));
            }
        }
    }
}

/// Scales flows to the matrix: divides each by the square root of its unknown's scale, and multiplies all by 2^`shift`.
pub(crate) fn scaled_flows(form: &Form, flows: impl Iterator<Item = f64>, shift: i32) -> Vec<f64> {
    let scaled = flows.zip(&form.levels);
    scaled.map(|(flow, level)| scale_by_power(flow, shift - form.scales[*level as usize] / 2)).collect()
}

/// The exponent that scales the largest of some flows to about 1 on the scale of the matrix; `None` where all are zero.
pub(crate) fn shift(form: &Form, flows: impl Iterator<Item = f64>) -> Option<i32> {
    let exponent =
        |(flow, level): (f64, &u16)| (flow != 0.0).then(|| exponent_of(flow) - form.scales[*level as usize] / 2);
    flows.zip(&form.levels).filter_map(exponent).max().map(|exponent| -exponent)
}

/// Scales unknowns back from the matrix to flows.
pub(crate) fn unscale(form: &Form, unknowns: &mut [f64], shift: i32) {
    for (unknown, level) in unknowns.iter_mut().zip(&form.levels) {
        *unknown = scale_by_power(*unknown, form.scales[*level as usize] / 2 - shift);
    }
}
