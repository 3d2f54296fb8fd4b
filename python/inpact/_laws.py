"""The laws of an interaction as functions of arrays."""

from __future__ import annotations

from inpact import _inpact

# `typing` takes longer to import than this package does: types are for those who check them.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Any, Literal, overload

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Floats = NDArray[np.float64]
    Against = Literal["clearance", "pressure"]


class GapConductance:
    """The gap electrical conductance σ_g of an interaction, C T⁻¹ L⁻² φ⁻¹ (*GAP ELECTRICAL CONDUCTANCE).

    Found as ``deck.interactions["NAME"].electrical``.
    Source: Abaqus Analysis User's Guide 37.3.1; Keywords Reference Guide, *GAP ELECTRICAL CONDUCTANCE.
    """

    __slots__ = ("_gap",)

    def __init__(self, gap: _inpact.GapConductance) -> None:
        self._gap = gap

    @property
    def interaction(self) -> str:
        """The name of the interaction."""
        return self._gap.interaction

    @property
    def tables(self) -> list[str]:
        """Against what there are tables: ``clearance``, ``pressure`` or both."""
        return self._gap.tables

    @property
    def depends_on(self) -> list[str]:
        """On what the value depends beside clearance and pressure: ``temperature``, ``fv1``, …."""
        flags = self._gap.depends_on
        names = ["temperature", *(f"fv{number}" for number in range(1, len(flags)))]
        return [name for name, depends in zip(names, flags, strict=False) if depends]

    if TYPE_CHECKING:

        @overload
        def conductance(
            self,
            clearance: float | None = None,
            pressure: float | None = None,
            temperature: float | None = None,
            fv: float | Sequence[float] | None = None,
            *,
            derivatives: Literal[False] = False,
        ) -> float: ...
        @overload
        def conductance(
            self,
            clearance: ArrayLike | None = None,
            pressure: ArrayLike | None = None,
            temperature: ArrayLike | None = None,
            fv: ArrayLike | Sequence[ArrayLike] | None = None,
            *,
            derivatives: Literal[False] = False,
        ) -> float | Floats: ...
        @overload
        def conductance(
            self,
            clearance: ArrayLike | None = None,
            pressure: ArrayLike | None = None,
            temperature: ArrayLike | None = None,
            fv: ArrayLike | Sequence[ArrayLike] | None = None,
            *,
            derivatives: Literal[True],
        ) -> tuple[float | Floats, dict[str, float | Floats]]: ...

    def conductance(
        self,
        clearance: Any = None,
        pressure: Any = None,
        temperature: Any = None,
        fv: Any = None,
        *,
        derivatives: bool = False,
    ) -> Any:
        """Evaluate the conductance, as exactly as float64 allows.

        A point is closed where d ≤ 0 or p ≠ 0, and where no clearance is given; closed points read the table
        against pressure where there is one, open points that against clearance, which is 0 where there is none.

        Parameters
        ----------
        clearance : array_like, optional
            Clearance d, L; negative in overclosure.
        pressure : array_like, optional
            Contact pressure p, F L⁻². One of clearance and pressure must be there.
        temperature : array_like, optional
            The average temperature of both sides, θ; needed where the tables depend on it.
        fv : array_like or sequence of array_like, optional
            The averages of the field variables, in their order: a list or tuple has one item each.
        derivatives : bool
            Give the slopes as well: right-hand at an abscissa, zero outside of the table.

        Returns
        -------
        float or ndarray
            The conductance, in the shape that the arguments broadcast to; NaN where an argument that counts is
            NaN, masked or None. A float where all arguments are scalars.
        dict of str to float or ndarray
            The slopes along each argument that was given, only with ``derivatives``.

        Raises
        ------
        TypeError
            For an argument that holds no numbers, or one that the tables depend on and that is missing.
        ValueError
            For shapes that do not broadcast.

        Examples
        --------
        >>> import inpact
        >>> deck = inpact.parse('''*SURFACE INTERACTION, NAME=JOINT
        ... *GAP ELECTRICAL CONDUCTANCE
        ... 8., 0., 300.
        ... 4., 2., 300.
        ... 6., 0., 400.
        ... 2., 2., 400.
        ... ''')
        >>> gap = deck.interactions["joint"].electrical
        >>> gap.conductance(clearance=1.0, temperature=350.0)
        5.0
        >>> gap.conductance(clearance=[0.5, 1.0], temperature=300.0, derivatives=True)
        (array([7., 6.]), {'clearance': array([-2., -2.]), 'temperature': array([-0.02, -0.02])})
        """
        return self._gap.conductance(clearance, pressure, temperature, fv, derivatives=derivatives)

    def table(self, against: Against) -> Table:
        """Give one table by itself.

        Parameters
        ----------
        against : {"clearance", "pressure"}
            Its own variable.

        Raises
        ------
        KeyError
            Where the interaction has no such table.
        """
        return Table(self._gap, against)

    def plot(self, against: Against | None = None, ax: Any = None, **variables: Any) -> Any:
        """Draw the conductance over clearance or pressure.

        Parameters
        ----------
        against : {"clearance", "pressure"}, optional
            The table to draw; the only one where there is one, otherwise that against pressure.
        ax : matplotlib.axes.Axes, optional
            Where to draw; new ones where there are none.
        **variables
            ``temperature`` and ``fv``, where the table depends on them.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        ImportError
            Where matplotlib is not installed.
        """
        import numpy as np

        if ax is None:
            import matplotlib.pyplot as plt

            ax = plt.gca()
        chosen: Any = against or self.tables[-1]
        table = self.table(chosen)
        abscissae = table.abscissae
        span = float(abscissae[-1] - abscissae[0]) or 1.0
        between = [np.linspace(a, b, 9) for a, b in zip(abscissae, abscissae[1:], strict=False)]
        ends = [abscissae[:1], abscissae[-1:], [abscissae[-1] + 0.1 * span]]
        points = np.unique(np.concatenate([*between, *ends]))
        ax.plot(points, table(points, **variables), label=self.interaction)
        ax.set_xlabel("contact pressure" if chosen == "pressure" else "clearance")
        ax.set_ylabel("gap electrical conductance")
        return ax

    def __repr__(self) -> str:
        return repr(self._gap)


class Table:
    r"""One table of a conductance: a function of its own variable, temperature and field variables.

    Unlike `GapConductance.conductance` it knows nothing of closed and open.

    Examples
    --------
    >>> import inpact
    >>> text = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n0., 0.\n4., 2.\n"
    >>> table = inpact.parse(text).interactions["A"].electrical.table("pressure")
    >>> table([0.0, 0.5, 9.0])
    array([0., 1., 4.])
    >>> table.abscissae
    array([0., 2.])
    """

    __slots__ = ("_gap", "against")

    against: Against

    def __init__(self, gap: _inpact.GapConductance, against: Against) -> None:
        self._gap = gap
        self.against = against
        # A table that is not there is found out now.
        gap.abscissae(against)

    @property
    def abscissae(self) -> Floats:
        """The values of its own variable, in ascending order without repetition."""
        return self._gap.abscissae(self.against)

    def __call__(self, values: ArrayLike, temperature: Any = None, fv: Any = None) -> float | Floats:
        """Evaluate it; the value at its ends holds outside."""
        from inpact import _arrays

        found: float | Floats = _arrays.table_values(self._gap, self.against, values, temperature, fv)
        return found

    def __repr__(self) -> str:
        return f"<Table against {self.against} of {self._gap.interaction!r}>"
