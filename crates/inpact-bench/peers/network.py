"""Time and memory of the network solvers and of their peers on the same grids, as the page docs/network-speed.md.

    network.py INPACT_BENCH [--rounds R] [--plot FILE.svg] [--grids 100x100,46x46x46,...]

INPACT_BENCH is the program `inpact-bench` of a release build. The peers are CHOLMOD (scikit-sparse before 0.5; orderings AMD and METIS) and
SuperLU (scipy; ordering MMD of A'+A, symmetric mode, no pivoting); a peer that is not installed is left out. All use one thread.

Contenders take turns, each round of each in a process of its own; the least of all rounds counts, where one takes over 30 s of one round. Times are wall seconds, without reading files.
Memory is the peak above what the process held with the network, or the matrix, in memory.
"""

import os

for name in ("OMP", "OPENBLAS", "MKL", "BLIS"):
    os.environ[name + "_NUM_THREADS"] = "1"  # read when numpy is imported

import argparse
import json
import math
import subprocess
import sys
import tempfile
import time
from functools import partial
from pathlib import Path
from typing import Callable, NamedTuple

import numpy as np
from scipy.io import mmread
from scipy.sparse import csc_matrix, tril
from scipy.sparse.linalg import splu

try:
    from sksparse.cholmod import analyze as cholmod_analyze
except ImportError:
    cholmod_analyze = None

GRIDS = "100x100,316x316,1000x1000,22x22x22,32x32x32,46x46x46,64x64x64"
SOLVERS = {
    "inpact, direct": ["--solver", "direct"],
    "inpact, direct, 1e-9": ["--solver", "direct", "--tolerance", "1e-9"],
    "inpact, mixed": ["--solver", "mixed"],
    "inpact, mixed, 1e-9": ["--solver", "mixed", "--tolerance", "1e-9"],
    "inpact, iterative": ["--solver", "iterative"],
}
REFERENCE = "CHOLMOD, AMD"
ONCE = 30.0  # seconds from which one round is enough


class Peer(NamedTuple):
    """One way to solve A x = b. `factor` takes A and what `analyze` gave, or None without an analysis."""

    triangle: bool  # wants the lower triangle only
    analyze: Callable | None
    factor: Callable
    solve: Callable
    lower: Callable  # L as a sparse matrix


def cholmod(ordering):
    def factor(a, symbolic):
        symbolic.cholesky_inplace(a)
        return symbolic

    return Peer(
        triangle=True,
        analyze=lambda a: cholmod_analyze(a, mode="auto", ordering_method=ordering),
        factor=factor,
        solve=lambda f, b: f.solve_A(b),
        lower=lambda f: f.L(),
    )


def superlu():
    def factor(a, _):
        return splu(a, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})

    return Peer(triangle=False, analyze=None, factor=factor, solve=lambda f, b: f.solve(b), lower=lambda f: f.L)


PEERS = {"SuperLU, MMD": superlu()}
if cholmod_analyze:
    PEERS = {REFERENCE: cholmod("amd"), "CHOLMOD, METIS": cholmod("metis")} | PEERS


def timed(work, *args):
    start = time.perf_counter()
    result = work(*args)
    return result, time.perf_counter() - start


def resident_mib(key):
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith(key)) / 1024


def solve_once(peer, matrix):
    a = csc_matrix(tril(matrix)) if peer.triangle else matrix
    b = matrix @ np.random.default_rng(0).uniform(-1.0, 1.0, matrix.shape[0])
    base = resident_mib("VmRSS")
    with open("/proc/self/clear_refs", "w") as refs:
        refs.write("5")  # the peak starts anew here
    symbolic, order = timed(peer.analyze, a) if peer.analyze else (None, 0.0)
    factor, factoring = timed(peer.factor, a, symbolic)
    x, solving = timed(peer.solve, factor, b)
    peak = resident_mib("VmHWM") - base
    return {
        "order": order,
        "factor": factoring,
        "solve": solving,
        "whole": order + factoring + solving,
        "memory": peak,
        "entries": int(np.count_nonzero(peer.lower(factor).data)),
        "residual": float(np.abs(b - matrix @ x).max() / np.abs(b).max()),
    }


def in_a_child(work, *args):
    """What `work` returns, run in a forked process, so that its peak is its own."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        with os.fdopen(writing, "w") as out:
            json.dump(work(*args), out)
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as result:
        text = result.read()
    os.waitpid(child, 0)
    return json.loads(text)


def inpact(program, grid, options):
    sizes = [f"--n{axis}={size}" for axis, size in zip("xyz", grid)]
    out = subprocess.run([program, "grid", *sizes, *options, "--rounds", "1"], capture_output=True, check=True)
    line = json.loads(out.stdout)
    return line | {"memory": line["peak_mib"] - line["base_mib"]}


def least(rounds):
    """The round with the least whole time, with the least of every part."""
    best = dict(min(rounds, key=lambda one: one["whole"]))
    for part in ("set_up", "order", "factor", "solve", "memory"):
        if part in best:
            best[part] = min(one[part] for one in rounds)
    return best


def measure(program, grid, rounds):
    """The results of every contender on one grid, by name."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "grid.mtx"
        sizes = [f"--n{axis}={size}" for axis, size in zip("xyz", grid)]
        subprocess.run([program, "grid-matrix", *sizes, path], check=True)
        matrix = csc_matrix(mmread(path))
    contenders = {name: partial(inpact, program, grid, options) for name, options in SOLVERS.items()}
    contenders |= {name: partial(in_a_child, solve_once, peer, matrix) for name, peer in PEERS.items()}
    found = {name: [] for name in contenders}
    for _ in range(rounds):
        for name, run in contenders.items():
            if not found[name] or found[name][0]["whole"] < ONCE:
                found[name].append(run())
    return {name: least(rounds) for name, rounds in found.items()}


