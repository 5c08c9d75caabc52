"""What decides a case: eliminated unknowns, sums of squares, what is zero nowhere."""

from __future__ import annotations

from fractions import Fraction

import pytest
from one_ring import in_one_ring

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch, Pending, restricted
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.division import Divisor
from screwkit.algebra.elimination import steps_of
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.implied import eliminants
from screwkit.algebra.modular import rank
from screwkit.algebra.nowhere_zero import FACTORED, without_nowhere_zero
from screwkit.algebra.points import differential, residue
from screwkit.algebra.real_zeros import vanishing_together
from screwkit.algebra.search import Decomposition, Search, refined
from screwkit.algebra.splitting import split
from screwkit.algebra.substitution import reduced
from screwkit.algebra.taken_apart import taken_apart
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive
from screwkit.analyses.singularities import limb_singularities
from screwkit.case import load, load_text
from screwkit.kinematics.assembly import Assembly

POSITIVE = Assumptions(frozenset({"a", "b"}))


def zeros(*texts: str) -> tuple[TrigonometricRing, Decomposition]:
    ring, conditions = in_one_ring(*texts)
    search = Search(FactorLibrary(ring))
    return ring, common_zeros(Branch(ring, POSITIVE), conditions, search)


@pytest.mark.parametrize(
    ("one", "two", "without", "implied"),
    [
        # x = 1 or 2 in the first, x = y in the second.
        ("x^2 - 3*x + 2", "x - y", "x", "(y - 1)*(y - 2)"),
        # On both, sin q = x and cos q = y.
        ("sin(q) - x", "cos(q) - y", "q", "x^2 + y^2 - 1"),
        # Both are homogeneous in sin q and cos q: their determinant vanishes.
        ("x*sin(q) + cos(q)", "sin(q) - y*cos(q)", "q", "x*y + 1"),
    ],
)
def test_two_conditions_imply_one_without_an_unknown(
    one: str, two: str, without: str, implied: str
) -> None:
    ring, (first, second, wanted) = in_one_ring(one, two, implied)
    found = [e for e in eliminants(ring, first, second) if e in (wanted, -wanted)]
    assert found, without


def test_a_length_is_not_solved_where_a_pending_condition_makes_it_zero() -> None:
    """2 a cos p is what the pending condition says is 0: then cos p = 0."""
    ring, (first, second) = in_one_ring(
        "x*sin(q) - y*cos(r) - z", "2*a*cos(p) - x*sin(q) + y*cos(r) + z"
    )
    pending = (Pending(first, first),)
    branch = Branch(ring, POSITIVE, conditions=(first,), pending=pending)
    symbols = dict(zip(ring.symbols, ring.symbol_indices(), strict=True))
    parts = split(branch, second, (symbols["a"],))
    assert parts is not None
    assert parts.solved is None


def test_conditions_that_become_the_same_are_one() -> None:
    ring, (one, two) = in_one_ring("x^2*sin(q) + y^2 - z^2", "x^2*sin(r) + y^2 - z^2")
    pending = Pending(one, one), Pending(two, one)
    same = Branch(ring, POSITIVE, conditions=(one, two), pending=pending)
    assert not same.points
    parts = refined(same, Search(FactorLibrary(ring)))
    assert parts is not None
    assert [part.codimension for part in parts] == [1]
    assert parts[0].points


def test_a_condition_says_less_where_another_holds() -> None:
    """(u v + w)·sin p + Q·cos p, where Q is 0, is a product: u v + w = 0 or sin p = 0.

    It was taken for irreducible, and searches went round in circles on it.
    """
    ring, (one, two, sine, product) = in_one_ring(
        "x*sin(q) + y*cos(r) + x*y",
        "(u*v + w)*sin(p) + (x*sin(q) + y*cos(r) + x*y)*cos(p)",
        "sin(p)",
        "u*v + w",
    )
    pending = Pending(one, one), Pending(two, two)
    branch = Branch(ring, POSITIVE, conditions=(one, two), pending=pending)
    parts = refined(branch, Search(FactorLibrary(ring)))
    assert parts is not None
    assert {part.codimension for part in parts} == {2}
    zero = {(part.value(sine) == 0, part.value(product) == 0) for part in parts}
    assert zero == {(True, False), (False, True)}
    assert all(part.points for part in parts)


