//! Files written as the manuals describe them, and the folder of real ones.
#![allow(dead_code, reason = "each test uses some of it")]

use std::fmt::Write;
use std::path::{Path, PathBuf};

/// A real file, where the folder of them is at hand.
///
/// They are no part of the project. The folder is taken from `INPACT_RESULTS`, or from `shared/results-samples` beside the
/// repository; where neither is there the test says so and checks nothing.
#[expect(clippy::print_stderr, reason = "whoever runs the tests must learn that there was nothing to read")]
pub(crate) fn sample(name: &str) -> Option<Vec<u8>> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/results-samples");
    let folder = std::env::var_os("INPACT_RESULTS").map_or(beside, PathBuf::from);
    let bytes = std::fs::read(folder.join(name)).ok();
    if bytes.is_none() {
        eprintln!("no `{name}` in `{}`: set INPACT_RESULTS to a folder of results", folder.display());
    }
    bytes
}

/// A word of a `.fil`.
#[derive(Clone, Debug)]
pub(crate) enum W {
    I(i64),
    D(f64),
    A(&'static str),
}

/// A number in Fortran's format 1PD22.15.
pub(crate) fn d22(value: f64) -> String {
    let text = format!("{value:.15e}");
    let (mantissa, exponent) = text.split_once('e').expect("an exponent");
    let exponent: i32 = exponent.parse().expect("an integer");
    let letter = if exponent.abs() < 100 { "D" } else { "" };
    format!("{:>22}", format!("{mantissa}{letter}{}{:02}", if exponent < 0 { '-' } else { '+' }, exponent.abs()))
}

/// The value of [`d22`].
pub(crate) fn of_d22(value: f64) -> f64 {
    format!("{value:.15e}").parse().expect("a number")
}

/// An ASCII `.fil` record by record.
#[derive(Default)]
pub(crate) struct Fil {
    stream: String,
}

impl Fil {
    pub(crate) fn record(&mut self, key: i64, attributes: &[W]) -> &mut Self {
        self.stream.push('*');
        let count = i64::try_from(attributes.len()).expect("few") + 2;
        for word in [W::I(count), W::I(key)].iter().chain(attributes) {
            match word {
                W::I(value) => {
                    let digits = value.to_string();
                    write!(self.stream, "I{:2}{digits}", digits.len()).expect("a string");
                }
                W::D(value) => write!(self.stream, "D{}", d22(*value)).expect("a string"),
                W::A(text) => write!(self.stream, "A{text:<8}").expect("a string"),
            }
        }
        self
    }

    pub(crate) fn begin(&mut self, step: i64, increment: i64, total: f64, within: f64) -> &mut Self {
        let mut attributes =
            vec![W::D(total), W::D(within), W::D(0.0), W::D(0.0), W::I(1), W::I(step), W::I(increment)];
        attributes.extend([W::I(0), W::D(0.0), W::D(0.0), W::D(0.1)]);
        attributes.extend((0..10).map(|_| W::A("")));
        self.record(2000, &attributes)
    }

    /// Ends an increment, and fills two lines with blanks as the solver does.
    pub(crate) fn end(&mut self) -> &mut Self {
        self.record(2001, &[]);
        let full = self.stream.len().div_ceil(80) * 80 + 80;
        let blanks = full - self.stream.len();
        self.stream.push_str(&" ".repeat(blanks));
        self
    }

