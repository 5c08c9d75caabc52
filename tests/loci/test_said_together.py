"""Statements together, and lines of members and of stretched limbs."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import pairwise

import numpy as np
import pytest
from loci.numeric import Array, value

import screwkit as sk
from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.points import residue
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive
from screwkit.analyses.hybrid_limbs import hybrid_limb
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.whole_graph import WholeGraph
from screwkit.loci.conjunctions import conjunction
from screwkit.loci.figure_words import dependent_along
from screwkit.loci.limb_wrenches import wrench_screws
from screwkit.loci.local_conjunctions import up_to_others
from screwkit.loci.member_wrenches import member_wrenches
from screwkit.loci.named_screws import LINE, NamedScrew
from screwkit.loci.pieces import Piece
from screwkit.loci.placed_points import power
from screwkit.loci.said_together import Conjunction, stated, where_else

SOURCE = np.random.default_rng(8)


class Space:
    """The planar 3-RPR's position, from where no leg is lost, and its angle."""

    def __init__(self) -> None:
        assembly = Assembly(sk.load("3rpr_planar").mechanism)
        self.ring: TrigonometricRing = assembly.common_twists.ring
        self.root: Branch = assembly.root(self.ring)
        self.library: FactorLibrary = assembly.library(self.ring)
        self.x, self.y = (self.ring.symbol(n) - 1 for n in "xy")
        ((self.sine, self.cosine),) = (
            (self.ring.generator(f"s{i}"), self.ring.generator(f"c{i}"))
            for i in range(len(self.ring.basis))
        )

    def where(self, *equations: Polynomial) -> Piece:
        zeros = common_zeros(self.root, equations, Search(self.library))
        return Piece(equations, zeros.branches)


@pytest.fixture(scope="module")
def space() -> Space:
    return Space()


def test_what_a_divisor_hides_is_seen(space: Space) -> None:
    """Of x sin φ = y cos φ and y = 0: x = y = 0, but y = sin φ = 0 too."""
    s = space
    origin, hidden = s.where(s.x, s.y), s.where(s.y, s.sine)
    said = [("along", [s.x * s.sine - s.y * s.cosine]), ("low", [s.y])]
    assert conjunction(origin, said, s.root, s.library) is None
    assert stated(said, origin, s.root, s.library) is None
    found = conjunction(origin, said, s.root, s.library, [origin, hidden])
    assert found == Conjunction(("along", "low"), (1,))


def test_statements_name_the_components_inside_which_they_hold(space: Space) -> None:
    s = space
    origin, line = s.where(s.x, s.y), s.where(s.y - 1)
    said = [("left", [s.x]), ("two", [s.y * (s.y - 1)])]
    assert stated(said, origin, s.root, s.library) is None
    found = stated(said, origin, s.root, s.library, [line, origin])
    assert found == Conjunction(("left", "two"), (), (0,))
    assert where_else(found, 2, 3) == " (elsewhere only inside component 4)"
    # One more statement cuts off what lies inside no component.
    more = [("low", [s.y * (s.y + 2)])]
    found = stated(said, origin, s.root, s.library, more=more)
    assert found == Conjunction(("left", "two", "low"))


def test_what_is_singular_lies_inside_a_complete_list(space: Space) -> None:
    """Whichever component that is; of what is regular nothing is taken for granted."""
    s = space
    origin = s.where(s.x, s.y)
    said = [("left", [s.x]), ("two", [s.y * (s.y - 1)])]
    given = origin, s.root, s.library, (), ()
    found = stated(said, *given, lambda branch: True)
    assert found == Conjunction(("left", "two"), further=True)
    assert stated(said, *given, lambda branch: False) is None
    # What would cut off the singular part as well is not asked to.
    three = [("left", [s.x]), ("three", [s.y * (s.y - 1) * (s.y - 2)])]
    more = [("low", [s.y * (s.y - 1)])]

    def on_one(branch: Branch) -> bool:
        return not any(residue(s.y - 1, *at) for at in branch.points)

    found = stated(three, origin, s.root, s.library, (), more, on_one)
    assert found == Conjunction(("left", "three", "low"), further=True)