def test_pending_conditions_are_solved_together() -> None:
    """√3 (u² − v²) − 6 u v = √3 on the unit circle: v = 0 or v = −√3 u, four points."""
    _, found = zeros("u^2 + v^2 - 1", "sqrt(3)*u^2 - 6*u*v - sqrt(3)*v^2 - sqrt(3)")
    assert found.complete
    points = set()
    for branch in found.branches:
        assert branch.codimension == 2
        for point, prime in branch.points:
            root = next(r for r in point if r * r % prime == 3)
            u, v = (point[i] for i in branch.ring.symbol_indices())
            assert (u * u + v * v - 1) % prime == 0
            points.add(v == 0 or (v * root + 3 * u) % prime == 0)
    assert len(found.branches) == 4
    assert points == {True}


@pytest.mark.parametrize(
    ("text", "terms"),
    [
        ("a*x^2 + b*y^2", {"x", "y"}),
        # sin² p + cos² p cos² q, in normal form 1 − cos² p sin² q, with 1 = s² + c².
        (
            "sin(p)^2 + cos(p)^2*cos(q)^2",
            {"sin(p)*sin(q)", "sin(p)*cos(q)", "cos(p)*cos(q)"},
        ),
        ("cos(p)*cos(q) - 1", {"sin(p)", "sin(q)"}),
        ("x^2 + sqrt(3)*y^4 + 1", {"x", "y", "1"}),
    ],
)
def test_in_a_sum_of_squares_every_term_vanishes(text: str, terms: set[str]) -> None:
    ring, (polynomial, *others) = in_one_ring(text, *sorted(terms))
    found = vanishing_together(ring, POSITIVE, polynomial)
    assert found is not None
    # The lengths a and b are not zero and may stay.
    positive = [ring.symbol(n) for n in ring.symbols if n in POSITIVE.positive]
    allowed = [{str(o * f) for f in (ring.one, *positive)} for o in others]
    assert len(found) == len(others)
    assert all(any(str(term) in own for term in found) for own in allowed)


@pytest.mark.parametrize("text", ["x^2 - y^2", "sin(p)^2 - cos(q)^2", "x*y + x^2"])
def test_what_may_have_other_zeros_is_no_sum_of_squares(text: str) -> None:
    ring, (polynomial,) = in_one_ring(text)
    assert vanishing_together(ring, POSITIVE, polynomial) is None


@pytest.mark.parametrize(
    "text", ["sin(p)^2 + cos(p)^2*cos(q)^2", "cos(p)*sin(q) - 1", "x^2 + a*y^2"]
)
def test_a_sum_of_squares_is_a_locus_of_codimension_two(text: str) -> None:
    _, found = zeros(text)
    _, (polynomial,) = in_one_ring(text)
    assert found.complete
    assert found.branches
    for branch in found.branches:
        assert not any(residue(polynomial, *at) for at in branch.points)
    assert all(branch.codimension == 2 for branch in found.branches)


@pytest.mark.parametrize(
    ("text", "halves"),
    [
        ("(x - k)^2 + (y - sqrt(3)*k)^2", ["x - k", "y - sqrt(3)*k"]),
        ("(x - k*y)^2 + 3*(y - 1)^2", ["x - k*y", "y - 1"]),
        ("(a*x - sin(p))^2 + (x*cos(p) + 2)^2", ["a*x - sin(p)", "x*cos(p) + 2"]),
    ],
)
def test_two_squares_multiplied_out_are_a_locus_of_codimension_two(
    text: str, halves: list[str]
) -> None:
    ring, decomposed = zeros(text, *(f"0*({half})" for half in halves))
    own, wanted = in_one_ring(text, *halves)
    assert own.names == ring.names
    assert decomposed.complete
    assert decomposed.branches
    for branch in decomposed.branches:
        assert branch.codimension == 2
        assert not any(residue(w, *at) for w in wanted for at in branch.points)


def test_a_square_and_lengths_are_never_zero() -> None:
    """Three quarters of it are (x − 2y/3)² + 5y²/9 + 4ab/3."""
    ring, (polynomial,) = in_one_ring("3*x^2 - 4*x*y + 3*y^2 + 4*a*b")
    assert vanishing_together(ring, POSITIVE, polynomial) == [ring.one]


