"""What `analyze` answers: all questions, each with its answer or its refusal."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from screwkit.results.distance import Distance
from screwkit.results.manipulability import Manipulability
from screwkit.results.mobility import Mobility
from screwkit.results.schemes import Schemes
from screwkit.results.screws import Screws
from screwkit.results.shown import Shown
from screwkit.results.singularities import Singularities
from screwkit.results.undecided import Undecided


@dataclass(frozen=True)
class ClaimCheck:
    """A claim of the literature beside what holds.

    Attributes:
        claimed: What the source says, as plain data or grammar text.
        computed: What the engine finds; None where the question is open.
        agrees: Whether they are equal; None where it could not be compared.
        status: ``published``, ``derived`` or ``regression``.
        holds: What the file itself says of the claim.
        note: What holds instead, as the file says.
    """

    question: str
    claimed: Any
    computed: Any
    agrees: bool | None
    status: str
    source: str
    holds: bool = True
    note: str = ""


@dataclass(frozen=True)
class JointRow:
    """A row of the geometry table, as written in the file."""

    joint: str
    type: str
    antecedent: str
    parameters: tuple[str, ...]
    variable: str


@dataclass(frozen=True)
class Description:
    """The mechanism as the file gives it, for the head of a report.

    Attributes:
        columns: Heads of ``rows``' parameters (``gamma``, ``b``, ``alpha`` …).
        values: (name, value, assumption) of every parameter.
    """

    case: str
    title: str
    source: str
    units: str
    base: str
    platform: str
    links: int
    columns: tuple[str, ...]
    rows: tuple[JointRow, ...]
    values: tuple[tuple[str, str, str], ...]
    limbs: tuple[tuple[str, tuple[str, ...]], ...]


@dataclass(frozen=True, repr=False)
class Analysis(Shown):
    """The answer of ``analyze``.

    Attributes:
        distance: None where it was not asked for.
    """

    case: str
    title: str
    description: Description
    mobility: Mobility | Undecided
    screws: Screws | Undecided
    singularities: Singularities | Undecided
    schemes: Schemes | Undecided
    manipulability: Manipulability | Undecided
    claims: tuple[ClaimCheck, ...] = ()
    distance: Distance | Undecided | None = None
