"""The freedoms that closed loops leave, one by one: what turns and what moves with it.

Idle ones come first, at which the platform rests: each with as few joints as possible,
so that a rod that spins about its own axis is seen as that.  Then the platform's, with
twists that are translations, rotations or screws as simple as its twist system has
them; what only idles is left out of each.

References: [Hunt1978], [BicchiMelchiorri] (redundancy and coordinated motion).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from screwkit.kinematics.network import Motion
from screwkit.reasons.readable_screws import Row, readable_basis
from screwkit.reasons.residue_spaces import (
    Span,
    complement,
    least_outside,
    reduced_echelon,
    vanishing,
)
from screwkit.reasons.short_loops import by_name

Entry: TypeAlias = str | int
"""A freedom by its label, or a coordinate of the twist of one body."""
Rates: TypeAlias = dict[str, int]
_SEARCH = 1500
"""Idle freedoms that hang together, times joints, up to which few joints are sought."""
_WHOLE = -1  # an entry that marks a rate as one to which others are added


@dataclass(frozen=True)
class NamedFreedom:
    """One of the freedoms left.

    Attributes:
        idle: Whether the platform rests.
        rates: Of the freedoms that turn or slide, modulo the prime, by label.
        bodies: Those that move.
        twist: (ω; v) of the platform; of an idle freedom that of its bodies where they
            move as one, else empty.
    """

    idle: bool
    rates: Mapping[str, int]
    bodies: tuple[str, ...]
    twist: Row


def named_freedoms(motion: Motion) -> tuple[NamedFreedom, ...]:
    """A basis of the joint rates that reads well: idle ones, then the platform's.

    Where nothing connects the platform with the base every freedom counts as idle.
    """
    network, prime = motion.network, motion.posture.prime
    base, platform = network.mechanism.base, network.mechanism.platform
    followed = platform if network.connected(base, platform) else base
    rows = _with_twists(motion, motion.rates, followed)
    driving = [row for row in rows if isinstance(min(row, key=_twist_first), int)]
    idle = [_rates(row) for row in rows[len(driving) :]]
    basis = [rates for block in _blocks(idle) for rates in _least_idle(motion, block)]
    basis = [_sorted(motion, rates) for rates in basis]
    found = [_idle(motion, rates) for rates in basis]
    system = [_twist(row) for row in driving]
    for twist in readable_basis(system, prime) if system else ():
        rates = _rates(_with_twist(driving, twist, prime))
        rates = _sorted(motion, _without_idling(motion, rates, basis))
        found.append(NamedFreedom(False, rates, motion.moving(rates), twist))
    return tuple(found)


def _sorted(motion: Motion, rates: Rates) -> Rates:
    """In the order of the file."""
    return {label: rates[label] for label in motion.network.labels if label in rates}


def _idle(motion: Motion, rates: Rates) -> NamedFreedom:
    twists = motion.body_twists(rates)
    moving = tuple(body for body, twist in twists.items() if any(twist))
    common = {tuple(twists[body]) for body in moving}
    return NamedFreedom(True, rates, moving, common.pop() if len(common) == 1 else ())


def _with_twists(
    motion: Motion, rates: Sequence[Mapping[str, int]], body: str
) -> list[dict[Entry, int]]:
    """Echelon basis of rates, the twist of a body first."""
    rows: list[dict[Entry, int]] = []
    for one in rates:
        twist = motion.body_twists(one)[body]
        row: dict[Entry, int] = {i: x for i, x in enumerate(twist) if x}
        row.update(one)
        rows.append(row)
    return reduced_echelon(rows, motion.posture.prime, _twist_first)


def _with_twist(
    rows: Sequence[Mapping[Entry, int]], twist: Row, prime: int
) -> dict[Entry, int]:
    """The combination of echelon rows at which the body has this twist."""
    total: dict[Entry, int] = {}
    for row in rows:
        pivot = min(row, key=_twist_first)
        factor = twist[pivot] if isinstance(pivot, int) else 0
        for key, value in row.items():
            total[key] = (total.get(key, 0) + factor * value) % prime
    return {key: value for key, value in total.items() if value}


def _blocks(idle: Sequence[Rates]) -> list[list[Rates]]:
    """Idle rates parted so that no freedom occurs in two parts.

    Rates of fewest joints never mix vectors of an echelon basis that share no freedom.
    """
    blocks: list[tuple[set[str], list[Rates]]] = []
    for rates in idle:
        labels, members = set(rates), [rates]
        apart = []
        for block in blocks:
            if block[0] & labels:
                labels |= block[0]
                members = [*block[1], *members]
            else:
                apart.append(block)
        blocks = [*apart, (labels, members)]
    blocks.sort(key=lambda block: min(map(by_name, block[0])))
    return [members for _, members in blocks]


def _least_idle(motion: Motion, block: Sequence[Rates]) -> list[Rates]:
    """A basis of a part of the idle rates, few moving bodies first."""
    network, prime = motion.network, motion.posture.prime
    joints = sorted({network.joint_of[x] for r in block for x in r}, key=by_name)
    if len(block) * len(joints) > _SEARCH:
        return list(block)
    span: Span[str] = Span(prime)
    basis: list[Rates] = []
    for allowed in _neighbourhoods(motion, joints):
        outside = [
            label
            for joint in joints
            if joint not in allowed
            for label in network.labels_of[joint]
        ]
        space = vanishing(block, outside, prime)
        while any(span.rest(rates) for rates in space):
            spared = [network.labels_of[joint] for joint in reversed(joints)]
            least = least_outside(space, spared, span)
            labels = {label for rates in least for label in rates}
            known = [rates for rates in basis if set(rates) <= labels]
            added = _readable(motion, complement(least, known, prime, by_name))
            basis.extend(rates for rates in added if span.add(rates))
        if len(basis) == len(block):
            break
    return basis


def _neighbourhoods(motion: Motion, joints: Sequence[str]) -> Iterator[set[str]]:
    """Single joints, those at one body, at two bodies side by side; at last all."""
    mechanism = motion.network.mechanism
    at: dict[str, set[str]] = {}
    pairs = []
    for name in joints:
        yield {name}
    wanted = set(joints)
    for joint in sorted(mechanism.joints, key=lambda joint: by_name(joint.name)):
        for body in (joint.parent, joint.child):
            if joint.name in wanted:
                at.setdefault(body, set()).add(joint.name)
        pairs.append((joint.parent, joint.child))
    at.pop(mechanism.base, None)
    yield from at.values()
    for one, other in pairs:
        if one in at and other in at:
            yield at[one] | at[other]
    yield wanted


def _readable(motion: Motion, space: Sequence[Rates]) -> list[Rates]:
    """Where one body shows them all apart, the basis that reads best there."""
    prime = motion.posture.prime
    if len(space) < 2:
        return list(space)
    moving = {body for rates in space for body in motion.moving(rates)}
    for body in sorted(moving, key=by_name):
        rows = _with_twists(motion, space, body)
        if all(isinstance(min(row, key=_twist_first), int) for row in rows):
            system = readable_basis([_twist(row) for row in rows], prime)
            return [_rates(_with_twist(rows, twist, prime)) for twist in system]
    return list(space)


def _without_idling(motion: Motion, rates: Rates, idle: Sequence[Rates]) -> Rates:
    """The rates with as many joints at rest as idle rates can bring to rest."""
    network, prime = motion.network, motion.posture.prime
    whole: dict[Entry, int] = {_WHOLE: 1}
    whole.update(rates)
    space: list[dict[Entry, int]] = [whole]
    for one in idle:
        row: dict[Entry, int] = {}
        row.update(one)
        space.append(row)
    idling = {network.joint_of[label] for one in idle for label in one}
    for joint in sorted(idling, key=by_name, reverse=True):
        without = vanishing(space, network.labels_of[joint], prime)
        if any(_WHOLE in row for row in without):
            space = without
    whole = next(row for row in space if _WHOLE in row)
    rest = [row for row in space if _WHOLE not in row]
    (least,) = complement([whole], rest, prime, _twist_first)
    return _rates(least)


def _twist_first(entry: Entry) -> tuple[object, ...]:
    return (0, entry) if isinstance(entry, int) else (1, by_name(entry))


def _rates(row: Mapping[Entry, int]) -> Rates:
    return {key: value for key, value in row.items() if isinstance(key, str)}


def _twist(row: Mapping[Entry, int]) -> Row:
    return tuple(row.get(i, 0) for i in range(6))
