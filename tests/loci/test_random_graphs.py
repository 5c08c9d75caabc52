"""Random planar graphs: the listed hypersurfaces are those of random minors on lines.

On a random line modulo a prime, the loop matrix squeezed to its rank by random matrices
has a determinant that is a polynomial in one unknown.  Two of them share exactly the
zeros at which the rank falls.  Loops, twists and polynomials are the test's own.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import Any

import pytest
from flint import nmod_mat, nmod_poly

from screwkit.case import load_text
from screwkit.questions import singularities
from screwkit.results.singularities import Component

PRIME = 2**61 - 1
DEGREE = 40  # of a determinant on a line, at most

Edge = tuple[int, int, tuple[str, str]]


@dataclass(frozen=True)
class Planar:
    """Links joined by pivots whose coordinates are numbers or symbols."""

    links: int
    edges: tuple[Edge, ...]

    @property
    def text(self) -> str:
        lines = ["screwkit: 1", "name: drawn", "space: planar", "geometry: posture"]
        names = [f"b{i}" for i in range(self.links)]
        lines += [f"base: {names[0]}", f"platform: {names[-1]}"]
        lines += [f"links: [{', '.join(names)}]", "variables: {x: 1, y: 2}", "joints:"]
        for number, (one, two, (px, py)) in enumerate(self.edges):
            lines.append(
                f"  - {{name: j{number}, type: revolute, parent: b{one}, "
                f"child: b{two}, point: [{px}, {py}]}}"
            )
        return "\n".join([*lines, "actuated: [j0]"]) + "\n"

    def loops(self) -> list[dict[int, int]]:
        """Signs by edge, one loop for every edge outside a tree."""
        way: dict[int, dict[int, int]] = {0: {}}
        found, left = [], list(range(len(self.edges)))
        while left:
            for number in left:
                one, two, _ = self.edges[number]
                if one in way and two in way:
                    loop = dict(way[one])
                    loop[number] = 1
                    for edge, sign in way[two].items():
                        loop[edge] = loop.get(edge, 0) - sign
                    found.append({e: s for e, s in loop.items() if s})
                elif one in way:
                    way[two] = {**way[one], number: 1}
                elif two in way:
                    way[one] = {**way[two], number: -1}
                else:
                    continue
                left.remove(number)
                break
        return found

    def matrix(self, at: dict[str, int], locked: tuple[int, ...]) -> list[list[int]]:
        """Three rows a loop, at residues of the symbols."""

        def number(written: str) -> int:
            return at[written] if written in at else int(written)

        rows = []
        for loop in self.loops():
            block: list[list[int]] = [[], [], []]
            for edge, (_, _, (px, py)) in enumerate(self.edges):
                if edge in locked:
                    continue
                sign = loop.get(edge, 0)
                for row, entry in zip(block, (1, number(py), -number(px)), strict=True):
                    row.append(sign * entry % PRIME)
            rows += block
        return rows


def drawn(seed: int) -> Planar:
    """A connected graph with two loops or three, two pivots of it at symbols."""
    source = random.Random(seed)
    links = source.choice((5, 6, 7))
    loops = 2 if links < 7 else 3
    edges: list[tuple[int, int]] = [(source.randrange(i), i) for i in range(1, links)]
    while len(edges) < links - 1 + loops:
        one, two = source.sample(range(links), 2)
        edges.append((min(one, two), max(one, two)))
    places = [
        (str(source.randrange(-9, 10)), str(source.randrange(-9, 10))) for _ in edges
    ]
    for k, place in zip(
        source.sample(range(len(edges)), 2), (("x", "y"), ("y", "3")), strict=True
    ):
        places[k] = place
    return Planar(
        links, tuple((a, b, p) for (a, b), p in zip(edges, places, strict=True))
    )


def squeezed(rows: list[list[int]], rank: int, seed: int) -> int:
    source = random.Random(seed)

    def mixing(height: int, width: int) -> Any:
        entries = [source.randrange(PRIME) for _ in range(height * width)]
        return nmod_mat(height, width, entries, PRIME)

    flat = [x for row in rows for x in row]
    matrix = nmod_mat(len(rows), len(rows[0]), flat, PRIME)
    product = mixing(rank, len(rows)) * matrix * mixing(len(rows[0]), rank)
    return int(product.det())


def interpolated(values: list[int]) -> Any:
    """The polynomial with these values at 0, 1, 2 and so on."""
    total, basis = nmod_poly([0], PRIME), nmod_poly([1], PRIME)
    for k, wanted in enumerate(values):
        scale = (wanted - int(total(k))) * pow(int(basis(k)), -1, PRIME) % PRIME
        total += basis * scale
        basis *= nmod_poly([-k % PRIME, 1], PRIME)
    return total


def radical(polynomial: Any) -> Any:
    found = nmod_poly([1], PRIME)
    for factor, _ in polynomial.factor()[1]:
        found *= factor
    return found


def on_line(equation: str, slope: int, start: int) -> Any:
    """A polynomial of the grammar with x = t, y = slope·t + start."""
    scope = {"x": nmod_poly([0, 1], PRIME), "y": nmod_poly([start, slope], PRIME)}
    value = eval(equation.replace("^", "**"), {"__builtins__": {}}, scope)
    return nmod_poly([1], PRIME) * value


def listed_on_line(components: tuple[Component, ...], slope: int, start: int) -> Any:
    product = nmod_poly([1], PRIME)
    for component in components:
        if component.codimension == 1:
            product *= on_line(component.equations[0], slope, start)
    return radical(product)


def zeros_on_line(
    graph: Planar, locked: tuple[int, ...], slope: int, start: int
) -> Any:
    """Where the rank falls on the line."""

    def rows(t: int) -> list[list[int]]:
        return graph.matrix({"x": t, "y": (slope * t + start) % PRIME}, locked)

    first = rows(123456789123)
    flat = [x for row in first for x in row]
    rank = int(nmod_mat(len(first), len(first[0]), flat, PRIME).rank())
    common = nmod_poly([0], PRIME)
    for seed in (1, 2):
        values = [squeezed(rows(t), rank, seed) for t in range(DEGREE)]
        found = interpolated(values)
        assert found.degree() < DEGREE - 2
        common = common.gcd(found)
    return radical(common)


@pytest.mark.parametrize("seed", range(24))
def test_hypersurfaces_are_those_of_random_minors(seed: int) -> None:
    graph = drawn(seed)
    found = singularities(load_text(graph.text))
    source = random.Random(1000 + seed)
    slope, start = source.randrange(PRIME), source.randrange(PRIME)
    constraint = found.constraint
    assert constraint.complete
    listed = listed_on_line(constraint.components, slope, start)
    assert listed == zeros_on_line(graph, (), slope, start)
    actuation = found.actuation
    assert actuation is not None
    if actuation.admissible and actuation.complete:
        both = (*actuation.components, *actuation.idle)
        listed = listed_on_line(both, slope, start)
        assert listed == zeros_on_line(graph, (0,), slope, start)


def test_most_graphs_drawn_are_singular_somewhere() -> None:
    """Else the comparison above would be of nothing with nothing."""
    degrees = [
        zeros_on_line(drawn(seed), (), 3 + seed, 5).degree() for seed in range(24)
    ]
    assert sum(degree > 0 for degree in degrees) > 8
    assert max(degrees) > 1