def test_statements_are_chosen_by_their_tangents(space: Space) -> None:
    s = space
    origin = s.where(s.x, s.y)
    first, weak = ("first", [s.x]), ("weak", [s.x * (s.y + 1)])
    both, squared = ("both", [s.x + s.y, s.y]), ("squared", [s.y * s.y])
    choose = partial(up_to_others, origin, root=s.root, library=s.library)
    assert choose([first, weak, both]) == Conjunction(("both",))
    assert choose([first, ("low", [s.y])]) == Conjunction(("first", "low"))
    # A double condition is no second tangent.
    assert choose([first, weak, squared]) is None


def test_other_components_are_told_in_brackets() -> None:
    both = Conjunction(("one",), (1, 2), (4,))
    told = " (here and on components 2 and 3, elsewhere only inside component 5)"
    assert where_else(both, 6, 0) == told
    assert where_else(Conjunction(("one",), (1,)), 2, "the limb") == (
        " (here and on the other component of the limb)"
    )
    assert where_else(Conjunction(("one",)), 2, 0) == ""
    many = " (elsewhere only inside other components)"
    assert where_else(Conjunction(("one",), (), (1, 2, 3, 4)), 9, 0) == many
    assert where_else(Conjunction(("one",), (), (), further=True), 9, 0) == many
    assert where_else(Conjunction(("one",), (1,)), 3, "the scheme") == (
        " (here and on 1 other component of the scheme)"
    )


def _line(point: Array, along: Array) -> Array:
    return np.concatenate([along, np.cross(point, along)])


def test_forces_up_to_couples_normal_to_an_axis() -> None:
    """Three lines of which a sum is such a couple, and their four coordinates."""
    axis = np.array([2.0, -1.0, 3.0])
    for _ in range(20):
        one, other = (_line(*SOURCE.normal(size=(2, 3))) for _ in range(2))
        both = one + 2 * other
        force = both[:3]
        across = np.cross(axis, SOURCE.normal(size=3))
        if abs(across @ force) < 0.1:
            continue
        # The couple that leaves a force without pitch.
        couple = -across * (both[3:] @ force) / (across @ force)
        third = both + np.concatenate([np.zeros(3), couple])
        assert abs(third[:3] @ third[3:]) < 1e-9
        rows = [[*w[:3], w[3:] @ axis] for w in (one, other, third)]
        assert np.linalg.svd(np.array(rows), compute_uv=False)[2] < 1e-9
    named = [NamedScrew((), LINE, n, 0) for n in ("A B", "C D", "E F")]
    assert dependent_along("R", named[:2], 1) == (
        "lines A B and C D are parallel, in one plane parallel to axis R"
    )
    assert dependent_along("R", named, 2) == (
        "some forces along lines A B, C D and E F add up to no more than a couple "
        "normal to axis R"
    )
    assert dependent_along("R", named, 1) is None


def test_members_with_two_joints_transmit_one_wrench() -> None:
    graph = WholeGraph(sk.load("stephenson_six_bar").mechanism)
    members = member_wrenches(graph.mechanism, graph.framed)
    pairs = {"A and B", "C and D", "E and F", "F and G"}
    assert {m.name for m in members} == {f"through axes {p}" for p in pairs}
    point, prime = graph.root.points[0]
    for member in members:
        for joint in member.name.removeprefix("through axes ").split(" and "):
            twist = [residue(v, point, prime) for v in graph.framed.column(joint)]
            assert power(member.at(point, prime), twist) % prime == 0
    # With B held the crank and the coupler are one body of three joints.
    held = member_wrenches(graph.mechanism, graph.framed, ["B"])
    assert {m.name for m in held} == {
        f"through axes {p}" for p in ("C and D", "E and F", "F and G")
    }


