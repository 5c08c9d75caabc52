"""A condition solved where a divisor is not zero, and what that leaves out.

Solving A·x + B = 0 for x needs A ≠ 0; the part where A and B vanish together has to be
searched as well.  Two equations P·sin φ + Q·cos φ + R = 0 of a factor in half angles
give φ where the determinant of their coefficients is not zero.

References: [CoxLittleOShea] §3.1 (partial solutions and what they miss).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import permutations

from screwkit.algebra.branches import Branch, Pending, still_pending
from screwkit.algebra.elimination import half_angle_solutions
from screwkit.algebra.linear_systems import largest_system, solutions_of
from screwkit.algebra.search import before_pending
from screwkit.algebra.substitution import Substitution, angle_parts, linear_parts
from screwkit.algebra.trigonometric import Polynomial


@dataclass(frozen=True)
class Split:
    """A condition solved where a divisor is not zero, and what that leaves out.

    Attributes:
        solved: The part on which the divisor is nowhere zero; None where it is empty.
        left: What vanishes together on the rest.
    """

    solved: Branch | None
    left: tuple[Polynomial, ...]


def split(
    branch: Branch, condition: Polynomial, symbols: Sequence[int] | None = None
) -> Split | None:
    """Solve a condition for the symbol with the shortest coefficient, if there is one.

    Coordinates of the posture come before dimensions of the mechanism.  Unlike
    `restricted` this leaves a rest, which the caller has to search as well.

    Args:
        branch: Where the condition is irreducible and not zero.
        condition: In the generators that are left on the branch.
        symbols: Indices of those to choose from; all by default.
    """
    ring = branch.ring
    degrees = condition.degrees()
    best: tuple[bool, int, int] | None = None
    for index in ring.symbol_indices() if symbols is None else symbols:
        if degrees[index] == 1:
            size = len(linear_parts(ring, condition, index)[0])
            own = index in branch.dimensions, size, index
            if best is None or own < best:
                best = own
    if best is None:
        return None
    factor, rest = linear_parts(ring, condition, best[2])
    step = Substitution(((best[2], -rest),), factor, condition=condition, partial=True)
    return Split(_after(branch, condition, step), (factor, rest))


def split_half_angle(
    branch: Branch, condition: Polynomial, companions: Sequence[Polynomial]
) -> Split | None:
    """Solve the equations of a half-angle factor for the angle of the least divisor.

    None where no angle occurs in just two of them, linear in its sine and cosine.
    """
    steps = half_angle_solutions(branch.ring, condition, companions)
    if not steps:
        return None
    best = min(steps, key=lambda step: len(step.divisor))
    whole = replace(
        best, condition=condition, companions=tuple(companions), partial=True
    )
    left = (best.divisor, condition, *companions)
    return Split(_after(branch, condition, whole), left)


def says_nothing(branch: Branch, polynomial: Polynomial) -> bool:
    """Whether a polynomial is seen to vanish on all of a branch."""
    if any(divmod(polynomial, p.value)[1] == 0 for p in branch.pending):
        return True
    return bool(branch.points) and branch.vanishes([polynomial])


def _after(branch: Branch, condition: Polynomial, step: Substitution) -> Branch | None:
    pending = still_pending(branch, step)
    if pending is None:
        return None
    solved = replace(
        branch,
        conditions=(*branch.conditions, condition),
        steps=(*branch.steps, step),
        pending=pending,
    )
    return None if solved.is_empty else solved


@dataclass(frozen=True)
class AngleSplit:
    """One angle taken out of a pending condition by another one.

    Attributes:
        before: The branch without any pending condition; with the angle solved by both
            where that was possible.
        implied: What the one says where the other one gives the angle.
        again: What has to be imposed after it.
        nonzero: What vanishes on no posture where the other one gives the angle.
        left: What vanishes together where it does not.
    """

    before: Branch
    implied: Polynomial
    again: tuple[Polynomial, ...]
    nonzero: tuple[Polynomial, ...]
    left: tuple[Polynomial, ...]


def split_angle(branch: Branch) -> AngleSplit | None:
    """Take an angle out of a pending condition; the shortest result that there is.

    P·sin φ + Q·cos φ = 0 gives φ up to half a turn where P and Q are not both 0, and
    another such condition says there that their determinant vanishes.  Of two with
    rests both give the sine and cosine of φ, where the determinant does not vanish.
    """
    own = [p for p in branch.pending if not p.companions]
    if len(own) < len(branch.pending):
        return None
    choices = [
        split
        for kept, gone in permutations(own, 2)
        for angle in range(len(branch.ring.basis))
        if (split := _angle_taken_out(branch, kept, gone, angle)) is not None
    ]
    return min(choices, key=lambda choice: len(choice.implied), default=None)


def _angle_taken_out(
    branch: Branch, kept: Pending, gone: Pending, angle: int
) -> AngleSplit | None:
    ring = branch.ring
    parts = [angle_parts(ring, pending.value, angle) for pending in (kept, gone)]
    if parts[0] is None or parts[1] is None:
        return None
    (p, q, r), (u, v, w) = parts[0], parts[1]
    determinant = ring.normal(p * v - q * u)
    if determinant == 0 or says_nothing(branch, determinant):
        return None
    before, again = before_pending(branch)
    others = tuple(e for e in again if e is not gone.value)
    if r == 0 and w == 0:
        square = ring.normal(p * p + q * q)
        return AngleSplit(before, determinant, others, (square,), (p, q, *again))
    sine, cosine = ring.normal(q * w - r * v), ring.normal(r * u - p * w)
    circle = ring.normal(sine * sine + cosine * cosine - determinant * determinant)
    if circle == 0:
        return None
    images = (ring.sine_index(angle), sine), (ring.cosine_index(angle), cosine)
    step = Substitution(images, determinant, condition=kept.condition, partial=True)
    solved = replace(
        before,
        conditions=(*before.conditions, kept.condition),
        steps=(*before.steps, step),
        extra=(*before.extra, gone.condition),
    )
    others = tuple(e for e in others if e is not kept.value)
    return AngleSplit(solved, circle, others, (), (determinant, *again))


def split_system(branch: Branch) -> Split | None:
    """Solve pending conditions that are linear in as many coordinates together.

    As many as possible, and of these the ones with the shortest determinant; by
    Cramer's rule, where that is not zero.  Other conditions may contain the same
    coordinates.
    """
    values = [p.value for p in branch.pending if not p.companions]
    free = [i for i in branch.ring.symbol_indices() if i not in branch.dimensions]
    system = largest_system(branch.ring, values, free)
    if system is None or says_nothing(branch, system.determinant):
        return None
    own = [p for p in branch.pending if not p.companions]
    chosen = [own[k] for k in system.conditions]
    images = solutions_of(branch.ring, values, system)
    steps = [
        Substitution(
            ((symbol, image),),
            system.determinant,
            condition=pending.condition,
            partial=True,
        )
        for pending, symbol, image in zip(chosen, system.symbols, images, strict=True)
    ]
    others = tuple(p for p in branch.pending if p not in chosen)
    solved = _after_all(replace(branch, pending=others), steps)
    return Split(solved, (system.determinant, *(p.value for p in chosen)))


def split_difference(branch: Branch) -> Split | None:
    """Solve the difference of two pending conditions, quadratic in one symbol both.

    With A·x² + ... = 0 and B·x² + ... = 0, where B is zero nowhere, the second and
    B·(first) − A·(second) say the same as both, and that may be linear in a coordinate.
    Two quadrics, as rotations leave them, become a graph over one plane curve.

    Returns:
        The part before any condition is pending; all of them have to be imposed again.
    """
    ring = branch.ring
    free = [i for i in ring.symbol_indices() if i not in branch.dimensions]
    own = [p for p in branch.pending if not p.companions]
    best: tuple[int, Pending, int, Polynomial, Polynomial] | None = None
    for replaced, kept in permutations(own, 2):
        for index in free:
            leading = [_square_of(p.value, index) for p in (replaced, kept)]
            if None in leading:
                continue
            one, two = leading
            if not branch.assumptions.is_nonzero(ring, two):
                continue
            value = ring.normal(two * replaced.value - one * kept.value)
            degrees = value.degrees()
            for symbol in (i for i in free if degrees[i] == 1):
                factor, rest = linear_parts(ring, value, symbol)
                size = len(factor)
                if (best is None or size < best[0]) and not says_nothing(
                    branch, factor
                ):
                    best = size, replaced, symbol, factor, rest
    if best is None:
        return None
    _, replaced, symbol, factor, rest = best
    step = Substitution(
        ((symbol, -rest),), factor, condition=replaced.condition, partial=True
    )
    before, _ = before_pending(branch)
    return Split(_after(before, replaced.condition, step), (factor, rest))


def _square_of(polynomial: Polynomial, index: int) -> Polynomial | None:
    """The coefficient of a symbol's square, where it has no higher power."""
    if polynomial.degrees()[index] != 2:
        return None
    return polynomial.derivative(index).derivative(index) / 2


def _after_all(branch: Branch, steps: Sequence[Substitution]) -> Branch | None:
    """A branch by steps that solve conditions which it has already."""
    for step in steps:
        pending = still_pending(branch, step)
        if pending is None:
            return None
        branch = replace(branch, steps=(*branch.steps, step), pending=pending)
    return None if branch.is_empty else branch
