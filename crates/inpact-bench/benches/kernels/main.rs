//! Times.
use inpact_evaluation::kernel::*;
use inpact_evaluation::table::*;
use std::time::Instant;
fn main() {
    let n = 1_000_000usize;
    let mut s = 1u64;
    let mut unit = move || {
        s = s.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (s >> 11) as f64 / 9007199254740992.0
    };
    for n in [n, 10 * n] {
        for (k, log) in [
            (2usize, false),
            (8, false),
            (10, false),
            (16, false),
            (17, false),
            (100, false),
            (1000, false),
            (10, true),
            (100, true),
            (1000, true),
        ] {
            let mut x = 0.0;
            let mut knots = vec![];
            for i in 0..k {
                if log {
                    knots.push(1e-9 * (1.3e9f64).powf((i as f64 + 0.3 * unit()) / (k - 1) as f64));
                } else {
                    knots.push(x);
                    x += 0.5 + unit();
                }
            }
            let cells: Vec<f64> = knots.iter().flat_map(|&k| [1.0 / (1.0 + k), k]).collect();
            let t = PiecewiseTable::from_rows(&cells, 2, Tail::Constant).unwrap();
            let kernel = TableKernel::new(&t);
            let (a, b) = (knots[0], knots[k - 1]);
            let col: Vec<f64> = (0..n)
                .map(|_| if log { a * (b / a).powf(unit() * 1.1 - 0.05) } else { a + (b - a) * (unit() * 1.2 - 0.1) })
                .collect();
            let mut out = vec![1.0; n];
            let mut best = vec![f64::INFINITY; 8];
            let sets = InstructionSet::available();
            for _ in 0..if n > 5_000_000 { 5 } else { 11 } {
                let c = Instant::now();
                out.copy_from_slice(&col);
                std::hint::black_box(&mut out);
                best[0] = best[0].min(c.elapsed().as_secs_f64());
                for (i, &set) in sets.iter().enumerate() {
                    if set == InstructionSet::Scalar && n > 5_000_000 {
                        continue;
                    }
                    let c = Instant::now();
                    kernel.values_with(set, &[&col], &mut out);
                    std::hint::black_box(&mut out);
                    best[1 + i] = best[1 + i].min(c.elapsed().as_secs_f64());
                }
                if n < 5_000_000 {
                    let c = Instant::now();
                    for (o, &x) in out.iter_mut().zip(&col) {
                        *o = t.value_at(x, &[]);
                    }
                    std::hint::black_box(&mut out);
                    best[5] = best[5].min(c.elapsed().as_secs_f64());
                }
            }
            println!(
                "n={n} k={k} log={log} {:?} {:?}: copy {:.2} {:.2?} table {:.2}",
                kernel.search(),
                sets,
                best[0] * 1e9 / n as f64,
                best[1..=sets.len()].iter().map(|b| b * 1e9 / n as f64).collect::<Vec<_>>(),
                best[5] * 1e9 / n as f64
            );
        }
    }
}
