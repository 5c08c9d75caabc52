"""What `load` returns: a mechanism, its claims, and the questions it can be asked.

The exact work starts when a question is asked, and what two questions share is
computed once.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from screwkit.algebra.expression import Expression
from screwkit.algebra.names import did_you_mean
from screwkit.errors import (
    Fault,
    MechanismFileError,
    UndecidedError,
    UnknownCaseError,
    UnknownNameError,
)
from screwkit.mechanism.files import mechanism_from_text, place_of, read_mechanism
from screwkit.mechanism.given_scheme import with_actuated
from screwkit.mechanism.model import (
    Claim,
    Mechanism,
    Variant,
)
from screwkit.mechanism.reading import Outside
from screwkit.mechanism.variants import at_variant

if TYPE_CHECKING:
    from screwkit.analyses.grasp_view import GraspView
    from screwkit.analyses.limb_view import LimbView
    from screwkit.kinematics.assembly import Assembly
    from screwkit.kinematics.network import Network
    from screwkit.kinematics.whole_graph import WholeGraph


@dataclass(frozen=True)
class Given:
    """What was asked of a file when it was loaded; see `load`."""

    set_values: Mapping[str, object] = field(default_factory=dict)
    at: Mapping[str, object] = field(default_factory=dict)
    variant: str | None = None
    actuated: Sequence[str] | None = None

    @property
    def values(self) -> Mapping[str, str]:
        """Texts of all values, by symbol and joint variable."""
        return {n: str(v) for n, v in {**self.set_values, **self.at}.items()}


class Case:
    """A mechanism file, loaded.

    Attributes:
        mechanism: What the file declares.
        wanted: Values of joint variables that loops tie together; the mechanism has
            still to be moved there.
        path: Of its file; None where it has none.
        given: What was asked of the file.
        unplaced: What the file declares before ``at`` gives values to its symbols.
    """

    def __init__(
        self,
        mechanism: Mechanism,
        wanted: Mapping[str, Expression] | None = None,
        path: Path | None = None,
        given: Given | None = None,
        unplaced: Mechanism | None = None,
    ) -> None:
        self.mechanism = mechanism
        self.unplaced = unplaced or mechanism
        self.given = given or Given()
        self.wanted = dict(wanted or {})
        self.path = path

    def __repr__(self) -> str:
        return f"<screwkit case {self.mechanism.name!r}>"

    @property
    def name(self) -> str:
        """The name in the file."""
        return self.mechanism.name

    @property
    def is_bundled(self) -> bool:
        """Whether its file came with the package."""
        return self.path is not None and self.path in _bundled_files()

    def refuse(self, place: Sequence[str | int], message: str) -> MechanismFileError:
        """The refusal of something in the file, with its line and column."""
        where = (0, 0) if self.path is None else place_of(self.path, tuple(place))
        source = str(self.path or self.name)
        return MechanismFileError(source, (Fault(*where, message),))

    def need_held_platform(self) -> None:
        """Refuse a platform that no limb connects with the base.

        Raises:
            MechanismFileError: If it hangs on nothing, and is not the base itself.
        """
        from screwkit.mechanism.graph import holding_joints  # noqa: PLC0415

        base, platform = self.mechanism.base, self.mechanism.platform
        if base != platform and not holding_joints(self.mechanism):
            raise self.refuse(
                ("platform",),
                f"no limb holds the platform {platform!r}: connect it with the base, "
                f"or name another body as platform",
            )

    def need_loci(self) -> None:
        """Refuse what has no singular loci, or no known ones, as these say."""
        self.need_held_platform()
        self.need_known_sides()

    def need_known_sides(self) -> None:
        """Refuse loci where freedoms of a joint are written for most postures alone.

        Raises:
            UndecidedError: If a normal moves of which no side is known everywhere.
        """
        from screwkit.mechanism.sides import without_sides  # noqa: PLC0415

        for joint in without_sides(self.mechanism):
            raise UndecidedError(
                f"no direction is known that is at right angles to the normal of joint "
                f"{joint.name!r} at every posture: along products of the normal with "
                f"axes of the base the joint would seem to lose a freedom where the "
                f"two are parallel; name one of constant length under `vectors`, if "
                f"there is one, or give numbers with --set"
            )

    @property
    def claims(self) -> tuple[Claim, ...]:
        """The expected values that the file records."""
        return self.mechanism.claims

    @property
    def variants(self) -> tuple[str, ...]:
        """Names of the variants that the file declares."""
        return tuple(variant.name for variant in self.mechanism.variants)

    @cached_property
    def assembly(self) -> Assembly:
        """The mechanism with its limbs resolved and its twists on demand.

        Raises:
            UndecidedError: If the mechanism is of a kind not analysed yet.
        """
        from screwkit.kinematics.assembly import Assembly  # noqa: PLC0415

        return Assembly(self.mechanism)

    @cached_property
    def graph(self) -> WholeGraph | None:
        """The whole joint graph, where the mechanism is no sum of nested limbs.

        None where its limbs say all, or loops tie joint variables together.
        """
        from screwkit.kinematics.whole_graph import WholeGraph  # noqa: PLC0415

        if self.network.tied:
            return None
        try:
            self.assembly.refuse_other_loops()
        except UndecidedError:
            return WholeGraph(self.mechanism)
        return None

    @cached_property
    def network(self) -> Network:
        """The mechanism as a graph of bodies and freedoms."""
        from screwkit.kinematics.network import Network  # noqa: PLC0415

        return Network(self.mechanism)

    @cached_property
    def grasp(self) -> GraspView:
        """The platform as a grasped object: labelled matrices G, J, D, H."""
        from screwkit.analyses.grasp_view import GraspView  # noqa: PLC0415

        return GraspView(self.mechanism)

    @cached_property
    def limbs(self) -> tuple[LimbView, ...]:
        """The limbs, with their twist and wrench systems on demand.

        Raises:
            UndecidedError: If the mechanism is of a kind not analysed yet.
        """
        from screwkit.analyses.limb_view import LimbView  # noqa: PLC0415

        return tuple(LimbView(self.assembly, limb) for limb in self.assembly.limbs)


def load(
    source: str | Path,
    set_values: Mapping[str, object] | None = None,
    actuated: Sequence[str] | None = None,
    variant: str | None = None,
    at: Mapping[str, object] | None = None,
) -> Case:
    """Read a mechanism file, or a bundled case by its name.

    Args:
        source: A path, or the name of a bundled case; with ``#name`` behind it, a
            variant of it.
        set_values: Numbers (or texts of constant expressions) for symbols of the file.
        actuated: Replaces the declared scheme; freedoms as in the file format.
        variant: One of the variants that the file declares; its values replace the
            file's, its claims too, and ``set_values`` act on top of it.
        at: Values of joint variables, and of the symbols that describe a posture.
            Where loops tie joint variables together, the mechanism is moved there from
            the posture of the file when a question is asked.

    Raises:
        UnknownCaseError: If there is no such file and no such bundled case.
        MechanismFileError: If the file is wrong.
        UnknownNameError: If ``set_values``, ``actuated`` or ``variant`` name what is
            not there, a freedom twice, or a second variant.
        ExpressionError: If a value is no constant expression.
        UnfitValueError: If a value contradicts what the file demands of its symbols.
    """
    path, referred = found(source)
    if variant is not None and referred is not None:
        raise UnknownNameError(
            f"two variants are named: {str(source)!r} is variant {referred!r}, and "
            f"{variant!r} is asked for; name one"
        )
    replaced = frozenset({*(set_values or ()), *(at or ())})
    mechanism = read_mechanism(path, Outside(replaced, _why_no_place))
    chosen = variant if variant is not None else referred
    given = Given(set_values or {}, at or {}, chosen, actuated)
    return _asked(mechanism, given, path)


def load_text(
    text: str,
    json: bool = False,
    set_values: Mapping[str, object] | None = None,
    actuated: Sequence[str] | None = None,
    variant: str | None = None,
    at: Mapping[str, object] | None = None,
    *,
    claims: bool = True,
) -> Case:
    """The case of a mechanism file's text; arguments and errors as of `load`.

    ``claims`` tells whether what the file expects will be compared, and so has to be
    about something that is answered.
    """
    replaced = frozenset({*(set_values or ()), *(at or ())})
    why_no_place = _why_no_place if claims else _no_fault
    outside = Outside(replaced, why_no_place)
    mechanism = mechanism_from_text(text, "the text", json, outside)
    given = Given(set_values or {}, at or {}, variant, actuated)
    return _asked(mechanism, given, None)


def _asked(mechanism: Mechanism, given: Given, path: Path | None) -> Case:
    """The case of a mechanism with everything that was asked of its file."""
    from screwkit.kinematics.given_values import placed_at, with_numbers  # noqa: PLC0415

    if given.variant is not None:
        mechanism = at_variant(mechanism, _variant(mechanism, given.variant))
    if given.set_values:
        mechanism = with_numbers(mechanism, given.set_values)
    if given.actuated is not None:
        mechanism = with_actuated(mechanism, given.actuated)
    _refuse_open_table(mechanism, path)
    wanted: dict[str, Expression] = {}
    unplaced = mechanism
    if given.at:
        mechanism, wanted = placed_at(mechanism, given.at)
    return Case(mechanism, wanted, path, given, unplaced)


def _no_fault(_question: str) -> str:
    return ""


def _why_no_place(question: str) -> str:
    from screwkit.reports.claim_places import why_no_place  # noqa: PLC0415

    return why_no_place(question)


def found(source: str | Path) -> tuple[Path, str | None]:
    """The file of a path or of a bundled case's name, and the variant named with it.

    Raises:
        UnknownCaseError: If there is neither.
    """
    case, mark, variant = str(source).rpartition("#")
    if not mark or Path(source).exists():
        return find(source), None
    return find(case), variant


def find(source: str | Path) -> Path:
    """The file of a path or of a bundled case's name.

    Raises:
        UnknownCaseError: If there is neither.
    """
    name = str(source)
    if not name.strip():
        raise UnknownCaseError(
            "the name of the case is empty; a file or a bundled case is expected "
            "(`screwkit cases` lists them)"
        )
    path = Path(source)
    if path.exists():
        return path
    bundled = {file.stem: file for file in _bundled_files()}
    if name in bundled:
        return bundled[name]
    if path.suffix or path.name != name:
        raise UnknownCaseError(f"no such file: {name!r}{_nearby(path, bundled)}")
    hint = did_you_mean(name, bundled) or "; `screwkit cases` lists the bundled ones"
    raise UnknownCaseError(f"no file and no bundled case {name!r}{hint}")


def _nearby(path: Path, bundled: Collection[str]) -> str:
    """The bundled case of that name, else the nearest file beside a missing one."""
    if path.stem in bundled:
        return f" (did you mean the bundled case {path.stem!r}?)"
    if not path.parent.is_dir():
        return f"; there is no folder {str(path.parent)!r}"
    beside = [file.name for file in path.parent.iterdir() if file.suffix == path.suffix]
    return did_you_mean(path.name, beside)


def bundled_cases() -> list[str]:
    """Names of the bundled cases, in alphabetical order."""
    return sorted(file.stem for file in _bundled_files())


def _bundled_files() -> list[Path]:
    """In an installed package beside the modules, in a checkout beside the package."""
    here = Path(__file__).parent
    for folder in (here / "bundled", here.parent / "cases"):
        if folder.is_dir():
            return sorted(folder.glob("*.yaml"))
    return []


def _variant(mechanism: Mechanism, name: str) -> Variant:
    known = {variant.name: variant for variant in mechanism.variants}
    if name in known:
        return known[name]
    hint = did_you_mean(name, known)
    if not hint:
        hint = f"; it has {', '.join(known)}" if known else "; it has none"
    raise UnknownNameError(f"no variant {name!r} of {mechanism.name}{hint}")


def _refuse_open_table(mechanism: Mechanism, path: Path | None) -> None:
    """A table that places a body twice must have a closed posture.

    Raises:
        MechanismFileError: If none is found.
    """
    from screwkit.kinematics.placement import why_tied  # noqa: PLC0415

    if mechanism.geometry != "mdh" or not why_tied(mechanism):
        return
    from screwkit.finite.table_search import closed_posture  # noqa: PLC0415
    from screwkit.kinematics.values import (  # noqa: PLC0415
        declared_values,
        with_values,
    )

    try:
        found = closed_posture(with_values(mechanism, declared_values(mechanism)))
    except UnknownNameError:
        return  # without numbers there is no posture to look at
    if found.closed:
        return
    row = [joint.name for joint in mechanism.joints].index(found.joint)
    place = (0, 0) if path is None else place_of(path, ("joints", row))
    twice = mechanism.joint(found.joint).child
    message = (
        f"the posture does not close: joint {found.joint!r} places {twice!r}, which "
        f"another row places already, and no values of the joint variables were found "
        f"that bring the two together (at best they miss by {found.miss:.2g}); check "
        f"the lengths, or attach it by a fixed joint without a row"
    )
    raise MechanismFileError(str(path or mechanism.name), (Fault(*place, message),))
