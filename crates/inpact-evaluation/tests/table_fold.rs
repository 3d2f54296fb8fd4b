//! Folded tables against the exact rationals of the whole ones, and against their sides.

mod table_judge;

use inpact_evaluation::ErrorKind;
use inpact_evaluation::table::{PiecewiseTable, Tail};
use table_judge::random_tables::{Range, compile, random_ending, random_point, random_rows};
use table_judge::{Random, cases, report, table_value, ulps_from};

/// Folds random tables along random axes; gives how many could be folded.
fn check_folding(axes: usize, count: usize, range: Range) -> usize {
    let mut random = Random::new(0xf01d + axes as u64);
    let (mut folded_count, mut worst) = (0, 0.0);
    for _ in 0..count {
        let rows = random_rows(&mut random, axes, range);
        let ending = random_ending(&mut random);
        let table = compile(&rows, ending);
        let axis = random.below(axes);
        let at = random_point(&mut random, &rows)[axis];
        let Ok(folded) = table.folded(axis, at) else { continue };
        folded_count += 1;
        for _ in 0..8 {
            let mut point = random_point(&mut random, &rows);
            point[axis] = at;
            let (_, sides) = table.value_and_sides_at(point[0], &point[1..]);
            // The folded axis is not read.
            let mut seen = point.clone();
            seen[axis] = f64::NAN;
            let (value, folded_sides) = folded.value_and_sides_at(seen[0], &seen[1..]);
            let error = ulps_from(value, &table_value(&rows, &point, ending));
            assert!(
                error <= axes as f64 + 1.0,
                "off by {error} ulp: {value:e} at {point:?} folded along {axis} of {rows:?}"
            );
            assert_eq!(folded_sides, sides, "at {point:?} folded along {axis} of {rows:?}");
            worst = f64::max(worst, error);
        }
    }
    report(&format!("{axes} axes"), &format!("largest error {worst:.4} ulp, {folded_count} of {count} folded"));
    folded_count
}

#[test]
fn folded_tables_keep_the_bound_and_the_sides() {
    for (axes, count) in [(1, 400), (2, 2_000), (3, 1_000), (4, 300)] {
        for range in [Range::AllDecades, Range::Ordinary] {
            let folded = check_folding(axes, cases(count), range);
            assert!(folded * 10 > cases(count), "only {folded} tables of {axes} axes could be folded");
        }
    }
}

/// One axis after the other, down to a constant.
#[test]
fn folding_everything_gives_the_value() {
    let rows = [[10.0, 0.0, 300.0], [6.0, 1.0, 300.0], [2.0, 2.0, 300.0], [20.0, 0.0, 400.0], [10.0, 4.0, 400.0]];
    let table = PiecewiseTable::from_rows(rows.as_flattened(), 3, Tail::Constant).unwrap();
    let folded = table.folded(1, 350.0).unwrap();
    assert_eq!(folded.row_count(), 4);
    assert_eq!(folded.values(), [15.0, 11.75, 8.5, 6.0]);
    let constant = folded.folded(0, 3.0).unwrap();
    assert_eq!((constant.row_count(), constant.values()), (1, &[7.25][..]));
    // 3 lies beyond the clearances at 300, as it did before.
    assert!(constant.value_and_sides_at(f64::NAN, &[]).1.is_above(0));
    assert!(table.sides(&[3.0, 350.0]).is_above(0));
}

#[test]
fn groups_that_drop_to_zero_at_different_clearances_are_not_folded() {
    let rows = [[10.0, 0.0, 300.0], [2.0, 2.0, 300.0], [20.0, 0.0, 400.0], [10.0, 4.0, 400.0]];
    let table = PiecewiseTable::from_rows(rows.as_flattened(), 3, Tail::Zero).unwrap();
    assert_eq!(*table.folded(1, 350.0).unwrap_err().kind(), ErrorKind::DropsDiffer);
    // In one of the groups there is nothing to interpolate.
    let folded = table.folded(1, 300.0).unwrap();
    assert_eq!((folded.value(&[2.0, 300.0]), folded.value(&[2.1, 300.0])), (2.0, 0.0));
    // Along the clearance each group is its own value, zero beyond its own end.
    assert_eq!(*table.folded(0, 3.0).unwrap_err().kind(), ErrorKind::RangesDiffer { axis: 0 });
}
