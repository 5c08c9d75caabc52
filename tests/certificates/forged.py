"""Small mechanisms and hand-made certificates that tell little lies about them."""

from __future__ import annotations

from pathlib import Path

from screwkit.case import load, load_text
from screwkit.certificates.checking import check
from screwkit.certificates.equations_told import Step, Unsolved
from screwkit.certificates.findings import Findings
from screwkit.certificates.records import (
    Case,
    Certificate,
    Locus,
    Node,
    Part,
    Reach,
    Sheet,
    Source,
)
from screwkit.certificates.written import SCHEMA

HEAD = """
screwkit: 1
name: forged
space: planar
base: ground
platform: tip
links: [ground, arm, fore, tip]
geometry: posture
"""


def three_joints(symbols: str, second: str, third: str) -> str:
    """Three revolute joints in a row; rank 3 unless they are in line."""
    return f"""{HEAD}
{symbols}
joints:
  - {{name: "1", type: revolute, parent: ground, child: arm, point: [0, 0]}}
  - {{name: "2", type: revolute, parent: arm, child: fore, point: {second}}}
  - {{name: "3", type: revolute, parent: fore, child: tip, point: {third}}}
"""


def certificate(text: str, part: Part) -> Certificate:
    return Certificate(SCHEMA, "forged", "0", Source(text), (part,))


def judged(text: str, part: Part, seed: int = 1) -> Findings:
    (found,) = check(certificate(text, part), load_text(text).mechanism, seed)
    return found


def limb(*components: Locus, proof: Node | None = None) -> Part:
    return Part(
        "limb", "ground", ({"q": 1},), 3, components, limb="limb_1", proof=proof
    )


def minor(*cases: Case) -> Node:
    return Node(
        0, rank=3, rows=(2, 3, 4), columns=("1", "2", "3"), over={}, cases=cases
    )


def turned(sine: str, cosine: str) -> Step:
    return Step("angle", angle=0, sine=sine, cosine=cosine)


# det of the three twists: c·(a − b)·sin q.
TWO_LENGTHS = three_joints(
    "parameters: {a: 1, b: 2, c: {value: 1, positive: true}}\n"
    "variables: {q: {value: 0.3, angle: true}}",
    "[c, 0]",
    "[c + (a - b)*cos(q), (a - b)*sin(q)]",
)
# det: c·(5·sin q − 3), which vanishes at (3/5, 4/5) and (3/5, −4/5).
ONE_HEIGHT = three_joints(
    "parameters: {c: {value: 1, positive: true}}\n"
    "variables: {q: {value: 0.3, angle: true}}",
    "[c, 0]",
    "[cos(q), 5*sin(q) - 3]",
)
# Four helical joints of equal pitch at 0, (x1, y1), (x2, y2), (x3, y3): two loops'
# wrenches depend where all are in one plane, by three equations.
HELICAL = Path(str(load("4H_equal_pitch").path)).read_text(encoding="utf-8")
IN_PLANE = ("y1*x2 - y2*x1", "y1*x3 - y3*x1", "y2*x3 - y3*x2")


def zero(symbol: str, node: Node) -> Sheet:
    return Sheet(Step("symbol", symbol=symbol, value="0", over="1"), node)


def solved(number: int, condition: int, *cases: Sheet) -> Node:
    """A condition that is a product of symbols, each of which is 0."""
    return Node(
        number,
        condition=condition,
        over={},
        cases=tuple(Case((own.step.symbol,), 1, sheets=(own,)) for own in cases),
    )


def helical(*equations: str, cover: Node | None) -> Part:
    """Its constraint singularities, by some of the three equations."""
    one, two, _ = IN_PLANE
    reach = Reach((), (Unsolved(two, symbol="x3"), Unsolved(one, symbol="x2")))
    locus = Locus(equations, 2, 2, (reach,), cover)
    return Part("constraint", "L0", (), 3, (locus,))


def met_in_turn(*cases: Case) -> Node:
    """The first two equations, linear in x2 and x3, with what follows elsewhere."""
    one, two, _ = IN_PLANE
    roots = Unsolved(one, symbol="x2"), Unsolved(two, symbol="x3")
    return Node(0, sheet=True, roots=roots, cases=cases)


IN_LINE = Locus(
    ("sin(q)",), 2, -1, (Reach((turned("0", "1"),)), Reach((turned("0", "-1"),)))
)
POSITIVE = Case(("c",), 1, end="positive")
