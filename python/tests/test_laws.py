import math

import numpy as np
import pytest

import inpact

CLEARANCE = "*GAP ELECTRICAL CONDUCTANCE\n8., 0.\n4., 2.\n"
PRESSURE = "*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n10., 0.\n30., 2.\n"
VARIABLES = """\
*GAP ELECTRICAL CONDUCTANCE, DEPENDENCIES=1
8., 0., 300., 1.
4., 2., 300., 1.
6., 0., 300., 2.
2., 2., 300., 2.
"""


def gap_of(tables: str) -> inpact.GapConductance:
    gap = inpact.parse("*SURFACE INTERACTION, NAME=A\n" + tables).interactions["A"].electrical
    assert gap is not None
    return gap


def test_closed_and_open():
    gap = gap_of(CLEARANCE + PRESSURE)
    assert gap.tables == ["clearance", "pressure"]
    assert gap.conductance(clearance=1.0) == 6.0
    assert gap.conductance(clearance=1.0, pressure=0.0) == 6.0
    assert gap.conductance(clearance=1.0, pressure=1.0) == 20.0
    assert gap.conductance(clearance=-1.0, pressure=1.0) == 20.0
    assert gap.conductance(clearance=0.0) == 10.0
    assert gap.conductance(pressure=0.0) == 10.0
    assert gap_of(PRESSURE).conductance(clearance=1.0) == 0.0
    assert gap_of(CLEARANCE).conductance(clearance=-1.0) == 8.0


def test_scalars_give_floats_and_arrays_their_shape():
    gap = gap_of(PRESSURE)
    for scalar in [1.0, 1, np.float64(1.0), np.float32(1.0), np.int8(1), np.array(1.0), True]:
        value = gap.conductance(pressure=scalar)
        assert type(value) is float
        assert value == 20.0
    assert gap.conductance(pressure=[1.0]).shape == (1,)
    assert gap.conductance(pressure=np.ones((2, 3))).shape == (2, 3)
    assert gap.conductance(pressure=np.ones((2, 0))).shape == (2, 0)
    assert gap.conductance(clearance=np.ones((2, 1)), pressure=np.ones(3)).shape == (2, 3)


WHOLE = np.linspace(-1.0, 3.0, 24)


@pytest.mark.parametrize(
    "array",
    [
        WHOLE.reshape(4, 6),
        np.asfortranarray(WHOLE.reshape(4, 6)),
        np.repeat(WHOLE, 2)[::2].reshape(4, 6),
        WHOLE[::-1][::-1].reshape(4, 6),
        WHOLE.astype(">f8").reshape(4, 6),
        np.ma.masked_array(WHOLE.reshape(4, 6), mask=np.zeros((4, 6))),
        WHOLE.reshape(4, 6).tolist(),
        tuple(map(tuple, WHOLE.reshape(4, 6))),
        WHOLE.astype(object).reshape(4, 6),
        np.broadcast_to(WHOLE.reshape(1, 4, 6), (1, 4, 6))[0],
    ],
)
def test_the_layout_of_an_array_makes_no_difference(array):
    gap = gap_of(CLEARANCE)
    expected = np.array([[gap.conductance(clearance=float(d)) for d in row] for row in WHOLE.reshape(4, 6)])
    assert gap.conductance(clearance=array).tolist() == expected.tolist()


def test_an_array_that_may_not_be_written_is_read():
    array = np.array([0.5, 1.0])
    array.flags.writeable = False
    before = array.copy()
    assert gap_of(CLEARANCE).conductance(clearance=array).tolist() == [7.0, 6.0]
    assert (array == before).all()


@pytest.mark.parametrize("kind", ["f2", "f4", "i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", "?"])
def test_numbers_of_any_kind(kind):
    gap = gap_of(CLEARANCE)
    array = np.array([0, 1, 1, 0], dtype=kind)
    assert gap.conductance(clearance=array).tolist() == [8.0, 6.0, 6.0, 8.0]


def test_what_is_missing_is_nan():
    gap = gap_of(CLEARANCE)
    masked = np.ma.masked_array([0.5, 1.0], mask=[False, True])
    for array in [masked, [0.5, None], [0.5, math.nan], np.array([0.5, None], dtype=object)]:
        first, second = gap.conductance(clearance=array)
        assert first == 7.0
        assert math.isnan(second)
    assert math.isnan(gap.conductance(clearance=math.nan))
    assert gap.conductance(clearance=math.inf) == 4.0
    assert gap.conductance(clearance=-math.inf) == 8.0


