"""Tables whose rows place a body twice: closed at 0, closed elsewhere, never closed."""

from __future__ import annotations

import re
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from math import cos, hypot, pi, sin, sqrt, tan
from pathlib import Path
from textwrap import dedent

import numpy as np
import pytest

import screwkit as sk
from screwkit import cli
from screwkit.analyses.moved import closed_table
from screwkit.case import Case, load_text
from screwkit.errors import MechanismFileError, UndecidedError
from screwkit.finite.table_closure import OPEN, table_misses
from screwkit.finite.table_search import closed_posture
from screwkit.kinematics.loops import ring_at
from screwkit.kinematics.values import declared_values, with_values
from screwkit.questions import mobility, relative_motion
from screwkit.results.mobility import Mobility
from screwkit.results.partition import Partition

HEAD = """\
screwkit: 1
name: linkage
geometry: mdh
base: base
platform: rod
links: [base, crank, rod, rocker, tip]
"""


@dataclass(frozen=True)
class Table:
    """A loop of four joints; the last row and a fixed joint both place ``tip``."""

    rows: tuple[str, str, str, str, str]
    last: str = "revolute"
    symbols: str = ""

    @property
    def text(self) -> str:
        a, b, c, end, d = self.rows
        return (
            HEAD
            + (f"parameters: {{{self.symbols}}}\n" if self.symbols else "")
            + "joints:\n"
            f"  - {{name: A, type: revolute, parent: base, child: crank, {a}}}\n"
            f"  - {{name: B, type: revolute, parent: crank, child: rod, {b}}}\n"
            f"  - {{name: C, type: revolute, parent: rod, child: rocker, {c}}}\n"
            f"  - {{name: E, type: fixed, parent: rocker, child: tip, {end}}}\n"
            f"  - {{name: D, type: {self.last}, parent: base, child: tip, {d}}}\n"
            "actuated: [A]\n"
        )

    def load(self, folder: Path) -> Case:
        path = folder / "linkage.yaml"
        path.write_text(self.text, encoding="utf-8")
        return sk.load(path)


def four_bar(
    crank: object, rod: object, rocker: object, frame: object, symbols: str = ""
) -> Table:
    rows = ("mdh: {}", *(f"mdh: {{d: {x}}}" for x in (crank, rod, rocker, frame)))
    return Table((rows[0], rows[1], rows[2], rows[3], rows[4]), symbols=symbols)


def bennett(first: str, second: str, lengths: tuple[int, int]) -> Table:
    """Links of twist ``first`` and ``second`` in turn; the lengths are as their sines.

    The last link of the loop is passed from its other end.
    """
    one = f"mdh: {{d: {lengths[0]}, alpha: {first}}}"
    other = f"mdh: {{d: {lengths[1]}, alpha: {second}}}"
    back = f"mdh: {{d: -{lengths[1]}, alpha: -{second}}}"
    return Table(("mdh: {}", one, other, one, back))


def slider_crank(start: int = 0) -> Table:
    """A crank of 1, a rod of 3 and a slider along x that ``start`` places at 0."""
    across = "gamma: pi/2, alpha: pi/2"
    slider = f"mdh: {{{across}, r: {start}}}"
    return Table(
        ("mdh: {}", "mdh: {d: 1}", "mdh: {d: 3}", f"mdh: {{{across}}}", slider),
        last="prismatic",
    )


SQUARE = Table(  # its sides turn the corners by offsets
    (
        "mdh: {}, offset: pi/2",
        "mdh: {d: 2}, offset: -pi/2",
        "mdh: {d: 2}, offset: -pi/2",
        "mdh: {d: 2}",
        "mdh: {d: 2}, offset: -pi/2",
    )
)
AT_ZERO = {
    "square": (SQUARE, (3, 1)),
    "in line": (four_bar(1, 3, 2, 6), (2, 2)),  # dead: coupler, crank and rocker
    "slider-crank": (slider_crank(4), (3, 1)),
}
ELSEWHERE = {
    "four-bar": four_bar(1, 3, 2, 3),
    "four-bar by a symbol": four_bar(1, 3, 2, "g", "g: {value: 3}"),
    "slider-crank": slider_crank(),
    "bennett": bennett("pi/6", "pi/2", (1, 2)),
}
NEVER = {
    "too long a frame": four_bar(1, 3, 2, 7),
    "too long by a symbol": four_bar(1, 3, 2, "g", "g: {value: 13/2}"),
    "another plane": Table((*four_bar(1, 3, 2, 3).rows[:4], "mdh: {b: 1, d: 3}")),
}


