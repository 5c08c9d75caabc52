"""The named lines, planes and pitches are the system's: it can be built from them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias

import numpy as np
import pytest
from hypothesis import given, settings
from systems.screw_systems import ALL, PRIMES, X, Y, Z, both, displacements, moved

from screwkit.systems.screw_structure import ScrewStructure, normal_part
from screwkit.systems.system_class import classify

P = PRIMES[0]
Vector: TypeAlias = tuple[int, ...]
Screws: TypeAlias = list[list[int]]
Elements: TypeAlias = Mapping[str, Vector]


def cross(a: Sequence[int], b: Sequence[int]) -> Vector:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def at(point: Vector, direction: Vector, pitch: int = 0) -> list[int]:
    moment = cross(point, direction)
    return [
        *direction,
        *((m + pitch * d) % P for m, d in zip(moment, direction, strict=True)),
    ]


def free(direction: Vector) -> list[int]:
    return [0, 0, 0, *direction]


def plus(a: Vector, b: Vector) -> Vector:
    return tuple((x + y) % P for x, y in zip(a, b, strict=True))


def normals(vector: Vector) -> tuple[Vector, ...]:
    """Two directions normal to one."""
    return normal_part((X, Y, Z), [vector], P)


def bundle(point: Vector, directions: Sequence[Vector], pitch: int = 0) -> Screws:
    return [at(point, direction, pitch) for direction in directions]


def field(point: Vector, normal: Vector, pitch: int = 0) -> Screws:
    """Screws along lines of a plane."""
    a, b = normals(normal)
    lines = (point, a), (point, b), (plus(point, a), b)
    return [at(q, direction, pitch) for q, direction in lines]


def parallels(point: Vector, step: Vector, direction: Vector, pitch: int) -> Screws:
    return [at(point, direction, pitch), at(plus(point, step), direction, pitch)]


def meeting(point: Vector, axis: Vector, directions: Sequence[Vector]) -> Screws:
    """Rotations about lines through two points of an axis."""
    return [*bundle(point, directions), *bundle(plus(point, axis), directions)]


def pitch_of(e: Elements, name: str = "pitch") -> int:
    return e[name][0] if name in e else 0


def in_plane(e: Elements) -> Screws:
    step = cross(e["direction"], e["normal"])
    return parallels(e["foot"], step, e["direction"], pitch_of(e))


def planar(e: Elements) -> Screws:
    turn = at((0, 0, 0), e["direction"], pitch_of(e))
    return [turn, *map(free, normals(e["direction"]))]


def revolved(e: Elements) -> Screws:
    flat = bundle(e["point"], normals(e["normal"]), pitch_of(e))
    return [*flat, at(e["point"], e["normal"], pitch_of(e, "second_pitch"))]


ALL_DIRECTIONS = (X, Y, Z)
BUILT: Mapping[str, Callable[[Elements], Screws]] = {
    "no motion": lambda _: [],
    "translation": lambda e: [free(e["direction"])],
    "planar translation": lambda e: [*map(free, normals(e["normal"]))],
    "spatial translation": lambda _: [*map(free, ALL_DIRECTIONS)],
    "rotation": lambda e: [at(e["point"], e["direction"])],
    "helical motion": lambda e: [at(e["point"], e["direction"], pitch_of(e))],
    "cylindrical motion": lambda e: [
        at(e["point"], e["direction"]),
        free(e["direction"]),
    ],
    "rotations about parallel lines of a plane": in_plane,
    "helical motions about parallel lines of a plane": in_plane,
    "rotation and oblique translation": lambda e: [
        at(e["point"], e["direction"]),
        free(e["second"]),
    ],
    "planar motion": planar,
    "planar translation with a helical motion": planar,
    "planar translation and rotations about parallel lines of a plane": lambda e: [
        *in_plane(e),
        *map(free, normals(e["second"])),
    ],
    "flat pencil of rotations": lambda e: bundle(e["point"], normals(e["normal"])),
    "flat pencil of helical motions": lambda e: bundle(
        e["point"], normals(e["normal"]), pitch_of(e)
    ),
    "planar field of rotations": lambda e: field(e["foot"], e["normal"]),
    "planar field of helical motions": lambda e: field(
        e["foot"], e["normal"], pitch_of(e)
    ),
    "flat pencil of rotations and a translation": lambda e: [
        *bundle(e["point"], normals(e["normal"])),
        free(e["second"]),
    ],
    "spherical motion": lambda e: bundle(e["point"], ALL_DIRECTIONS),
    "helical motions about all lines through a point": lambda e: bundle(
        e["point"], ALL_DIRECTIONS, pitch_of(e)
    ),
    "flat pencil of rotations and a helical motion across it": revolved,
    "three-system of revolution": revolved,
    "Schönflies motion": lambda e: [
        at((0, 0, 0), e["normal"]),
        *map(free, ALL_DIRECTIONS),
    ],
    "rotations about the lines across an axis": lambda e: meeting(
        e["point"], e["direction"], normals(e["direction"])
    ),
    "rotations about lines of a plane's directions that meet an axis": lambda e: (
        meeting(e["point"], e["direction"], normals(e["second"]))
    ),
    "planar field of rotations and a translation": lambda e: [
        *field(e["foot"], e["normal"]),
        *map(free, normals(e["direction"])),
    ],
    "spherical motion and a translation": lambda e: [
        *bundle(e["point"], ALL_DIRECTIONS),
        free(e["normal"]),
    ],
    "special linear complex of rotations": lambda e: [
        *meeting(e["point"], e["direction"], ALL_DIRECTIONS),
        *map(free, normals(e["direction"])),
    ],
    "all translations and a plane of rotation directions": lambda e: [
        *bundle((0, 0, 0), normals(e["direction"])),
        *map(free, ALL_DIRECTIONS),
    ],
    "spatial motion": lambda _: [
        *bundle((0, 0, 0), ALL_DIRECTIONS),
        *map(free, ALL_DIRECTIONS),
    ],
}


@pytest.mark.parametrize("name", BUILT)
@settings(max_examples=8)
@given(displacement=displacements())
def test_a_system_can_be_built_from_its_elements(
    name: str, displacement: np.ndarray
) -> None:
    systems = both(moved(displacement, ALL[name]))
    found = classify(systems)
    assert found.name == name
    elements = {element.name: element.residues[0] for element in found.elements}
    built = ScrewStructure.spanned_by(BUILT[name](elements), P)
    assert built == ScrewStructure.spanned_by(*systems[0])


RECIPROCAL = {
    "linear complex",
    "rotations and helical motions of a plane's directions",
    "four-system of equal pitches",
}


@pytest.mark.parametrize("name", sorted(RECIPROCAL))
@settings(max_examples=8)
@given(displacement=displacements())
def test_what_is_said_to_be_reciprocal_is(name: str, displacement: np.ndarray) -> None:
    systems = both(moved(displacement, ALL[name]))
    e = {x.name: x.residues[0] for x in classify(systems).elements}
    held = {
        "linear complex": lambda: [at(e["point"], e["direction"], pitch_of(e))],
        "four-system of equal pitches": lambda: bundle(
            e["point"], normals(e["normal"]), pitch_of(e)
        ),
        "rotations and helical motions of a plane's directions": lambda: in_plane(e),
    }[name]()
    system = ScrewStructure.spanned_by(*systems[0])
    assert ScrewStructure.spanned_by(held, P) == system.reciprocal


@settings(max_examples=30)
@given(displacements())
def test_all_screws_of_a_cylindroid_cross_its_line(displacement: np.ndarray) -> None:
    systems = both(moved(displacement, ALL["cylindroid"]))
    e = {x.name: x.residues[0] for x in classify(systems).elements}
    central = at(e["point"], e["normal"])
    for screw in ScrewStructure.spanned_by(*systems[0]).basis:
        direction, moment = screw[:3], screw[3:]
        power = cross(direction, moment)
        size = sum(x * x for x in direction)
        line = at(tuple(x * pow(size, -1, P) for x in power), direction)
        assert sum(a * b for a, b in zip(central[:3], direction, strict=True)) % P == 0
        crossing = zip(central, [*line[3:], *line[:3]], strict=True)
        assert sum(a * b for a, b in crossing) % P == 0
