"""Scenes: what is held, what conducts, and the states that follow."""

from __future__ import annotations

import os

from inpact import _inpact

# `typing` takes longer to import than this package does: types are for those who check them.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import Any, Literal

    import numpy as np
    from numpy.typing import NDArray

    from inpact._deck import Dialect, Path, RelativeTo

    Field = Literal["potential", "temperature", "pore_pressure"]


def solve(
    path: Path,
    *,
    solver: Literal["direct", "mixed", "iterative"] = "direct",
    tolerance: float | None = None,
    dialect: Dialect | None = None,
    release: str | None = None,
    include_dirs: Sequence[Path] = (),
    include_root: Path | None = None,
    relative_to: RelativeTo | None = None,
    config: Path | None = None,
    isolated: bool = False,
    progress: Callable[[int], object] | None = None,
) -> Solution:
    """Solve a scene: nodes, bulk conductances and the interfaces of a deck that couple them.

    Parameters
    ----------
    path : path-like
        The scene, a TOML file (docs/scenes.md says what it may hold).
    solver : {"direct", "mixed", "iterative"}
        How linear equations are solved; one that does not reach the tolerance is replaced by the next safer one.
    tolerance : float, optional
        The relative error of a flow that is acceptable; the last digit where there is none.
    dialect, release, include_dirs, include_root, relative_to, config, isolated
        As for `inpact.read`, for the deck of the scene.
    progress : callable, optional
        Called now and then with the number of states that are found.

    Raises
    ------
    OSError
        For a file that cannot be read.
    DeckError
        For a scene or a deck with errors, and for a scene without a solution.
    """
    reading = _inpact.Reading(dialect, release, include_dirs, include_root, relative_to, config, isolated)
    return Solution(_inpact.solve(os.fspath(path), solver, tolerance, reading, progress))


class Solution:
    """The states of a scene: one of a steady scene, one an increment of a transient."""

    __slots__ = ("_solution",)

    def __init__(self, solution: _inpact.Solution) -> None:
        self._solution = solution

    @property
    def nodes(self) -> list[str]:
        """The names of the nodes."""
        return self._solution.nodes

    @property
    def links(self) -> list[tuple[str, str]]:
        """The two nodes of each link."""
        return self._solution.links

    @property
    def fields(self) -> list[str]:
        """The fields that were solved for."""
        return self._solution.fields

    @property
    def left_out(self) -> list[str]:
        """What was not solved and why, a sentence each."""
        return self._solution.left_out

    @property
    def times(self) -> NDArray[np.float64]:
        """The time of each state, T; 0 in a steady scene."""
        return self._solution.times

    def values(self, field: Field) -> NDArray[np.float64]:
        """Give the values of a field: a row a state, a column a node; NaN where one is not known.

        Potentials are in φ, temperatures in θ, pore pressures in F L⁻².
        """
        return self._solution.flat_values(field).reshape(len(self.times), len(self.nodes))

    def flows(self, field: Field) -> NDArray[np.float64]:
        """Give the flows through the links, from the first node to the second: a row a state, a column a link.

        Currents (of ``potential``) are in C T⁻¹, heat (of ``temperature``) in F L T⁻¹, fluid (of
        ``pore_pressure``) in L³ T⁻¹.
        """
        return self._solution.flat_flows(field).reshape(len(self.times), len(self.links))

    def at_end(self, field: Field) -> dict[str, float]:
        """Give the last values of a field by the names of the nodes."""
        last = self.values(field)[-1]
        return dict(zip(self.nodes, last.tolist(), strict=True))

    def to_dict(self) -> dict[str, Any]:
        """Give the states as a mapping of columns: ``time``, ``node`` and the fields, a row a state and node."""
        import numpy as np

        times, nodes = self.times, self.nodes
        columns: dict[str, Any] = {"time": np.repeat(times, len(nodes)), "node": nodes * len(times)}
        for field in ("potential", "temperature", "pore_pressure"):
            columns[field] = self._solution.flat_values(field)
        return columns

    def __repr__(self) -> str:
        return repr(self._solution)
