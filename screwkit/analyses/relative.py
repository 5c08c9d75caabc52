"""The twist system of any body relative to any other, in symbols or at numbers.

Where the joints between two bodies nest as chains in series and side by side, the
system is found in symbols.  Elsewhere it is found at the values of the file: a basis in
reduced echelon form modulo two primes, brought back to exact numbers.

References: [Hunt1978], §13.
"""

from __future__ import annotations

from screwkit.algebra.common_factors import without_common_factors
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.expression import Expression
from screwkit.algebra.modular import echelon
from screwkit.algebra.names import meant_or_all
from screwkit.algebra.reconstruction import Reconstruction
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.analyses.identified import ScrewWriter
from screwkit.analyses.platform import motion_class
from screwkit.errors import TooLargeError, UndecidedError, UnknownNameError
from screwkit.kinematics.exact_postures import at_zero
from screwkit.kinematics.frames import framed_twists
from screwkit.kinematics.network import Motion, Network
from screwkit.kinematics.series_parallel import (
    chain_between,
    element_columns,
    joints_of,
)
from screwkit.loci.reciprocals import FoundScrew
from screwkit.results.screws import RelativeMotion
from screwkit.screw.nullspace import Column, independent, reciprocal_basis, shortened

LARGEST = 400
"""Terms of a block's wrenches beyond which its twists are found at numbers."""


def relative_motion(
    network: Network, body: str, relative_to: str = "", order: str = "angular"
) -> RelativeMotion:
    """What one body can do relative to another, generic over the free symbols.

    Args:
        network: The mechanism.
        body: A link.
        relative_to: Another one; the base by default.
        order: ``angular``: (ω; v); ``linear``: (v; ω).

    Raises:
        UnknownNameError: If there is no such link.
        UndecidedError: If no joints connect the two, or the joints between them do not
            nest and the file's symbols have no values.
    """
    links = network.mechanism.links
    other = relative_to or network.mechanism.base
    for name in (body, other):
        if name not in links:
            hint = meant_or_all(name, links)
            raise UnknownNameError(
                f"no link {name!r} in {network.mechanism.name}{hint}"
            )
    if not network.connected(body, other):
        raise UndecidedError(f"no joints connect {body!r} with {other!r}")
    dimension = len(network.motion.twists_of(body, other))
    found = _in_symbols(network, body, other) if dimension else None
    symbolic = found is not None and len(found[1]) == dimension
    if found is None or not symbolic:
        found = _at_numbers(network, body, other)
    ring, columns = found
    planar = len(network.rows) == 3
    writer = ScrewWriter(ring, linear=order == "linear", planar=planar)
    outside = [
        tuple(ring.one if i == place else ring.zero for i in range(6))
        for place in ((0, 1, 5) if planar else ())
    ]
    wrenches = reciprocal_basis(ring, [*columns, *outside]).columns
    return RelativeMotion(
        case=network.mechanism.name,
        title=network.mechanism.title,
        body=body,
        relative_to=other,
        order="direction-moment" if order == "angular" else "moment-direction",
        frame=network.mechanism.base,
        point="origin",
        twist_dimension=dimension,
        twists=tuple(writer.twist(FoundScrew(column)) for column in columns),
        wrench_dimension=len(wrenches),
        wrenches=tuple(writer.wrench(FoundScrew(column)) for column in wrenches),
        motion_class=motion_class(network, body, other),
        generic=symbolic,
    )


def _in_symbols(
    network: Network, body: str, other: str
) -> tuple[TrigonometricRing, tuple[Column, ...]] | None:
    """A basis over the exact ring; None where the joints between do not nest."""
    mechanism = at_zero(network.mechanism) if network.tied else network.mechanism
    chain = chain_between(mechanism.joints, other, body)
    if chain is None:
        return None
    names = joints_of(chain)
    # The rows of a table are placed from the base on, whatever lies between the two.
    placing = (
        [j.name for j in mechanism.joints] if mechanism.geometry == "mdh" else names
    )
    framed = framed_twists(mechanism, placing, mechanism.base, merged=False)
    columns: dict[str, list[Column]] = {name: [] for name in names}
    for label, column in zip(framed.joints, framed.columns, strict=True):
        if network.joint_of[label] in columns:
            columns[network.joint_of[label]].append(column)
    try:
        spanning = [
            c for e in chain for c in element_columns(framed.ring, e, columns, LARGEST)
        ]
    except TooLargeError:
        return None
    chosen = independent(framed.ring, spanning)
    return framed.ring, tuple(
        shortened(framed.ring, without_common_factors(framed.ring, spanning[i]))
        for i in chosen
    )


def _at_numbers(
    network: Network, body: str, other: str
) -> tuple[TrigonometricRing, tuple[Column, ...]]:
    rows = twists_in_numbers((network.at_values or network).motions, body, other)
    survey = SurveyRing()
    for row in rows:
        for entry in row:
            evaluate(entry, survey)
    ring = TrigonometricRing(survey)
    return ring, tuple(tuple(evaluate(e, ring) for e in row) for row in rows)


def twists_in_numbers(
    motions: tuple[Motion, Motion], body: str, other: str
) -> list[list[Expression]]:
    """A basis of the twists of a body relative to another, as exact numbers.

    Args:
        motions: At the same posture modulo two primes.
        body: A link.
        other: Another one, connected with it.

    Raises:
        UndecidedError: If the posture has symbols, so that no numbers come back.
    """
    one, two = motions
    known = Reconstruction(
        one.posture.field,
        (one.posture.prime, two.posture.prime),
        (one.posture.constants, two.posture.constants),
    )
    bases = [echelon(m.twists_of(body, other), m.posture.prime) for m in (one, two)]
    rows = []
    for first, second in zip(*bases, strict=True):
        vector = known.direction(first, second)
        if vector is None:
            raise UndecidedError(
                f"the twists of {body!r} relative to {other!r} form a system of "
                f"dimension {len(bases[0])}; the joints between them do not nest, and "
                f"without values for the symbols (--set) no basis is written"
            )
        rows.append([number.expression for number in vector])
    return rows
