//! Pictures: what is written comes back bit for bit, and what VTK's own writers write is read.

use inpact_results::vtu::{
    Array, Cell, CellKind, Grid, Moment, Space, Values, read_grid, write_collection, write_grid,
};
use inpact_results::{Format, read};
use proptest::prelude::*;

fn written(grid: &Grid) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_grid(grid, &mut bytes).expect("sound");
    bytes
}

fn picture() -> Grid {
    Grid {
        points: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.1], [1.0, 1.0, -0.0], [0.0, 1.0, 1e-300], [2.0, 0.5, 0.0]],
        cells: vec![Cell::face(vec![0, 1, 2, 3], Space::Solid), Cell::face(vec![1, 4, 2], Space::Solid)],
        point_data: vec![
            Array::integers("node", vec![11, 12, 13, 14, 15]),
            Array::reals("ECD < \"0\" & more", vec![1.5, -0.0, f64::MAX, 5e-324, 1.0 / 3.0]),
            Array { name: "U".to_owned(), components: 3, values: Values::Reals((0..15).map(f64::from).collect()) },
        ],
        cell_data: vec![Array::integers("element", vec![100, 200])],
        time: Some(0.25),
    }
}

#[test]
fn what_is_written_comes_back() {
    let (found, problem) = read_grid(&written(&picture()));
    assert_eq!((found, problem), (picture(), None));
    let kinds: Vec<_> = picture().cells.iter().map(|cell| cell.kind).collect();
    assert_eq!(kinds, [CellKind::Quadrilateral, CellKind::Triangle]);
}

#[test]
fn a_picture_is_results_too() {
    let results = read(&written(&picture())).expect("whole");
    assert_eq!((results.format, results.frames.len(), results.frames[0].total_time), (Format::Vtu, 1, Some(0.25)));
    let (field, second) = results.frames[0].column("U2").expect("there");
    assert_eq!(field.rows.nodes(), Some(&[11, 12, 13, 14, 15][..]));
    assert_eq!(second.values, [1.0, 4.0, 7.0, 10.0, 13.0]);
}

#[test]
fn an_empty_picture_comes_back() {
    let (found, problem) = read_grid(&written(&Grid::default()));
    assert_eq!((found, problem), (Grid::default(), None));
}

#[test]
fn what_cannot_be_a_picture_is_refused() {
    let mut grid = picture();
    grid.cells[1].points[0] = 5;
    let error = write_grid(&grid, &mut Vec::new()).expect_err("no such point");
    assert!(error.to_string().contains("a cell names point 5, there are 5"), "{error}");
    let mut grid = picture();
    grid.point_data[0] = Array::integers("node", vec![1]);
    let error = write_grid(&grid, &mut Vec::new()).expect_err("too few");
    assert!(error.to_string().contains("`node` has 1 values"), "{error}");
}

