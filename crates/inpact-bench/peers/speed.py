"""What a row of a node table costs in the whole program, beside its yardsticks in the same run, as the page docs/speed.md.

    speed.py INPACT [--rows N] [--rounds R] [--benches FOLDER] > docs/speed.md

INPACT is the program of a release build. FOLDER has the built benchmarks `kernels-*` and `facade-*` (target/release/deps); without it their part is left out.
Yardsticks: a copy of the same columns in memory (numpy), and pyarrow, which reads the columns that are read and writes those that are written.

Contenders take turns, each evaluation in a process of its own; the least of all rounds counts. "CPU" is user and system time of all threads, which a busy machine
changes least; "wall" is what a clock shows. Rows per second are made of the CPU time, shared by the threads that there are, unless "wall" is said.
"""

import argparse
import os
import platform
import re
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet

ELECTRICAL = """*GAP ELECTRICAL CONDUCTANCE
5e6, 0.
4e6, 2e-6
3e6, 4e-6
2e6, 6e-6
1e6, 8e-6
5e5, 1e-5
1e5, 1.2e-5
0., 1.4e-5
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
5e6, 0.
5e7, 5e7
1e8, 1e8
1.5e8, 1.4e8
2e8, 2e8
"""
THERMAL = """*GAP CONDUCTANCE
5e3, 0.
2e3, 4e-6
5e2, 1e-5
0., 1.4e-5
*GAP CONDUCTANCE, PRESSURE
5e3, 0.
5e4, 5e7
2e5, 2e8
"""
RADIATION = """*GAP RADIATION
0.8, 0.6
1., 0.
0.5, 1e-5
"""
PORE = """*CONTACT PERMEABILITY
1e-9, 0.
2e-9, 1e8
3e-9, 2e8
"""
HEAD = "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15, STEFAN BOLTZMANN=5.67e-8\n*SURFACE INTERACTION, NAME=JOINT\n"
INCREMENTS = 40


def two_axes():
    """A table of 30 by 30 points along clearance and temperature, the kind on which a grid is faster than the table itself."""
    rows = [
        f"{1e6 * (1.0 - gap / 29.0) * (1.0 + heat / 40.0):.6g}, {gap * 4.8e-7 * (1.0 + 0.3 * (gap % 3)):.6g}, {heat * 33.0:.6g}"
        for heat in range(30)
        for gap in sorted(range(30), key=lambda gap: gap * (1.0 + 0.3 * (gap % 3)))
    ]
    return "*GAP ELECTRICAL CONDUCTANCE\n" + "\n".join(rows) + "\n"


def node_table(rows, order):
    """Rows half of which are closed; `order` is None for rows that stand alone, "node" or "time" for histories sorted by it."""
    chance = np.random.default_rng(1)
    columns = {}
    if order is None:
        columns["node"] = np.arange(1, rows + 1)
    else:
        nodes = rows // INCREMENTS
        node, increment = np.arange(1, nodes + 1), np.arange(INCREMENTS)
        by_node = order == "node"
        columns["node"] = np.repeat(node, INCREMENTS) if by_node else np.tile(node, INCREMENTS)
        columns["time"] = (np.tile(increment, nodes) if by_node else np.repeat(increment, nodes)) / 100.0
        rows = nodes * INCREMENTS
    gap = chance.random(rows) - 0.5
    columns["clearance"] = np.round(np.maximum(gap, 0.0) * 2.4e-5, 9)
    columns["pressure"] = np.round(np.maximum(-gap, 0.0) * 4e8)
    for name in ("temp_s", "temp_m"):
        columns[name] = np.round(20 + 900 * chance.random(rows), 2)
    columns["epot_s"] = np.round(1 + 0.5 * chance.random(rows), 6)
    columns["epot_m"] = np.round(1 - 0.5 * chance.random(rows), 6)
    for name in ("por_s", "por_m"):
        columns[name] = np.round(1e5 * chance.random(rows), 1)
    columns["area"] = np.round(1e-6 * chance.random(rows), 9)
    return pa.table(columns)


