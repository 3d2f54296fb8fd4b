"""Times numpy.interp and scipy's RegularGridInterpolator on a table and queries.

Called by the benchmark `kernels` with a directory of f64 files, the number of axes and the number of rounds.
Prints a line for each: name, tab, nanoseconds a row (the least of the rounds).
"""

import sys
import time
from pathlib import Path

import numpy
import scipy
from scipy.interpolate import RegularGridInterpolator


def least_time(run, rows, rounds):
    times = []
    for _ in range(rounds):
        start = time.perf_counter()
        run()
        times.append(time.perf_counter() - start)
    return min(times) * 1e9 / rows


def main():
    directory, axes, rounds = Path(sys.argv[1]), int(sys.argv[2]), max(2, int(sys.argv[3]) // 2)
    knots = [numpy.fromfile(directory / f"knots{axis}") for axis in range(axes)]
    queries = [numpy.fromfile(directory / f"queries{axis}") for axis in range(axes)]
    values = numpy.fromfile(directory / "values")
    rows = len(queries[0])
    if axes == 1:
        spent = least_time(lambda: numpy.interp(queries[0], knots[0], values), rows, rounds)
        print(f"numpy.interp {numpy.__version__}\t{spent}")
    # Axis 0 runs fastest, which is the last axis of an array.
    grid = RegularGridInterpolator(knots[::-1], values.reshape([len(axis) for axis in knots[::-1]]))
    points = numpy.stack(queries[::-1], axis=-1)
    spent = least_time(lambda: grid(points), rows, rounds)
    print(f"scipy {scipy.__version__} RegularGridInterpolator\t{spent}")


main()
