"""Check, convert, evaluate and solve the contact interfaces of Abaqus input decks.

>>> import inpact
>>> deck = inpact.parse('''*SURFACE INTERACTION, NAME=JOINT
... *GAP ELECTRICAL CONDUCTANCE, PRESSURE
... 0., 0.
... 4000., 1e6
... ''')
>>> deck.check()
[]
>>> gap = deck.interactions["JOINT"].electrical
>>> gap.conductance(pressure=2.5e5)
1000.0
>>> gap.conductance(pressure=[0.0, 5e5, 2e6])
array([   0., 2000., 4000.])

Quantities have the units of the deck; their dimensions are given by M mass, L length, T time,
θ temperature, φ electric potential and C charge.
NumPy is imported when it is first needed; Arrow tables of any library are taken as they are.
"""

from inpact._deck import Deck, Fixed, Interaction, Interactions, from_dict, from_json, parse, read
from inpact._errors import DeckError
from inpact._evaluate import evaluate, nodes
from inpact._inpact import Finding, Fix, FixedFile, Result, __version__, explain
from inpact._laws import GapConductance, Table
from inpact._scene import Solution, solve
from inpact._user import UserPoints

__all__ = [
    "Deck",
    "DeckError",
    "Finding",
    "Fix",
    "Fixed",
    "FixedFile",
    "GapConductance",
    "Interaction",
    "Interactions",
    "Result",
    "Solution",
    "Table",
    "UserPoints",
    "__version__",
    "evaluate",
    "explain",
    "from_dict",
    "from_json",
    "nodes",
    "parse",
    "read",
    "solve",
]
