"""Python, the command line over CSV and over Parquet, and Dask give the same bits."""

import pathlib
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet as pq
import pytest

import inpact

pytest.importorskip("distributed")

import random_decks
from distributed import Client, LocalCluster

import inpact.dask

DECKS = 200
SAMPLES = ["spot-weld", "busbar-joint", "retaining-wall", "brake-disc"]
TEXTS = pyarrow.csv.ConvertOptions(column_types={"node": pa.string(), "interaction": pa.string()})


@pytest.fixture(scope="module")
def client():
    # Threads of this process: the same code of workers, without the time that processes take to start.
    with LocalCluster(n_workers=2, processes=False, dashboard_address=None) as cluster, Client(cluster) as client:
        yield client


def evaluated_by_command(deck: pathlib.Path, nodes: pathlib.Path, out: pathlib.Path) -> pathlib.Path:
    command = shutil.which("inpact", path=str(pathlib.Path(sys.executable).parent))
    assert command is not None
    arguments = [command, "eval", deck, "--nodes", nodes, "-o", out]
    run = subprocess.run(arguments, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    return out


def bits(column: pa.ChunkedArray) -> list[object]:
    """The values of a column; numbers by their bits, so that 0 is not -0, and nothing is not NaN."""
    if pa.types.is_floating(column.type):
        return [None if value is None else np.float64(value).tobytes() for value in column.to_pylist()]
    return [None if value is None else str(value) for value in column.to_pylist()]


def agree(found: pa.Table, expected: pa.Table, what: str) -> None:
    assert found.column_names == expected.column_names, what
    for name in expected.column_names:
        assert bits(found[name]) == bits(expected[name]), (what, name)


def csv_of(path: pathlib.Path, like: pa.Table) -> pa.Table:
    types = {field.name: pa.string() if pa.types.is_dictionary(field.type) else field.type for field in like.schema}
    options = pyarrow.csv.ConvertOptions(column_types=types, strings_can_be_null=True, null_values=[""])
    return pyarrow.csv.read_csv(path, convert_options=options)


def judged(client: Client, folder: pathlib.Path, deck: pathlib.Path, table: pa.Table) -> int:
    """Evaluate a table in every way and compare; give the number of values."""
    nodes = folder / "nodes"
    nodes.mkdir(parents=True)
    parquet, csv = nodes / "part.parquet", folder / "nodes.csv"
    pq.write_table(table, parquet)
    pyarrow.csv.write_csv(table, csv, pyarrow.csv.WriteOptions(quoting_style="none"))
    in_python = pa.table(inpact.evaluate(inpact.read(deck), table))
    assert in_python.num_rows == table.num_rows
    agree(pq.read_table(evaluated_by_command(deck, parquet, folder / "p.parquet")), in_python, f"{deck} Parquet")
    agree(csv_of(evaluated_by_command(deck, csv, folder / "c.csv"), in_python), in_python, f"{deck} CSV")
    partitions = inpact.dask.evaluate(deck, nodes, folder / "dask", client=client)
    assert [partition.rows for partition in partitions] == [table.num_rows]
    agree(pq.read_table(partitions[0].target), in_python, f"{deck} Dask")
    return in_python.num_rows * in_python.num_columns


@pytest.mark.parametrize("sample", SAMPLES)
def test_samples_agree(client: Client, sample: str, decks: pathlib.Path, tmp_path: pathlib.Path):
    table = pyarrow.csv.read_csv(decks / sample / f"{sample}-nodes.csv", convert_options=TEXTS)
    assert judged(client, tmp_path / "out", decks / sample / f"{sample}.inp", table) > 100


def test_random_decks_agree(client: Client, tmp_path: pathlib.Path):
    def one(seed: int) -> int:
        random = np.random.default_rng(seed)
        text, fields = random_decks.deck(random)
        folder = tmp_path / str(seed)
        folder.mkdir()
        deck = folder / "gap.inp"
        deck.write_text(text)
        return judged(client, folder, deck, pa.table(random_decks.rows(random, fields)))

    # Most of the time goes to the processes of the command.
    with ThreadPoolExecutor(4) as pool:
        values = list(pool.map(one, range(DECKS)))
    assert len(values) == DECKS
    assert min(values) >= 5
