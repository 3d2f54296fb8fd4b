import math
import pathlib
import signal
import subprocess
import sys
import threading
import time

import duckdb
import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet
import pytest

import inpact

JOINT = "*SURFACE INTERACTION, NAME=JOINT\n*GAP ELECTRICAL CONDUCTANCE\n4000., 0.\n0., 2.\n"
USER = "*SURFACE INTERACTION, NAME=JOINT\n*GAP ELECTRICAL CONDUCTANCE, USER\n"
SAMPLES = ["spot-weld", "busbar-joint", "retaining-wall", "brake-disc"]
TEXTS = pyarrow.csv.ConvertOptions(column_types={"node": pa.string(), "interaction": pa.string()})


def inpact_command(*arguments: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "inpact", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("sample", SAMPLES)
def test_samples_have_the_bits_of_the_command_line(sample: str, decks: pathlib.Path, tmp_path: pathlib.Path):
    deck, nodes = decks / sample / f"{sample}.inp", decks / sample / f"{sample}-nodes.csv"
    run = inpact_command("eval", deck, "--nodes", nodes, "-o", tmp_path / "out.parquet")
    assert run.returncode == 0, run.stderr
    expected = pyarrow.parquet.read_table(tmp_path / "out.parquet")
    table = pyarrow.csv.read_csv(nodes, convert_options=TEXTS)
    result = inpact.evaluate(inpact.read(deck), table)
    assert result.num_rows == len(result) == table.num_rows
    assert result.column_names == expected.column_names
    found = pa.table(result)
    for name in expected.column_names:
        assert found[name].to_pylist() == expected[name].to_pylist(), name


def test_every_kind_of_table_gives_the_same():
    deck = inpact.parse(JOINT)
    arrow = pa.table({"node": ["1", "2", "3"], "clearance": [0.5, 1.0, 3.0], "epot_jump": [1.0, 2.0, 3.0]})
    tables = [
        arrow,
        arrow.to_reader(),
        arrow.to_batches()[0],
        arrow.to_pandas(),
        pl.from_arrow(arrow),
        arrow.to_pydict(),
        {name: np.array(values) for name, values in arrow.to_pydict().items()},
        {"node": pd.Series(["1", "2", "3"]), "clearance": (0.5, 1.0, 3.0), "epot_jump": np.float32([1, 2, 3])},
    ]
    for table in tables:
        result = inpact.evaluate(deck, table, outputs=["ECD", "SJD"])
        assert result["ECD"].tolist() == [3000.0, 4000.0, 0.0]
        assert result["node"] == ["1", "2", "3"]
        assert result.column_names == ["node", "ECD", "SJD"]
    frame = pl.from_arrow(pa.table(inpact.evaluate(deck, arrow)))
    assert frame["ECD"].to_list() == [3000.0, 4000.0, 0.0]
    assert pd.DataFrame.from_records(pa.table(inpact.evaluate(deck, arrow)).to_pylist())["ECD"][0] == 3000.0


def test_relations_of_duckdb_give_the_same(tmp_path: pathlib.Path):
    rows = 5000
    random = np.random.default_rng(5)
    arrow = pa.table(
        {
            "node": pa.array([str(row) for row in range(rows)]),
            "clearance": random.random(rows) * 3.0,
            "epot_jump": random.normal(size=rows),
        }
    )
    deck = inpact.parse(JOINT)
    expected = pa.table(inpact.evaluate(deck, arrow, outputs=["ECD", "SJD"]))
    pyarrow.parquet.write_table(arrow, tmp_path / "nodes.parquet")
    with duckdb.connect() as connection:
        from_memory = connection.sql("SELECT * FROM arrow")
        from_disk = connection.sql(f"SELECT * FROM '{tmp_path}/nodes.parquet' ORDER BY node::INTEGER")
        for relation in (from_memory, from_disk):
            result = inpact.evaluate(deck, relation, outputs=["ECD", "SJD"])
            assert pa.table(result).to_pydict() == expected.to_pydict()
        # And back: what is evaluated is a table to DuckDB.
        currents = pa.table(result)
        [(count, largest)] = connection.sql("SELECT count(*), max(abs(ECD)) FROM currents").fetchall()
    assert count == rows == currents.num_rows
    assert largest == np.abs(expected["ECD"].to_numpy()).max()


def test_what_is_missing_and_what_is_no_number():
    deck = inpact.parse(JOINT)
    columns = {"clearance": [0.5, None, 1.0], "epot_jump": np.ma.masked_array([1.0, 1.0, 2.0], mask=[0, 0, 1])}
    ecd = inpact.evaluate(deck, columns, outputs=["ECD"])["ECD"]
    assert ecd[0] == 3000.0
    assert math.isnan(ecd[1])
    assert math.isnan(ecd[2])
    text = pa.table(inpact.evaluate(deck, columns, outputs=["ECD"]))["ECD"].to_pylist()
    assert text == [3000.0, None, None]
    for wrong in [[1j], [[1.0]], [object()]]:
        with pytest.raises((TypeError, ValueError), match="clearance"):
            inpact.evaluate(deck, {"clearance": wrong, "epot_jump": [1.0]})
    with pytest.raises(ValueError, match="column `epot_jump` has 2 rows, and `clearance` has 1"):
        inpact.evaluate(deck, {"clearance": [1.0], "epot_jump": [1.0, 2.0]})
    with pytest.raises(inpact.DeckError) as caught:
        inpact.evaluate(deck, {"clearance": ["wide"], "epot_jump": [1.0]}, outputs=["ECD"])
    assert [f.code for f in caught.value.findings if f.severity == "error"]
    with pytest.raises(TypeError, match="found `int`"):
        inpact.evaluate(deck, 3)
    with pytest.raises(TypeError, match="one array"):
        inpact.evaluate(deck, pa.array([1.0]))


def test_no_rows_and_several_batches():
    deck = inpact.parse(JOINT)
    table = pa.table({"clearance": pa.array([], pa.float64()), "epot_jump": pa.array([], pa.float64())})
    nothing = inpact.evaluate(deck, table, outputs=["ECD"])
    assert (nothing.num_rows, nothing.column_names, nothing["ECD"].shape) == (0, ["ECD"], (0,))
    rows = np.arange(50_000.0)
    table = pa.table({"clearance": rows % 3, "epot_jump": rows})
    batches = pa.Table.from_batches(
        [
            batch
            for part in (slice(0, 1), slice(1, 20_001), slice(20_001, 50_000))
            for batch in table.slice(part.start, part.stop - part.start).to_batches()
        ]
    )
    whole, cut = (inpact.evaluate(deck, given, threads=threads) for given, threads in [(table, 1), (batches, 0)])
    assert whole["SJD"].tobytes() == cut["SJD"].tobytes()


def test_arguments_that_are_none():
    deck = inpact.parse(JOINT)
    table = {"clearance": [1.0], "epot_jump": [1.0]}
    for arguments, error, message in [
        ({"outputs": "ECD"}, TypeError, "found a text"),
        ({"outputs": ["ECX"]}, ValueError, "no output `ECX`"),
        ({"outputs": ["ECDA"]}, inpact.DeckError, "area"),
        ({"procedure": "static"}, ValueError, "expected `steady` or `transient`, found `static`"),
        ({"accuracy": "exact"}, ValueError, "`accuracy`"),
        ({"tolerance": 0.0}, ValueError, "above zero"),
        ({"tolerance": 1e-6, "tolerance_relative": 1e-6}, ValueError, "exclude"),
        ({"char_length": math.inf}, ValueError, "finite"),
        ({"interaction": "OTHER"}, inpact.DeckError, "OTHER"),
        ({"progress": 3}, TypeError, "`progress`"),
        ({"user_conductance": 3}, TypeError, "`user_conductance`"),
    ]:
        with pytest.raises(error, match=message):
            inpact.evaluate(deck, table, **arguments)
    for arguments in [{"accuracy": "reference"}, {"tolerance": 1e-3}, {"tolerance_relative": 1e-9}, {"threads": 1}]:
        assert inpact.evaluate(deck, table, **arguments)["ECD"].tolist() == [2000.0]
    with pytest.raises(KeyError, match="no column `ecd`"):
        _ = inpact.evaluate(deck, table)["ecd"]


def test_a_deck_with_errors_is_not_evaluated():
    deck = inpact.parse("*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n1., 1.\n0., 0.\n", name="a.inp")
    with pytest.raises(inpact.DeckError) as caught:
        inpact.evaluate(deck, {"clearance": [1.0], "epot_jump": [1.0]})
    assert [(f.code, f.line) for f in caught.value.findings][0] == ("T001", 4)


def test_a_function_as_conductance():
    deck = inpact.parse(USER)
    seen = []

    def fading(points: inpact.UserPoints):
        seen.append(points)
        return 5.0 * np.exp(-points.clearance)

    clearance = np.linspace(0.0, 3.0, 1000)
    table = {
        "clearance": clearance,
        "epot_jump": np.ones(1000),
        "temp_s": np.full(1000, 7.0),
        "temp_m": np.arange(1000.0),
    }
    result = inpact.evaluate(deck, table, outputs=["ECD"], user_conductance=fading)
    assert result["ECD"].tolist() == (5.0 * np.exp(-clearance)).tolist()
    (points,) = seen
    assert points.interaction == "JOINT"
    assert points.clearance.tolist() == clearance.tolist()
    assert points.temperature[0].tolist() == [7.0] * 1000
    assert points.temperature[1].tolist() == list(range(1000))

    def wrong(points: inpact.UserPoints):
        raise ZeroDivisionError("no conductance here")

    with pytest.raises(ZeroDivisionError, match="no conductance here") as caught:
        inpact.evaluate(deck, table, user_conductance=wrong)
    assert caught.traceback[-1].name == "wrong"
    for given, error in [
        (lambda _: "x", TypeError),
        (lambda _: np.ones(3), ValueError),
        (lambda _: (1, 2, 3), TypeError),
    ]:
        with pytest.raises(error, match="user_conductance"):
            inpact.evaluate(deck, table, user_conductance=given)
    with pytest.raises(inpact.DeckError):
        inpact.evaluate(deck, table, user_conductance=lambda points: -np.ones_like(points.clearance))
    with pytest.raises(inpact.DeckError):
        inpact.evaluate(deck, table)


def large(rows: int):
    random = np.random.default_rng(1)
    return pa.table({"clearance": random.random(rows), "epot_jump": random.random(rows)})


def test_progress():
    seen: list[int] = []
    inpact.evaluate(inpact.parse(JOINT), large(200_000), progress=seen.append)
    assert seen == sorted(seen)
    assert seen[-1] == 200_000

    def stop(rows: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        inpact.evaluate(inpact.parse(JOINT), large(200_000), progress=stop)


@pytest.fixture
def interruptible():
    """Ctrl-C as a terminal has it: a shell's background job begins with SIGINT ignored, and Python leaves it so."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_ctrl_c_stops(interruptible: None):
    deck, table = inpact.parse(JOINT), large(1_000_000)
    start = time.perf_counter()
    timer = threading.Timer(0.1, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(1000):
            inpact.evaluate(deck, table)
    assert time.perf_counter() - start < 10.0


def test_threads_agree_and_other_threads_go_on():
    deck, table = inpact.parse(JOINT), large(100_000)
    expected = inpact.evaluate(deck, table)["SJD"].tobytes()
    found: list[bytes] = []
    counted = 0
    threads = [
        threading.Thread(target=lambda: found.append(inpact.evaluate(deck, table)["SJD"].tobytes())) for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        counted += 1
        time.sleep(0.001)
    assert found == [expected] * 4
    assert counted > 3


def test_nodes_of_a_mesh(decks: pathlib.Path, tmp_path: pathlib.Path):
    path = decks / "weld-mesh" / "weld-mesh.inp"
    deck = inpact.read(path)
    nodes = inpact.nodes(deck)
    assert nodes.num_rows == 25
    run = inpact_command("nodes", path, "-o", tmp_path / "nodes.parquet")
    assert run.returncode == 0, run.stderr
    assert pa.table(nodes).to_pydict() == pyarrow.parquet.read_table(tmp_path / "nodes.parquet").to_pydict()
    assert inpact.evaluate(deck, nodes).num_rows == 25
    with pytest.raises(inpact.DeckError, match="no contact pair"):
        inpact.nodes(inpact.parse(JOINT))
    with pytest.raises(FileNotFoundError):
        inpact.nodes(deck, results="nothing.frd")
