"""The two arms of the NAO: what the engine says, and what is known of them."""

from __future__ import annotations

import json
from functools import cache, partial
from pathlib import Path
from typing import Any

from loci.numeric import Array, Posture, limb_columns

from screwkit.analyses.mobility import mobility
from screwkit.analyses.motion_type import motion_cases
from screwkit.analyses.schemes import schemes
from screwkit.analyses.singularities import singularities
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.network import Network
from screwkit.mechanism.files import read_mechanism
from screwkit.mechanism.model import Mechanism
from screwkit.results.mobility import Mobility
from screwkit.results.schemes import Schemes
from screwkit.results.singularities import Singularities

ROOT = Path(__file__).parents[2]
LIMBS = (("1", "2", "3", "4", "5"), ("6", "7", "8", "9", "10"))
VARIABLES = tuple(f"q{i}" for i in range(1, 11))
LENGTHS = {"b1": 0.31, "r1": 0.87, "d3": 0.36, "r3": 1.13, "r5": 0.52}
"""Other than the robot's own, so that no result rests on them."""

NAMES = {
    "T2": "r3*cos(q2) + d3*sin(q2)",
    "T7": "r3*cos(q7) - d3*sin(q7)",
    "s4": "sin(q4)",
    "s9": "sin(q9)",
    "sD": "sin(q6 - q1)",
    "cD": "cos(q6 - q1)",
}


@cache
def mechanism() -> Mechanism:
    return read_mechanism(ROOT / "cases" / "nao_t14.yaml")


@cache
def assembly() -> Assembly:
    return Assembly(mechanism())


@cache
def the_mobility() -> Mobility:
    return mobility(Network(mechanism()), partial(motion_cases, assembly()))


@cache
def the_singularities() -> Singularities:
    return singularities(assembly())


@cache
def the_schemes() -> Schemes:
    return schemes(assembly())


@cache
def expected() -> dict[str, Any]:
    path = ROOT / "tests" / "reference" / "nao_expected.json"
    loaded: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return loaded


@cache
def expected_schemes() -> dict[str, Any]:
    path = ROOT / "tests" / "reference" / "nao_schemes.json"
    loaded: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return loaded


def limbs_at(posture: Posture) -> list[Array]:
    """The twists of both arms at a posture that gives angles and lengths."""
    return [limb_columns(mechanism(), joints, posture) for joints in LIMBS]


@cache
def expected_ranks() -> dict[str, Any]:
    path = ROOT / "tests" / "reference" / "nao_scheme_ranks.json"
    loaded: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return loaded
