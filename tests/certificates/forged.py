"""Small mechanisms and hand-made certificates that tell little lies about them."""

from __future__ import annotations

from screwkit.case import load_text
from screwkit.certificates.checking import check
from screwkit.certificates.records import (
    Case,
    Certificate,
    Locus,
    Node,
    Part,
    Reach,
    Source,
    Step,
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


def judged(text: str, part: Part, seed: int = 1) -> None:
    check(certificate(text, part), load_text(text).mechanism, seed)


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
IN_LINE = Locus(
    ("sin(q)",), 2, -1, (Reach((turned("0", "1"),)), Reach((turned("0", "-1"),)))
)
POSITIVE = Case(("c",), 1, end="positive")