def test_an_instant_centre_is_where_lines_meet() -> None:
    """The link l5 points at the centre about which the coupler turns."""
    assembly = Assembly(sk.load("stephenson_six_bar").mechanism)
    (component,) = hybrid_limb(assembly, assembly.limbs[0]).components
    assert component.geometry == (
        "the lines through axes A and B, through axes C and D, and through axes E and "
        "F, meet in one point or are parallel"
    )
    (equation,) = component.equations
    for _ in range(10):
        b, c, e, (d, t) = SOURCE.uniform(1, 5, (4, 2))
        # a B = D + b (C - D): the centre on both lines.
        a, _ = np.linalg.solve(np.array([b, [d, 0] - c]).T, [d, 0])
        f = e + t * (a * b - e)
        names = dict(
            zip(("xb", "yb", "xc", "yc", "xe", "ye"), [*b, *c, *e], strict=True)
        )
        on = value(equation, {"d": d, "xf": f[0], "yf": f[1], **names})
        off = value(equation, {"d": d, "xf": f[0] + 1, "yf": f[1], **names})
        assert abs(on) < 1e-6 * max(1.0, abs(off))


def test_lines_of_stretched_limbs_are_such_as_are_never_lost() -> None:
    """Isoglide4: first links have a length, second links may be folded to none."""
    assembly = Assembly(sk.load("isoglide4_t3r1").mechanism)
    framed = assembly.common_twists
    root, ring = assembly.root(framed.ring), framed.ring
    library = assembly.library(ring)
    # Axes R12, R13 and R14 in one plane: normal to it in the base frame is y, z only.
    one, two, three = (framed.points[framed.joints.index(f"R1{i}")] for i in "234")
    (u, v), (p, q) = [
        [b[i] - a[i] for i in (1, 2)] for a, b in ((one, two), (one, three))
    ]
    stretched = primitive(ring.without_divisors([ring.normal(u * q - v * p)])[0])
    zeros = common_zeros(root, [stretched], Search(library))
    on = [at for branch in zeros.branches for at in branch.points]
    assert on
    lines = {w.name for w in wrench_screws(assembly, (), on, firm=True) if w.limb == 0}
    assert "A1 E1" in lines
    assert "A1 E1" not in {w.name for w in wrench_screws(assembly) if w.limb == 0}


def test_forces_normal_to_two_directions_have_a_name() -> None:
    """Tricept's passive leg resists forces through O across its slide, and a couple."""
    answer = sk.singularities(sk.load("tricept")).actuation
    assert answer is not None
    (component,) = answer.components
    assert "through O normal to axes U11:1 and P42 are" in (component.geometry or "")
    (equation,) = component.equations
    found = 0
    for alpha, beta in SOURCE.uniform(-1, 1, (12, 2)):
        names = {"alpha": alpha, "beta": beta, "a": 4.0, "b": 1.0}

        def at(h: float, names: dict[str, float] = names) -> float:
            return value(equation, {"h": h, **names})

        heights = np.linspace(-6, 6, 60)
        for low, high in pairwise(heights):
            if at(low) * at(high) < 0:
                h = _root(at, low, high)
                on, off = (_tricept(h + d, alpha, beta) for d in (0.0, 0.5))
                assert abs(on) < 1e-7 * max(1.0, abs(off))
                found += 1
    assert found > 5


def _root(at: Callable[[float], float], low: float, high: float) -> float:
    for _ in range(80):
        middle = (low + high) / 2
        if at(low) * at(middle) <= 0:
            high = middle
        else:
            low = middle
    return low


def _tricept(h: float, alpha: float, beta: float) -> float:
    """The determinant of the wrenches that hold the platform, by hand."""
    ca, sa, cb, sb = np.cos(alpha), np.sin(alpha), np.cos(beta), np.sin(beta)
    about_x = np.array([[1, 0, 0], [0, ca, -sa], [0, sa, ca]])
    turned = about_x @ np.array([[cb, 0, sb], [0, 1, 0], [-sb, 0, cb]])
    rows = []
    for angle in (0, 2 * np.pi / 3, -2 * np.pi / 3):
        corner = np.array([np.cos(angle), np.sin(angle), 0])
        start, end = 4 * corner, turned @ (corner - [0, 0, h])
        rows.append(_line(start, end - start))
    # Through O across the slide, and the couple across both axes of the joint there.
    rows += [np.array([*turned[:, i], 0, 0, 0]) for i in (0, 1)]
    rows.append(np.array([0, 0, 0, *np.cross([1, 0, 0], turned[:, 1])]))
    return float(np.linalg.det(np.array(rows)))
