"""Why a locked platform moves: the superbracket of six lines, as a product.

A factor is compared with the components of the actuation locus: at exact points of
them, and by the irreducible factors of its own polynomial.

References: [BenHorinShoham2006]; [BenHorinShoham2009].
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, TypeAlias

from screwkit.algebra.cases import possible_factors
from screwkit.algebra.constant_multiples import condition_key
from screwkit.algebra.points import residue
from screwkit.algebra.trigonometric import primitive
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.bracket_forms import Form, product_of
from screwkit.loci.brackets import Monomial, shortest_monomials
from screwkit.loci.pieces import Piece
from screwkit.loci.placed_points import PlacedPoint
from screwkit.loci.same_zeros import is_special
from screwkit.loci.superbracket import SixLines, six_lines
from screwkit.results.superbracket import BracketFactor, BracketPoint, Superbracket

Holds: TypeAlias = Literal["never", "exactly", "wider", "there", "elsewhere"]

LETTERS = "abcdefghijkl"

LONGEST = 1_500
"""Terms of a factor's polynomial that is factored."""

COSTLIEST = 400_000
"""Products of terms of the coordinates in one factor that are expanded."""


def superbracket(
    assembly: Assembly, actuated: Sequence[str], pieces: Sequence[Piece]
) -> Superbracket | None:
    """The superbracket of a scheme; None where its wrenches are not six such lines.

    Args:
        assembly: The mechanism.
        actuated: Its admissible scheme.
        pieces: The actuation components, in the order of the answer.
    """
    found = six_lines(assembly, actuated)
    if isinstance(found, str):
        return None
    monomials = shortest_monomials(found.lines, found.always_in_a_plane)
    if not monomials:  # lines of one limb that other limbs have too
        return None
    ideal = [point.ideal for point in found.points]
    forms = product_of(monomials, found.lines, ideal, found.samples)
    factors = () if forms is None else tuple(dict.fromkeys(forms))
    return Superbracket(
        points=tuple(
            BracketPoint(letter, point.name, point.ideal)
            for letter, point in zip(LETTERS, found.points, strict=False)
        ),
        lines=tuple(f"{LETTERS[a]}{LETTERS[b]}" for a, b in found.lines),
        monomials=tuple(_monomial(m, count) for m, count in monomials.items()),
        factors=tuple(_factor(assembly, found, form, pieces) for form in factors),
        reason="" if factors else "no simple form of these brackets is known here",
    )


def _monomial(monomial: Monomial, count: int) -> str:
    sign = "-" if count < 0 else "+"
    times = str(abs(count)) if abs(count) != 1 else ""
    return sign + times + "".join(f"[{_letters(four)}]" for four in monomial)


def _letters(group: Sequence[int]) -> str:
    return "".join(LETTERS[i] for i in group)


def _factor(
    assembly: Assembly, found: SixLines, form: Form, pieces: Sequence[Piece]
) -> BracketFactor:
    met = tuple(n for n, piece in enumerate(pieces) if _vanishes_on(piece, form, found))
    return BracketFactor(
        expression=expression(form),
        words=in_words(form, found.points),
        holds=_holds(assembly, found, form, [pieces[n] for n in met]),
        components=met,
    )


def _vanishes_on(piece: Piece, form: Form, found: SixLines) -> bool:
    """Whether a form vanishes at all exact points of a piece."""
    points = [point for branch in piece.branches for point in branch.points]
    return bool(points) and not any(
        form.value(
            [[residue(x, at, prime) for x in p.coordinates] for p in found.points]
        )
        % prime
        for at, prime in points
    )


