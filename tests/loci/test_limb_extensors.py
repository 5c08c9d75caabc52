"""Factors of limbs taken out of minors: products are what they were."""

from __future__ import annotations

from itertools import islice

import pytest

import screwkit as sk
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.parse import parse
from screwkit.algebra.points import residue
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.kinematics.assembly import Assembly, loop_rows
from screwkit.loci.actuation import passive_joints
from screwkit.loci.limb_extensors import content_of, primitive_extensor
from screwkit.loci.passive import PassiveSystem


def test_what_all_coordinates_share_is_taken_out() -> None:
    """sin² hides in 1 − cos²: a plain common divisor does not see it."""
    survey = SurveyRing()
    evaluate(parse("a*sin(q)*sin(u)"), survey)
    ring = TrigonometricRing(survey)
    a = ring.symbol("a")
    (_, s), (d, t) = ring.cosine_sine("q"), ring.cosine_sine("u")
    rest = {3: a + d, 5: 2 * s * t, 6: a * t}
    whole = {key: ring.normal(s * value) for key, value in rest.items()}
    found = primitive_extensor(ring, whole, FactorLibrary(ring))
    assert [(str(f.equations[0]), n) for f, n in found.content] == [(str(s), 1)]
    for key, value in found.coordinates.items():
        assert ring.normal(s * value) == whole[key]
    again = primitive_extensor(ring, found.coordinates, FactorLibrary(ring))
    assert (again.content, again.coordinates) == ((), found.coordinates)
    twice = content_of([found, found])
    assert [n for _, n in twice] == [2]


@pytest.mark.parametrize("actuated", [("P12", "P22", "P42"), ("U21:0", "P22", "P42")])
def test_a_determinant_is_the_product(actuated: tuple[str, ...]) -> None:
    """Against the assembled columns at exact points, up to one sign."""
    assembly = sk.load("tricept").assembly
    system = PassiveSystem(assembly)
    passive = passive_joints(assembly, actuated)
    assert system.fills(passive)
    (minor,) = islice(system.maximal_minors(passive), 2)
    assert minor.content  # a limb without actuator has its own determinant
    signs = set()
    for point, prime in assembly.root(assembly.common_twists.ring).points:
        wanted = _determinant(assembly, passive, point, prime)
        ring = assembly.common_twists.ring
        found = residue(minor.expanded(ring), point, prime)
        assert found
        assert found in {wanted, prime - wanted}
        signs.add(found == wanted)
    assert len(signs) == 1


def _determinant(
    assembly: Assembly, passive: tuple[str, ...], point: object, prime: int
) -> int:
    """By elimination over residues."""
    framed = assembly.common_twists
    limbs = [
        [
            [residue(x, point, prime) for x in framed.column(j)]  # type: ignore[arg-type]
            for j in limb.joints
            if j in passive
        ]
        for limb in assembly.limbs
    ]
    rows = [list(map(int, row)) for row in loop_rows(limbs)]
    size, value = len(rows), 1
    for k in range(size):
        pivot = next(i for i in range(k, size) if rows[i][k] % prime)
        if pivot != k:
            rows[k], rows[pivot], value = rows[pivot], rows[k], -value
        value = value * rows[k][k] % prime
        inverse = pow(rows[k][k], -1, prime)
        for i in range(k + 1, size):
            factor = rows[i][k] * inverse % prime
            rows[i] = [
                (x - factor * y) % prime for x, y in zip(rows[i], rows[k], strict=True)
            ]
    return value % prime


def test_factors_in_half_angles_may_be_shared_unevenly() -> None:
    """With u = sin q/2, v = cos q/2, g = x u + 2 v: g²u⁵v and g u⁴v³."""
    long, short = "x*sin(q) + 2*(1 + cos(q))", "x*(1 - cos(q)) + 2*sin(q)"
    texts = (
        f"({long})*(1 - cos(q))*({short})*(1 - cos(q))",
        f"({long})*sin(q)*(1 - cos(q))*sin(q)",
    )
    survey = SurveyRing()
    for text in texts:
        evaluate(parse(text), survey)
    ring = TrigonometricRing(survey)
    whole = {1 << i: ring.normal(evaluate(parse(t), ring)) for i, t in enumerate(texts)}
    found = primitive_extensor(ring, whole, FactorLibrary(ring))
    one, two = whole.values()
    first, second = found.coordinates.values()
    assert ring.normal(one * second - two * first) == 0
    assert first != 0
