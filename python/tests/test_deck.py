import pathlib
import pickle

import pytest

import inpact

JOINT = """\
*SURFACE INTERACTION, NAME=Joint
1.,
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
10., 0.
30., 2.
20., 1.
"""


def test_findings_have_their_places():
    (found,) = [f for f in inpact.parse(JOINT, name="a.inp").check() if f.severity == "error"]
    assert (found.code, found.name) == ("T001", "not-ascending")
    assert (found.file, found.line, found.column) == ("a.inp", 6, 6)
    start, end = found.span
    assert JOINT.encode()[start:end] == b"1."
    assert found.message
    assert found.help
    assert str(found).startswith("a.inp:6:6: error[T001] ")
    assert found == inpact.parse(JOINT, name="a.inp").check()[0]
    assert "a.inp:6:6" in repr(found)


def test_a_fix_changes_a_file_only_when_it_is_written(tmp_path: pathlib.Path):
    path = tmp_path / "a.inp"
    path.write_text(JOINT)
    deck = inpact.read(path)
    assert deck.fix().findings == 0
    fixed = deck.fix(codes=["T001"])
    assert fixed.findings == 1
    assert fixed.deck.check() == []
    assert "+20., 1." in fixed.diff()
    assert path.read_text() == JOINT
    fixed.write()
    assert inpact.read(path).check() == []
    path.write_text("*HEADING\n")
    with pytest.raises(OSError, match="another program changed it"):
        fixed.write()


def test_a_deck_of_a_text_is_not_written():
    fixed = inpact.parse(JOINT).fix(codes=["T001"])
    with pytest.raises(ValueError, match="was not read from a file"):
        fixed.write()


def test_codes_are_a_sequence_of_rules():
    with pytest.raises(TypeError, match="found a text"):
        inpact.parse(JOINT).fix(codes="T001")
    with pytest.raises(ValueError, match="there is no rule `T999`"):
        inpact.parse(JOINT).fix(codes=["T999"])


def test_json_both_ways():
    deck = inpact.parse(JOINT)
    document = deck.to_dict()
    assert document["schema"] == "inpact/model/1"
    assert document["interactions"]["Joint"]["gap_electrical_conductance"]["pressure"]["rows"][1][:2] == [30.0, 2.0]
    again = inpact.from_dict(document)
    assert again.to_dict()["interactions"]["Joint"]["thickness"] == 1.0
    syntax = deck.to_dict("syntax")
    assert syntax["schema"] == "inpact/syntax/1"
    assert inpact.from_dict(syntax).to_json("syntax") == deck.to_json("syntax")
    with pytest.raises(inpact.DeckError, match="interactions"):
        inpact.from_dict({**document, "interactions": 3})
    with pytest.raises(ValueError, match="expected `model` or `syntax`"):
        deck.to_json("text")


def test_interactions_are_a_mapping_without_regard_to_case():
    deck = inpact.parse(JOINT)
    assert list(deck.interactions) == ["Joint"]
    assert len(deck.interactions) == 1
    assert deck.interactions["JOINT"].name == "Joint"
    assert "joint" in deck.interactions
    assert "other" not in deck.interactions
    with pytest.raises(KeyError, match="no interaction `other`: there are `Joint`"):
        deck.interactions["other"]
    assert 3 not in deck.interactions


def test_files_that_cannot_be_read(tmp_path: pathlib.Path):
    with pytest.raises(FileNotFoundError, match="nothing.inp"):
        inpact.read(tmp_path / "nothing.inp")
    with pytest.raises(OSError, match="folder"):
        inpact.read(tmp_path)
    with pytest.raises(ValueError, match="no release"):
        inpact.parse("", release="1999")
    with pytest.raises(ValueError, match="expected `abaqus` or `calculix`, found `nastran`"):
        inpact.parse("", dialect="nastran")
    with pytest.raises(ValueError, match="exclude one another"):
        inpact.parse("", config="inpact.toml", isolated=True)


def test_includes_and_settings(tmp_path: pathlib.Path):
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "gap.inp").write_text("*GAP ELECTRICAL CONDUCTANCE\n1., 0.\n0., 2.\n")
    deck = tmp_path / "a.inp"
    deck.write_text("*SURFACE INTERACTION, NAME=A\n*INCLUDE, INPUT=gap.inp\n")
    (missing,) = [f for f in inpact.read(deck).check() if f.severity == "error"]
    assert "gap.inp" in missing.message
    found = inpact.read(deck, include_dirs=[tmp_path / "parts"])
    assert found.check() == []
    assert len(found.files) == 2
    (tmp_path / "inpact.toml").write_text(f'[rules]\n{missing.code} = "off"\n')
    assert inpact.read(deck).check() == []
    assert inpact.read(deck, isolated=True).check() == [missing]


def test_the_syntax_view_needs_all_rows(decks: pathlib.Path):
    path = decks / "weld-mesh" / "weld-mesh.inp"
    with pytest.raises(ValueError, match="keep_everything"):
        inpact.read(path).to_dict("syntax")
    assert inpact.read(path, keep_everything=True).to_dict("syntax")["files"]


def test_errors_go_from_process_to_process():
    error = inpact.DeckError("the deck is wrong", inpact.parse(JOINT, name="a.inp").check())
    again = pickle.loads(pickle.dumps(error))
    assert isinstance(again, ValueError)
    assert "the deck is wrong" in str(again)
    assert "T001" in str(again)


def test_render():
    deck = inpact.parse(JOINT, name="a.inp")
    assert "error[T001]" in deck.render()
    assert deck.render(format="concise").count("\n") == len(deck.check())
    assert '"2.1.0"' in deck.render(format="sarif")
    with pytest.raises(ValueError, match="`format`"):
        deck.render(format="xml")


def test_explain():
    assert inpact.explain("T001").startswith("# T001 not-ascending")
    with pytest.raises(ValueError, match="did you mean"):
        inpact.explain("T0O1")