def number(value):
    if value == 0:
        return "—"
    if value >= 100:
        return f"{value:,.0f}"
    return f"{value:.3g}"


def table(grid, found):
    unknowns = math.prod(grid)
    print(f"\n## {' × '.join(map(str, grid))}: {unknowns:,} unknowns\n")
    print("| solver | set up | order | factor | solve | whole | : CHOLMOD, AMD | memory | entries of the factor | residual |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|")
    reference = found.get(REFERENCE)
    for name, one in found.items():
        ratio = f"{one['whole'] / reference['whole']:.2f}" if reference else "—"
        parts = [number(one.get(part, 0)) for part in ("set_up", "order", "factor", "solve", "whole")]
        entries = f"{one['entries']:,}" if one["entries"] else "—"
        print(f"| {name} | {' | '.join(parts)} | {ratio} | {number(one['memory'])} | {entries} | {one['residual']:.0e} |")


def exponent(points):
    """The slope of a straight line through points of two logarithmic axes."""
    x, y = np.log(np.array(points).T)
    return float(np.polyfit(x, y, 1)[0])


def growth(results):
    print("\n## Growth\n")
    print("Exponents of a straight line through the logarithms of time, or memory, and unknowns.\n")
    print("| solver | time, 2-D | time, 3-D | memory, 2-D | memory, 3-D |")
    print("|---|---:|---:|---:|---:|")
    names = list(dict.fromkeys(name for _, found in results for name in found))
    for name in names:
        cells = []
        for part in ("whole", "memory"):
            for dimensions in (2, 3):
                of = [(math.prod(grid), found[name][part]) for grid, found in results if len(grid) == dimensions]
                cells.append(f"{exponent(of):.2f}" if len(of) > 1 else "—")
        print(f"| {name} | {' | '.join(cells)} |")


COLOURS = ["#0b5fa5", "#7fb2dd", "#d1495b", "#eda5ad", "#2e8b57", "#8a6d3b", "#7b5ea7", "#555555"]


def plot(results):
    """Time against unknowns over two logarithmic axes: a panel for two dimensions, one for three."""
    width, height, left, top, bottom = 960, 460, 70, 60, 400
    text = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12">',
        f'<rect width="{width}" height="{height}" fill="white"/>',
        '<text x="24" y="28" font-size="16">Whole time of a solution against unknowns</text>',
    ]
    times = [one["whole"] for _, found in results for one in found.values()]
    low, high = math.floor(math.log10(min(times))), math.ceil(math.log10(max(times)))
    y_of = lambda value: bottom - (math.log10(value) - low) / (high - low) * (bottom - top)
    names = list(dict.fromkeys(name for _, found in results for name in found))
    for panel, dimensions in enumerate((2, 3)):
        start, end = left + panel * 360, left + panel * 360 + 310
        of = [(math.prod(grid), found) for grid, found in results if len(grid) == dimensions]
        first, last = math.floor(math.log10(of[0][0])), math.ceil(math.log10(of[-1][0]))
        x_of = lambda value: start + (math.log10(value) - first) / (last - first) * (end - start)
        text.append(f'<text x="{start}" y="{top - 10}">{dimensions} dimensions</text>')
        for decade in range(low, high + 1):
            y = y_of(10.0**decade)
            text.append(f'<line x1="{start}" y1="{y:.1f}" x2="{end}" y2="{y:.1f}" stroke="#dddddd"/>')
            text.append(f'<text x="{start - 6}" y="{y + 4:.1f}" text-anchor="end">{10.0**decade:g} s</text>')
        for decade in range(first, last + 1):
            x = x_of(10.0**decade)
            text.append(f'<line x1="{x:.1f}" y1="{top}" x2="{x:.1f}" y2="{bottom}" stroke="#dddddd"/>')
            text.append(f'<text x="{x:.1f}" y="{bottom + 18}" text-anchor="middle">1e{decade}</text>')
        for name, colour in zip(names, COLOURS):
            points = [(x_of(unknowns), y_of(found[name]["whole"])) for unknowns, found in of if name in found]
            path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
            text.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
            text += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>' for x, y in points]
    for place, (name, colour) in enumerate(zip(names, COLOURS)):
        y = top + 20 * place
        text.append(f'<line x1="770" y1="{y}" x2="800" y2="{y}" stroke="{colour}" stroke-width="2"/>')
        text.append(f'<text x="808" y="{y + 4}">{name}</text>')
    text.append(f'<text x="{left}" y="{bottom + 44}">unknowns</text></svg>')
    return "\n".join(text) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="INPACT_BENCH")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--plot", type=Path)
    parser.add_argument("--grids", default=GRIDS)
    arguments = parser.parse_args()
    results = []
    for name in arguments.grids.split(","):
        grid = [int(size) for size in name.split("x")]
        found = measure(arguments.program, grid, arguments.rounds)
        results.append((grid, found))
        table(grid, found)
        sys.stdout.flush()
    growth(results)
    if arguments.plot:
        arguments.plot.write_text(plot(results))


main()
