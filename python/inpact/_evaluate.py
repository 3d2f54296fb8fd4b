"""The interface laws of a deck over tables of nodes."""

from __future__ import annotations

import os
from collections.abc import Mapping

# `typing` takes longer to import than this package does: types are for those who check them.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import Any, Literal

    from inpact._deck import Deck, Path
    from inpact._inpact import Result
    from inpact._user import UserPoints


def evaluate(
    deck: Deck,
    table: Any,
    *,
    outputs: Sequence[str] | None = None,
    interaction: str | None = None,
    procedure: Literal["steady", "transient"] | None = None,
    accuracy: Literal["reference", "full", "fast"] = "full",
    tolerance: float | None = None,
    tolerance_relative: float | None = None,
    derivatives: bool = False,
    char_length: float | None = None,
    history_start: Literal["first-row", "at-rest"] = "first-row",
    user_conductance: Callable[[UserPoints], Any] | None = None,
    threads: int = 0,
    progress: Callable[[int], object] | None = None,
) -> Result:
    """Evaluate the interface laws of a deck on the rows of a node table.

    Rows out are rows in, in their order. The bits are those of ``inpact eval``, for any number of threads.

    Parameters
    ----------
    deck : Deck
        The deck; errors in the interactions that are used end in a `DeckError`.
    table : Arrow stream or mapping
        Anything with ``__arrow_c_stream__`` (tables and readers of pyarrow, DataFrames of polars and pandas,
        relations of DuckDB), whose numeric columns are not copied, or a mapping of names to arrays.
        ``inpact.explain("columns")`` lists the columns with their units; null is a missing number, NaN is NaN.
    outputs : sequence of str, optional
        The columns of results that are wanted, all that deck and table give where there are none.
        One that cannot be given is an error.
    interaction : str, optional
        The interaction that governs every row, instead of column ``interaction``.
    procedure : {"steady", "transient"}, optional
        Instead of what the procedures of the deck say.
    accuracy : {"reference", "full", "fast"}
        How exactly the values of tables are found: in twice the precision of float64 rounded once, within two
        units in the last place an axis, or in the cheapest form whose bound is within 1e-4 of the largest value.
    tolerance, tolerance_relative : float, optional
        The error that is acceptable, as a part of the largest value of a table, or of the value itself.
    derivatives : bool
        Give the slopes of conductances and permeability as well.
    char_length : float, optional
        The characteristic element length of all rows, L.
    history_start : {"first-row", "at-rest"}
        Where the histories of nodes start.
    user_conductance : callable, optional
        The conductance of interactions with *GAP ELECTRICAL CONDUCTANCE, USER: it is called once an
        interaction with the `UserPoints` of all rows, and gives an array, or a tuple of an array and its slopes
        along the temperatures of slave and master.
    threads : int
        So many threads; 0 for one a core.
    progress : callable, optional
        Called now and then with the number of rows that are done.

    Returns
    -------
    Result
        The key columns and the results; anything that takes an Arrow stream takes it, and ``result["ECD"]`` is
        a column as an array.

    Raises
    ------
    DeckError
        For a deck or a table with errors: its ``findings`` say what and where.
    TypeError, ValueError
        For arguments that are none of these.

    Examples
    --------
    >>> import inpact
    >>> deck = inpact.parse('''*SURFACE INTERACTION, NAME=JOINT
    ... *GAP ELECTRICAL CONDUCTANCE
    ... 4000., 0.
    ... 0., 2.
    ... ''')
    >>> result = inpact.evaluate(deck, {"clearance": [0.5, 1.0], "epot_jump": [1.0, 2.0]}, outputs=["ECD", "SJD"])
    >>> result["ECD"]
    array([3000., 4000.])
    """
    if isinstance(table, Mapping):
        from inpact import _arrays

        rows: Any = _arrays.columns(table)
    elif hasattr(table, "__arrow_c_stream__"):
        rows = table
    elif hasattr(table, "__arrow_c_array__"):
        raise TypeError("`table`: expected a stream of record batches, found one array: wrap it into a table")
    else:
        raise TypeError(
            "`table`: expected an Arrow stream (pyarrow, polars, pandas, DuckDB) or a mapping of names to "
            f"arrays, found `{type(table).__name__}`"
        )
    if isinstance(outputs, str):
        raise TypeError("`outputs`: expected a sequence of names, found a text")
    for name, function in [("user_conductance", user_conductance), ("progress", progress)]:
        if function is not None and not callable(function):
            raise TypeError(f"`{name}`: expected a function, found `{type(function).__name__}`")
    arguments = {
        "outputs": None if outputs is None else list(outputs),
        "interaction": interaction,
        "procedure": procedure,
        "accuracy": accuracy,
        "tolerance": tolerance,
        "tolerance_relative": tolerance_relative,
        "derivatives": derivatives,
        "char_length": char_length,
        "history_start": history_start,
        "threads": threads,
    }
    return deck._deck.evaluate_table(rows, arguments, progress, user_conductance)


def nodes(deck: Deck, results: Path | Sequence[Path] = ()) -> Result:
    """Make the node table of the contact pairs of a deck, which `evaluate` takes as it is.

    Parameters
    ----------
    deck : Deck
        The deck, with its mesh.
    results : path-like or sequence of path-like
        What the deck's own job wrote: .frd or .dat of CalculiX, .fil (ASCII) or .rpt of Abaqus, .vtu.
        Several are joined by their times; where there are none, the table is that of the beginning.

    Returns
    -------
    Result
        A row a slave node and state, with clearance (L), area (L²) and what else is known, in the columns that
        ``inpact.explain("columns")`` lists. Its ``notes`` say what was not read and why.

    Raises
    ------
    OSError
        For a file that cannot be read.
    DeckError
        For a deck without a contact pair in its mesh, and for result files of another mesh.
    """
    paths = [results] if isinstance(results, (str, os.PathLike)) else list(results)
    return deck._deck.nodes([os.fspath(path) for path in paths])
