"""Known factorisations, and those of the NAO dual arm against the published ones."""

import json
from collections import Counter
from fractions import Fraction
from functools import cache
from itertools import combinations
from pathlib import Path
from time import perf_counter

import pytest
from one_ring import in_one_ring

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.expression import ZERO
from screwkit.algebra.factors import Factored, FactorLibrary, factor
from screwkit.algebra.half_angle import HalfAngles
from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.minors import minor_table
from screwkit.algebra.parse import parse
from screwkit.algebra.polynomial_text import equation_text
from screwkit.algebra.restrictions import Layout
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive
from screwkit.kinematics.placement import joint_twists
from screwkit.mechanism.model import Joint, JointType, MdhRow, Mechanism, Parameter

REFERENCE = Path(__file__).parents[1] / "reference" / "nao_schemes.json"


def polynomial(text: str) -> tuple[TrigonometricRing, Polynomial]:
    ring, (value,) = in_one_ring(text)
    return ring, value


def factored(text: str) -> tuple[TrigonometricRing, Polynomial, Factored]:
    ring, value = polynomial(text)
    return ring, value, factor(ring, value)


def equations(text: str) -> list[tuple[tuple[str, ...], int]]:
    ring, _, found = factored(text)
    return sorted(
        (tuple(equation_text(ring, e) for e in part.equations), multiplicity)
        for part, multiplicity in found.factors
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("(r3*sin(q2) - d3*cos(q2))^2", [(("r3*sin(q2) - d3*cos(q2)",), 2)]),
        ("sin(q4)^2", [(("sin(q4)",), 2)]),
        ("x*sin(q4)^4*cos(q4)", [(("cos(q4)",), 1), (("sin(q4)",), 4), (("x",), 1)]),
        ("sin(q1 + q2)^2", [(("sin(q1 + q2)",), 2)]),
        ("sin(2*q1)", [(("cos(q1)",), 1), (("sin(q1)",), 1)]),
        ("2*x^2 - 2*y^2", [(("x + y",), 1), (("x - y",), 1)]),
        ("3*cos(q1) + 4*sin(q1)", [(("3*cos(q1) + 4*sin(q1)",), 1)]),
        ("(3*cos(q1) + 4*sin(q1))^2", [(("3*cos(q1) + 4*sin(q1)",), 2)]),
        ("cos(q1)^2 - 1/4", [(("2*cos(q1) + 1",), 1), (("2*cos(q1) - 1",), 1)]),
        ("-x/3", [(("x",), 1)]),
        (
            "sin(q1 - q2)*cos(q2 + q3)*(a*sin(q1) + b*cos(q2) + c)^2",
            [
                (("a*sin(q1) + b*cos(q2) + c",), 2),
                (("cos(q2 + q3)",), 1),
                (("sin(q2 - q1)",), 1),
            ],
        ),
    ],
)
def test_known_factors(text: str, expected: list[tuple[tuple[str, ...], int]]) -> None:
    assert equations(text) == sorted(expected)


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("r3*sin(q2) - d3*cos(q2)", "r3*sin(q2) - d3*cos(q2)"),
        ("a*sin(q2 + q3) + b*cos(q2)", "a*sin(q2)*cos(q5) + b*cos(q3)*sin(q4) + c"),
        ("a*sin(q2) + b*cos(q3) + c*sin(q4)", "c*cos(q2) + a*sin(q3)*cos(q4) + b"),
        ("a*sin(q1) + b*cos(q2)", "sqrt(3)*a*cos(q1)*sin(q3) + b*cos(q3) + a*sin(q2)"),
    ],
)
def test_parts_that_share_angles_are_found(first: str, second: str) -> None:
    """Products that no longer show their factors once squared sines are replaced."""
    both = f"({first})*({second})"
    expected = Counter(dict(equations(first)))
    expected.update(dict(equations(second)))
    assert dict(equations(both)) == expected
    ring, value, found = factored(both)
    assert found.certified
    assert found.expand(ring) == value


