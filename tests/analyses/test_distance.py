"""Distances to singularities, against triangles, planes and dense grids."""

from __future__ import annotations

from collections.abc import Iterator
from math import acos, atan, atan2, cos, hypot, pi, sin, sqrt

import numpy as np
import pytest

import screwkit as sk
from screwkit.algebra.batch import BatchRing
from screwkit.algebra.closed_values import closed_value
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.parse import parse
from screwkit.case import load_text
from screwkit.errors import ExpressionError, UndecidedError, UnknownNameError
from screwkit.reports.article import article
from screwkit.reports.blocks import Paragraph, Text
from screwkit.reports.conditions import numbered
from screwkit.reports.records import from_json, to_json
from screwkit.results.distance import Distance, NearestPosture, SingularityDistance

Point = tuple[float, float]


def plain(text: Text) -> str:
    """The words of a text."""
    return "".join(str(getattr(part, "text", part)) for part in text)


def of(answer: Distance, kind: str, *equations: str) -> SingularityDistance:
    """The one component with these equations; without any, the one kind by ranks."""
    (found,) = [
        one
        for one in answer.singularities
        if one.kind == kind
        and (one.component.equations if one.component else ()) == equations
    ]
    return found


def nearest(one: SingularityDistance) -> NearestPosture:
    assert one.nearest is not None, one.reason
    return one.nearest


def posture(answer: Distance, one: SingularityDistance) -> dict[str, float]:
    names = answer.freedoms if one.by_freedoms else answer.variables
    return dict(zip(names, nearest(one).values, strict=True))


def test_planes_in_free_angles_are_exact() -> None:
    """Each condition is a family of parallel planes: by hand, mod π."""
    at = {"q4": "3/10", "q9": 3, "q6": "1/2", "q8": 0.2}
    answer = sk.distance(sk.load("nao_t14", at=at))
    by_hand = {
        ("limb", "sin(q4)"): 0.3,
        ("limb", "sin(q9)"): pi - 3,
        ("limb", "r3*cos(q2) + d3*sin(q2)"): atan(0.105 / 0.015),
        ("actuation", "sin(q6 - q1)"): 0.5 / sqrt(2),
    }
    for (kind, equation), expected in by_hand.items():
        found = nearest(of(answer, kind, equation))
        assert found.distance == pytest.approx(expected, abs=1e-14)
        exact = closed_value(parse(found.exact, ()))
        assert exact == pytest.approx(expected, abs=1e-14)
        assert found.connected
    assert nearest(of(answer, "limb", "sin(q9)")).exact == "pi - 3"
    # Perpendicular planes: the foot is common to all of them.
    equations = "r3*cos(q2) + d3*sin(q2)", "sin(q9)", "cos(q8)"
    corner = of(answer, "constraint", *equations)
    squares = atan(7) ** 2 + (pi - 3) ** 2 + (pi / 2 - 0.2) ** 2
    assert nearest(corner).distance == pytest.approx(sqrt(squares), abs=1e-14)
    there = posture(answer, corner)
    assert there["q9"] == pytest.approx(pi)
    assert there["q8"] == pytest.approx(pi / 2)
    assert there["q4"] == pytest.approx(0.3)
    # Two angles share the change evenly.
    there = posture(answer, of(answer, "actuation", "sin(q6 - q1)"))
    assert (there["q1"], there["q6"]) == pytest.approx((0.25, 0.25))


def test_no_posture_of_a_dense_sample_is_nearer_than_a_searched_one() -> None:
    """The equation changes its sign nowhere within the distance."""
    case = sk.load("nao_t14", at={"q9": pi / 2})
    answer = sk.distance(case)
    (entry,) = [
        one
        for one in answer.singularities
        if one.kind == "actuation" and one.component and not one.component.solved[0]
    ]
    assert entry.component is not None
    assert entry.starts > 0
    assert nearest(entry).exact == ""
    values = {
        p.name: closed_value(p.value or parse("0", ()))
        for p in case.mechanism.parameters
    }
    (text,) = entry.component.equations
    expression = parse(text, [*values, *answer.variables])
    within = np.linspace(0, 0.99 * nearest(entry).distance, 50)
    ways = np.random.default_rng(5).normal(size=(3000, len(answer.variables)))
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    points = np.array(answer.posture) + ways[:, None] * within[:, None]
    known = {name: points[..., i] for i, name in enumerate(answer.variables)}
    lengths = {name: value or 0.0 for name, value in values.items()}
    signs = np.sign(evaluate(expression, BatchRing({**lengths, **known})))
    assert (signs == signs[0, 0]).all()


