"""Tripterons: three slides through one point, each with a planar arm along it."""

TRIPTERON = """
screwkit: 1
name: tripteron
base: base
platform: tool
links: [base, a1, b1, c1, a2, b2, c2, a3, b3, c3, tool]
geometry: posture
variables:
  x: 0.3
  y: 0.4
  z: 0.5
  s1: {value: 1, angle: true}
  s2: {value: 1, angle: true}
  s3: {value: 1, angle: true}
points:
  X: [x, y, z]
  C1: [x, 2, 2]
  C2: [2, y, 2]
  C3: [2, 2, z]
  D1: [x, 2 + cos(s1), 2 + sin(s1)]
  D2: [2 + sin(s2), y, 2 + cos(s2)]
  D3: [2 + cos(s3), 2 + sin(s3), z]
vectors: {i: [1, 0, 0], j: [0, 1, 0], k: [0, 0, 1]}
joints:
  - {name: P1, type: prismatic, parent: base, child: a1, axis: i}
  - {name: Q1, type: revolute, parent: a1, child: b1, axis: i, point: C1}
  - {name: R1, type: revolute, parent: b1, child: c1, axis: i, point: D1}
  - {name: S1, type: revolute, parent: c1, child: tool, axis: i, point: X}
  - {name: P2, type: prismatic, parent: base, child: a2, axis: j}
  - {name: Q2, type: revolute, parent: a2, child: b2, axis: j, point: C2}
  - {name: R2, type: revolute, parent: b2, child: c2, axis: j, point: D2}
  - {name: S2, type: revolute, parent: c2, child: tool, axis: j, point: X}
  - {name: P3, type: prismatic, parent: base, child: a3, axis: k}
  - {name: Q3, type: revolute, parent: a3, child: b3, axis: k, point: C3}
  - {name: R3, type: revolute, parent: b3, child: c3, axis: k, point: D3}
  - {name: S3, type: revolute, parent: c3, child: tool, axis: k, point: X}
"""

_ON_A_HUB = TRIPTERON.replace("child: tool", "child: hub").replace(
    " tool]", " hub, tool]"
)
TRIPTERON_WITH_A_HINGE = f"""{_ON_A_HUB}
  - {{name: hinge, type: revolute, parent: hub, child: tool, axis: k, point: X}}
"""
