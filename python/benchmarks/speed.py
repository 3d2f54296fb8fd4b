"""Times of the package beside NumPy and SciPy, in one run; writes its section of docs/python-speed.md.

Every pair is measured in turns, so that both meet the same load; the best of all rounds counts.
The wheel must be one for release, with SciPy and pyarrow beside it.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import time
import timeit
from collections.abc import Callable

import numpy as np
import page
import pyarrow as pa
import scipy
from scipy.interpolate import RegularGridInterpolator

import inpact

POINTS = 1_000_000
ROUNDS = 25


def best(functions: list[Callable[[], object]], rounds: int = ROUNDS) -> list[float]:
    """Measure the least time of each function, in seconds; the functions take turns."""
    times = [float("inf")] * len(functions)
    for _ in range(rounds):
        for place, function in enumerate(functions):
            start = time.perf_counter()
            function()
            times[place] = min(times[place], time.perf_counter() - start)
    return times


def deck_of(rows: list[tuple[float, ...]]) -> inpact.Deck:
    """Make a deck with one conductance against pressure."""
    lines = [", ".join(repr(float(number)) for number in row) for row in rows]
    head = "*SURFACE INTERACTION, NAME=GAP\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n"
    return inpact.parse(head + "\n".join(lines) + "\n")


def on_one_thread(function: Callable[[], object]) -> Callable[[], object]:
    """Do the same on one thread, as NumPy and SciPy do; otherwise all cores share it."""

    def alone() -> object:
        os.environ["RAYON_NUM_THREADS"] = "1"
        try:
            return function()
        finally:
            del os.environ["RAYON_NUM_THREADS"]

    return alone


def row(what: str, ours: float, theirs: float, whose: str, aim: str) -> str:
    """Make a row of the table; times in milliseconds."""
    return f"| {what} | {ours * 1e3:.3g} ms | {whose} {theirs * 1e3:.3g} ms | {theirs / ours:.1f} × | {aim} |"


def one_axis(random: np.random.Generator) -> list[str]:
    """Interpolate along pressure alone."""
    pressures = np.concatenate([[0.0], np.sort(random.random(9))]) * 1e6
    values = np.sort(random.random(10)) * 4e3
    gap = deck_of(list(zip(values, pressures, strict=True))).interactions["GAP"].electrical
    points = random.random(POINTS) * 1.1e6
    ours, theirs = gap.conductance(pressure=points), np.interp(points, pressures, values)
    assert np.abs(ours - theirs).max() <= 1e-12 * values.max()

    def conductance() -> object:
        return gap.conductance(pressure=points)

    functions = [conductance, on_one_thread(conductance), lambda: np.interp(points, pressures, values)]
    shared, alone, theirs = best(functions)
    what = "`conductance`, 10⁶ points, table of 10 pressures"
    return [
        row(what, shared, theirs, "`numpy.interp`", "≥ 15 ×"),
        row(f"{what}, one thread", alone, theirs, "`numpy.interp`", "—"),
    ]


def two_axes(random: np.random.Generator) -> list[str]:
    """Interpolate along pressure and temperature."""
    pressures = np.concatenate([[0.0], np.sort(random.random(9))]) * 1e6
    temperatures = np.array([20.0, 150.0, 400.0, 700.0, 1100.0])
    values = random.random((5, 10)) * 4e3
    rows = [
        (values[i, j], pressures[j], temperatures[i]) for i in range(temperatures.size) for j in range(pressures.size)
    ]
    gap = deck_of(rows).interactions["GAP"].electrical
    pressure, temperature = random.random(POINTS) * 1e6 * pressures[-1] / 1e6, 20.0 + random.random(POINTS) * 1080.0
    grid = RegularGridInterpolator((temperatures, pressures), values)
    # As it wants them, so that it has nothing to copy.
    points = np.column_stack([temperature, pressure])
    ours, theirs = gap.conductance(pressure=pressure, temperature=temperature), grid(points)
    assert np.abs(ours - theirs).max() <= 1e-12 * values.max()

    def conductance() -> object:
        return gap.conductance(pressure=pressure, temperature=temperature)

    shared, alone, theirs = best([conductance, on_one_thread(conductance), lambda: grid(points)], 9)
    what = "`conductance`, 10⁶ points, 10 pressures × 5 temperatures"
    return [
        row(what, shared, theirs, "`RegularGridInterpolator`", "≥ 20 ×"),
        row(f"{what}, one thread", alone, theirs, "`RegularGridInterpolator`", "—"),
    ]


def tables(random: np.random.Generator) -> list[str]:
    """Evaluate a table that is there already, beside copies of it."""
    deck = deck_of([(0.0, 0.0), (1e3, 2e5), (4e3, 1e6)])
    columns = {
        "clearance": np.zeros(POINTS),
        "pressure": random.random(POINTS) * 1e6,
        "epot_s": random.random(POINTS),
        "epot_m": random.random(POINTS),
    }
    table = pa.table(columns)
    outputs = ["ECD", "SJD"]
    arrow, arrays, copy = best(
        [
            lambda: inpact.evaluate(deck, table, outputs=outputs, threads=1),
            lambda: inpact.evaluate(deck, columns, outputs=outputs, threads=1),
            lambda: [column.copy() for column in columns.values()],
        ]
    )
    what = "`evaluate` ECD and SJD, 10⁶ rows of four columns of an Arrow table, one thread"
    return [
        row(what, arrow, arrays, "the same columns as NumPy arrays, which are copied first", "—"),
        row(what, arrow, copy, "nothing but a copy of the four columns", "—"),
    ]


def one_point() -> list[str]:
    """Call for a single point."""
    pressures, values = [0.0, 2e5, 1e6], [0.0, 1e3, 4e3]
    gap = deck_of(list(zip(values, pressures, strict=True))).interactions["GAP"].electrical

    def interp() -> object:
        return np.interp(3e5, pressures, values)

    calls = 20_000
    ours, theirs = (
        min(timeit.repeat(function, number=calls, repeat=15)) / calls
        for function in [lambda: gap.conductance(pressure=3e5), interp]
    )
    times = f"{ours * 1e6:.2f} µs | `numpy.interp` {theirs * 1e6:.2f} µs"
    return [f"| `conductance` of one point | {times} | {theirs / ours:.1f} × | < 2 µs |"]


def imports() -> str:
    """Import the package in a process of its own."""
    code = "import time; start = time.perf_counter(); import {}; print(time.perf_counter() - start)"

    def times_of(module: str) -> list[float]:
        command = [sys.executable, "-c", code.format(module)]
        return [float(subprocess.run(command, capture_output=True, text=True, check=True).stdout) for _ in range(15)]

    ours, theirs = times_of("inpact"), times_of("numpy")
    median = statistics.median(ours) * 1e3
    what = f"`import inpact`, least of 15 (median {median:.1f} ms)"
    return row(what, min(ours), min(theirs), "`import numpy`", "< 30 ms")


def main() -> None:
    """Measure all, and write the section."""
    random = np.random.default_rng(1)
    rows = [*one_axis(random), *two_axes(random), *tables(random), *one_point(), imports()]
    page.write(
        "speed",
        [
            f"NumPy {np.__version__}, SciPy {scipy.__version__}, pyarrow {pa.__version__}; {page.machine()}",
            "",
            "| what | inpact | beside | ratio | aim |",
            "|---|---|---|---|---|",
            *rows,
        ],
    )


if __name__ == "__main__":
    main()