class Time:
    """The least CPU and wall time so far."""

    def __init__(self):
        self.cpu = self.wall = float("inf")

    def take(self, work):
        before, start = cpu_time(), time.perf_counter()
        work()
        self.wall = min(self.wall, time.perf_counter() - start)
        self.cpu = min(self.cpu, cpu_time() - before)


def cpu_time():
    """User and system time of this process and of those it has waited for."""
    used = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(each.ru_utime + each.ru_stime for each in used)


class Runs:
    def __init__(self, inpact, folder, rows):
        self.inpact, self.folder, self.rows = inpact, Path(folder), rows
        self.contenders = {}
        for name, laws in {
            "electrical": ELECTRICAL,
            "heat": ELECTRICAL + THERMAL + RADIATION,
            "thermal": THERMAL,
            "pore": PORE,
            "two-axes": two_axes(),
        }.items():
            self.path(f"{name}.inp").write_text(HEAD + laws)
        for name, order in {"rows": None, "by-node": "node", "by-time": "time"}.items():
            table = node_table(rows, order)
            pa.parquet.write_table(table, self.path(f"{name}.parquet"), compression="none", use_dictionary=False, row_group_size=1 << 18)
            pa.csv.write_csv(table, self.path(f"{name}.csv"))
        with pa.OSFile(str(self.path("rows.arrow")), "wb") as file, pa.ipc.new_file(file, node_table(rows, None).schema) as writer:
            writer.write_table(node_table(rows, None), max_chunksize=1 << 16)

    def path(self, name):
        return self.folder / name

    def add(self, key, work):
        self.contenders[key] = (work, Time())

    def evaluation(self, key, deck, table, kind, threads=1, more=(), out=None):
        """An evaluation of a table to the same kind of table, steady unless `more` says otherwise."""
        target = self.path(f"{out or 'out'}.{kind}")
        command = [self.inpact, "eval", self.path(f"{deck}.inp"), "--nodes", self.path(f"{table}.{kind}"), "-o", target]
        command += ["--threads", str(threads), *(more or ("--procedure", "steady"))]

        def work():
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode != 0:
                sys.exit(f"{' '.join(map(str, command))}: {done.stderr}")

        self.add(key, work)

    def measure(self, rounds):
        for _ in range(rounds):
            for work, best in self.contenders.values():
                best.take(work)

    def __getitem__(self, key):
        return self.contenders[key][1]

    def rate(self, key, threads=1):
        """Millions of rows a second by CPU time."""
        return self.rows / self[key].cpu * threads / 1e6

    def wall_rate(self, key):
        return self.rows / self[key].wall / 1e6

    def row(self, key):
        """CPU time of a row in ns."""
        return self[key].cpu * 1e9 / self.rows


def copies(table):
    return [np.array(column.to_numpy()) for column in table.columns if pa.types.is_floating(column.type)]