@pytest.mark.parametrize(
    "text",
    [
        "(x - k)^2 - (y - sqrt(3)*k)^2",
        "x^2 + x*y - 2",
        "(x - k)^2 + y*k - 1",
        "(y^2 - y - k)*(x^2 + 1)",
    ],
)
def test_differences_of_squares_and_products_are_left(text: str) -> None:
    ring, (polynomial,) = in_one_ring(text)
    assert vanishing_together(ring, POSITIVE, polynomial) is None


def test_roots_of_squares_are_in_normal_form() -> None:
    """The angle p is real only where (1 + t²)² ≤ (1 − t²)², which is where t = 0."""
    t = "(x*sin(q)^2 - sin(q)*cos(q))"
    text = f"({t}^2 - 1)*sin(p) + {t}^2 + 1"
    ring, (polynomial, root) = in_one_ring(text, t)
    found = vanishing_together(ring, Assumptions(), polynomial)
    assert found is not None
    assert [primitive(p) for p in found] == [primitive(root), primitive(polynomial)]


def test_an_axis_is_zero_on_no_branch_whether_points_are_found_or_not() -> None:
    """A turned (−1, 1, 2) never is (−1, 3, −2): a leg between the two has a length."""
    spins = {  # of Rz(a) Ry(b) Rx(c), by rows
        "x": "-cos(a)*cos(b) + cos(a)*sin(b)*sin(c) - sin(a)*cos(c)"
        " + 2*cos(a)*sin(b)*cos(c) + 2*sin(a)*sin(c)",
        "y": "-sin(a)*cos(b) + sin(a)*sin(b)*sin(c) + cos(a)*cos(c)"
        " + 2*sin(a)*sin(b)*cos(c) - 2*cos(a)*sin(c)",
        "z": "sin(b) + cos(b)*sin(c) + 2*cos(b)*cos(c)",
    }
    texts = [f"{spins['x']} + 1", f"{spins['y']} - 3", f"{spins['z']} + 2"]
    ring, leg = in_one_ring(*texts)
    root = Branch(ring, Assumptions(), directions=(tuple(leg),))
    zeros = common_zeros(root, leg, Search(FactorLibrary(ring)))
    assert zeros.complete
    assert not zeros.branches


def test_a_root_vanishes_where_its_radicand_does() -> None:
    """√(x² − y²) = 0 on the two lines y = ±x."""
    _, found = zeros("sqrt(x^2 - y^2)*(a + 1)")
    assert found.complete
    assert {str(b.conditions[0].to_dict()) for b in found.branches}
    for branch in found.branches:
        assert branch.codimension == 1
        for point, prime in branch.points:
            x, y = (
                point[branch.ring.names.index(f"x{branch.ring.symbols.index(n)}")]
                for n in ("x", "y")
            )
            assert (x * x - y * y) % prime == 0
    assert len(found.branches) == 2


def test_what_is_zero_nowhere_is_divided_out() -> None:
    """Also where √3 and s² = 1 − c² hide the factor."""
    square = "(x - sqrt(3)*y*cos(q))^2 + (1 + y*sin(q))^2 + sin(p)^2"
    rest = "(x*sin(q) + sqrt(3)*y - cos(p))*(y^2 + 3*x*cos(p) - 2)"
    ring, (product, divisor, plain) = in_one_ring(f"({square})*({rest})", square, rest)
    (found,) = without_nowhere_zero(ring, [product], [divisor])
    assert found in (plain, -plain)
    (kept,) = without_nowhere_zero(ring, [plain * plain], [divisor])
    assert kept == plain * plain


def test_a_number_is_not_divided_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """√3 divides every polynomial over Q(√3), and so it would for ever."""
    left, divide = iter(range(20)), Divisor.divide

    def counted(self: Divisor, polynomial: Polynomial) -> Polynomial | None:
        next(left)
        return divide(self, polynomial)

    monkeypatch.setattr(Divisor, "divide", counted)
    long = "(x + y + sqrt(3)*cos(q))^4*(1 - x*sin(q))^2"
    ring, (whole, root, unit) = in_one_ring(long, "sqrt(3)", "2 + sqrt(3)")
    assert len(whole) > FACTORED
    assert without_nowhere_zero(ring, [whole], [root, unit]) == [whole]