def closed_values(case: Case) -> dict[str, float]:
    """By joint."""
    mechanism = with_values(case.mechanism, declared_values(case.mechanism))
    found = closed_posture(mechanism)
    assert found.closed
    misses = table_misses(mechanism, ring_at(mechanism, found.values))
    assert misses
    assert max(float(np.abs(miss).max()) for miss in misses.values()) <= OPEN
    return {name.removeprefix("q"): value for name, value in found.values.items()}


# -- closed at 0 -----------------------------------------------------------------------


@pytest.mark.parametrize("name", AT_ZERO)
def test_a_table_closed_at_0_is_taken_there(name: str, tmp_path: Path) -> None:
    table, (rank, freedoms) = AT_ZERO[name]
    case = table.load(tmp_path)
    assert not any(closed_values(case).values())
    assert closed_table(case.network) is None
    assert {(m.rank, m.mobility) for m in case.network.motions} == {(rank, freedoms)}


def test_a_parallelogram_moves_its_coupler_without_turning_it(tmp_path: Path) -> None:
    found = relative_motion(SQUARE.load(tmp_path))
    assert [twist.kind for twist in found.twists] == ["translation"]


# -- closed elsewhere ------------------------------------------------------------------


@pytest.mark.parametrize("name", ELSEWHERE)
def test_a_closed_posture_is_found(name: str, tmp_path: Path) -> None:
    case = ELSEWHERE[name].load(tmp_path)
    assert any(closed_values(case).values())
    assert closed_table(case.network) is not None


def test_the_four_bar_closes_as_its_links_do(tmp_path: Path) -> None:
    """The end of the rod is at the rocker's length from the fixed pivot (3, 0)."""
    q = closed_values(ELSEWHERE["four-bar"].load(tmp_path))
    rod = q["A"] + q["B"]
    x, y = cos(q["A"]) + 3 * cos(rod), sin(q["A"]) + 3 * sin(rod)
    assert hypot(3 - x, y) == pytest.approx(2, abs=1e-8)


def test_the_slider_is_where_rod_and_crank_reach(tmp_path: Path) -> None:
    q = closed_values(ELSEWHERE["slider-crank"].load(tmp_path))
    reach = cos(q["A"]) + sqrt(9 - sin(q["A"]) ** 2) * (1 if q["D"] > 0 else -1)
    assert q["D"] == pytest.approx(reach, abs=1e-8)


def test_bennett_angles_have_a_constant_product_of_tangents(tmp_path: Path) -> None:
    """tan(θ/2)·tan(φ/2) = sin((β + α)/2) / sin((β − α)/2) [Bennett1903]."""
    q = closed_values(ELSEWHERE["bennett"].load(tmp_path))
    product = tan(q["A"] / 2) * tan(q["B"] / 2)
    alpha, beta = pi / 6, pi / 2
    expected = sin((beta + alpha) / 2) / sin((beta - alpha) / 2)
    assert abs(product) == pytest.approx(expected, abs=1e-7)
    assert cos(q["A"]) == pytest.approx(cos(q["C"]), abs=1e-8)
    assert cos(q["B"]) == pytest.approx(cos(q["D"]), abs=1e-8)


def planar_posture(table: Table, folder: Path) -> str:
    """The same loop with its axes written down where the table closes."""
    q = closed_values(table.load(folder))
    rod = q["A"] + q["B"]
    x, y = cos(q["A"]), sin(q["A"])
    b = f"[{x:.9f}, {y:.9f}, 0]"
    c = f"[{x + 3 * cos(rod):.9f}, {y + 3 * sin(rod):.9f}, 0]"
    last = "type: revolute, axis: [0, 0, 1], point: [3, 0, 0]"
    if table.last == "prismatic":
        last = "type: prismatic, axis: [1, 0, 0]"
    hinge = "type: revolute, axis: [0, 0, 1]"
    return dedent(
        f"""\
        screwkit: 1
        name: linkage
        geometry: posture
        base: base
        platform: rod
        links: [base, crank, rod, rocker]
        joints:
          - {{name: A, parent: base, child: crank, {hinge}, point: [0, 0, 0]}}
          - {{name: B, parent: crank, child: rod, {hinge}, point: {b}}}
          - {{name: C, parent: rod, child: rocker, {hinge}, point: {c}}}
          - {{name: D, parent: base, child: rocker, {last}}}
        actuated: [A]
        """
    )