def add_contenders(runs):
    runs.evaluation("parquet 1", "electrical", "rows", "parquet", 1, out="electrical")
    runs.evaluation("parquet 2", "electrical", "rows", "parquet", 2)
    runs.evaluation("arrow 1", "electrical", "rows", "arrow", 1)
    runs.evaluation("csv", "electrical", "rows", "csv", out="electrical")
    for order in ("by-node", "by-time"):
        for kind in ("parquet", "csv"):
            runs.evaluation(f"{order} {kind}", "electrical", order, kind, more=("--procedure", "transient"))
            # The same columns of the same rows, none of which is an increment of another.
            alone = ("--procedure", "steady", "--outputs", ALONE)
            runs.evaluation(f"{order} {kind} alone", "electrical", order, kind, more=alone)
    for deck in ("thermal", "heat", "pore"):
        runs.evaluation(f"{deck} parquet", deck, "rows", "parquet")
    for way, more in {"full": (), "fast": ("--accuracy", "fast"), "1e-9": ("--tolerance", "1e-9"), "1e-2": ("--tolerance", "1e-2")}.items():
        for deck in ("electrical", "heat", "two-axes"):
            runs.evaluation(f"{way} {deck}", deck, "rows", "parquet", more=("--procedure", "steady", *more))
    # The results of one run say which columns pyarrow writes.
    runs.contenders["parquet 1"][0]()
    runs.contenders["csv"][0]()
    read = ["node", "clearance", "pressure", "epot_s", "epot_m", "area"]
    results = pa.parquet.read_table(runs.path("electrical.parquet"))
    csv_results = pa.csv.read_csv(runs.path("electrical.csv"))
    rows = pa.parquet.read_table(runs.path("rows.parquet"), columns=read)

    def through_pyarrow(threads):
        def work():
            pa.set_cpu_count(threads)
            pa.parquet.read_table(runs.path("rows.parquet"), columns=read, use_threads=threads > 1)
            pa.parquet.write_table(results, runs.path("peer.parquet"), compression="none", use_dictionary=["status"], row_group_size=1 << 18)

        return work

    def csv_through_pyarrow():
        pa.csv.read_csv(runs.path("rows.csv"), read_options=pa.csv.ReadOptions(use_threads=False))
        pa.csv.write_csv(csv_results, runs.path("peer.csv"))

    runs.add("pyarrow 1", through_pyarrow(1))
    runs.add("pyarrow 2", through_pyarrow(2))
    runs.add("pyarrow csv", csv_through_pyarrow)
    runs.add("copy", lambda: (copies(rows), copies(results)))
    return results


ALONE = "ECD,ECDA,SJD,SJDA,WEIGHT,conductance,heat_s,heat_m,status"


def verdict(found, aim, is_met, detail=""):
    return f"| {found} | {aim} | {'met' if is_met else 'missed'}{detail} |"