def test_an_angle_in_numbers_is_not_two_angles() -> None:
    """Cosine and sine 1/2 are no point of the circle; 3/5 and 4/5 are one."""
    _, none = zeros("2*cos(q) - 1", "2*sin(q) - 1")
    assert none.complete
    assert not none.branches
    texts = "5*cos(q) - 3", "5*sin(q) - 4"
    ring, found = zeros(*texts)
    assert found.branches
    _, conditions = in_one_ring(*texts)
    for branch in found.branches:
        assert branch.points
        assert not any(residue(c, *at) for c in conditions for at in branch.points)
    assert ring.basis


def test_what_an_angle_in_numbers_implies_holds_after_later_steps() -> None:
    """With s = 3 − 4c on the circle 17c² − 24c + 8 = 0, also when x takes c's place."""
    ring, (angle, equal, implied) = in_one_ring(
        "sin(q) + 4*cos(q) - 3", "x - cos(q)", "17*x^2 - 24*x + 8"
    )
    (first,) = restricted(Branch(ring, POSITIVE), angle)
    (second,) = restricted(first, first.value(equal))
    assert second.value(implied) == 0


def test_conditions_that_follow_from_others_leave_points() -> None:
    """The three minors of a matrix of two rows: where two vanish so does the third."""
    ring, minors = in_one_ring("x*y - z*w", "x*u - z*v", "w*u - y*v")
    pending = tuple(Pending(minor, minor) for minor in minors)
    branch = Branch(ring, POSITIVE, tuple(minors), pending=pending, thorough=True)
    assert branch.points
    assert not any(residue(minor, *at) for minor in minors for at in branch.points)


def test_a_sum_that_touches_zero_has_few_real_zeros() -> None:
    """a² + b² − 2ab cos q is the square of the third side of a triangle."""
    ring, (side, flat) = in_one_ring("a^2 + b^2 - 2*a*b*cos(q)", "a^2 - b^2")
    found = vanishing_together(ring, Assumptions(), side)
    assert found is not None
    assert any(p in (flat, -flat) for p in found)
    ring, (two_angles,) = in_one_ring("2 + 2*cos(p)*cos(q) - sin(p)*sin(q)")
    # 4 − 4 cos² p − sin² p = 3 sin² p must not be positive.
    found = vanishing_together(ring, Assumptions(), two_angles)
    assert found is not None
    assert any(len(p) == 1 for p in found)
    ring, (far,) = in_one_ring("3*x + x*sin(q) + 2*x*cos(q)*sin(p)")
    # 9 − sin² q − 4 cos² q sin² p is no square: nothing is said.
    assert vanishing_together(ring, Assumptions(), far) is None
    ring, (never,) = in_one_ring("3 + sin(q)")
    assert restricted(Branch(ring, POSITIVE), never) == []


@pytest.mark.parametrize(
    ("text", "never"),
    [
        ("3 + sin(p)*sin(q)", True),
        ("a - 3*b - 2*a + b*sin(p)*sin(q)*cos(r)", True),
        ("3*a - b + a*sin(p)*sin(q)", False),
        # For sin p = ±1 they are between ±√2: 1.40 < √2 < 1.42.
        ("71/50 + sin(p)*sin(q) + cos(q)", True),
        ("7/5 + sin(p)*sin(q) + cos(q)", False),
        ("x + 3 + sin(p)*sin(q)", False),
    ],
)
def test_what_sines_cannot_outweigh_is_zero_nowhere(text: str, never: bool) -> None:
    ring, (polynomial,) = in_one_ring(text)
    found = vanishing_together(ring, POSITIVE, polynomial)
    assert found == ([ring.one] if never else None)


def test_many_angles_are_not_multiplied_out() -> None:
    """Ten squares of cosines made homogeneous have millions of terms.

    e² − y² is no square where e is the sum of them: at exact points already.
    """
    squares = " + ".join(f"u{k}*cos(p{k})^2" for k in range(10))
    ring, (polynomial,) = in_one_ring(f"y*sin(q) + {squares}")
    assert vanishing_together(ring, POSITIVE, polynomial) is None