def on_circles(a: Point, b: Point, from_a: float, from_b: float) -> Iterator[Point]:
    """Where two circles meet, by the law of cosines."""
    apart = hypot(b[0] - a[0], b[1] - a[1])
    ratio = (from_a**2 + apart**2 - from_b**2) / (2 * from_a * apart)
    if abs(ratio) > 1:
        return
    towards = atan2(b[1] - a[1], b[0] - a[0])
    for sign in (1, -1):
        angle = towards + sign * acos(ratio)
        yield a[0] + from_a * cos(angle), a[1] + from_a * sin(angle)


FOUR_BAR = ((0.0, 0.0), (1.0, 2.0), (5.0, 3.0), (6.0, 0.0))
CRANK, COUPLER, ROCKER = sqrt(5), sqrt(17), sqrt(10)


def dead_points() -> Iterator[tuple[Point, Point]]:
    """B and C where coupler and rocker are in line: B lies on a circle about D."""
    a, _, _, d = FOUR_BAR
    for reach in (ROCKER + COUPLER, ROCKER - COUPLER):
        for b in on_circles(a, d, CRANK, abs(reach)):
            part = ROCKER / reach
            yield b, (d[0] + part * (b[0] - d[0]), d[1] + part * (b[1] - d[1]))


def test_dead_points_of_a_four_bar() -> None:
    (_, b, c, _) = FOUR_BAR
    answer = sk.distance(sk.load("four_bar_planar"), length="2")
    ways = [
        sqrt(sum((x - y) ** 2 for x, y in zip((*b, *c), (*p, *q), strict=True))) / 2
        for p, q in dead_points()
    ]
    equation = "d*yb - d*yc + xb*yc - xc*yb"
    found = nearest(of(answer, "actuation", equation))
    assert found.distance == pytest.approx(min(ways), abs=1e-9)
    assert found.connected
    assert found.platform_freedom == 1
    # The fixed length of the crank keeps A and B apart.
    assert of(answer, "limb", "yb", "xb").nearest is None
    assert answer.measure is not None
    assert (answer.measure.length, answer.measure.given) == (2.0, True)
    assert answer.measure.lengths == ("xb", "yb", "xc", "yc")


def turned(first: Point, second: Point, now: tuple[Point, Point]) -> float:
    """By which angle the way between two points has turned, within half a turn."""
    before = atan2(second[1] - first[1], second[0] - first[0])
    after = atan2(now[1][1] - now[0][1], now[1][0] - now[0][0])
    return (after - before + pi) % (2 * pi) - pi


def by_joints(bar: tuple[Point, ...], p: Point, q: Point) -> float:
    """From a posture of the four-bar to that with B at p and C at q."""
    a, b, c, d = bar
    crank, coupler = turned(a, b, (a, p)), turned(b, c, (p, q))
    rocker = turned(d, c, (d, q))
    return hypot(crank, coupler - crank, rocker - coupler, rocker)