    pub(crate) fn bytes(&self) -> Vec<u8> {
        let lines = self.stream.as_bytes().chunks(80);
        lines.flat_map(|line| line.iter().copied().chain([b'\n'])).collect()
    }
}

/// A `.fil` with two increments of a contact pair and nodal temperatures and potentials.
pub(crate) fn contact_fil() -> Fil {
    let mut fil = Fil::default();
    fil.record(1921, &[W::A("2024"), W::A("30-Nov-2"), W::A("026"), W::A("00:00:00"), W::I(2), W::I(6), W::D(1.0)]);
    for node in 1..=4 {
        #[expect(clippy::cast_precision_loss, reason = "small")]
        let x = node as f64 / 3.0;
        fil.record(1901, &[W::I(node), W::D(x), W::D(-x), W::D(0.5)]);
    }
    fil.record(1501, &[W::A("       7"), W::I(3), W::I(1), W::I(1), W::I(1), W::A("MAST")]);
    fil.record(1502, &[W::I(20), W::I(5), W::I(4), W::I(1), W::I(2), W::I(3), W::I(4)]);
    fil.record(1902, &[W::I(1), W::I(2), W::I(3), W::I(0), W::I(0), W::I(0)]);
    fil.record(1940, &[W::I(7), W::A("ASSEMBLY"), W::A("_SLAVE_S"), W::A("URFACE")]);
    fil.end();
    for increment in 1..=2 {
        #[expect(clippy::cast_precision_loss, reason = "small")]
        let time = increment as f64 * 0.1;
        fil.begin(2, increment, 1.0 + time, time);
        fil.record(1911, &[W::I(1), W::A("ALL"), W::A("")]);
        for node in 1..=3 {
            #[expect(clippy::cast_precision_loss, reason = "small")]
            let at = node as f64 * time;
            fil.record(101, &[W::I(node), W::D(at), W::D(-at), W::D(at * 1e-120)]);
            fil.record(201, &[W::I(node), W::D(300.0 + at)]);
            fil.record(105, &[W::I(node), W::D(at / 7.0)]);
        }
        fil.record(1503, &[W::I(0), W::A("       7"), W::A("MAST"), W::A("")]);
        for node in 1..=2 {
            #[expect(clippy::cast_precision_loss, reason = "small")]
            let at = node as f64 * time;
            fil.record(1504, &[W::I(node), W::I(3)]);
            fil.record(1511, &[W::D(10.0 * at), W::D(at), W::D(-at)]);
            fil.record(1521, &[W::D(-1e-6 * at), W::D(at), W::D(0.0)]);
            for key in 1528..=1548 {
                #[expect(clippy::cast_precision_loss, reason = "small")]
                let value = key as f64 * at;
                fil.record(key, &[W::D(value)]);
            }
        }
        fil.record(1522, &[W::D(5.0), W::D(0.0), W::D(3.0), W::D(4.0)]);
        fil.record(1524, &[W::D(2.25)]);
        fil.record(1999, &[W::D(1.0), W::D(2.0)]);
        fil.end();
    }
    fil
}

/// A `.frd` in the long format with two times, one of them with eight components.
pub(crate) fn frd() -> String {
    let mut text = String::from(
        "    1C\n    1UUSER\n    2C                             2                                     1\n",
    );
    text.push_str(
        " -1         1 1.00000E+00 0.00000E+00-2.50000E-01\n -1         2 1.00000E+00 0.00000E+00 0.00000E+00\n -3\n",
    );
    text.push_str("    3C                             1                                     1\n -1         1    1    0    1\n -2         1         2\n -3\n");
    for (kode, time) in ["5.00000E-01", "1.00000E+00"].iter().enumerate() {
        let (kode, increment) = (kode * 2 + 1, kode + 1);
        let head = |kode: usize, nodes: usize| {
            format!(
                "    1PSTEP                {kode:12}{increment:12}{:12}\n  100CL  101{time:>12}{nodes:12}{:20} 0{increment:5}{:10} 1\n",
                1, "", 1
            )
        };
        text.push_str(&head(kode, 2));
        text.push_str(
            " -4  DISP        4    1\n -5  D1          1    2    1    0\n -5  D2          1    2    2    0\n",
        );
        text.push_str(" -5  D3          1    2    3    0\n -5  ALL         1    2    0    0    1ALL\n");
        text.push_str(" -1         1 1.00000E-03-2.00000E-03 3.00000E-03\n -1         2 4.00000E-03 5.00000E-03-6.0000E-100\n -3\n");
        text.push_str(&head(kode + 1, 1));
        text.push_str(" -4  MANY        8    1\n");
        for at in 1..=8 {
            writeln!(text, " -5  C{at}          1    1    1    0").expect("a string");
        }
        text.push_str(" -1         2 1.00000E+00 2.00000E+00 3.00000E+00 4.00000E+00 5.00000E+00 6.00000E+00\n");
        text.push_str(" -2           7.00000E+00-8.00000E+00\n -3\n");
    }
    text.push_str(" 9999\n");
    text
}

/// A `.dat` as ccx 2.20 prints it, with its misspelt titles.
pub(crate) fn dat() -> String {
    let mut text = String::new();
    for time in ["0.5000000E+00", "0.1000000E+01"] {
        write!(
            text,
            "\n displacements (vx,vy,vz) for set NALL and time  {time}\n\n         1  0.000000E+00 -1.500000E-05  3.068865E-05
\n temperatures for set NALL and time  {time}\n\n         1  3.000000E+02
\n stresses (elem, integ.pnt.,sxx,syy,szz,sxy,sxz,syz) for set EALL and time  {time}\n\n         1   1  1.0E+00  1.0E+00  1.0E+00  1.0E+00  1.0E+00  1.0E+00
\n relative contact displacement (slave node,normal,tang1,tang2) for all contact elements and time {time}\n
        65 -1.047481E-04  0.000000E+00  0.000000E+00\n        66 -1.044770E-04  0.000000E+00  1.0000000-101
\n contact stress (slave element+face,press,tang1,tang2) for all contact elements and time {time}\n
        28          3  1.017562E+02  0.000000E+00  0.000000E+00\n        28          3  1.000000E+02  0.000000E+00  0.000000E+00
\n contact print energy (slave element+face,energy)for all contact elements and time {time}\n\n        28          3  8.096094E-06
\n total number of contact elements for time  {time}\n\n              252\n
\n statistics for slave set SSLAV, master set SMAST and time  {time}\n
   total surface force (fx,fy,fz) and moment about the origin (mx,my,mz)\n
    1.000000E+00  2.000000E+00  3.000000E+00  4.000000E+00  5.000000E+00  6.000000E+00\n
   center of gravity and mean normal\n
    2.502056E-01  2.502056E-01  9.995740E-01          NaN          NaN          NaN\n
   moment about the center of gravity(mx,my,mz)\n
   -5.142940E-03  5.142940E-03 -1.594095E-17\n
   area,  normal force (+ = tension) and shear force (size)\n
    2.500000E-01 -2.500000E+01  4.063595E-18\n"
        )
        .expect("a string");
    }
    text
}

/// Field reports of two parts with their sums, then XY data.
pub(crate) fn rpt() -> String {
    let stars = "*".repeat(80);
    let field = |part: &str, rows: &str| {
        format!(
            "Field Output reported at nodes for part: {part}\n   Averaged at nodes\n\n            Node           U.U1    U.Magnitude         CPRESS\n           \
             Label          @Loc 1          @Loc 1          @Loc 1\n{}\n{rows}\n\n  Minimum             0.     1.E+00      2.E-03\n      At Node              1              1              1\n\n",
            "-".repeat(60)
        )
    };
    let mut text = format!(
        "{stars}\nField Output Report, written Mon Nov 30 00:00:00 2026\n\nSource 1\n---------\n\n   ODB: /home/user/job.odb\n   \
         Step: WELD\n   Frame: Increment     10: Step Time =    1.500\n\nLoc 1 : Nodal values from source 1\n\n"
    );
    text.push_str(&field("A", "               1     644.116E-06             -0.         125.E-03\n               2     1.09260E-03         7.E+00              0."));
    text.push_str(&field("B", "               1    -15.4724E-06         1.E+00              1."));
    text.push_str("\n               X       CPRESS_n1      CPRESS_n12            Wtot\n\n");
    text.push_str("   0.0000000E+00   1.0000000E+00  -2.0000000E+00         NoValue\n   1.0000000E-01   3.0000000E+00   4.0000000E-03   5.0000000E+00\n\n\n");
    text
}