def test_a_factor_in_half_angles_is_kept_with_all_its_equations() -> None:
    """4u(xu³ + v³) with u = sin q/2, v = cos q/2: q = 0, or a cubic in tan q/2."""
    text = "x*(1 - cos(q))^2 + sin(q)*(1 + cos(q))"
    ring, (condition, beside) = in_one_ring(
        text, "x*sin(q)*(1 - cos(q)) + (1 + cos(q))^2"
    )
    found = common_zeros(
        Branch(ring, POSITIVE), [condition], Search(FactorLibrary(ring))
    )
    assert found.complete
    (cubic,) = [b for b in found.branches if b.pending]
    assert len(found.branches) == 2
    assert not any(residue(beside, *at) for at in cubic.points)
    assert len(cubic.points) == 2


def test_a_piece_is_taken_apart_where_a_coefficient_vanishes() -> None:
    """Planes x sin p = z cos p and y sin r = z cos r, and what stands upright."""
    ring, conditions = in_one_ring("x*sin(p) - z*cos(p)", "y*sin(r) - z*cos(r)")
    search = Search(FactorLibrary(ring))
    branch = Branch(ring, POSITIVE)
    for condition in conditions:
        (branch,) = restricted(branch, condition)
    assert len(branch.pending) == 2
    waiting, parts = [branch], []
    while waiting:
        here = waiting.pop()
        apart = taken_apart(here, search)
        if apart is None:
            parts.append(here)
            continue
        assert not apart.open
        waiting += apart.parts
    assert all(not part.pending for part in parts)
    for part in parts:
        assert part.points
        assert not any(residue(c, *at) for c in conditions for at in part.points)
    # Of each condition the general part, and z = 0 with the sine zero.
    assert {part.codimension for part in parts} == {2, 3}


def test_what_a_known_piece_says_is_not_found_again() -> None:
    ring, (product, known, other) = in_one_ring(
        "(x - y)*(x + y - 1)", "x - y", "x + y - 1"
    )
    search = Search(FactorLibrary(ring), away=(known,))
    (found,) = common_zeros(Branch(ring, POSITIVE), [product], search).branches
    assert found.conditions in ((other,), (-other,))


def test_an_angle_that_a_number_fixes_is_not_fixed_again() -> None:
    """Normal forms write sin² q by cos q, which is known: 1 − 9/100."""
    ring, (first, second, third) = in_one_ring(
        "10*cos(q) + 3", "5*sin(p)*sin(q) + 2", "50*cos(p)*sin(q) + 25*sqrt(3)"
    )
    (fixed,) = restricted(Branch(ring, POSITIVE), first)
    _, sine = ring.cosine_sine("q")
    (left,) = reduced([ring.normal(sine * sine)], fixed.steps)
    assert left == ring.rational(Fraction(91, 100))
    found = common_zeros(
        Branch(ring, POSITIVE), [first, second, third], Search(FactorLibrary(ring))
    )
    for branch in (*found.branches, *found.open):
        assert len({str(c) for c in branch.conditions}) == branch.codimension <= 3


@pytest.mark.parametrize(
    ("text", "count"),
    [
        # tan q = 7/√2 and (7 − √2)/√2: the roots of 51 and 53 − 14 √2 are not in Q(√2).
        ("sqrt(2)*sin(q) - 7*cos(q)", 1),
        ("sqrt(2)*sin(q) - (7 - sqrt(2))*cos(q)", 1),
        # A common factor hides that sin q = ±4/5: two sheets would be one.
        ("(3 + 3*sqrt(2))*sin(q) + (4 + 4*sqrt(2))*cos(q)", None),
        ("sin(q) - 2*sqrt(2)*cos(q)", 2),
    ],
)
def test_irrational_numbers_fix_an_angle(text: str, count: int | None) -> None:
    ring, (condition,) = in_one_ring(text)
    steps = steps_of(ring, POSITIVE, condition)
    assert (None if steps is None else len(steps)) == count
    if count == 1:
        (branch,) = restricted(Branch(ring, POSITIVE), condition)
        assert branch.points
        assert not any(residue(condition, *at) for at in branch.points)
        cosine, _ = ring.cosine_sine("q")
        if text.endswith("7*cos(q)"):
            assert branch.value(51 * cosine * cosine - 2) == 0


