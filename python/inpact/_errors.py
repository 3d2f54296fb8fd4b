"""What is raised where data has errors."""

from __future__ import annotations

# `typing` takes longer to import than this package does: types are for those who check them.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from inpact._inpact import Finding


class DeckError(ValueError):
    """A deck, a table or a scene has errors that leave nothing to go on with.

    Attributes
    ----------
    findings : list of Finding
        What was found, the errors among them; empty where the message says everything.

    Examples
    --------
    >>> import inpact
    >>> deck = inpact.parse("*SURFACE INTERACTION, NAME=A")
    >>> try:
    ...     inpact.evaluate(deck, {"clearance": [0.0], "epot_jump": [1.0]}, outputs=["ECD"])
    ... except inpact.DeckError as error:
    ...     print(error.findings[0].code)
    D001
    """

    findings: list[Finding]

    def __init__(self, message: str, findings: list[Finding] | None = None) -> None:
        super().__init__(message)
        self.findings = findings or []

    def __reduce__(self) -> tuple[type[DeckError], tuple[str]]:
        # Findings stay in their process; what they say goes along.
        lines = [str(finding) for finding in self.findings if str(finding) not in str(self)]
        return (DeckError, ("\n".join([str(self), *lines]),))
