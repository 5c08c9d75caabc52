"""What limbs' passive twists span, without the factors that belong to a limb alone.

All coordinates of a limb's extensor may share factors, such as the determinant of a
limb none of whose joints is locked.  Every minor of the loop constraint matrix is
linear in each limb's extensor, so that such a factor is a factor of the minor: it is
found once for a limb and not in every scheme, and minors are expanded without it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from screwkit.algebra.common_factors import without_common_factors
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.factors import Factor, Factored, factor
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

Content = tuple[tuple[Factor, int], ...]
"""Irreducible factors with their multiplicities."""


@dataclass(frozen=True)
class PrimitiveExtensor:
    """An extensor as a product.

    Attributes:
        coordinates: Without a common factor, by set of rows.
        content: The factors they shared; numbers are left out.
    """

    coordinates: Mapping[int, Polynomial]
    content: Content


class Minor(NamedTuple):
    """A minor of the loop constraint matrix as a product.

    Attributes:
        rest: What is left without the limbs' own factors.
        content: Those.
    """

    rest: Polynomial
    content: Content

    def expanded(self, ring: TrigonometricRing) -> Polynomial:
        """The product."""
        content = Factored(Fraction(1), self.content).expand(ring)
        return ring.normal(content * self.rest)


def content_of(extensors: Sequence[PrimitiveExtensor]) -> Content:
    """The factors that several extensors together give to a minor."""
    powers: Counter[str] = Counter()
    factors: dict[str, Factor] = {}
    for extensor in extensors:
        for one, number in extensor.content:
            factors[one.key] = one
            powers[one.key] += number
    return tuple((factors[key], number) for key, number in powers.items())


def primitive_extensor(
    ring: TrigonometricRing,
    coordinates: Mapping[int, Polynomial],
    library: FactorLibrary,
) -> PrimitiveExtensor:
    """An extensor without the factors that its coordinates share.

    Args:
        ring: Of the coordinates.
        coordinates: By set of rows; none is zero.
        library: Of the same ring.
    """
    if not coordinates:
        return PrimitiveExtensor({}, ())
    values = list(coordinates.values())
    rest = without_common_factors(ring, values, library)
    shortest = min(range(len(values)), key=lambda k: len(values[k]))
    factors, before = _counted(ring, values[shortest], library)
    _, after = _counted(ring, rest[shortest], library)
    content = tuple((factors[key], n) for key, n in (before - after).items())
    if not _is_whole(content):  # of half angles, which the entries share in pairs
        return PrimitiveExtensor(coordinates, ())
    product = Minor(rest[shortest], content).expanded(ring)
    scale = values[shortest].coeffs()[0] / product.coeffs()[0]
    if scale * product != values[shortest]:  # an irrational number was divided out
        return PrimitiveExtensor(coordinates, ())
    scaled = [scale * value for value in rest]
    return PrimitiveExtensor(dict(zip(coordinates, scaled, strict=True)), content)


def _is_whole(content: Content) -> bool:
    """Whether a product of factors is one of whole angles."""
    degrees: Counter[int] = Counter()
    for one, number in content:
        if one.form is not None:
            degrees.update({a: d * number for a, d in one.form.degrees.items()})
    return not any(degree % 2 for degree in degrees.values())


def _counted(
    ring: TrigonometricRing, polynomial: Polynomial, library: FactorLibrary
) -> tuple[dict[str, Factor], Counter[str]]:
    found = factor(ring, polynomial, library).factors
    return {f.key: f for f, _ in found}, Counter({f.key: n for f, n in found})
