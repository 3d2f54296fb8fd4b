//! The bits of tables: values, sides, slopes, references and folded rows of tables of every shape, over dense and extreme points, as hashes.
//!
//! The hashes were taken before the evaluation was written anew for the last time; whoever changes one says in the commit why the new bits are the better ones.

mod table_judge;

use inpact_evaluation::table::{InstructionSet, PiecewiseTable, Sides, TableKernel};
use table_judge::random_tables::{Range, compile, random_ending, random_point, random_rows};
use table_judge::{Random, Rows};

/// A hash of numbers in their order (FNV-1a); all NaN are one number.
struct Hash(u64);

impl Hash {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn add(&mut self, number: f64) {
        let bits = if number.is_nan() { u64::MAX } else { number.to_bits() };
        for byte in bits.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    fn add_sides(&mut self, sides: Sides, axes: usize) {
        for axis in 0..axes {
            self.add(f64::from(u8::from(sides.is_below(axis)) + 2 * u8::from(sides.is_above(axis))));
        }
    }
}

/// What is hashed of a set of tables.
struct Hashes {
    values: Hash,
    references: Hash,
    slopes: Hash,
    folded: Hash,
}

/// A random set of rows.
#[derive(Clone, Copy, Debug)]
enum Layout {
    /// Each group has abscissae of its own.
    Ragged(Range),
    /// All groups of an axis have the same abscissae, that many an axis.
    Rectilinear(&'static [usize]),
    /// One axis with so many points over some decades, ordinary values.
    Decades(usize),
}

fn rectilinear(random: &mut Random, counts: &[usize]) -> Rows {
    let axes: Vec<Vec<f64>> = counts
        .iter()
        .map(|count| {
            let mut x = [0.0, -0.0, -3.0, 273.15][random.below(4)];
            (0..*count)
                .map(|_| {
                    x += random.positive(-6, 2);
                    x
                })
                .collect()
        })
        .collect();
    let mut rows = Rows::new();
    for index in 0..counts.iter().product() {
        let mut row = vec![random.positive(-10, 10)];
        let mut rest = index;
        for (axis, count) in axes.iter().zip(counts) {
            row.push(axis[rest % count]);
            rest /= count;
        }
        rows.push(row);
    }
    rows
}

fn decades(random: &mut Random, count: usize) -> Rows {
    let mut x = random.positive(-40, -30);
    let mut rows = Rows::new();
    for _ in 0..count {
        let value = match random.below(12) {
            0 => 0.0,
            1 => -0.0,
            _ => random.positive(-10, 10),
        };
        rows.push(vec![value, x]);
        x *= 1.0 + 20.0 * random.unit() / count as f64;
    }
    rows
}

impl Layout {
    fn rows(self, random: &mut Random, axes: usize) -> Rows {
        match self {
            Self::Ragged(range) => random_rows(random, axes, range),
            Self::Rectilinear(counts) => rectilinear(random, counts),
            Self::Decades(count) => decades(random, count),
        }
    }
}

fn points(random: &mut Random, rows: &Rows, count: usize) -> Vec<Vec<f64>> {
    let mut points = Vec::new();
    for _ in 0..count {
        let mut point = random_point(random, rows);
        for coordinate in &mut point {
            *coordinate = match random.below(40) {
                0 => f64::NAN,
                1 => f64::INFINITY,
                2 => f64::NEG_INFINITY,
                3 => -0.0,
                _ => *coordinate,
            };
        }
        points.push(point);
    }
    points
}

fn add_table(hashes: &mut Hashes, random: &mut Random, table: &PiecewiseTable, points: &[Vec<f64>]) {
    let axes = table.axis_count();
    let columns: Vec<Vec<f64>> = (0..axes).map(|axis| points.iter().map(|point| point[axis]).collect()).collect();
    let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let mut expected = Vec::new();
    for point in points {
        let (first, others) = point.split_first().map_or((f64::NAN, &[][..]), |(first, others)| (*first, others));
        let (value, sides) = table.value_and_sides_at(first, others);
        hashes.values.add(value);
        hashes.values.add_sides(sides, axes);
        expected.push((value, sides));
        hashes.references.add(table.reference_value_at(first, others));
        for axis in 0..axes {
            hashes.slopes.add(table.slope_at(axis, first, others));
        }
    }
    let kernel = TableKernel::new(table);
    let mut values = vec![0.0; points.len()];
    let mut sides = vec![Sides::default(); points.len()];
    for set in InstructionSet::available() {
        kernel.values_and_sides_with(set, &columns, &mut values, &mut sides);
        for (row, (value, side)) in expected.iter().enumerate() {
            let is_same = value.to_bits() == values[row].to_bits() || (value.is_nan() && values[row].is_nan());
            assert!(is_same, "{set}: {} instead of {value} at {:?} of {table:?}", values[row], points[row]);
            assert_eq!(sides[row], *side, "{set}: at {:?} of {table:?}", points[row]);
        }
    }
    if axes > 0 {
        let axis = random.below(axes);
        let at = points[random.below(points.len())][axis];
        if at.is_finite()
            && let Ok(folded) = table.folded(axis, at)
        {
            hashes.folded.add(folded.row_count() as f64);
            folded.values().iter().for_each(|value| hashes.folded.add(*value));
            for point in points.iter().take(10) {
                let (value, sides) = folded.value_and_sides_at(point[0], &point[1..]);
                hashes.folded.add(value);
                hashes.folded.add_sides(sides, axes);
            }
        }
    }
}

fn hashes_of(layout: Layout, axes: usize, tables: usize) -> [u64; 4] {
    let mut random = Random::new(0xb175 + axes as u64);
    let mut hashes = Hashes { values: Hash::new(), references: Hash::new(), slopes: Hash::new(), folded: Hash::new() };
    for _ in 0..tables {
        let rows = layout.rows(&mut random, axes);
        let table = compile(&rows, random_ending(&mut random));
        let points = points(&mut random, &rows, 333);
        add_table(&mut hashes, &mut random, &table, &points);
    }
    [hashes.values.0, hashes.references.0, hashes.slopes.0, hashes.folded.0]
}

/// Every shape with its number of axes, how many tables of it are made, and the hashes of their values, references, slopes and folded tables.
const HASHES: &[(Layout, usize, usize, [u64; 4])] = &[
    (
        Layout::Ragged(Range::Ordinary),
        0,
        5,
        [0x857e_9562_759f_17e3, 0x857e_9562_759f_17e3, 0xcbf2_9ce4_8422_2325, 0xcbf2_9ce4_8422_2325],
    ),
    (
        Layout::Ragged(Range::Ordinary),
        1,
        60,
        [0xaaec_56ab_f711_49c7, 0x02f0_4cb4_0d8d_a41b, 0xe31d_603a_fe27_80a0, 0x3a41_c1ed_01c7_c6e1],
    ),
    (
        Layout::Ragged(Range::Ordinary),
        2,
        40,
        [0xc608_3903_4879_e5a9, 0x4165_e687_c376_6557, 0x014e_4b2e_8d85_f8e1, 0x8187_505d_5901_1c24],
    ),
    (
        Layout::Ragged(Range::Ordinary),
        3,
        20,
        [0x6101_c653_e1a0_a2f5, 0x3664_aebf_6cb6_009b, 0x49ec_82ee_64b0_cea9, 0x8560_996b_0f8c_ad3b],
    ),
    (
        Layout::Ragged(Range::Ordinary),
        4,
        10,
        [0x7fab_96d0_33bf_1e2f, 0x8d52_d76b_160e_5e36, 0xe6c8_a5ad_62d9_1905, 0xcbf2_9ce4_8422_2325],
    ),
    (
        Layout::Ragged(Range::AllDecades),
        1,
        60,
        [0x2f0d_cfd4_d6f6_5544, 0x9444_9adc_14a3_75a2, 0x6447_e4f7_83de_2b64, 0x3bbc_02ec_7d0c_e012],
    ),
    (
        Layout::Ragged(Range::AllDecades),
        2,
        40,
        [0x6388_10cf_69ca_f145, 0x1ebf_be2f_4828_bdc4, 0x4b68_7145_29c4_9421, 0xc36f_0355_6e1c_7a59],
    ),
    (
        Layout::Ragged(Range::AllDecades),
        3,
        20,
        [0x7e2c_62de_4cc0_4f63, 0x2b89_d2b2_9462_1c7e, 0x559d_d158_3c9f_4e44, 0x52bd_f68d_77d3_fd43],
    ),
    (
        Layout::Ragged(Range::AllDecades),
        4,
        10,
        [0x6d64_62d5_608c_5721, 0x365d_9766_7969_04ef, 0x5fe7_3180_0127_2ddc, 0xe105_3515_5a51_92d3],
    ),
    (
        Layout::Rectilinear(&[7]),
        1,
        20,
        [0x2cbc_75d7_a2ec_12c1, 0x315f_c6a2_0e31_8b26, 0x195a_aa58_ab4e_04bd, 0xc49d_5824_4cda_250b],
    ),
    (
        Layout::Rectilinear(&[16]),
        1,
        20,
        [0x8d93_2d72_88f3_304f, 0xe5b9_e36b_415c_1964, 0x028c_92e9_1d48_2e4d, 0xd433_503b_4569_4bea],
    ),
    (
        Layout::Rectilinear(&[17]),
        1,
        20,
        [0x17b3_2741_5676_baec, 0x83c3_b308_0895_a086, 0xf41a_f677_403f_fd1e, 0x6294_490f_d1be_e9da],
    ),
    (
        Layout::Rectilinear(&[2, 3]),
        2,
        20,
        [0xbecd_4c4b_c1fb_9bbd, 0xafed_4a5f_316a_be86, 0x33f1_6468_7daa_5347, 0x15b1_2b35_2204_a1b2],
    ),
    (
        Layout::Rectilinear(&[10, 10]),
        2,
        10,
        [0xa57f_7bbd_b246_c373, 0x5ef3_5998_b3c6_355d, 0xda39_13a8_2f97_7f42, 0xd8f6_e87f_07e9_e6ce],
    ),
    (
        Layout::Rectilinear(&[40, 30]),
        2,
        3,
        [0xe00e_8c03_5f1e_f0ec, 0x4baa_94d5_2885_2189, 0x85d5_58d5_db89_47f2, 0x059c_b33e_2a40_f900],
    ),
    (
        Layout::Rectilinear(&[1, 5]),
        2,
        10,
        [0xfdd6_19f0_8f78_6a18, 0x097a_cecf_398b_5a39, 0x2908_6a8d_fc32_d994, 0x6f2e_a944_4cd3_64de],
    ),
    (
        Layout::Rectilinear(&[4, 3, 5]),
        3,
        10,
        [0x92d6_6070_7fdf_7a28, 0x9bda_6ca0_4c0e_e98d, 0xc021_5ff3_37fd_4fbb, 0xec17_8404_0607_4b2e],
    ),
    (
        Layout::Rectilinear(&[4, 1, 5]),
        3,
        10,
        [0x3337_fbcd_80bd_ffe6, 0x5a4a_8cf6_d52b_72eb, 0x7733_1b35_630c_7b43, 0xd9e0_47fd_094d_f631],
    ),
    (
        Layout::Rectilinear(&[3, 3, 2, 4]),
        4,
        5,
        [0x996d_2343_6aa4_a6ef, 0x2c7d_2af7_6e29_2c06, 0x82ca_a437_8827_dabf, 0x7f64_83f0_61eb_09b0],
    ),
    (
        Layout::Decades(2),
        1,
        10,
        [0x5f37_a4fb_cc99_3737, 0xc844_7e68_7e3c_3d1b, 0x1d27_2b7c_b743_2565, 0x795d_9601_5864_59c6],
    ),
    (
        Layout::Decades(9),
        1,
        10,
        [0x27ff_e12d_c540_c748, 0x103d_d460_0c4c_2ef2, 0xc3fa_ba71_8797_f598, 0xd648_f4e9_7b3b_167a],
    ),
    (
        Layout::Decades(16),
        1,
        10,
        [0x0677_6ef4_0263_0c43, 0x65e9_be46_744d_0f04, 0x8587_dc01_25fb_f767, 0x584b_30e7_9bde_0112],
    ),
    (
        Layout::Decades(33),
        1,
        10,
        [0xe699_7fd7_a815_91ac, 0xfa29_c990_85a3_c3d0, 0x9d49_4000_9ef7_8838, 0x15a5_0ea5_def7_0991],
    ),
    (
        Layout::Decades(100),
        1,
        10,
        [0xc6a5_21ae_2256_2a92, 0xd0af_efca_a014_d2ac, 0xe948_901a_47aa_4f19, 0x12bf_bd12_902a_d937],
    ),
    (
        Layout::Decades(1000),
        1,
        10,
        [0x1cb2_d385_0a11_8020, 0x7315_0d1a_c0e8_7978, 0xab6e_6101_d75a_6a34, 0x225a_bf66_a337_76a0],
    ),
];

#[test]
fn tables_of_every_shape_keep_their_bits() {
    let mut changed = String::new();
    for (layout, axes, tables, expected) in HASHES {
        let found = hashes_of(*layout, *axes, *tables);
        if found != *expected {
            let [values, references, slopes, folded] = found;
            let found = format!("[{values:#018x}, {references:#018x}, {slopes:#018x}, {folded:#018x}]");
            changed += &format!("{layout:?}, {axes} axes: {found}\n");
        }
    }
    assert!(changed.is_empty(), "{changed}");
}