@pytest.mark.parametrize(
    "wrong",
    ["1.0", ["a"], [1.0, "b"], 1j, [1j], np.array(["2020-01-01"], dtype="M8[D]"), object(), [[1.0], [1.0, 2.0]], {}],
)
def test_what_is_no_number_is_a_type_error(wrong):
    with pytest.raises(TypeError, match="clearance"):
        gap_of(CLEARANCE).conductance(clearance=wrong)


def test_shapes_that_do_not_go_together():
    with pytest.raises(ValueError, match=r"`clearance` \(2,\), `pressure` \(3,\)"):
        gap_of(CLEARANCE + PRESSURE).conductance(clearance=[1.0, 2.0], pressure=[1.0, 2.0, 3.0])


def test_what_counts_must_be_there():
    gap = gap_of(VARIABLES)
    assert gap.depends_on == ["fv1"]
    with pytest.raises(TypeError, match="`fv1` is missing"):
        gap.conductance(clearance=1.0)
    with pytest.raises(TypeError, match="`fv1` is missing"):
        gap.conductance(clearance=[1.0], temperature=3.0)
    with pytest.raises(TypeError, match="`clearance` or `pressure` is missing"):
        gap.conductance(temperature=1.0)
    for fv in [1.5, [1.5], (1.5,), [np.array(1.5)], np.array(1.5)]:
        assert gap.conductance(clearance=1.0, fv=fv) == 5.0
    assert gap.conductance(clearance=1.0, fv=[[1.0, 2.0]]).tolist() == [6.0, 4.0]
    with pytest.raises(TypeError, match="mapping"):
        gap.conductance(clearance=1.0, fv={"fv1": 1.0})


def test_slopes():
    value, slopes = gap_of(VARIABLES).conductance(clearance=[1.0], fv=[[1.5]], derivatives=True)
    assert value.tolist() == [5.0]
    assert {name: slope.tolist() for name, slope in slopes.items()} == {"clearance": [-2.0], "fv1": [-2.0]}
    value, slopes = gap_of(CLEARANCE + PRESSURE).conductance(clearance=0.0, pressure=1.0, derivatives=True)
    assert (value, slopes) == (20.0, {"clearance": 0.0, "pressure": 10.0})


def test_tables():
    gap = gap_of(PRESSURE)
    table = gap.table("pressure")
    assert table(1.0) == 20.0
    assert table([-1.0, 3.0]).tolist() == [10.0, 30.0]
    assert table.abscissae.tolist() == [0.0, 2.0]
    with pytest.raises(KeyError, match="no table against clearance"):
        gap.table("clearance")
    with pytest.raises(ValueError, match="found `temperature`"):
        gap.table("temperature")


def test_interactions_without_a_conductance():
    deck = inpact.parse(
        "*SURFACE INTERACTION, NAME=A\n*SURFACE INTERACTION, NAME=B\n*GAP ELECTRICAL CONDUCTANCE, USER\n"
    )
    assert deck.interactions["A"].electrical is None
    assert deck.interactions["B"].electrical is None
    broken = inpact.parse("*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n1., 1.\n1., 0.\n")
    with pytest.raises(inpact.DeckError, match="against clearance of `A`"):
        _ = broken.interactions["A"].electrical


def test_arrays_have_the_bits_of_points():
    random = np.random.default_rng(3)
    gap = gap_of(CLEARANCE + PRESSURE)
    d, p = random.uniform(-1, 3, 5000), random.uniform(0, 3, 5000) * (random.random(5000) < 0.5)
    points = [gap.conductance(clearance=float(a), pressure=float(b)) for a, b in zip(d, p, strict=True)]
    assert gap.conductance(clearance=d, pressure=p).tolist() == points


def test_plot():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    axes = gap_of(CLEARANCE + PRESSURE).plot()
    (line,) = axes.get_lines()
    assert axes.get_xlabel() == "contact pressure"
    assert dict(zip(*map(list, line.get_data()), strict=True))[2.0] == 30.0
