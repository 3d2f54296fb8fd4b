"""Pictures in both directions, against the programs that users open them with.

    pip install meshio pyvista
    python3 tests/python/vtu_readback.py [PROGRAM]

Pictures that inpact writes are read by meshio and by VTK, and what these write, in each of their modes, is read by inpact;
every number is compared, bit for bit. Exit code 1 where one differs.
With the program itself, `target/debug/inpact` for one, the picture of a sample deck is compared with its table too.
"""

import csv
import pathlib
import subprocess
import sys
import tempfile

import meshio
import numpy as np
import pyvista
import vtk

ROOT = pathlib.Path(__file__).parents[2]


def example(name, argument):
    command = ["cargo", "run", "--quiet", "--locked", "-p", "inpact-results", "--example", name, "--", str(argument)]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True)


def same(what, found, expected):
    found, expected = np.asarray(found), np.asarray(expected)
    if found.shape != expected.shape or found.tobytes() != expected.astype(found.dtype).tobytes():
        sys.exit(f"{what}: {found} is not {expected}")


def written_by_inpact(folder):
    run = example("picture", folder)
    if run.returncode != 0:
        sys.exit(run.stderr)
    grids = []
    for at, time in enumerate([0.0, 0.5, 1.0]):
        path = folder / f"strip_{at}.vtu"
        by_meshio, by_vtk = meshio.read(path), pyvista.read(path)
        same("points", by_meshio.points, by_vtk.points)
        side = np.tile([0.0, 1.0], 41)
        same("sides", by_vtk.points[:, 2], side)
        if not np.allclose(np.hypot(by_vtk.points[:, 0], by_vtk.points[:, 1]), 1.0, rtol=0, atol=1e-15):
            sys.exit("the strip is no circle")
        same("labels", by_vtk.point_data["node"], np.arange(1001, 1083))
        same("values", by_vtk.point_data["ECD"], 1.0 * time * by_vtk.points[:, 0] / 3.0)
        same("small values", by_vtk.point_data["HFL & more <1>"], 1e-300 * time * by_vtk.points[:, 0] / 3.0)
        same("vectors", by_vtk.point_data["normal"], by_vtk.points)
        for name in ["node", "ECD", "HFL & more <1>", "normal"]:
            same(name, by_meshio.point_data[name], by_vtk.point_data[name])
        same("time", by_vtk.field_data["TimeValue"], [time])
        counts = {kind: len(cells) for kind, cells in by_vtk.cells_dict.items()}
        if counts != {vtk.VTK_TRIANGLE: 20, vtk.VTK_QUAD: 30} or by_vtk.n_cells != 50:
            sys.exit(f"cells: {counts}")
        if sum(len(block.data) for block in by_meshio.cells) != 50:
            sys.exit("cells of meshio")
        same("faces", by_vtk.cell_data["face"], np.arange(50))
        grids.append(by_vtk)
    reader = pyvista.get_reader(str(folder / "strip.pvd"))
    same("times", reader.time_values, [0.0, 0.5, 1.0])
    return grids


def drawn_by_program(program, folder):
    deck = ROOT / "decks/weld-mesh/weld-mesh.inp"

    def run(*arguments):
        done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stderr)
        return list(csv.DictReader(done.stdout.splitlines()))

    rows = run("eval", deck)
    run("eval", deck, "-o", folder / "weld.vtu")
    by_meshio, by_vtk = meshio.read(folder / "weld.vtu"), pyvista.read(folder / "weld.vtu")
    if by_vtk.n_cells != 16 or by_vtk.n_points != 25 or len(rows) != 25:
        sys.exit(f"weld: {by_vtk.n_cells} cells, {by_vtk.n_points} points, {len(rows)} rows")
    same("weld: labels", [f"UPPER-1.{label}" for label in by_vtk.point_data["node"]], [row["node"] for row in rows])
    for name in set(rows[0]) - {"node", "interaction", "status", "electrical_status", "thermal_status"}:
        values = [float(row[name]) if row[name] else float("nan") for row in rows]
        same(f"weld: {name}", by_vtk.point_data[name], values)
        same(f"weld: {name}", by_meshio.point_data[name], values)
    # The slave surface is 4 mm square and crowned by 10 micrometres.
    if not np.isclose(by_vtk.compute_cell_sizes()["Area"].sum(), 16e-6, rtol=1e-4):
        sys.exit("weld: the area of the picture")


def read_by_inpact(what, path, grid):
    run = example("columns", path)
    if run.returncode != 0:
        sys.exit(f"{what}: {run.stderr}")
    found = {}
    for _, _, _, column, label, value in csv.reader(run.stdout.splitlines()):
        found.setdefault(column, []).append((int(label), float(value)))
    for name in ["ECD", "HFL & more <1>"]:
        labels, values = zip(*found[name])
        same(f"{what}: {name}", values, grid.point_data[name])
        same(f"{what}: labels", labels, grid.point_data["node"])
    for axis in range(3):
        same(f"{what}: normal", [value for _, value in found[f"normal{axis + 1}"]], grid.point_data["normal"][:, axis])


def written_by_vtk(folder, grid):
    for mode in ["Ascii", "Binary", "Appended"]:
        for compressor in ["None", "ZLib"]:
            for header in ["UInt32", "UInt64"]:
                for order in ["LittleEndian", "BigEndian"]:
                    writer = vtk.vtkXMLUnstructuredGridWriter()
                    path = folder / f"{mode}-{compressor}-{header}-{order}.vtu"
                    writer.SetFileName(str(path))
                    writer.SetInputData(grid)
                    getattr(writer, f"SetDataModeTo{mode}")()
                    getattr(writer, f"SetCompressorTypeTo{compressor}")()
                    getattr(writer, f"SetHeaderTypeTo{header}")()
                    getattr(writer, f"SetByteOrderTo{order}")()
                    # Several compressed blocks an array, the last of them shorter.
                    writer.SetBlockSize(256)
                    writer.EncodeAppendedDataOff()
                    writer.Write()
                    read_by_inpact(path.name, path, grid)
    for compressor in ["LZ4", "LZMA"]:
        writer = vtk.vtkXMLUnstructuredGridWriter()
        path = folder / f"{compressor}.vtu"
        writer.SetFileName(str(path))
        writer.SetInputData(grid)
        getattr(writer, f"SetCompressorTypeTo{compressor}")()
        writer.Write()
        run = example("columns", path)
        if run.returncode != 1 or "ZLib" not in run.stderr:
            sys.exit(f"{compressor}: expected what to do, found `{run.stderr}`")


def written_by_meshio(folder, grid):
    mesh = meshio.read(folder / "strip_2.vtu")
    for options in [{"binary": False}, {"compression": None}, {"compression": "zlib"}]:
        path = folder / "meshio.vtu"
        meshio.write(path, mesh, file_format="vtu", **options)
        if options == {"binary": False}:
            # meshio prints eleven digits.
            run = example("columns", path)
            if run.returncode != 0:
                sys.exit(run.stderr)
            continue
        read_by_inpact(f"meshio {options}", path, grid)


def main():
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        grids = written_by_inpact(folder)
        written_by_vtk(folder, grids[2])
        written_by_meshio(folder, grids[2])
        if len(sys.argv) == 2:
            drawn_by_program(sys.argv[1], folder)
    print(f"pictures: the same for inpact, meshio {meshio.__version__} and VTK {vtk.vtkVersion().GetVTKVersion()}")


main()