#[test]
fn a_collection_lists_files_by_time() {
    let mut bytes = Vec::new();
    let moments = [(0.0, "a_0.vtu"), (1.0 / 3.0, "a & b.vtu")];
    let moments = moments.map(|(time, file)| Moment { time, file: file.to_owned() });
    write_collection(&moments, &mut bytes).expect("memory");
    let text = String::from_utf8(bytes).expect("UTF-8");
    assert!(text.contains(r#"<DataSet timestep="0.0" part="0" file="a_0.vtu"/>"#), "{text}");
    assert!(text.contains(r#"timestep="0.3333333333333333" part="0" file="a &amp; b.vtu""#), "{text}");
}

/// As ParaView writes it in ASCII, with the ranges it puts into arrays.
const ASCII: &str = r#"<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
  <UnstructuredGrid>
    <Piece NumberOfPoints="3"                    NumberOfCells="1"                   >
      <PointData>
        <DataArray type="Float32" Name="ECD" format="ascii" RangeMin="1" RangeMax="3">
          1.5 2 3e-1
          <InformationKey name="L2_NORM_RANGE" location="vtkDataArray" length="1"><Value index="0">0</Value></InformationKey>
        </DataArray>
        <DataArray type="String" Name="what" format="ascii">65 0</DataArray>
      </PointData>
      <CellData/>
      <Points>
        <DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray>
      </Points>
      <Cells>
        <DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
        <DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
        <DataArray type="UInt8" Name="types" format="ascii">5</DataArray>
      </Cells>
    </Piece>
  </UnstructuredGrid>
</VTKFile>
"#;

#[test]
fn ascii_is_read() {
    let (grid, problem) = read_grid(ASCII.as_bytes());
    assert_eq!(problem, None);
    assert_eq!(grid.point_data, [Array::reals("ECD", vec![1.5, 2.0, 0.3])]);
    assert_eq!(grid.cells, [Cell { kind: CellKind::Triangle, points: vec![0, 1, 2] }]);
}

/// Raw bytes at the end, compressed by zlib in two blocks, with lengths of 4 bytes, big-endian.
#[test]
fn compressed_appended_bytes_are_read() {
    let values = [1.5_f64, -2.0, 0.3];
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_be_bytes()).collect();
    let blocks = [&bytes[..16], &bytes[16..]].map(|block| miniz_oxide::deflate::compress_to_vec_zlib(block, 6));
    let lengths = [2, 16, 8, blocks[0].len(), blocks[1].len()].map(|length| u32::try_from(length).expect("small"));
    let mut appended: Vec<u8> = lengths.iter().flat_map(|length| length.to_be_bytes()).collect();
    appended.extend(blocks.concat());
    let mut file = ASCII
        .replace(r#"byte_order="LittleEndian""#, r#"byte_order="BigEndian" compressor="vtkZLibDataCompressor""#)
        .replace(
            r#"<DataArray type="Float32" Name="ECD" format="ascii""#,
            r#"<DataArray type="Float64" Name="ECD" format="appended" offset="0""#,
        )
        .replace("</VTKFile>\n", "<AppendedData encoding=\"raw\">\n   _")
        .into_bytes();
    file.extend(appended);
    file.extend(b"\n  </AppendedData>\n</VTKFile>\n");
    let (grid, problem) = read_grid(&file);
    assert_eq!((&grid.point_data[..], problem), (&[Array::reals("ECD", values.to_vec())][..], None));
}

#[test]
fn every_other_thing_is_a_problem_with_what_to_do() {
    for (from, to, part) in [
        ("UnstructuredGrid\" version", "PolyData\" version", "`PolyData`"),
        ("format=\"ascii\" RangeMin", "format=\"appended\" offset=\"0\" RangeMin", "no raw bytes"),
        ("byte_order", "compressor=\"vtkLZ4DataCompressor\" byte_order", "vtkLZ4DataCompressor"),
        (">0 1 2<", ">0 1 3<", "point that is not there"),
        (">3<", ">4<", "expected an offset from 0 to 3, found 4"),
        ("1.5 2 3e-1", "1.5 2", "expected 1 numbers for each of 3, found 2"),
        ("1.5 2 3e-1", "1.5 2 x", "found `x`"),
        ("</VTKFile>", "", "ends before `</VTKFile>`"),
    ] {
        let changed = ASCII.replace(from, to);
        assert_ne!(changed, ASCII);
        let (_, problem) = read_grid(changed.as_bytes());
        let problem = problem.unwrap_or_else(|| panic!("{to}"));
        assert!(problem.to_string().contains(part), "{to}: {problem}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn any_values_come_back_bit_for_bit(
        points in prop::collection::vec((any::<f64>(), any::<f64>(), any::<i64>()), 1..200),
        name in "[ -~]{1,12}",
    ) {
        let count = points.len();
        let grid = Grid {
            points: points.iter().map(|(x, y, _)| [*x, *y, 0.0]).collect(),
            cells: (0..count).map(|point| Cell::face(vec![point, (point + 1) % count], Space::Plane)).collect(),
            point_data: vec![
                Array::reals(name.clone(), points.iter().map(|point| point.1).collect()),
                Array::integers("node", points.iter().map(|point| point.2).collect()),
            ],
            ..Grid::default()
        };
        let bytes = written(&grid);
        let (found, problem) = read_grid(&bytes);
        prop_assert_eq!(problem, None);
        prop_assert_eq!(written(&found), bytes);
        prop_assert_eq!(&found.point_data[0].name, &name);
        prop_assert_eq!(&found.point_data[1], &grid.point_data[1]);
    }
}
