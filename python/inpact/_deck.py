"""Decks: what is read, what is wrong with it, what it says."""

from __future__ import annotations

import os
from collections.abc import Mapping

from inpact import _inpact
from inpact._laws import GapConductance

# `typing` takes longer to import than this package does: types are for those who check them.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from typing import Any, Literal

    from inpact._inpact import Finding, FixedFile

    Dialect = Literal["abaqus", "calculix"]
    RelativeTo = Literal["deck", "including-file"]
    Path = str | os.PathLike[str]


def read(
    path: Path,
    *,
    dialect: Dialect | None = None,
    release: str | None = None,
    include_dirs: Sequence[Path] = (),
    include_root: Path | None = None,
    relative_to: RelativeTo | None = None,
    config: Path | None = None,
    isolated: bool = False,
    keep_everything: bool = False,
) -> Deck:
    """Read a deck or a fragment of one, with everything it includes.

    What is wrong with it is no error here: `Deck.check` says it.
    What no argument says is as the ``inpact.toml`` above the deck has it.

    Parameters
    ----------
    path : path-like
        The file.
    dialect : {"abaqus", "calculix"}, optional
        Whose keyword language it is in.
    release : str, optional
        The release of Abaqus that it is for: "6.11", "6.14", "2016", "2017", "2022", "2024".
    include_dirs : sequence of path-like
        Where included files are looked for as well.
    include_root : path-like, optional
        A folder outside of which no file is read.
    relative_to : {"deck", "including-file"}, optional
        What the names of included files are relative to.
    config : path-like, optional
        A configuration to read instead of the ``inpact.toml`` above the deck.
    isolated : bool
        Read no configuration.
    keep_everything : bool
        Keep the text of all rows, of meshes too: `Deck.to_dict` with ``view="syntax"`` needs it.

    Raises
    ------
    OSError
        For a file that cannot be read.
    ValueError
        For a configuration or an argument that says what it cannot say.
    """
    reading = _inpact.Reading(dialect, release, include_dirs, include_root, relative_to, config, isolated)
    return Deck(_inpact.read(os.fspath(path), reading, keep_everything))


def parse(
    text: str | bytes,
    *,
    name: Path = "deck.inp",
    dialect: Dialect | None = None,
    release: str | None = None,
    include_dirs: Sequence[Path] = (),
    include_root: Path | None = None,
    relative_to: RelativeTo | None = None,
    config: Path | None = None,
    isolated: bool = False,
) -> Deck:
    """Read a deck from its text.

    Parameters
    ----------
    text : str or bytes
        The deck.
    name : path-like
        What messages call it; files that it includes are found from there. Nothing of that name is read.
    dialect, release, include_dirs, include_root, relative_to, config, isolated
        As for `read`.

    Examples
    --------
    >>> import inpact
    >>> deck = inpact.parse("*SURFACE INTERACTION", name="a.inp")
    >>> print(*deck.check())
    a.inp:1:1: error[K006] `*SURFACE INTERACTION` lacks its parameter `NAME`
    """
    content = text.encode() if isinstance(text, str) else bytes(text)
    reading = _inpact.Reading(dialect, release, include_dirs, include_root, relative_to, config, isolated)
    return Deck(_inpact.parse(content, os.fspath(name), reading))


def from_dict(document: Mapping[str, Any], *, dialect: Dialect | None = None, release: str | None = None) -> Deck:
    """Make a deck from what `Deck.to_dict` gives, either view.

    The model view is written in the language that can say it; ``dialect`` and ``release`` are those that the
    lines of the syntax view are read in.

    Raises
    ------
    DeckError
        For a document that is no deck, with the path of what is wrong with it.

    Examples
    --------
    >>> import inpact
    >>> document = inpact.parse("*SURFACE INTERACTION, NAME=A").to_dict()
    >>> document["interactions"]["A"]["thickness"] = 0.5
    >>> print(inpact.from_dict(document).to_inp(), end="")
    *SURFACE INTERACTION, NAME=A
    0.5,
    """
    # Imported here and in no module: it takes a third of the time that importing inpact takes.
    import json

    return from_json(json.dumps(document), dialect=dialect, release=release)


def from_json(text: str, *, dialect: Dialect | None = None, release: str | None = None) -> Deck:
    """Make a deck from JSON of ``inpact json``, either view, as `from_dict` does."""
    return Deck(_inpact.from_json(text, _inpact.Reading(dialect, release, isolated=True)))


