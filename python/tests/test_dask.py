import hashlib
import os
import pathlib
import signal
import threading
import time

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

import inpact

pytest.importorskip("distributed")

from distributed import Client, LocalCluster

import inpact.dask

DECK = """\
*SURFACE INTERACTION, NAME=JOINT
*GAP ELECTRICAL CONDUCTANCE
4000., 0.
0., 2.
*STEP
*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL
0.1, 1.
*END STEP
"""
OUTPUTS = ["ECD", "ECDT"]


def dataset(folder: pathlib.Path, files: int, nodes: int, increments: int) -> pathlib.Path:
    """Write files of nodes with histories, each node in one file."""
    folder.mkdir()
    random = np.random.default_rng(7)
    for number in range(files):
        labels = np.arange(nodes) + number * nodes
        rows = nodes * increments
        table = pa.table(
            {
                "node": np.repeat(labels, increments),
                "time": np.tile(np.linspace(0.0, 1.0, increments), nodes),
                "clearance": random.random(rows),
                "epot_jump": random.random(rows),
                "area": np.ones(rows),
            }
        )
        pq.write_table(table, folder / f"block-{number}.parquet")
    return folder


@pytest.fixture(scope="module")
def client():
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        yield client


def digest(files: list[pathlib.Path]) -> str:
    tables = [pq.read_table(file) for file in files]
    whole = pa.concat_tables(tables).sort_by([("node", "ascending"), ("time", "ascending")])
    text = hashlib.sha256()
    for column in whole.itercolumns():
        text.update(column.combine_chunks().to_numpy(zero_copy_only=False).tobytes())
    return text.hexdigest()


def one_process(nodes: pathlib.Path, out: pathlib.Path) -> list[pathlib.Path]:
    out.mkdir()
    written = []
    for file in sorted(nodes.glob("*.parquet")):
        result = inpact.evaluate(inpact.parse(DECK), pq.read_table(file), outputs=OUTPUTS)
        pq.write_table(pa.table(result), out / file.name)
        written.append(out / file.name)
    return written


def test_a_cluster_has_the_bits_of_one_process(client, tmp_path: pathlib.Path):
    nodes = dataset(tmp_path / "nodes", files=3, nodes=20, increments=5)
    partitions = inpact.dask.evaluate(inpact.parse(DECK), nodes, tmp_path / "out", client=client, outputs=OUTPUTS)
    assert [partition.rows for partition in partitions] == [100] * 3
    targets = [pathlib.Path(partition.target) for partition in partitions]
    assert [hashlib.sha256(file.read_bytes()).hexdigest() for file in targets] == [p.sha256 for p in partitions]
    assert digest(targets) == digest(one_process(nodes, tmp_path / "alone"))
    assert sorted(os.listdir(tmp_path / "out")) == [f"block-{number}.parquet" for number in range(3)]


def test_a_lost_worker_costs_a_file(client, tmp_path: pathlib.Path):
    nodes = dataset(tmp_path / "nodes", files=8, nodes=2000, increments=10)
    out = tmp_path / "out"
    pids = list(client.run(os.getpid).values())

    def kill() -> None:
        while not list(out.glob("*.parquet")):
            time.sleep(0.005)
        os.kill(pids[0], signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    partitions = inpact.dask.evaluate(inpact.parse(DECK), nodes, out, client=client, outputs=OUTPUTS)
    killer.join()
    assert sum(partition.rows for partition in partitions) == 8 * 20_000
    targets = [pathlib.Path(partition.target) for partition in partitions]
    assert digest(targets) == digest(one_process(nodes, tmp_path / "alone"))
    assert sorted(os.listdir(out)) == [f"block-{number}.parquet" for number in range(8)]


def test_a_history_is_not_cut(client, tmp_path: pathlib.Path):
    nodes = dataset(tmp_path / "nodes", files=1, nodes=6, increments=4)
    whole = pq.read_table(nodes / "block-0.parquet")
    cut = tmp_path / "cut"
    cut.mkdir()
    for number in range(2):
        pq.write_table(whole.slice(number * 10, 10 + 4 * number), cut / f"{number}.parquet")
    with pytest.raises(inpact.DeckError, match=r"node `2` is in .*inpact.dask.repartition"):
        inpact.dask.evaluate(inpact.parse(DECK), cut, tmp_path / "out", client=client, outputs=OUTPUTS)
    written = inpact.dask.repartition(cut, tmp_path / "by-node")
    assert sum(pq.read_metadata(file).num_rows for file in written) == 24
    partitions = inpact.dask.evaluate(
        inpact.parse(DECK), tmp_path / "by-node", tmp_path / "out", client=client, outputs=OUTPUTS
    )
    targets = [pathlib.Path(partition.target) for partition in partitions]
    assert digest(targets) == digest(one_process(nodes, tmp_path / "alone"))


def test_what_is_wrong(client, tmp_path: pathlib.Path):
    nodes = dataset(tmp_path / "nodes", files=1, nodes=2, increments=2)
    with pytest.raises(ValueError, match="the folder of the dataset"):
        inpact.dask.evaluate(inpact.parse(DECK), nodes, nodes, client=client)
    with pytest.raises(FileNotFoundError):
        inpact.dask.evaluate(inpact.parse(DECK), tmp_path / "nothing", tmp_path / "out", client=client)
    with pytest.raises(inpact.DeckError, match="PFL"):
        inpact.dask.evaluate(inpact.parse(DECK), nodes, tmp_path / "out", client=client, outputs=["PFL"])
    assert os.listdir(tmp_path / "out") == []
