"""From whatever users have to contiguous columns of float64, and back; imported with the first array, as NumPy is."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from inpact._user import UserPoints

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from inpact import _inpact

    Floats = NDArray[np.float64]


def number_array(name: str, value: Any) -> Floats:
    """Make an array of float64 of one quantity, NaN where it is masked or None.

    Raises
    ------
    TypeError
        For texts, complex numbers, times and objects that are no numbers.
    """
    if isinstance(value, np.ma.MaskedArray):
        mask = np.ma.getmaskarray(value)
        filled = number_array(name, value.data).copy()
        filled[mask] = np.nan
        return filled
    try:
        array = np.asarray(value)
    except ValueError as error:
        raise TypeError(f"`{name}`: expected an array of numbers, found a ragged sequence") from error
    kind = array.dtype.kind
    if kind == "O":
        flat = [np.nan if item is None else item for item in array.ravel().tolist()]
        for item in flat:
            is_number = isinstance(item, (int, float, np.number)) or type(item).__name__ == "NAType"
            if not is_number or isinstance(item, complex):
                raise TypeError(f"`{name}`: expected numbers, found {item!r}")
        floats = [np.nan if type(item).__name__ == "NAType" else float(item) for item in flat]
        return np.array(floats, dtype=np.float64).reshape(array.shape)
    if kind not in "fiub":
        raise TypeError(f"`{name}`: expected numbers, found an array of {array.dtype}")
    return array.astype(np.float64, copy=False)


def field_variables(fv: Any) -> list[tuple[str, Any]]:
    """Name the field variables: one value or array is the first of them, a list or tuple has one each."""
    if fv is None:
        return []
    if isinstance(fv, Mapping):
        raise TypeError("`fv`: expected a sequence with one item a field variable, found a mapping")
    items = list(fv) if isinstance(fv, (list, tuple)) else [fv]
    return [(f"fv{number}", item) for number, item in enumerate(items, 1)]


def broadcast(given: list[tuple[str, Any]]) -> tuple[tuple[int, ...], list[Floats]]:
    """Bring quantities to one shape; give it and the contiguous columns of their values."""
    arrays = [number_array(name, value) for name, value in given]
    try:
        shape = np.broadcast_shapes(*(array.shape for array in arrays))
    except ValueError as error:
        shapes = ", ".join(f"`{name}` {array.shape}" for (name, _), array in zip(given, arrays, strict=True))
        raise ValueError(f"the shapes of the arguments do not go together: {shapes}") from error
    columns = [np.ascontiguousarray(np.broadcast_to(array, shape)).reshape(-1) for array in arrays]
    return shape, columns


def shaped(values: Floats, shape: tuple[int, ...]) -> Any:
    """Bring a column to a shape; a column of one value without a shape is a float."""
    return float(values[0]) if shape == () else values.reshape(shape)


def variables_of(gap: _inpact.GapConductance, temperature: Any, fv: Any) -> list[tuple[str, Any]]:
    """Name temperature and field variables in the order of the tables, without those that are not given.

    Raises
    ------
    TypeError
        Where the tables depend on one that is missing.
    """
    given = dict(field_variables(fv))
    if temperature is not None:
        given["temperature"] = temperature
    depends_on = gap.depends_on
    names = ["temperature", *(f"fv{number}" for number in range(1, len(depends_on)))][: len(depends_on)]
    for name, depends in zip(names, depends_on, strict=True):
        if depends and name not in given:
            how = f"fv=[…] with {name}" if name.startswith("fv") else name
            raise TypeError(f"`{name}` is missing: the conductance of `{gap.interaction}` depends on it ({how})")
    return [(name, given[name]) for name in names if name in given]


def conductance(
    gap: _inpact.GapConductance,
    clearance: Any,
    pressure: Any,
    temperature: Any,
    fv: Any,
    derivatives: bool,
) -> Any:
    """Evaluate a conductance over arrays; see `inpact.GapConductance.conductance`."""
    if clearance is None and pressure is None:
        raise TypeError("`clearance` or `pressure` is missing: one of them must say whether the gap is closed")
    contact = [("clearance", clearance), ("pressure", pressure)]
    contact = [(name, value) for name, value in contact if value is not None]
    variables = variables_of(gap, temperature, fv)
    shape, columns = broadcast(contact + variables)
    by_name = {name: column for (name, _), column in zip(contact + variables, columns, strict=True)}
    names = ["temperature", *(f"fv{number}" for number in range(1, len(gap.depends_on)))]
    others = [by_name.get(name) for name in names[: len(gap.depends_on)]]
    rows = columns[0].size
    arguments = (rows, by_name.get("clearance"), by_name.get("pressure"), others)
    # NumPy's memory is used again from call to call, and is not cleared before it is written.
    column = np.empty(rows)
    gap.values(*arguments, column)
    values = shaped(column, shape)
    if not derivatives:
        return values
    slopes = gap.slopes(*arguments)
    return values, {name: shaped(column, shape) for name, column in slopes.items() if name in by_name}


def table_values(gap: _inpact.GapConductance, against: str, first: Any, temperature: Any, fv: Any) -> Any:
    """Evaluate one table by itself over arrays."""
    variables = variables_of(gap, temperature, fv)
    shape, columns = broadcast([(against, first), *variables])
    by_name = {name: column for (name, _), column in zip(variables, columns[1:], strict=True)}
    names = ["temperature", *(f"fv{number}" for number in range(1, len(gap.depends_on)))]
    others = [by_name.get(name) for name in names[: len(gap.depends_on)]]
    column = np.empty(columns[0].size)
    gap.table_values(against, columns[0].size, [columns[0], *others], column)
    return shaped(column, shape)


Column = tuple[str, Any, Any]


def columns(table: Mapping[str, ArrayLike | Sequence[Any]]) -> list[Column]:
    """Make plain columns of a mapping of arrays: float64, int64, bool or texts, and what is missing.

    Raises
    ------
    TypeError, ValueError
        For a column that holds neither numbers nor texts, is no column, or has another length than the first.
    """
    plain: list[Column] = []
    length: int | None = None
    for name, values in table.items():
        if not isinstance(name, str):
            raise TypeError(f"expected the names of columns as texts, found {name!r}")
        column = plain_column(name, values)
        size = len(column[1])
        if length is not None and size != length:
            raise ValueError(f"column `{name}` has {size} rows, and `{plain[0][0]}` has {length}")
        length = size
        plain.append(column)
    return plain


def plain_column(name: str, values: Any) -> Column:
    """Make a plain column of one array."""
    missing = None
    if isinstance(values, np.ma.MaskedArray):
        missing = np.ascontiguousarray(np.ma.getmaskarray(values))
        values = values.data
    array = np.asarray(values)
    if array.ndim != 1:
        raise ValueError(f"column `{name}`: expected one dimension, found an array of shape {array.shape}")
    kind = array.dtype.kind
    if kind == "O":
        items = array.tolist()
        present = [item for item in items if not is_missing(item)]
        if present and all(isinstance(item, str) for item in present):
            return (name, [None if is_missing(item) else item for item in items], None)
        absent = np.array([is_missing(item) for item in items], dtype=bool)
        missing = absent if missing is None else missing | absent
        numbers = number_array(name, [0.0 if is_missing(item) else item for item in items])
        return (name, numbers, missing)
    if kind in "US":
        texts = array.astype(str).tolist()
        if missing is not None:
            texts = [None if gone else text for text, gone in zip(texts, missing, strict=True)]
        return (name, texts, None)
    if kind == "b":
        return (name, np.ascontiguousarray(array), missing)
    if kind == "i" or (kind == "u" and array.dtype.itemsize < 8):
        return (name, np.ascontiguousarray(array, dtype=np.int64), missing)
    return (name, np.ascontiguousarray(number_array(name, array)), missing)


def is_missing(item: Any) -> bool:
    """Whether an item stands for nothing; NaN is a number that is none, not nothing."""
    return item is None or type(item).__name__ in ("NAType", "NaTType")


def call_user_conductance(
    function: Callable[[Any], Any],
    interaction: str,
    clearance: Floats,
    temperature: tuple[Floats, Floats],
    fv: list[tuple[Floats, Floats]],
    time: Floats,
    node: Floats,
) -> tuple[Floats, Floats, Floats]:
    """Call a user's conductance over arrays, and make plain columns of what it gives."""
    points = UserPoints(interaction, clearance, tuple(temperature), [tuple(sides) for sides in fv], time, node)
    given = function(points)
    slopes: Any = (0.0, 0.0)
    if isinstance(given, tuple):
        if len(given) != 2 or len(given[1]) != 2:
            raise TypeError(
                "`user_conductance`: expected an array, or a tuple of an array and the slopes along the "
                f"temperatures of slave and master, found a tuple of {len(given)}"
            )
        given, slopes = given
    items = [number_array("user_conductance", item) for item in (given, *slopes)]
    shape = clearance.shape
    for item in items:
        if item.shape not in ((), shape):
            raise ValueError(f"`user_conductance`: expected an array of shape {shape}, found one of {item.shape}")
    conductance, slave, master = (np.ascontiguousarray(np.broadcast_to(item, shape)) for item in items)
    return conductance, slave, master
