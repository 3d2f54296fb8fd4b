"""What a user's own conductance is asked."""

from __future__ import annotations

# `typing` takes longer to import than this package does: types are for those who check them.
TYPE_CHECKING = False

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


class UserPoints:
    """The points that a user's conductance is asked at, as arrays of one length.

    Attributes
    ----------
    interaction : str
        The name of the interaction, in capitals as Abaqus hands it over.
    clearance : ndarray
        Clearance d, L; negative in overclosure.
    temperature : tuple of two ndarrays
        Of slave and master, θ.
    fv : list of tuples of two ndarrays
        The field variables, of slave and master.
    time : ndarray
        Total time, T; 0 where the table has none.
    node : ndarray
        The number of the slave node; 0 where its label is no number.
    """

    __slots__ = ("clearance", "fv", "interaction", "node", "temperature", "time")

    def __init__(
        self,
        interaction: str,
        clearance: Floats,
        temperature: tuple[Floats, ...],
        fv: list[tuple[Floats, ...]],
        time: Floats,
        node: Floats,
    ) -> None:
        self.interaction = interaction
        self.clearance = clearance
        self.temperature = temperature
        self.fv = fv
        self.time = time
        self.node = node

    def __repr__(self) -> str:
        return f"<UserPoints of {self.interaction!r}: {len(self.clearance)}>"