def counted(parts: Partition) -> tuple[int | None, ...]:
    return (parts.mobility, parts.connectivity, parts.redundancy, parts.indeterminacy)


def told(answer: Mobility) -> dict[str, object]:
    """What two files of one mechanism agree on, however they describe it."""
    actuation = answer.actuation
    assert actuation is not None
    return {
        "loops": answer.topology.independent_loops,
        "freedoms": answer.topology.freedoms,
        "grubler": answer.counts.grubler,
        "moroskine": answer.counts.moroskine,
        "rank": answer.loop_rank,
        "redundant": answer.redundant_constraints,
        "mobility": answer.instantaneous_mobility,
        "finite": answer.full_cycle.mobility,
        "type": answer.platform.motion_type,
        "twists": answer.platform.twist_dimension,
        "wrenches": answer.platform.wrench_dimension,
        "couples": answer.platform.couples,
        "finite types": answer.platform.finite_motion_types,
        "locked": (actuation.remaining_mobility, actuation.remaining_platform_freedom),
        "partition": counted(answer.partition),
    }


@pytest.mark.parametrize("name", ["four-bar", "slider-crank"])
def test_planar_tables_answer_as_postures_do(name: str, tmp_path: Path) -> None:
    table = ELSEWHERE[name]
    path = tmp_path / "posture.yaml"
    path.write_text(planar_posture(table, tmp_path), encoding="utf-8")
    answer = mobility(table.load(tmp_path))
    assert told(answer) == told(mobility(sk.load(path)))
    assert "not closed at 0" in answer.unnamed
    assert not answer.generic


def test_the_bennett_table_answers_as_the_bundled_posture(tmp_path: Path) -> None:
    answer = mobility(ELSEWHERE["bennett"].load(tmp_path))
    assert told(answer) == told(mobility(sk.load("bennett")))


def test_a_loop_that_is_no_bennett_linkage_is_never_closed(tmp_path: Path) -> None:
    """Lengths that are not as the sines of the twists leave it rigid or open."""
    try:
        answer = mobility(bennett("pi/6", "pi/2", (1, 3)).load(tmp_path))
    except MechanismFileError:
        return
    assert answer.full_cycle.mobility in ((0,), ())


# -- never closed ----------------------------------------------------------------------


@pytest.mark.parametrize("name", NEVER)
def test_what_never_closes_is_refused_at_its_row(name: str, tmp_path: Path) -> None:
    with pytest.raises(MechanismFileError) as refused:
        NEVER[name].load(tmp_path)
    (fault,) = refused.value.faults
    assert "does not close" in fault.message
    lines = NEVER[name].text.splitlines()
    row = lines[fault.line - 1]
    # The place is the row whose joint the message names.
    assert row.startswith("  - {name: ")
    assert fault.column == row.index("{") + 1
    joint = row.partition("name: ")[2][0]
    assert f"joint {joint!r} places" in fault.message