@pytest.mark.parametrize("geometry", ["posture", "reference"])
def test_joints_count_where_no_symbol_moves_the_mechanism(geometry: str) -> None:
    """The same four-bar in numbers: the changes of its four angles are squared."""
    text = f"""
screwkit: 1
name: bar
geometry: {geometry}
base: base
platform: link
links: [base, crank, link, rocker]
vectors: {{k: [0, 0, 1]}}
joints:
  - {{name: A, type: revolute, parent: base, child: crank, point: [0, 0, 0], axis: k}}
  - {{name: B, type: revolute, parent: crank, child: link, point: [1, 2, 0], axis: k}}
  - {{name: C, type: revolute, parent: link, child: rocker, point: [5, 3, 0], axis: k}}
  - {{name: D, type: revolute, parent: rocker, child: base, point: [6, 0, 0], axis: k}}
actuated: [A]
"""
    answer = sk.distance(load_text(text))
    ways = [by_joints(FOUR_BAR, p, q) for p, q in dead_points()]
    entry = of(answer, "actuation")
    assert nearest(entry).distance == pytest.approx(min(ways), abs=1e-9)
    assert nearest(entry).connected
    assert entry.by_freedoms
    assert answer.freedoms == ("A", "B", "C", "D")
    assert answer.variables == ()
    assert of(answer, "constraint").nearest is None


def test_the_posture_is_moved_to_before_anything_is_measured() -> None:
    """The crank turned by 1/2: B by its angle, C by the law of cosines."""
    answer = sk.distance(sk.load("four_bar_planar", at={"qA": "1/2"}))
    a, b, c, d = FOUR_BAR
    angle = atan2(b[1], b[0]) + 0.5
    b = CRANK * cos(angle), CRANK * sin(angle)
    c = min(
        on_circles(b, d, COUPLER, ROCKER),
        key=lambda p: hypot(p[0] - c[0], p[1] - c[1]),
    )
    entry = of(answer, "actuation")
    expected = min(by_joints((a, b, c, d), p, q) for p, q in dead_points())
    assert nearest(entry).distance == pytest.approx(expected, abs=1e-9)
    with pytest.raises(UndecidedError, match=r"not reached: .*turns back at qA ="):
        sk.distance(sk.load("four_bar_planar", at={"qA": 2.5}))


TABLE = """
screwkit: 1
name: bar
geometry: mdh
base: base
platform: link
links: [base, crank, link, rocker, tip]
joints:
  - {name: A, type: revolute, parent: base, child: crank, mdh: {}}
  - {name: B, type: revolute, parent: crank, child: link, mdh: {d: sqrt(5)}}
  - {name: C, type: revolute, parent: link, child: rocker, mdh: {d: sqrt(17)}}
  - {name: F, type: fixed, parent: rocker, child: tip, mdh: {d: sqrt(10)}}
  - {name: D, type: revolute, parent: base, child: tip, mdh: {d: 6}}
actuated: [A]
"""


def test_a_table_that_ties_its_joints() -> None:
    """The posture that was found is said, and the distance is from there."""
    answer = sk.distance(load_text(TABLE))
    (said,) = [x for x in answer.remarks if x.startswith("distances begin at ")]
    pairs = said.removeprefix("distances begin at ").split(", ")
    at = {name: float(value) for name, value in (p.split(" = ") for p in pairs)}
    one, two = at["qA"], at["qA"] + at["qB"]
    b = CRANK * cos(one), CRANK * sin(one)
    c = b[0] + COUPLER * cos(two), b[1] + COUPLER * sin(two)
    bar = FOUR_BAR[0], b, c, FOUR_BAR[3]
    assert hypot(c[0] - 6, c[1]) == pytest.approx(ROCKER, abs=1e-4)
    expected = min(by_joints(bar, p, q) for p, q in dead_points())
    entry = of(answer, "actuation")
    assert nearest(entry).distance == pytest.approx(expected, abs=1e-4)