class Deck:
    """A deck with everything it includes, as `read` and `parse` give it."""

    __slots__ = ("_deck",)

    def __init__(self, deck: _inpact.Deck) -> None:
        self._deck = deck

    @property
    def name(self) -> str:
        """What messages call it."""
        return self._deck.name

    @property
    def files(self) -> list[str]:
        """Where its files are, the deck itself first."""
        return [os.fspath(file) for file in self._deck.files]

    @property
    def dialect(self) -> str:
        """Whose keyword language it is read in: ``abaqus`` or ``calculix``."""
        return self._deck.dialect

    @property
    def release(self) -> str:
        """The release that it is read for."""
        return self._deck.release

    @property
    def interactions(self) -> Interactions:
        """The contact interactions that it defines, by name without regard to case."""
        return Interactions(self._deck)

    def check(self) -> list[Finding]:
        """Say what is wrong with it, in the order of the deck.

        Returns
        -------
        list of Finding
            Each with ``code``, ``severity``, ``file``, ``line``, ``column``, ``message``, ``help`` and ``fix``;
            `inpact.explain` has a page for every code.
        """
        return self._deck.check()

    def render(
        self,
        findings: Sequence[Finding] | None = None,
        format: Literal["full", "concise", "json", "sarif", "github"] = "full",
    ) -> str:
        """Give findings of this deck as text; all of them where none are named."""
        return self._deck.render(list(self.check() if findings is None else findings), format)

    def fix(self, codes: Sequence[str] | None = None, *, also: Sequence[str] = (), included: bool = False) -> Fixed:
        r"""Apply fixes, in memory.

        Parameters
        ----------
        codes : sequence of str, optional
            The rules whose fixes are applied, also where they change what the deck means.
            Where none are named, all fixes that leave its meaning as it is.
        also : sequence of str
            Rules whose fixes are applied as well although they change what the deck means.
        included : bool
            Fix included files outside of the folder of the deck too.

        Examples
        --------
        >>> import inpact
        >>> text = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANC\n1., 0.\n0., 2.\n"
        >>> fixed = inpact.parse(text, name="a.inp").fix()
        >>> fixed.findings
        1
        >>> fixed.deck.check()
        []
        """
        if isinstance(codes, str) or isinstance(also, str):
            raise TypeError("expected a sequence of codes, found a text")
        return Fixed(self._deck.fix(None if codes is None else list(codes), list(also), included))

    def to_dict(self, view: Literal["model", "syntax"] = "model") -> dict[str, Any]:
        """Give what it says as plain data (schema ``inpact/model/1``), or every line of it (``inpact/syntax/1``).

        Examples
        --------
        >>> import inpact
        >>> inpact.parse("*SURFACE INTERACTION, NAME=A").to_dict()["interactions"]["A"]["thickness"]
        1.0
        """
        import json

        document: dict[str, Any] = json.loads(self.to_json(view))
        return document

    def to_json(self, view: Literal["model", "syntax"] = "model") -> str:
        """Give the same as JSON."""
        if view == "syntax":
            return self._deck.to_syntax_json()
        if view == "model":
            return self._deck.to_json()
        raise ValueError(f"`view`: expected `model` or `syntax`, found `{view}`")

    def to_inp(self) -> str:
        """Write a deck that says the same of the contact interfaces."""
        return self._deck.to_inp()

    def __repr__(self) -> str:
        return repr(self._deck)


class Fixed:
    """What fixing a deck came to; nothing is written until `write` is called."""

    __slots__ = ("_fixed",)

    def __init__(self, fixed: _inpact.Fixed) -> None:
        self._fixed = fixed

    @property
    def deck(self) -> Deck:
        """The deck as it is once fixed."""
        return Deck(self._fixed.deck)

    @property
    def findings(self) -> int:
        """How many findings it mends."""
        return self._fixed.findings

    @property
    def left(self) -> list[str]:
        """What was left although it has a fix, and why."""
        return self._fixed.left

    @property
    def files(self) -> list[FixedFile]:
        """The files that change: ``path``, ``before`` and ``after``, which are bytes."""
        return self._fixed.files

    def diff(self) -> str:
        """Give what changes as a unified difference."""
        return self._fixed.diff()

    def write(self) -> None:
        """Write the files, all of them or none, on condition that each still is what was read.

        Raises
        ------
        OSError
            For a file that cannot be written, or that another program has changed.
        ValueError
            For a deck that was parsed from a text.
        """
        self._fixed.write()

    def __repr__(self) -> str:
        return repr(self._fixed)


class Interaction:
    """A *SURFACE INTERACTION."""

    __slots__ = ("_deck", "name")

    name: str

    def __init__(self, deck: _inpact.Deck, name: str) -> None:
        self._deck = deck
        self.name = name

    @property
    def electrical(self) -> GapConductance | None:
        """Its gap electrical conductance; None where it has none, or one of a user subroutine.

        Raises
        ------
        DeckError
            For tables that cannot be evaluated, as `Deck.check` says.
        """
        gap = self._deck.electrical(self.name)
        return None if gap is None else GapConductance(gap)

    def to_dict(self) -> dict[str, Any]:
        """Give what the deck says of it as plain data."""
        import json

        document: dict[str, Any] = json.loads(self._deck.to_json())["interactions"][self.name]
        return document

    def __repr__(self) -> str:
        return f"<Interaction {self.name!r}>"


class Interactions(Mapping[str, Interaction]):
    """The interactions of a deck, by name without regard to case."""

    __slots__ = ("_deck",)

    def __init__(self, deck: _inpact.Deck) -> None:
        self._deck = deck

    def __getitem__(self, name: str) -> Interaction:
        written = self._deck.interaction_named(name) if isinstance(name, str) else None
        if written is None:
            names = ", ".join(f"`{name}`" for name in self) or "none"
            raise KeyError(f"the deck has no interaction `{name}`: there are {names}")
        return Interaction(self._deck, written)

    def __iter__(self) -> Iterator[str]:
        return iter(self._deck.interaction_names)

    def __len__(self) -> int:
        return len(self._deck.interaction_names)

    def __repr__(self) -> str:
        return f"<Interactions {', '.join(self)}>"
