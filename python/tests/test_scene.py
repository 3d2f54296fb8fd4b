import pathlib

import numpy as np
import pytest

import inpact


def test_two_bodies(decks: pathlib.Path):
    solution = inpact.solve(decks / "scenes" / "two-bodies.toml")
    assert solution.nodes == ["left-end", "left-face", "right-face", "right-end"]
    assert solution.links == [("left-end", "left-face"), ("right-face", "right-end")]
    assert solution.fields == ["potential", "temperature"]
    assert solution.times.tolist() == [0.0]
    assert solution.values("potential").shape == (1, 4)
    assert solution.at_end("potential")["left-face"] == 76.19047619047619
    assert solution.flows("potential").tolist() == [[23.80952380952381, 23.80952380952381]]
    assert np.isnan(solution.values("pore_pressure")).all()
    columns = solution.to_dict()
    assert columns["node"] == solution.nodes
    assert columns["potential"].tolist() == solution.values("potential")[0].tolist()
    assert "potential, temperature" in repr(solution)


def test_a_transient_is_several_states(decks: pathlib.Path):
    seen: list[int] = []
    solution = inpact.solve(decks / "scenes" / "cooling.toml", progress=seen.append)
    times = solution.times
    assert times.size > 2
    assert (np.diff(times) > 0).all()
    assert seen[-1] == times.size
    assert len(solution.to_dict()["node"]) == times.size * len(solution.nodes)


def test_what_is_wrong(tmp_path: pathlib.Path):
    with pytest.raises(FileNotFoundError):
        inpact.solve(tmp_path / "nothing.toml")
    scene = tmp_path / "a.toml"
    (tmp_path / "a.inp").write_text("*SURFACE INTERACTION, NAME=A\n")
    scene.write_text('deck = "a.inp"\nnodes = 3\n')
    with pytest.raises(inpact.DeckError) as caught:
        inpact.solve(scene)
    assert any(finding.severity == "error" for finding in caught.value.findings)
    with pytest.raises(ValueError, match="`solver`"):
        inpact.solve(scene, solver="magic")