@pytest.mark.parametrize("command", ["check", "mobility"])
def test_what_never_closes_is_exit_code_3(
    command: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "open.yaml"
    path.write_text(NEVER["too long a frame"].text, encoding="utf-8")
    with pytest.raises(SystemExit) as stop:
        cli.main([command, str(path), "--quiet"])
    assert stop.value.code == 3
    line = capfd.readouterr().err.splitlines()[0]
    place = rf"{re.escape(str(path))}:\d+:5  the posture does not close: joint "
    assert re.match(place, line)


def test_set_may_close_what_the_file_leaves_open(tmp_path: Path) -> None:
    path = tmp_path / "linkage.yaml"
    path.write_text(NEVER["too long by a symbol"].text, encoding="utf-8")
    answer = mobility(sk.load(path, set_values={"g": 3}))
    assert answer.instantaneous_mobility == 1


# -- what tables that close loops do not do yet ----------------------------------------


@contextmanager
def within(seconds: float) -> Iterator[None]:
    """Give up what takes longer."""

    def stop(*_: object) -> None:
        raise TimeoutError

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_a_table_closed_at_0_answers_as_a_posture_does(tmp_path: Path) -> None:
    with within(2.0):
        answer = mobility(SQUARE.load(tmp_path))
    assert answer.instantaneous_mobility == 1
    assert answer.platform.motion_type == "1T0R"
    assert answer.full_cycle.mobility == (1,)


def test_exact_questions_need_a_table_that_is_closed_at_0(tmp_path: Path) -> None:
    case = ELSEWHERE["four-bar"].load(tmp_path)
    for question in (relative_motion, sk.screws):
        with pytest.raises(UndecidedError, match="not closed at 0"):
            question(case)
    assert relative_motion(SQUARE.load(tmp_path)).twist_dimension == 1


def test_a_table_that_closes_elsewhere_is_moved(tmp_path: Path) -> None:
    ELSEWHERE["four-bar"].load(tmp_path)
    found = mobility(sk.load(tmp_path / "linkage.yaml", at={"qA": "1/10"})).at_posture
    assert found is not None


def test_a_row_that_places_the_base_closes_a_loop() -> None:
    """Bennett's loop, walked once around: the last row leads back to the base."""
    text = """
screwkit: 1
name: around
geometry: mdh
base: ground
platform: b
links: [ground, a, b, c, d]
joints:
  - {name: A, type: revolute, parent: ground, child: a, mdh: {}}
  - {name: B, type: revolute, parent: a, child: b, mdh: {d: 1, alpha: pi/6}}
  - {name: C, type: revolute, parent: b, child: c, mdh: {d: 2, alpha: pi/2}}
  - {name: D, type: revolute, parent: c, child: d, mdh: {d: 1, alpha: pi/6}}
  - {name: E, type: fixed, parent: d, child: ground, mdh: {d: 2, alpha: pi/2}}
"""
    case = load_text(text)
    assert "leads back to the base" in case.network.tied
    answer = mobility(case)
    assert answer.instantaneous_mobility == 1
    assert answer.redundant_constraints == 3


BACK_TO_BASE = """\
screwkit: 1
name: linkage
geometry: mdh
base: base
platform: rod
links: [base, crank, rod, rocker, tip]
joints:
  - {{name: A, type: revolute, parent: base, child: crank, mdh: {{}}}}
  - {{name: B, type: revolute, parent: crank, child: rod, mdh: {{{one}}}}}
  - {{name: C, type: revolute, parent: rod, child: rocker, mdh: {{{other}}}}}
  - {{name: D, type: revolute, parent: rocker, child: tip, mdh: {{{one}}}}}
  - {{name: E, type: fixed, parent: tip, child: base, mdh: {{{other}}}}}
"""


@pytest.mark.parametrize(
    ("one", "other", "rank", "moved"),
    [
        ("d: 4", "d: 3", 3, (1,)),
        ("d: 4, alpha: 2*atan(1/2)", "d: 3, alpha: 2*atan(1/3)", 3, (1,)),
    ],
    ids=["four-bar", "bennett"],
)
def test_a_row_that_leads_back_to_the_base_closes_the_loop(
    tmp_path: Path, one: str, other: str, rank: int, moved: tuple[int, ...]
) -> None:
    """Sides equal in pairs: a planar loop, and Bennett's, as the sines are 4/5, 3/5."""
    path = tmp_path / "linkage.yaml"
    path.write_text(BACK_TO_BASE.format(one=one, other=other), encoding="utf-8")
    case = sk.load(path)
    values = closed_values(case)
    if "alpha" in one:
        # tan(a/2) tan(b/2) is constant, of one sign and size or of its inverse.
        half = abs(tan(values["A"] / 2) * tan(values["B"] / 2))
        known = (1 / 2 + 1 / 3) / (1 / 2 - 1 / 3)
        assert min(half, 1 / half) == pytest.approx(1 / known)
    found = mobility(case)
    assert found.loop_rank == rank
    assert found.full_cycle.mobility == moved


def test_what_is_held_wherever_it_is_may_not_move_at_all(tmp_path: Path) -> None:
    """An open chain of two hinges whose end is held: nothing is left to move."""
    path = tmp_path / "held.yaml"
    path.write_text(
        "screwkit: 1\nname: held\ngeometry: mdh\nbase: base\nplatform: tool\n"
        "links: [base, arm, tool]\njoints:\n"
        "  - {name: A, type: revolute, parent: base, child: arm, mdh: {}}\n"
        "  - {name: B, type: revolute, parent: arm, child: tool, mdh: {d: 1}}\n"
        "  - {name: hold, type: fixed, parent: tool, child: base}\n",
        encoding="utf-8",
    )
    cycle = mobility(sk.load(path)).full_cycle
    assert cycle.mobility == (0,)
    assert "no joint rates keep it so" in cycle.reason
