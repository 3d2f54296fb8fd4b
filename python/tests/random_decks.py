"""Decks and node tables by chance: interactions with conductances of every kind, and rows with histories."""

from __future__ import annotations

from typing import Any

import numpy as np

REGIMES = ["STEADY STATE, ELECTRICAL", "ELECTRICAL", ""]


def table(random: np.random.Generator, own: str, depends: int, with_temperature: bool, ascending: bool) -> list[str]:
    """Rows of a conductance: abscissae, then temperature and field variables, the last one slowest."""
    highest = 2.0 if own == "clearance" else 1e6
    outer = [np.array([0.0])]
    if with_temperature:
        outer = [np.sort(random.choice(np.arange(0.0, 900.0, 50.0), random.integers(1, 4), replace=False))]
    outer += [np.sort(random.choice(np.arange(1.0, 9.0), random.integers(1, 3), replace=False)) for _ in range(depends)]
    rows = []
    for index in np.ndindex(*[len(values) for values in reversed(outer)]):
        place = [float(values[at]) for values, at in zip(outer, reversed(index), strict=True)]
        count = int(random.integers(2, 7))
        abscissae = np.concatenate([[0.0], np.sort(random.random(count - 1)) * highest])
        values = np.sort(random.random(count) * 10.0 ** random.integers(-3, 9))
        for value, abscissa in zip(values if ascending else values[::-1], abscissae, strict=True):
            rows.append(", ".join(repr(float(number)) for number in [value, abscissa, *place]))
    return rows


def deck(random: np.random.Generator) -> tuple[str, int]:
    """Lines of a deck with the interaction GAP, and the number of its field variables."""
    fields = int(random.integers(0, 3))
    depends = f", DEPENDENCIES={fields}" if fields else ""
    with_temperature = bool(random.integers(0, 2)) or fields > 0
    lines = ["*HEADING", "By chance", "*SURFACE INTERACTION, NAME=GAP"]
    for keyword in ["GAP ELECTRICAL CONDUCTANCE", "GAP CONDUCTANCE"]:
        kinds = [["clearance"], ["pressure"], ["clearance", "pressure"]][random.integers(0, 3)]
        for own in kinds:
            pressure = ", PRESSURE" if own == "pressure" else ""
            lines.append(f"*{keyword}{pressure}{depends}")
            lines += table(random, own, fields, with_temperature, own == "pressure")
    if random.integers(0, 2):
        lines += ["*GAP HEAT GENERATION", f"{random.random()!r}, {random.random()!r}"]
    regime = REGIMES[random.integers(0, len(REGIMES))]
    lines += ["*STEP", f"*COUPLED TEMPERATURE-DISPLACEMENT{', ' if regime else ''}{regime}", "0.1, 1.", "*END STEP"]
    return "\n".join(lines) + "\n", fields


def rows(random: np.random.Generator, fields: int) -> dict[str, Any]:
    """A node table with histories: nodes in random order of rows, times ascending for each."""
    nodes, increments = int(random.integers(1, 9)), int(random.integers(1, 6))
    count = nodes * increments
    labels = random.permutation(np.repeat(np.arange(1, nodes + 1), increments))
    times = np.empty(count)
    for label in range(1, nodes + 1):
        times[labels == label] = np.sort(random.random(increments))
    closed = random.random(count) < 0.5
    columns = {
        "node": labels,
        "time": times,
        "clearance": np.where(closed, 0.0, random.random(count) * 2.5),
        "pressure": np.where(closed, random.random(count) * 1.2e6, 0.0),
        "temp_s": random.random(count) * 1000.0,
        "temp_m": random.random(count) * 1000.0,
        "epot_s": random.random(count),
        "epot_m": random.random(count),
        "area": random.random(count),
    }
    for field in range(1, fields + 1):
        columns[f"fv{field}_s"] = random.random(count) * 9.0
        columns[f"fv{field}_m"] = random.random(count) * 9.0
    return columns
