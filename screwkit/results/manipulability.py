"""What `manipulability` answers: who moves with whom, and how well.

Twists are (ω; v) with v of the reference point, wrenches (f; m) about it; planar files
have (ωz; vx, vy) and (fx, fy; mz).  Exact quantities are texts of the grammar.
"""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.results.partition import Partition
from screwkit.results.scene import Scene
from screwkit.results.shown import Shown
from screwkit.results.undecided import Undecided


@dataclass(frozen=True)
class Statics:
    """What contact forces can do; dimensions of the blocks of eq. (19).

    Attributes:
        admissible: Of the contact forces that passive joints let through.
        transmitted: Of those that turn torques into wrenches.
        internal: Of the torques that leave the object in balance.
        structural: Of the wrenches that are balanced without torque.
        indeterminacy: Of the contact forces that neither torques nor wrenches tell.
        structural_wrenches: A basis, exact.
        internal_torques: A basis, exact, in the order of the actuated freedoms.
        balances_all: Whether every wrench on the object can be balanced.

    References: [BicchiPrattichizzo] eqs. (15)-(19).
    """

    admissible: int
    transmitted: int
    internal: int
    structural: int
    indeterminacy: int
    structural_wrenches: tuple[tuple[str, ...], ...] = ()
    internal_torques: tuple[tuple[str, ...], ...] = ()
    balances_all: bool = True


@dataclass(frozen=True)
class IndexValues:
    """One index: its stationary values and where they are taken.

    Attributes:
        finite: In descending order.
        infinite: How many are infinite, counted exactly.
        zero: How many are zero, counted exactly.
        directions: For each finite value the object's twist or wrench, of unit length;
            of the internal index the contact forces, component by component.
        joint_directions: The actuated rates or torques that go with it, of unit length.
        infinite_directions: Directions of the object with infinite values.
        zero_directions: Actuated directions with the value zero.
        polynomial: Exact, in x, its roots are the finite values; empty where it is not
            short.
        exact: The finite values where they are short expressions, as `finite`.
    """

    finite: tuple[float, ...] = ()
    infinite: int = 0
    zero: int = 0
    directions: tuple[tuple[float, ...], ...] = ()
    joint_directions: tuple[tuple[float, ...], ...] = ()
    infinite_directions: tuple[tuple[float, ...], ...] = ()
    zero_directions: tuple[tuple[float, ...], ...] = ()
    polynomial: str = ""
    exact: tuple[str, ...] = ()


@dataclass(frozen=True)
class Ellipsoid:
    """An ellipsoid by its axes.

    Attributes:
        semi_axes: In descending order.
        directions: Of unit length, as many.
        infinite: How many semi-axes are infinite; they are not among the others.
        linear: Semi-axes of its part in velocities of the reference point, or in
            forces, as vectors in base axes.
    """

    semi_axes: tuple[float, ...] = ()
    directions: tuple[tuple[float, ...], ...] = ()
    infinite: int = 0
    linear: tuple[tuple[float, ...], ...] = ()


@dataclass(frozen=True)
class ArmEllipsoids:
    """One arm as if it held the object alone.

    Attributes:
        joints: Its freedoms.
        shares: Of the system's effort along each axis of the absolute velocity
            ellipsoid, between 0 and 1; empty where the rule does not apply.
    """

    name: str
    joints: tuple[str, ...]
    absolute_velocity: Ellipsoid
    external_force: Ellipsoid
    shares: tuple[float, ...] = ()


@dataclass(frozen=True)
class Cooperative:
    """Several arms with one object.

    Attributes:
        rule: Whether the arms combine in parallel (30) and in series (37); where a
            contact slips, a joint is passive or a Jacobian lacks row rank they do not,
            and the reason stands here.

    References: [ChiacchioEtAl1990]; beyond two arms as `screwkit.metrics.arms` defines.
    """

    absolute_velocity: Ellipsoid
    external_force: Ellipsoid
    relative_velocity: Ellipsoid
    internal_force: Ellipsoid
    arms: tuple[ArmEllipsoids, ...]
    rule: str = ""


@dataclass(frozen=True)
class ContactPlace:
    """Where the object is held.

    Attributes:
        joint: The joint or contact.
        kind: In words.
        limb: Which limb holds there; empty outside limbs.
        point: In base coordinates; where its forces are taken.
        components: The components that it transmits, in base axes or its own.
    """

    joint: str
    kind: str
    limb: str
    point: tuple[float, ...]
    components: tuple[str, ...]


@dataclass(frozen=True)
class PostureNote:
    """The posture at which the numbers hold.

    Attributes:
        variables: Symbols and joint variables.
        values: Theirs.
        exact: Whether ranks are exact; otherwise they are counts of singular values.
        gap: Smallest ratio of a singular value that counts to one that does not, where
            they are counted.
    """

    variables: tuple[str, ...] = ()
    values: tuple[float, ...] = ()
    exact: bool = True
    gap: float | None = None


@dataclass(frozen=True)
class SymbolicIndices:
    """Polynomials whose roots are the values, for all values of the symbols.

    Attributes:
        kinematic: Of (13); empty where it is not short, or the file has no symbols.
        unknown: What the value is called there: x, unless the file has a symbol x.
    """

    kinematic: str = ""
    unknown: str = "x"


@dataclass(frozen=True, repr=False)
class Manipulability(Shown):
    """The answer.

    Attributes:
        actuated, passive: Freedoms in the order of rates.
        all_actuated: Whether the file declares no scheme and all joints are taken.
        space: ``spatial`` or ``planar``.
        order: ``direction-moment``.
        frame: The base link.
        point: The reference point, in base coordinates.
        kinematic: (13); ``infinite`` and ``zero`` as in (8).
        force: (24).
        active_force: (20), with zeros for internal torques.
        passive_force: (21), with infinite values for structural wrenches.
        internal_force: (22), (23).
        translation: Semi-axes of the velocities of the reference point alone.
        rotation: Of the angular velocities alone.
        forces: Semi-axes of the forces on the platform alone, for unit torques.
        cooperative: For two or more arms.
        scene: The mechanism as it stands, for pictures; None where it is too large.
        symbolic: The same in the symbols of the file.
        units: What the numbers mix, and by which measure; empty where nothing is mixed.
        differences: What is special about the posture.

    References: [BicchiPrattichizzo], [BicchiMelchiorri], [ChiacchioEtAl1990].
    """

    case: str
    title: str
    contacts: tuple[ContactPlace, ...]
    actuated: tuple[str, ...]
    passive: tuple[str, ...]
    all_actuated: bool
    space: str
    order: str
    frame: str
    point: tuple[float, ...]
    posture: PostureNote
    partition: Partition
    statics: Statics
    kinematic: IndexValues
    force: IndexValues
    active_force: IndexValues
    passive_force: IndexValues
    internal_force: IndexValues
    translation: Ellipsoid
    rotation: Ellipsoid
    forces: Ellipsoid
    cooperative: Cooperative | Undecided
    scene: Scene | None = None
    symbolic: SymbolicIndices = SymbolicIndices()
    platform_name: str = ""
    units: str = ""
    differences: tuple[str, ...] = ()