def page(runs, results, benches):
    copy = runs.row("copy")
    print("# Speed\n")
    print("What a row costs in the whole program, and what the kernels cost by themselves, beside their yardsticks in the same run.")
    print("This page is written by `crates/inpact-bench/peers/speed.py`; figures by hand have no place in it.\n")
    print("```text\ncargo build --release --workspace\ncargo bench -p inpact-bench --no-run")
    print("python3 crates/inpact-bench/peers/speed.py target/release/inpact --benches target/release/deps > docs/speed.md\n```\n")
    print("## How it was measured\n")
    print(f"- Machine: {os.cpu_count()} cores, {cpu_name()}, {platform.system()} {platform.release()}; load {os.getloadavg()[0]:.1f} at the end of the run.")
    print(f"- Python {platform.python_version()}, numpy {np.__version__}, pyarrow {pa.__version__}.")
    print(f"- {runs.rows:,} rows, half of them closed, in random order; {len(results.column_names) - 1} outputs: {', '.join(results.column_names[1:])}.")
    print("- Contenders take turns; each figure is the least of all rounds.")
    print("- CPU time is user and system time of all threads: a busy machine stretches the clock, not the CPU time, though caches and memory are shared all the same.\n")
    print("## The whole program\n")
    print("| | CPU, ns a row | rows a second by CPU time | wall, rows a second |\n|---|---:|---:|---:|")
    for key, name, threads in (
        ("copy", "copy of the same columns in memory", 1),
        ("parquet 1", "Parquet to Parquet, 1 thread", 1),
        ("parquet 2", "Parquet to Parquet, 2 threads", 2),
        ("pyarrow 1", "pyarrow reads and writes the same Parquet columns, 1 thread", 1),
        ("pyarrow 2", "the same, 2 threads", 2),
        ("arrow 1", "Arrow to Arrow, 1 thread", 1),
        ("csv", "CSV to CSV, 1 thread", 1),
        ("pyarrow csv", "pyarrow parses and prints the same CSV, 1 thread", 1),
        ("thermal parquet", "*GAP CONDUCTANCE, Parquet, 1 thread", 1),
        ("heat parquet", "current, conduction and radiation, Parquet, 1 thread", 1),
        ("pore parquet", "*CONTACT PERMEABILITY, Parquet, 1 thread", 1),
        ("by-node parquet", "histories by node, Parquet, 1 thread", 1),
        ("by-time parquet", "histories by time, Parquet, 1 thread", 1),
        ("by-node csv", "histories by node, CSV, 1 thread", 1),
        ("by-time csv", "histories by time, CSV, 1 thread", 1),
    ):
        print(f"| {name} | {runs.row(key):.0f} | {runs.rate(key, threads):.2f} M | {runs.wall_rate(key):.2f} M |")
    print("\n## Aims\n\n| measure | found | aim | |\n|---|---:|---:|---|")
    two = runs.rate("parquet 2", 2)
    print("| Parquet to Parquet, 2 threads, by CPU time ", end=""), print(verdict(f"{two:.1f} M rows/s", "12 M rows/s", 12 <= two))
    share = runs["parquet 2"].wall / runs["pyarrow 2"].wall
    print("| the same against pyarrow, wall ", end=""), print(verdict(f"{share:.2f} ×", "0.5 ×", share <= 0.5))
    share = runs["parquet 2"].cpu / runs["pyarrow 2"].cpu
    print("| the same against pyarrow, CPU ", end=""), print(verdict(f"{share:.2f} ×", "0.5 ×", share <= 0.5))
    rate = runs.rate("csv")
    print("| CSV to CSV, 1 thread ", end=""), print(verdict(f"{rate:.2f} M rows/s", "2.5 M rows/s", 2.5 <= rate))
    share = runs["csv"].cpu / runs["pyarrow csv"].cpu
    print(f"| the same against parse and print alone, by pyarrow | {share:.2f} × | | |")
    for order in ("by-node", "by-time"):
        for kind in ("parquet", "csv"):
            share = runs[f"{order} {kind}"].cpu / runs[f"{order} {kind} alone"].cpu
            name = f"histories {order.replace('-', ' ')} ({kind}, 4 outputs more) against the same rows without "
            print(f"| {name}", end=""), print(verdict(f"{share:.2f} ×", "1.5 ×", share <= 1.5))
    print("\n## Accuracy for speed\n")
    print("CPU time of the whole program against `full`, Parquet to Parquet, 1 thread; ratios within 5 % of 1 are noise.\n")
    print("| | `--accuracy fast` | `--tolerance 1e-9` | `--tolerance 1e-2` |\n|---|---:|---:|---:|")
    for deck, name in (("electrical", "electrical, tables of 8 and 5 points"), ("heat", "current, conduction and radiation"), ("two-axes", "electrical, 30 × 30 points along clearance and temperature")):
        shares = [runs[f"{way} {deck}"].cpu / runs[f"full {deck}"].cpu for way in ("fast", "1e-9", "1e-2")]
        print(f"| {name} | " + " | ".join(f"{share:.2f} ×" for share in shares) + " |")
    if benches is not None:
        print_benches(benches)


def print_benches(folder):
    for name, title, arguments in (
        ("facade", "Arrow in memory to Arrow in memory", ["1000000", "--rounds", "20"]),
        ("kernels", "Kernels", ["1000000", "--rounds", "3"]),
    ):
        programs = [path for path in Path(folder).glob(f"{name}-*") if path.suffix == "" and os.access(path, os.X_OK)]
        if not programs:
            sys.exit(f"{folder} has no benchmark `{name}`")
        newest = max(programs, key=lambda path: path.stat().st_mtime)
        environment = {**os.environ, "INPACT_PYTHON": sys.executable}
        done = subprocess.run([newest, *arguments, "--bench"], capture_output=True, text=True, env=environment)
        if done.returncode != 0:
            sys.exit(f"{newest}: {done.stderr}")
        text = re.sub(r"^## ", "### ", done.stdout.strip(), flags=re.MULTILINE)
        print(f"\n## {title}\n\n{text}")


def cpu_name():
    lines = Path("/proc/cpuinfo").read_text().splitlines() if Path("/proc/cpuinfo").exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.machine()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("inpact", type=Path)
    parser.add_argument("--rows", type=int, default=2_000_000)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--benches", type=Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(arguments.inpact.resolve(), folder, arguments.rows)
        results = add_contenders(runs)
        runs.measure(arguments.rounds)
        page(runs, results, arguments.benches)


if __name__ == "__main__":
    main()