def test_a_five_bar_against_all_cranks() -> None:
    """B, C and D are in line where BD is the sum or the difference of the two links."""
    answer = sk.distance(sk.load("five_bar"), length="1")
    b, c, d, e = (-1.0, 2.0), (2.0, 4.0), (5.0, 2.0), (4.0, 0.0)
    crank, follower = hypot(*b), hypot(d[0] - e[0], d[1] - e[1])
    one, two = hypot(3, 2), hypot(3, 2)
    least = 1e9
    for angle in np.linspace(-pi, pi, 20001):
        p = crank * cos(angle), crank * sin(angle)
        for q in on_circles(e, p, follower, one + two):
            part = one / (one + two)
            r = p[0] + part * (q[0] - p[0]), p[1] + part * (q[1] - p[1])
            changes = zip((*b, *c, *d), (*p, *r, *q), strict=True)
            least = min(least, sqrt(sum((x - y) ** 2 for x, y in changes)))
    (entry,) = [one for one in answer.singularities if one.kind == "actuation"]
    found = nearest(entry).distance
    assert found <= least + 1e-12
    assert found == pytest.approx(least, abs=1e-5)


def test_a_planar_platform_against_a_dense_grid() -> None:
    """The lines of the three legs meet: their determinant is a polynomial in y."""
    answer = sk.distance(sk.load("3rpr_planar"), length="2")
    base = np.array([[0, 0], [6, 0], [2, 5]])
    corners = np.array([[0, 0], [2, 0], [1, 1]])

    def determinant(x: float, y: float, phi: float) -> float:
        turn = np.array([[cos(phi), -sin(phi)], [sin(phi), cos(phi)]])
        points = np.array([x, y]) + corners @ turn.T
        ways = points - base
        moments = base[:, 0] * ways[:, 1] - base[:, 1] * ways[:, 0]
        return float(np.linalg.det(np.column_stack([ways, moments])))

    start = 2.0, 2.0, atan(3 / 4)
    least = 1e9
    samples = np.linspace(-3, 3, 4)
    for phi in np.linspace(start[2] - 0.7, start[2] + 0.7, 141):
        for x in np.linspace(0.5, 3.5, 151):
            values = [determinant(x, y, phi) for y in samples]
            for root in np.roots(np.polyfit(samples, values, 3)):
                if abs(root.imag) < 1e-9:
                    shift = hypot(x - start[0], root.real - start[1]) / 2
                    least = min(least, hypot(shift, phi - start[2]))
    (entry,) = [one for one in answer.singularities if one.kind == "actuation"]
    found = nearest(entry)
    assert found.distance <= least + 1e-12
    assert found.distance == pytest.approx(least, abs=2e-3)
    assert found.connected
    x, y, phi = found.values
    assert determinant(x, y, phi) == pytest.approx(0, abs=1e-8)


def test_a_turn_about_one_axis_is_an_angle() -> None:
    """With equal triangles the legs are parallel at φ = 0 and meet at φ = π.

    B_i − A_i = t + (R − 1) a_i: at φ = 0 all are t, at φ = π all lines pass t/2.
    """
    equal = {"a2": "6", "a3x": "2", "a3y": "5", "b2": "6", "b3x": "2", "b3y": "5"}
    for phi, expected in (("3/10", "3/10"), ("-3", "pi - 3")):
        case = sk.load("3rpr_planar", set_values=equal, at={"phi": phi, "x": "1"})
        answer = sk.distance(case)
        found = nearest(of(answer, "actuation", "sin(phi)"))
        assert closed_value(parse(found.exact, ())) == pytest.approx(
            closed_value(parse(expected, ())), abs=1e-14
        )
        x, y, there = found.values
        assert (x, y) == (1, 2)
        assert sin(there) == pytest.approx(0, abs=1e-14)


def test_what_lies_beside_the_symbols_is_found_by_ranks() -> None:
    """With phi a number the file describes two of three freedoms; all are there."""
    whole = sk.distance(sk.load("3rpr_planar"), length="2")
    held = sk.load("3rpr_planar", set_values={"phi": "atan(3/4)"})
    answer = sk.distance(held, length="2")
    assert answer.variables == ("x", "y")
    assert any("2 of the 3 dimensions" in remark for remark in answer.remarks)
    (inside,) = [o for o in answer.singularities if o.component is not None]
    (everywhere,) = [o for o in whole.singularities if o.component is not None]
    beside = of(answer, "actuation")
    assert beside.by_freedoms
    expected = nearest(everywhere).distance
    assert nearest(beside).distance == pytest.approx(expected, abs=1e-6)
    assert nearest(inside).distance > expected + 1e-3


