import pathlib

import pytest

PROJECT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture
def decks() -> pathlib.Path:
    """The sample decks."""
    return PROJECT / "decks"