def test_what_shares_an_irrational_number_is_not_called_irreducible() -> None:
    _, _, found = factored(
        "(sqrt(3)*sin(q1) - x*cos(q1))*(sqrt(3)*cos(q1) + y*sin(q1))"
    )
    assert len(found.factors) == 2 or not found.certified


def test_a_half_angle_factor_is_reported_as_a_pair() -> None:
    assert equations("1 - cos(q4)") == [(("sin(q4)", "cos(q4) - 1"), 2)]


def test_panda() -> None:
    """The sine of q4/2, and a4 sin(q4/2) = d3 cos(q4/2) twice."""
    found = equations(
        "sin(q4)*(a4*(1 - cos(q4)) - d3*sin(q4))"
        "*(a4^2*(1 - cos(q4)) - 2*a4*d3*sin(q4) + d3^2*(1 + cos(q4)))"
    )
    half = ("d3*cos(q4) - a4*sin(q4) + d3", "d3*sin(q4) + a4*cos(q4) - a4")
    assert found == [
        (half, 3),
        (("sin(q4)",), 1),
        (("sin(q4)", "cos(q4) - 1"), 1),
    ]


def test_ur_arm_is_one_factor() -> None:
    text = "d5*sin(q2 + q3 + q4) + a2*cos(q2) + a3*cos(q2 + q3)"
    assert equations(f"sin(q3)*sin(q5)*({text})") == sorted(
        [((text,), 1), (("sin(q3)",), 1), (("sin(q5)",), 1)]
    )


@pytest.mark.parametrize(
    "text",
    [
        "sqrt(3)*cos(q1) + sin(q1)",
        "(x + sqrt(3)*y)^2*sin(q1)^2",
        "cos(pi/7)*x*sin(q1)^2",
        "x*sqrt(x^2 + y^2)*sin(q1) + (x^2 + y^2)*cos(q1)",
        "sqrt(2)*(1 - cos(q1))",
    ],
)
def test_roots_do_not_break_the_product(text: str) -> None:
    ring, value, found = factored(text)
    assert found.expand(ring) == value


def test_irrational_numbers_are_no_factors() -> None:
    assert equations("cos(pi/7)*x*sin(q1)^2") == [(("sin(q1)",), 2), (("x",), 1)]


def test_zero_is_refused() -> None:
    ring, _ = polynomial("x")
    with pytest.raises(ValueError, match="zero has no factors"):
        factor(ring, ring.zero)


def test_a_constant_has_no_factors() -> None:
    ring, _ = polynomial("x")
    assert factor(ring, ring.rational(Fraction(3, 2))) == Factored(Fraction(3, 2), ())


def test_the_library_does_not_change_the_answer() -> None:
    ring, value = polynomial("sin(q1)^3*(a*cos(q1) + b*sin(q2))^2*(a + b*cos(q2))")
    library = FactorLibrary(ring)
    first, second = (factor(ring, value, library) for _ in range(2))
    assert first == second == factor(ring, value)


# -- the NAO dual arm ----------------------------------------------------------------


def nao() -> Mechanism:
    rows = {
        "1": ("torso", "r1", {"b": "b1", "alpha": "-pi/2", "r": "-r1"}),
        "2": ("r1", "r2", {"alpha": "pi/2"}),
        "3": ("r2", "r3", {"d": "-d3", "alpha": "pi/2", "r": "r3"}),
        "4": ("r3", "r4", {"alpha": "-pi/2"}),
        "5": ("r4", "r5", {"alpha": "pi/2", "r": "r5"}),
        "6": ("torso", "l1", {"b": "b1", "alpha": "-pi/2", "r": "r1"}),
        "7": ("l1", "l2", {"alpha": "pi/2"}),
        "8": ("l2", "l3", {"d": "d3", "alpha": "pi/2", "r": "r3"}),
        "9": ("l3", "l4", {"alpha": "-pi/2"}),
        "10": ("l4", "l5", {"alpha": "pi/2", "r": "r5"}),
    }
    joints = [
        Joint(
            name,
            JointType.REVOLUTE,
            parent,
            child,
            (f"q{name}",),
            (parse("pi/2") if name in ("2", "7") else ZERO,),
            (),
            MdhRow(**{key: parse(text) for key, text in row.items()}),
        )
        for name, (parent, child, row) in rows.items()
    ]
    joints += [
        Joint("grasp_right", JointType.FIXED, "r5", "object"),
        Joint("grasp_left", JointType.FIXED, "l5", "object"),
    ]
    links = ("torso", *(child for _, child, _ in rows.values()), "object")
    parameters = tuple(
        Parameter(name, parse("1"), True) for name in ("b1", "r1", "d3", "r3", "r5")
    )
    return Mechanism(
        "nao", "", "torso", "object", links, tuple(joints), "mdh", parameters=parameters
    )