ONE, TWO, THREE = (
    "(sqrt(2)*u*x + sqrt(3)*v*y + x*y + u + w + sqrt(2)*w*x + sqrt(3))",
    "(sqrt(3)*u*y - sqrt(2)*v*x + w*x + v - u*v + sqrt(2)*y + 3)",
    "(sqrt(2)*w*y + sqrt(3)*x*v + u*x - w + y - sqrt(3)*v*w + 1)",
)


@pytest.mark.parametrize("shared", [ONE, TWO])
def test_long_products_over_square_roots_hide_no_parts(shared: str) -> None:
    """Two products of 45 terms are not split: what they share must not be lost.

    All of ONE·TWO = 0 is too much, and its points may lie on the part that is not
    shared, where the second product asks for more.
    """
    other = TWO if shared == ONE else ONE
    found = zeros(f"{shared}*{other}", f"{shared}*{THREE}")[1]
    (part,) = in_one_ring(f"{shared}*{other}", f"{shared}*{THREE}", shared)[1][2:]
    if found.complete:
        assert any(str(part) in map(str, b.conditions) for b in found.branches)


@pytest.mark.parametrize("case", ["exechon", "panda"])
def test_what_squares_imply_is_not_added_time_and_again(case: str) -> None:
    """The root of e² − a² − b² comes out with either sign: one condition, once."""
    limbs = Assembly(load(case).mechanism)
    assert limb_singularities(limbs, limbs.limbs[0]).complete


def test_a_condition_that_later_ones_imply_takes_no_dimension() -> None:
    """x·sin p + z·cos p = 0 cannot be solved, and says nothing where z = sin p = 0."""
    ring, (first, z, sine) = in_one_ring("x*sin(p) + z*cos(p)", "z", "sin(p)")
    (unsolved,) = restricted(Branch(ring, Assumptions()), first)
    assert unsolved.pending
    (flat,) = restricted(unsolved, z)
    for branch in restricted(flat, sine):
        assert len(branch.conditions) == 3
        assert branch.codimension == 2
        point, prime = branch.points[0]
        rows = [differential(ring, c, point, prime) for c in (z, sine)]
        assert rank(rows, prime) == 2


def test_a_half_angle_is_not_solved_again_where_its_divisor_is_asked() -> None:
    """It was, until the search was out of breath: 103 pieces were left open."""
    _, found = zeros(
        "sin(p)*(sin(r)*cos(r) + 2*sin(r) + cos(r)^2 - cos(r)) + cos(p)*(2*sin(r)"
        " - sin(r)*cos(r) - cos(r)^2 - cos(r)) + sin(r)*cos(r) - 2*sin(r)"
        " + cos(r)^2 + cos(r)",
        "sin(p)*(sin(r)*cos(r) - 2*sin(r) + cos(r)^2 + cos(r)) + cos(p)*(2*sin(r)"
        " + sin(r)*cos(r) + cos(r)^2 - cos(r)) + sin(r)*cos(r) + 2*sin(r)"
        " + cos(r)^2 - cos(r)",
    )
    assert found.complete
    assert found.branches


STRUT = """
screwkit: 1
name: strut
geometry: posture
base: base
platform: platform
links: [base, platform, low, high]
variables: {y: 1/5, z: 2, p: {value: 0, angle: true}}
pose: {translation: [0, y, z], rotation: {axis: z, angle: p}}
points:
  A: [0, 1, 0]
  B: {link: platform, at: [-1, 1, 0]}
joints:
  - {name: T, type: spherical, parent: base, child: low, point: A}
  - {name: P, type: prismatic, parent: low, child: high, axis: B - A}
  - {name: S, type: spherical, parent: high, child: platform, point: B}
"""


def test_a_strut_has_a_length_where_an_angle_is_fixed_by_a_root() -> None:
    """Where sin p = −cos p, z = 0 and y = 1 − 2 cos p = 1 ± √2, both ends coincide.

    There is no such strut. A strut with a length has all six freedoms.
    """
    limbs = Assembly(load_text(STRUT).mechanism)
    limb = limb_singularities(limbs, limbs.limbs[0])
    assert limb.generic_rank == 6
    assert limb.complete
    assert not limb.components
