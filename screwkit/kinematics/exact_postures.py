"""Exact postures: the twist of every freedom modulo a prime.

Symbols without a number get random residues, angles random points of the circle, so
that ranks are generic; constants get the residues that their relations demand.  Every
question is put to two postures modulo two primes.

References: [Schwartz1980].
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, Generic, Protocol, TypeAlias, TypeVar

from screwkit.algebra.angle_measures import common_measures
from screwkit.algebra.constants import ConstantField
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.expression import ZERO, Number
from screwkit.algebra.modular import ModularRing, ResampleError, prime_for
from screwkit.algebra.survey import SurveyRing
from screwkit.errors import UndecidedError
from screwkit.kinematics.freedoms import JointTwist
from screwkit.kinematics.placement import joint_twists, table_agrees, why_tied
from screwkit.kinematics.values import with_values
from screwkit.mechanism.model import Mechanism

T = TypeVar("T")
T_co = TypeVar("T_co", covariant=True)
ResidueTwist: TypeAlias = tuple[int, ...]
_ATTEMPTS = 200


@dataclass(frozen=True)
class ExactPosture:
    """The twists of all freedoms at one posture.

    Attributes:
        twists: (ω; v) modulo the prime in base axes about the base origin, by label.
        prime: The modulus.
        constants: Residues of the generators of the geometry's constants.
        field: The field of the constants.
    """

    twists: Mapping[str, ResidueTwist]
    prime: int
    constants: Mapping[str, int]
    field: ConstantField


@dataclass(frozen=True)
class ExactValues(Generic[T]):
    """What a computation over a ring gives at an exact point.

    Attributes:
        value: Its residues.
        ring: The residues' ring, for more values at the same point.
        prime: The modulus.
        constants: Residues of the generators of the geometry's constants.
        field: The field of the constants.
    """

    value: T
    ring: ModularRing
    prime: int
    constants: Mapping[str, int]
    field: ConstantField


class Computation(Protocol[T_co]):
    """Anything that kinematics does over any ring."""

    def __call__(self, ring: Any, /) -> T_co:
        """The result in that ring."""
        ...


def surveyed(computation: Computation[Any]) -> SurveyRing:
    """What a computation asks of a ring: the roots and angles of its constants."""
    seen = SurveyRing()
    computation(seen)
    return seen


def exact_values(
    computation: Computation[T],
    seed: int,
    bits: int = 61,
    seen: SurveyRing | None = None,
) -> ExactValues[T]:
    """A computation at a point that is random where it has symbols.

    Args:
        computation: Of one argument, a ring.
        seed: Chooses the prime and the residues.
        bits: Size of the prime.
        seen: From `surveyed`, where several points are asked for.

    Raises:
        UndecidedError: If no point was found, because a root or an inverse in the
            geometry does not exist at any of many attempts.
    """
    seen = seen or surveyed(computation)
    radicands = [r.value for r in seen.roots if isinstance(r, Number)]
    field = ConstantField.needed_by(radicands, seen.turn)
    roots = [*radicands, *map(Fraction, field.primes)]
    measures = common_measures(seen.constant_angles)
    for attempt in range(_ATTEMPTS):
        prime = prime_for(seen.turn, roots, seed + 1000 * attempt, bits)
        ring = ModularRing(seed + attempt, prime, field, measures)
        try:
            for root in seen.roots:  # at once, for most attempts fail at one of these
                ring.square_root(root, evaluate(root, ring))
            value = computation(ring)
            constants = {g: int(ring.generator(g)) for g in field.generators}
        except (ResampleError, ZeroDivisionError):
            continue
        return ExactValues(value, ring, prime, constants, field)
    raise UndecidedError(
        f"no exact posture was found in {_ATTEMPTS} attempts: a root or an inverse in "
        f"the geometry may not exist"
    )


def exact_posture(mechanism: Mechanism, seed: int, bits: int = 61) -> ExactPosture:
    """One of `exact_postures`.

    Raises:
        UndecidedError: See `exact_values`.
    """
    return exact_postures(mechanism, (seed,), bits)[0]


def exact_postures(
    mechanism: Mechanism, seeds: Sequence[int] = (1, 2), bits: int = 61
) -> tuple[ExactPosture, ...]:
    """Postures of a mechanism, random where it has symbols.

    Args:
        mechanism: Any mechanism; joint variables count as symbols, but those of
            ``reference`` files are taken as 0 where loops tie them (see `at_zero`).
        seeds: One for each posture; chooses the prime and the residues.
        bits: Size of the primes.

    Raises:
        UndecidedError: See `exact_values`.
    """

    def twists(ring: Any) -> Mapping[str, JointTwist[Any]]:
        return joint_twists(mechanism, ring, mechanism.base)

    seen = surveyed(twists)
    return tuple(_posture(exact_values(twists, seed, bits, seen)) for seed in seeds)


def _posture(found: ExactValues[Mapping[str, JointTwist[Any]]]) -> ExactPosture:
    return ExactPosture(
        {
            label: tuple(int(x) for x in twist.coordinates)
            for label, twist in found.value.items()
        },
        found.prime,
        found.constants,
        found.field,
    )


def closes_at_zero(mechanism: Mechanism) -> bool:
    """Whether joint variables 0 are a closed posture whatever the symbols are.

    Args:
        mechanism: Any; only a table that ties joint variables may be open there.

    Raises:
        UndecidedError: See `exact_values`.
    """
    if mechanism.geometry != "mdh" or not why_tied(mechanism):
        return True
    table = at_zero(mechanism)
    return all(
        exact_values(lambda ring: table_agrees(table, ring), seed).value
        for seed in (1, 2)
    )


def at_zero(mechanism: Mechanism) -> Mechanism:
    """The mechanism with all joint variables 0."""
    if mechanism.geometry == "reference":
        return replace(mechanism, geometry="posture")
    return with_values(mechanism, dict.fromkeys(mechanism.joint_variables, ZERO))