Scheme = tuple[str, ...]


@cache
def determinants() -> tuple[TrigonometricRing, dict[Scheme, Polynomial]]:
    """Of the passive twists of every admissible scheme, in the frame of a link."""
    mechanism = nao()
    survey = SurveyRing()
    joint_twists(mechanism, survey, "torso")
    single = [((f"q{i}", 1),) for i in (2, 3, 4, 5, 7, 8, 9, 10)]
    ring = TrigonometricRing(survey, [(("q1", 1),), (("q6", 1), ("q1", -1)), *single])
    twists = joint_twists(mechanism, ring, "r1")
    names = sorted(twists, key=int)
    sides = names[:5], names[5:]
    tables = [
        minor_table(ring, [twists[name].coordinates for name in side], 6)
        for side in sides
    ]
    found: dict[Scheme, Polynomial] = {}
    for actuated in combinations(names, 4):
        masks = [
            sum(1 << i for i, name in enumerate(side) if name not in actuated)
            for side in sides
        ]
        right, left = (t.get(m, {}) for t, m in zip(tables, masks, strict=True))
        total = ring.zero
        for rows, minor in right.items():
            if 63 ^ rows in left:
                swaps = sum(
                    (~rows & ((1 << r) - 1)).bit_count()
                    for r in range(6)
                    if rows >> r & 1
                )
                total += (-1) ** swaps * minor * left[63 ^ rows]
        total = ring.normal(total)
        if total != 0:
            found[actuated] = total
    return ring, found


@cache
def nao_factored() -> dict[Scheme, Factored]:
    ring, found = determinants()
    library = FactorLibrary(ring)
    return {scheme: factor(ring, value, library) for scheme, value in found.items()}


def test_nao_factors_are_complete() -> None:
    results = nao_factored()
    assert len(results) == 139
    assert all(found.certified for found in results.values())
    assert len({part.key for f in results.values() for part, _ in f.factors}) == 78


def test_nao_products_are_exact() -> None:
    ring, found = determinants()
    for scheme, result in nao_factored().items():
        assert result.expand(ring) == found[scheme]


def test_nao_factors_are_the_published_ones() -> None:
    ring, _ = determinants()
    reference = json.loads(REFERENCE.read_text())
    keys = {
        name: str(primitive(evaluate(parse(text, limits=RESULT_LIMITS), ring)))
        for name, text in reference["factors"].items()
    }
    assert len(reference["schemes"]) == 139
    histogram: Counter[str] = Counter()
    for actuated, _, published in reference["schemes"]:
        found = {part.key: m for part, m in nao_factored()[tuple(actuated)].factors}
        assert found == {keys[name]: m for name, m in published}, actuated
        histogram[str(len(found))] += 1
    assert histogram == reference["histogram"]


@pytest.mark.benchmark
def test_nao_against_half_angles_everywhere() -> None:
    """Determinants of at most 100 terms; the longer ones gain more."""
    ring, found = determinants()
    short = [value for value in found.values() if len(value) <= 100]
    halves = HalfAngles(ring, Layout.of(ring))
    start = perf_counter()
    for value in short:
        halves.factor(halves.form(value, halves.degrees(value)))
    middle = perf_counter()
    library = FactorLibrary(ring)
    for value in short:
        factor(ring, value, library)
    assert (middle - start) / (perf_counter() - middle) > 10