def _holds(
    assembly: Assembly, found: SixLines, form: Form, met: Sequence[Piece]
) -> Holds:
    ring = assembly.common_twists.ring
    undecided: Holds = "there" if met else "elsewhere"
    size = 1
    for group in form.groups:
        size *= sum(max(map(len, found.points[i].coordinates)) for i in group)
    if size > COSTLIEST:
        return undecided
    value = ring.normal(form.value([p.coordinates for p in found.points]))
    value = ring.without_divisors([value])[0]
    if value == 0 or len(value) > LONGEST:
        return undecided
    root, library = assembly.root(ring), assembly.library(ring)
    factors = possible_factors(root, primitive(value), library)
    # What ties the dimensions alone is a special mechanism, not a posture.
    keys = {
        condition_key(ring, f.equations[0])
        for f in factors
        if not is_special(root, f.equations[0])
    }
    if not keys:
        return "never"
    known = {
        condition_key(ring, piece.equations[0])
        for piece in met
        if len(piece.equations) == 1
    }
    if keys <= known:
        return "exactly"
    return "wider" if met else "elsewhere"


def expression(form: Form) -> str:
    """A form in Grassmann–Cayley algebra.

    >>> expression(Form(((0, 1, 2, 3),)))
    '[abcd]'
    >>> expression(Form(((0, 1, 2), (3, 4, 5), (6, 7))))
    'abc ∧ def ∧ gh'
    >>> expression(Form(((0, 1), (2, 3), (4, 5))))
    '[ab∞ cd∞ ef∞]'
    """
    if len(form.groups) == 1:
        return f"[{_letters(form.groups[0])}]"
    if all(len(group) == 2 for group in form.groups):
        mark = "" if form.ideal else "∞"
        return "[" + " ".join(_letters(g) + mark for g in form.groups) + "]"
    return " ∧ ".join(map(_letters, form.groups))


def in_words(form: Form, points: Sequence[PlacedPoint]) -> str:
    """A form as a sentence without full stop."""
    groups = [[points[i] for i in group] for group in form.groups]
    if len(groups) == 1:
        return _in_one_plane(groups[0])
    if form.ideal:
        return "the moments of the three couples are parallel to one plane"
    if all(len(group) == 2 for group in groups):
        lines = _listed([_line(group) for group in groups])
        return f"{lines} are parallel to one plane"
    planes = [_plane(group) for group in groups if len(group) == 3]
    lines_of = [_line(group) for group in groups if len(group) == 2]
    met = _listed([*planes, *lines_of])
    return f"{met} meet in one point"


def _in_one_plane(four: Sequence[PlacedPoint]) -> str:
    finite = [p.name for p in four if not p.ideal]
    along = [_axis(p) for p in four if p.ideal]
    if not along:
        return f"{_listed(finite)} lie in one plane"
    if len(along) == 1:
        return f"the plane of {_listed(finite)} is parallel to axis {along[0]}"
    if len(along) == 2:
        line = f"the line through {_listed(finite)}"
        return f"{line} and axes {_listed(along)} are parallel to one plane"
    return f"axes {_listed(along)} are parallel to one plane"


def _plane(three: Sequence[PlacedPoint]) -> str:
    finite = [p.name for p in three if not p.ideal]
    along = [_axis(p) for p in three if p.ideal]
    if not finite:
        return "the plane at infinity"
    if not along:
        return f"the plane of {_listed(finite)}"
    return f"the plane through {_listed(finite)} parallel to {_axes(along)}"


def _line(two: Sequence[PlacedPoint]) -> str:
    finite = [p.name for p in two if not p.ideal]
    along = [_axis(p) for p in two if p.ideal]
    if not along:
        return f"the line through {_listed(finite)}"
    if finite:
        return f"the line through {finite[0]} parallel to axis {along[0]}"
    return f"the line at infinity of {_axes(along)}"


def _axes(names: Sequence[str]) -> str:
    return f"{'axis' if len(names) == 1 else 'axes'} {_listed(names)}"


def _axis(point: PlacedPoint) -> str:
    return point.name.removeprefix("the direction of axis ")


def _listed(names: Sequence[str]) -> str:
    return " and ".join(filter(None, (", ".join(names[:-1]), names[-1])))
