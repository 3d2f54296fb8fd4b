"""Runs the recipes of docs/engines.md as they stand there, and compares each with one process, bit by bit.

Usage: ``python engines.py [NAME …]``; each engine must be installed beside the wheel: dask[distributed], duckdb,
polars, ray[data], pyspark, which needs Java. One that is missing is said to be, and nothing else is a reason to go on.
At the end the trap in all of them is shown: a table cut into batches gives other values.
"""

from __future__ import annotations

import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

import inpact

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "engines.md"
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
FILES, NODES, INCREMENTS = 4, 5000, 10
# What a recipe needs, what stands around it, and what gives its result as an Arrow table.
AROUND = {
    "Dask": ("distributed", "", "SAVED", "client.close()"),
    "DuckDB": ("duckdb", "", "currents", ""),
    "Polars": ("polars", "", "currents.to_arrow()", ""),
    "Ray Data": ("ray", "import ray; ray.init(num_cpus=2, include_dashboard=False)", "SAVED", ""),
    "Spark": (
        "pyspark",
        "from pyspark.sql import SparkSession\n"
        "spark = SparkSession.builder.master('local[2]').config('spark.ui.enabled', 'false').getOrCreate()",
        "SAVED",
        "spark.stop()",
    ),
}


def recipes() -> dict[str, str]:
    """Give the code below each heading of the page."""
    parts = re.split(r"^## ", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]
    found = {}
    for part in parts:
        code = re.search(r"```python\n(.*?)```", part, re.DOTALL)
        if code:
            found[part.splitlines()[0]] = code.group(1)
    return found


def write_dataset(folder: pathlib.Path) -> None:
    """Write files of nodes with histories, each node in one file."""
    random = np.random.default_rng(7)
    (folder / "nodes").mkdir()
    for number in range(FILES):
        rows = NODES * INCREMENTS
        columns = {
            "node": np.repeat(np.arange(NODES) + number * NODES, INCREMENTS),
            "time": np.tile(np.linspace(0.0, 1.0, INCREMENTS), NODES),
            "clearance": random.random(rows),
            "epot_jump": random.random(rows),
            "area": np.ones(rows),
        }
        pq.write_table(pa.table(columns), folder / "nodes" / f"block-{number}.parquet")
    (folder / "joint.inp").write_text(DECK)


def column_bits(table: pa.Table) -> dict[str, bytes]:
    """Give the columns that every recipe has, sorted by node and time, as bytes."""
    node = pa.chunked_array(table["node"]).cast(pa.int64())
    table = table.set_column(table.column_names.index("node"), "node", node)
    table = table.sort_by([("node", "ascending"), ("time", "ascending")])
    return {name: table[name].to_numpy().tobytes() for name in ["node", "time", "ECD", "ECDT"]}


def run(folder: pathlib.Path, name: str, code: str) -> pa.Table:
    """Run a recipe in a process of its own, with its folder as the current one."""
    _, before, result, after = AROUND[name]
    code = code.replace("/shared", str(folder))
    if result == "SAVED":
        result = "pq.read_table('results')"
    indented = "\n".join("    " + line for line in "\n".join([before, code]).splitlines())
    # Processes that Dask starts import this file.
    program = (
        "def main():\n"
        f"{indented}\n"
        f"    {after}\n"
        "    import pyarrow.parquet as pq\n"
        f"    pq.write_table({result}, 'result-of-recipe.parquet')\n"
        "if __name__ == '__main__':\n    main()\n"
    )
    (folder / "recipe.py").write_text(program)
    # Spark's workers are whatever `python3` is otherwise.
    environment = {**os.environ, "PYSPARK_PYTHON": sys.executable}
    command = [sys.executable, "recipe.py"]
    captured = {"capture_output": True, "text": True}
    done = subprocess.run(command, cwd=folder, env=environment, timeout=600, check=False, **captured)
    if done.returncode != 0:
        raise SystemExit(f"{name} ended with {done.returncode}:\n{done.stderr[-4000:]}")
    return pq.read_table(folder / "result-of-recipe.parquet")


def main() -> None:
    """Run the recipes that are named, or all."""
    found = recipes()
    assert set(found) == set(AROUND), f"the page has the recipes {sorted(found)}"
    wanted = sys.argv[1:] or list(AROUND)
    deck = inpact.parse(DECK)
    for name in wanted:
        if importlib.util.find_spec(AROUND[name][0]) is None:
            print(f"{name}: not tried, {AROUND[name][0]} is not installed", flush=True)
            continue
        with tempfile.TemporaryDirectory() as temporary:
            folder = pathlib.Path(temporary)
            write_dataset(folder)
            rows = pa.concat_tables([pq.read_table(file) for file in sorted((folder / "nodes").iterdir())])
            expected = column_bits(pa.table(inpact.evaluate(deck, rows, outputs=["ECD", "ECDT"])))
            start = time.perf_counter()
            table = run(folder, name, found[name])
            took = time.perf_counter() - start
            assert table.num_rows == rows.num_rows, f"{name}: {rows.num_rows} rows in, {table.num_rows} out"
            assert column_bits(table) == expected, f"{name}: other bits than one process"
            print(f"{name}: {rows.num_rows} rows in and out, the bits of one process, {took:.1f} s", flush=True)
    cut = [inpact.evaluate(deck, rows.slice(start, 1234), outputs=["ECDT"]) for start in range(0, rows.num_rows, 1234)]
    batches = pa.concat_tables([pa.table(part) for part in cut])
    whole = pa.table(inpact.evaluate(deck, rows, outputs=["ECDT"]))
    wrong = int(np.sum(batches["ECDT"].to_numpy() != whole["ECDT"].to_numpy()))
    assert wrong > 0
    print(f"the trap: cut into batches of 1234 rows, {wrong} of {rows.num_rows} values of ECDT are others")


if __name__ == "__main__":
    os.environ.setdefault("RAY_DEDUP_LOGS", "0")
    main()