def test_a_singular_posture_is_at_distance_0() -> None:
    answer = sk.distance(sk.load("five_bar", variant="distal_collinear"))
    (entry,) = [one for one in answer.singularities if one.kind == "actuation"]
    assert nearest(entry).distance == 0
    assert nearest(entry).platform_freedom == 1
    assert "the posture itself is singular" in " ".join(str(answer).split())
    straight = sk.distance(sk.load("dual_planar_arm"))
    assert nearest(of(straight, "limb", "sin(qA2)")).exact == "0"


def test_symbols_that_change_the_mechanism_keep_their_values() -> None:
    """Turning the triangles of the base is a design, not a motion."""
    answer = sk.distance(sk.load("dual_6r"))
    assert answer.variables == ()
    said = "the symbols x, z would change the mechanism, and keep their values"
    assert said in answer.remarks


def test_postures_out_of_reach_are_passed_over() -> None:
    """Elbows by square roots: beyond the reach of the arms there is no posture."""
    answer = sk.distance(sk.load("dual_planar_3r"))
    assert "limb" in {one.kind for one in answer.singularities}
    for one in answer.singularities:
        assert one.nearest is None or np.isfinite(one.nearest.values).all()


def test_numbers_are_those_of_singularities() -> None:
    case = sk.load("five_bar")
    numbering = numbered(sk.singularities(case))
    listed = {
        entry.component.equations: entry.number
        for part in (*numbering.limbs, numbering.constraint, numbering.actuation)
        for entry in part
    }
    answer = sk.distance(case)
    assert {
        one.component.equations: one.number
        for one in answer.singularities
        if one.component is not None
    } == listed


def test_an_answer_goes_through_json_and_reads_well() -> None:
    answer = sk.distance(sk.load("four_bar_planar"))
    assert from_json(to_json(answer)) == answer
    text = " ".join(str(answer).split())
    assert "nearest singularity: limb none found; constraint none found" in text
    assert "≈ 0.8244" in text
    assert "the characteristic length" in text
    assert "that nothing is nearer is not proved" in text


def test_a_report_has_them_in_a_table_with_units() -> None:
    """A tenth of a radian of the elbow: the distance of its own singularity."""
    case = sk.load("dual_planar_arm", at={"qA2": "1/10", "qB2": 1})
    analysis = sk.analyze(case, distances=True)
    assert isinstance(analysis.distance, Distance)
    assert from_json(to_json(analysis)) == analysis
    composed = article(analysis)
    (table,) = [
        table
        for table in composed.tables
        if "nearest singularities" in plain(table.caption)
    ]
    heads = [plain(column.head) for column in table.columns]
    assert heads[:3] == ["kind", "distance, rad", "singularity"]
    assert len(table.rows) == len(analysis.distance.singularities)
    assert any(plain(row[1]).endswith("0.1") for row in table.rows)
    said = " ".join(
        plain(block.text) for block in composed.blocks if isinstance(block, Paragraph)
    )
    assert "Nearest singularity: limb 0.1 rad" in said
    assert "distances" not in str(sk.analyze(case)).casefold()


def test_what_is_refused() -> None:
    with pytest.raises(UnknownNameError, match="no symbol 'xq'"):
        sk.distance(sk.load("five_bar", at={"xq": 1}))
    with pytest.raises(ExpressionError, match="is positive, and -1 is not"):
        sk.distance(sk.load("five_bar"), length="-1")
    text = """
screwkit: 1
name: arm
geometry: posture
base: base
platform: tool
links: [base, arm, tool]
variables: {x: {}}
vectors: {k: [0, 0, 1]}
joints:
  - {name: A, type: revolute, parent: base, child: arm, point: [0, 0, 0], axis: k}
  - {name: B, type: revolute, parent: arm, child: tool, point: [x, 1, 0], axis: k}
"""
    with pytest.raises(UndecidedError, match="x has no value: --set x="):
        sk.distance(load_text(text))
