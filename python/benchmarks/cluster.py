"""Dask with two processes on 4·10⁶ rows with histories, one process killed in mid-job; writes docs/python-speed.md.

It ends with an error where the sorted result has another sha256 than that of one process, where rows are lost, or where
anything is left behind.
"""

from __future__ import annotations

import hashlib
import os
import pathlib
import signal
import tempfile
import threading
import time

import numpy as np
import page
import pyarrow as pa
import pyarrow.parquet as pq
from distributed import Client, LocalCluster

import inpact
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
OUTPUTS = ["ECD", "ECDT", "SJDT"]
FILES, NODES, INCREMENTS = 16, 25_000, 10
ROWS = FILES * NODES * INCREMENTS


def write_dataset(folder: pathlib.Path) -> None:
    """Write files of nodes with histories, each node in one file."""
    folder.mkdir()
    random = np.random.default_rng(7)
    for number in range(FILES):
        rows = NODES * INCREMENTS
        columns = {
            "node": np.repeat(np.arange(NODES) + number * NODES, INCREMENTS),
            "time": np.tile(np.linspace(0.0, 1.0, INCREMENTS), NODES),
            "clearance": random.random(rows),
            "epot_jump": random.random(rows),
        }
        pq.write_table(pa.table(columns), folder / f"block-{number:02}.parquet")


def digest(folder: pathlib.Path) -> tuple[str, int]:
    """Give sha256 and number of rows of a result, sorted by node and time."""
    whole = pa.concat_tables([pq.read_table(file) for file in sorted(folder.glob("*.parquet"))])
    whole = whole.sort_by([("node", "ascending"), ("time", "ascending")])
    sum_of_bytes = hashlib.sha256()
    for column in whole.itercolumns():
        sum_of_bytes.update(column.combine_chunks().to_numpy(zero_copy_only=False).tobytes())
    return sum_of_bytes.hexdigest(), whole.num_rows


def one_process(nodes: pathlib.Path, out: pathlib.Path) -> None:
    """Evaluate file by file, here."""
    out.mkdir()
    deck = inpact.parse(DECK)
    for file in sorted(nodes.glob("*.parquet")):
        result = inpact.evaluate(deck, pq.read_table(file), outputs=OUTPUTS, threads=1)
        pq.write_table(pa.table(result), out / file.name)


def on_cluster(nodes: pathlib.Path, out: pathlib.Path, client: Client, victim: int | None) -> list[int]:
    """Evaluate on the cluster, and kill a process when the second file is done; give the rows of each file."""

    def kill(process: int) -> None:
        while len(list(out.glob("*.parquet"))) < 2:
            time.sleep(0.002)
        os.kill(process, signal.SIGKILL)

    killer = threading.Thread(target=kill, args=(victim,)) if victim is not None else None
    if killer:
        killer.start()
    partitions = inpact.dask.evaluate(inpact.parse(DECK), nodes, out, client=client, outputs=OUTPUTS)
    if killer:
        killer.join()
    return [partition.rows for partition in partitions]


def main() -> None:
    """Run all three ways and compare."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        nodes = folder / "nodes"
        write_dataset(nodes)
        rows_in = sum(pq.read_metadata(file).num_rows for file in nodes.glob("*.parquet"))
        start = time.perf_counter()
        one_process(nodes, folder / "alone")
        took = {"alone": time.perf_counter() - start}
        counts = {"alone": rows_in}
        local = LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
        with local as cluster, Client(cluster) as client:
            for run in ["cluster", "killed"]:
                before = sorted(client.run(os.getpid).values())
                start = time.perf_counter()
                counts[run] = sum(on_cluster(nodes, folder / run, client, before[0] if run == "killed" else None))
                took[run] = time.perf_counter() - start
                client.wait_for_workers(2)
                after = sorted(client.run(os.getpid).values())
                assert (before[0] in after) == (run == "cluster"), f"{run}: {before} became {after}"
        names = {
            "alone": "one process, file by file",
            "cluster": "LocalCluster of two processes",
            "killed": "the same, one process killed with SIGKILL after the second file",
        }
        lines = []
        expected, _ = digest(folder / "alone")
        for run, what in names.items():
            found, rows_out = digest(folder / run)
            left = sorted(set(os.listdir(folder / run)) - {file.name for file in nodes.glob("*.parquet")})
            assert (found, rows_in, rows_out, counts[run], left) == (expected, ROWS, ROWS, ROWS, []), (run, found, left)
            lines.append(f"| {what} | {rows_in:,} | {rows_out:,} | {found[:16]}… | {len(left)} | {took[run]:.1f} s |")
        page.write(
            "cluster",
            [
                f"{FILES} Parquet files of {NODES:,} nodes with {INCREMENTS} increments each; "
                f"outputs {', '.join(OUTPUTS)}; {page.machine()}",
                "",
                "| how | rows in, by the footers | rows out | sha256 of the sorted result | files left behind | time |",
                "|---|---|---|---|---|---|",
                *lines,
            ],
        )


if __name__ == "__main__":
    main()
