"""Another actuation scheme than the file declares."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from screwkit.algebra.expression import Expression
from screwkit.algebra.names import meant_or_all
from screwkit.errors import UnknownNameError
from screwkit.mechanism.graph import actuable_freedoms
from screwkit.mechanism.model import Joint, Mechanism, freedom_label


def with_actuated(mechanism: Mechanism, actuated: Sequence[str]) -> Mechanism:
    """The mechanism with other actuated freedoms than its file declares.

    Args:
        mechanism: As read.
        actuated: Freedoms, by their labels.

    Raises:
        UnknownNameError: If one is no freedom a motor can drive, stands twice, or has
            no weight where the others have one.
    """
    known = dict.fromkeys(actuable_freedoms(mechanism))
    wanted = frozenset(actuated)
    if twice := next((name for name in actuated if list(actuated).count(name) > 1), ""):
        raise UnknownNameError(f"{twice!r} stands twice among the actuated freedoms")
    for name in actuated:
        if name not in known:
            hint = meant_or_all(name, known)
            raise UnknownNameError(
                f"no actuable freedom {name!r} in {mechanism.name}{hint}"
            )
    return replace(
        mechanism,
        joints=tuple(_driven(joint, wanted) for joint in mechanism.joints),
        scheme_order=tuple(actuated),
        weights=_weights_of(mechanism, actuated),
    )


def _weights_of(
    mechanism: Mechanism, actuated: Sequence[str]
) -> dict[str, tuple[tuple[Expression, ...], ...]]:
    """The weights, those of rates and torques for other actuators.

    Raises:
        UnknownNameError: If a freedom has none.
    """
    found = dict(mechanism.weights)
    before = list(mechanism.scheme_order)
    for key in ("rates", "torques"):
        if key not in found:
            continue
        for name in actuated:
            if name not in before:
                raise UnknownNameError(
                    f"the weights of {key} in {mechanism.name} are for "
                    f"{', '.join(before)}; there is none for {name!r}"
                )
        chosen = [before.index(name) for name in actuated]
        found[key] = tuple(tuple(found[key][i][j] for j in chosen) for i in chosen)
    return found


def _driven(joint: Joint, actuated: frozenset[str]) -> Joint:
    driven = tuple(
        index
        for index in range(len(joint.variables))
        if freedom_label(joint, index) in actuated
    )
    return replace(joint, actuated=driven)
