"""Hand-made answers about the two-armed humanoid: what renderers are tested on.

The facts follow Long, Caro and Khalil (2012) in the robot's own angles; they are
written down here, not computed, so that reports can be tested without the engine.
"""

from __future__ import annotations

from screwkit.results.analysis import Analysis, ClaimCheck, Description, JointRow
from screwkit.results.mobility import (
    Actuation,
    Counts,
    FullCycle,
    Mobility,
    MotionCase,
    Platform,
    SpecialValues,
    Topology,
    Working,
)
from screwkit.results.partition import Partition
from screwkit.results.schemes import (
    Balanced,
    LocusFactor,
    MirrorClasses,
    Refusal,
    Scheme,
    Schemes,
)
from screwkit.results.screws import (
    ActuationWrench,
    IdentifiedScrew,
    LimbScrews,
    PlatformScrews,
    Screws,
)
from screwkit.results.singularities import (
    ActuationSingularities,
    Component,
    ConstraintSingularities,
    Intersection,
    LimbSingularities,
    Singularities,
)
from screwkit.results.solution import Solution
from screwkit.results.undecided import Undecided

CASE = "nao_t14"
TITLE = "Two five-joint arms of a humanoid holding one object"
T2 = "r3*cos(q2) + d3*sin(q2)"
T7 = "r3*cos(q7) - d3*sin(q7)"
LONG = " + ".join(f"d3*r1*cos(q{k})*sin(q{k + 1})*cos(q9 - q{k})" for k in range(1, 61))

PLATFORM = Platform(
    twist_dimension=4,
    translations=1,
    rotations=3,
    motion_type="1T3R",
    wrench_dimension=2,
    couples=0,
    finite_motion_types=("1T3R",),
    cases=(
        MotionCase((), (), "1T3R", "the two constraint forces are skew"),
        MotionCase(
            ("sin(q6 - q1)",),
            ("q6 = q1 (mod pi)",),
            "1T3R",
            "they meet: rotations about their common point",
        ),
        MotionCase(
            ("sin(q6 - q1)", "sin(q2 - q7 - 2*atan(d3/r3))"),
            ("q6 = q1", "q2 - q7 = 2*atan(d3/r3) (mod pi)"),
            "2T2R",
            "they are parallel",
        ),
    ),
)

MOBILITY = Mobility(
    case=CASE,
    title=TITLE,
    topology=Topology(12, 12, 10, 1, 1),
    counts=Counts(4, None, 4, 4, 4),
    workings=(
        Working("Grübler–Kutzbach", "10 − 6·1", 4, "", "LongCaroKhalil2012, (14)"),
        Working(
            "Moroskine",
            "10 − rank Jc = 10 − 6",
            4,
            "",
            "LongCaroKhalil2012, (16)",
        ),
        Working(
            "Gogu",
            "10 − (5 + 5) + dim(E_right ∩ E_left) = 0 + 4",
            4,
            "the intersection of the two subspaces, not of coordinate bases",
            "LongCaroKhalil2012, (19)",
        ),
        Working("screws", "6 − dim(W_right + W_left) = 6 − 2", 4),
    ),
    loop_rank=6,
    redundant_constraints=0,
    instantaneous_mobility=4,
    full_cycle=FullCycle(
        "proved", (4,), "all joint variables are free, every posture is closed"
    ),
    platform=PLATFORM,
    actuation=Actuation(("1", "2", "3", "7"), 0, 0),
    partition=Partition(4, 4, 0, 0),
    at_values=SpecialValues(
        loop_rank=6,
        redundant_constraints=0,
        instantaneous_mobility=4,
        platform=PLATFORM,
        actuation=Actuation(("1", "2", "3", "7"), 0, 0),
        full_cycle=FullCycle("proved", (4,), "every posture is closed"),
    ),
    platform_name="object",
)

_FORCE_RIGHT = IdentifiedScrew(
    coordinates=(
        f"cos(q1)*({T2})",
        "r3*sin(q2) - d3*cos(q2)",
        f"-sin(q1)*({T2})",
        "b1*d3*cos(q2) - b1*r3*sin(q2) - r1*sin(q1)*r3*cos(q2)",
        f"b1*cos(q1)*({T2})",
        f"r1*cos(q1)*({T2})",
    ),
    kind="force",
    axis=(f"cos(q1)*({T2})", "r3*sin(q2) - d3*cos(q2)", f"-sin(q1)*({T2})"),
    point=("0", "-r1", "b1"),
    pitch="0",
    description="through the centres of the universal and spherical joints, O1 A",
)
_TWISTS = tuple(
    IdentifiedScrew(coordinates, "rotation", coordinates[:3], ("0", "-r1", "b1"), "0")
    for coordinates in (
        ("0", "1", "0", "-b1", "0", "0"),
        ("sin(q1)", "0", "cos(q1)", "-r1*cos(q1)", "b1*sin(q1)", "r1*sin(q1)"),
    )
)

SCREWS = Screws(
    case=CASE,
    title=TITLE,
    order="direction-moment",
    frame="torso",
    point="origin",
    limbs=(
        LimbScrews("right", ("1", "2", "3", "4", "5"), 5, _TWISTS, 1, (_FORCE_RIGHT,)),
        LimbScrews("left", ("6", "7", "8", "9", "10"), 5, _TWISTS, 1, (_FORCE_RIGHT,)),
    ),
    platform=PlatformScrews(
        4,
        (
            IdentifiedScrew(
                ("0", "0", "0", "cos(q1)", "0", "-sin(q1)"),
                "translation",
                ("cos(q1)", "0", "-sin(q1)"),
                (),
                "",
                "along the common normal of the two forces",
            ),
        ),
        2,
        (_FORCE_RIGHT,),
    ),
    actuation_wrenches=(
        ActuationWrench("1", 0, "right", _FORCE_RIGHT),
        ActuationWrench("5", 0, "right", None),
    ),
)

ATAN_RIGHT = Solution("q2", ("atan(-r3/d3)", "atan(-r3/d3) + pi"), "pi")
ATAN_LEFT = Solution("q7", ("atan(r3/d3)", "atan(r3/d3) - pi"), "pi")
Q3 = Solution("q3", ("pi/2", "-pi/2"), "pi")
Q4 = Solution("q4", ("0", "pi"), "pi")
Q8 = Solution("q8", ("pi/2", "-pi/2"), "pi")
Q9 = Solution("q9", ("0", "pi"), "pi")
MEETING = Solution("q6", ("q1", "q1 + pi"), "pi")


def _constraint(equations: tuple[str, ...], *solutions: Solution) -> Component:
    return Component(
        equations,
        len(equations),
        solutions,
        5,
        "both limbs can carry a force along the shoulder line",
        wrench_dimension=3,
        platform_freedom=3,
        mobility=5,
    )


SINGULARITIES = Singularities(
    case=CASE,
    title=TITLE,
    limb=(
        LimbSingularities(
            "right",
            ("1", "2", "3", "4", "5"),
            5,
            True,
            (
                Component(("sin(q4)",), 1, (Q4,), 4, "axes 3 and 5 are one line"),
                Component(
                    (T2,), 1, (ATAN_RIGHT,), 4, "the wrist centre A lies on axis 1"
                ),
            ),
            (Intersection((0, 1), ("cos(q3)",), 3),),
            "each of the six minors is ± sin q4 · (r3 cos q2 + d3 sin q2) times a "
            "coordinate of the line O1 A, and these never vanish together",
        ),
        LimbSingularities(
            "left",
            ("6", "7", "8", "9", "10"),
            5,
            True,
            (
                Component(("sin(q9)",), 1, (Q9,), 4, "axes 8 and 10 are one line"),
                Component(
                    (T7,), 1, (ATAN_LEFT,), 4, "the wrist centre B lies on axis 6"
                ),
            ),
            (Intersection((0, 1), ("cos(q8)",), 3),),
            "by the same argument",
        ),
    ),
    constraint=ConstraintSingularities(
        6,
        False,
        (
            _constraint((T2, T7), ATAN_RIGHT, ATAN_LEFT),
            _constraint((T2, "sin(q9)", "cos(q8)"), ATAN_RIGHT, Q9, Q8),
            _constraint((T7, "sin(q4)", "cos(q3)"), ATAN_LEFT, Q4, Q3),
            _constraint(
                ("sin(q4)", "cos(q3)", "sin(q9)", "cos(q8)"),
                Q4,
                Q3,
                Q9,
                Q8,
            ),
        ),
        reason="sets of codimension 4 and more were not exhausted",
    ),
    actuation=ActuationSingularities(
        ("1", "2", "3", "7"),
        True,
        6,
        True,
        (
            Component(
                ("sin(q6 - q1)",),
                1,
                (MEETING,),
                5,
                "the planes of axes 1, 2 and of 6, 7 coincide",
                platform_freedom=1,
            ),
            Component(
                ("r1*cos(q3)*cos(q4) - d3*cos(q6 - q1)*sin(q4)",),
                1,
                (),
                5,
                "B in the plane of axes 4 and 5",
                platform_freedom=1,
            ),
            Component((T2,), 1, (ATAN_RIGHT,), 5, None, platform_freedom=1),
        ),
        idle=(
            Component(("sin(q9)",), 1, (Q9,), 5),
            Component((T7,), 1, (ATAN_LEFT,), 5),
        ),
    ),
    assumptions=("d3 > 0", "r1 > 0", "r3 > 0"),
    platform_name="object",
)

SHOULDER = "their axes are one line: arms and object swing about it"
SCHEMES = Schemes(
    case=CASE,
    title=TITLE,
    size=4,
    total=210,
    admissible=139,
    balanced=Balanced(100, 63),
    schemes=(
        Scheme(("1", "2", "6", "7"), False, 5, reason="the line A B meets all forces"),
        Scheme(("2", "3", "4", "5"), False, 5, reason=SHOULDER),
        Scheme(
            ("1", "8", "9", "10"),
            True,
            6,
            ("cos(q6 - q1)", "sin(q4)", T2),
            (1, 1, 2),
            ("sin(q4)",),
        ),
        Scheme(
            ("1", "2", "4", "5"),
            True,
            6,
            ("sin(q6 - q1)", "sin(q9)", T7, "d3 + 2*r1*cos(q2)"),
            (1, 1, 2, 1),
            ("sin(q9)",),
        ),
        Scheme(
            ("1", "2", "3", "7"),
            True,
            6,
            ("sin(q6 - q1)", "sin(q9)", T7, T2, LONG),
            (1, 1, 1, 1, 1),
            ("sin(q9)", T7),
            balanced=False,
            mirror=("6", "7", "8", "2"),
        ),
    ),
    factors=(
        LocusFactor("sin(q4)", "axes 3 and 5 are one line", 1, 54),
        LocusFactor(T2, "the wrist centre A lies on axis 1", 2, 33),
        LocusFactor(LONG, None, 60, 1),
    ),
    refusals=(
        Refusal(f"1 and 6 both passive: {SHOULDER}", 70, ("2", "3", "4", "5")),
        Refusal(
            "all forces meet the line through the wrist centres A and B",
            1,
            ("1", "2", "6", "7"),
        ),
    ),
    mirror=MirrorClasses(
        (("1", "6"), ("2", "7"), ("3", "8"), ("4", "9"), ("5", "10")),
        (110, 10),
        (71, 3),
        (55, 10),
        (33, 3),
    ),
    left_out=("d3", "r1"),
)


def _row(joint: str, antecedent: str, *parameters: str) -> JointRow:
    return JointRow(joint, "revolute", antecedent, parameters, f"q{joint}")


DESCRIPTION = Description(
    case=CASE,
    title=TITLE,
    source="Long, Caro, Khalil 2012",
    units="m",
    base="torso",
    platform="object",
    links=12,
    columns=("gamma", "b", "alpha", "d", "theta", "r"),
    rows=(
        _row("1", "0", "0", "b1", "-pi/2", "0", "q1", "-r1"),
        _row("2", "1", "0", "0", "pi/2", "0", "q2 + pi/2", "0"),
        _row("3", "2", "0", "0", "pi/2", "-d3", "q3", "r3"),
        _row("4", "3", "0", "0", "-pi/2", "0", "q4", "0"),
        _row("5", "4", "0", "0", "pi/2", "0", "q5", "r5"),
        _row("6", "0", "0", "b1", "-pi/2", "0", "q6", "r1"),
        _row("7", "6", "0", "0", "pi/2", "0", "q7 + pi/2", "0"),
        _row("8", "7", "0", "0", "pi/2", "d3", "q8", "r3"),
        _row("9", "8", "0", "0", "-pi/2", "0", "q9", "0"),
        _row("10", "9", "0", "0", "pi/2", "0", "q10", "r5"),
    ),
    values=(
        ("b1", "1/10", "> 0"),
        ("r1", "49/500", "> 0"),
        ("d3", "3/200", "> 0"),
        ("r3", "21/200", "> 0"),
        ("r5", "1137/10000", ""),
    ),
    limbs=(
        ("right", ("1", "2", "3", "4", "5")),
        ("left", ("6", "7", "8", "9", "10")),
    ),
)

ANALYSIS = Analysis(
    case=CASE,
    title=TITLE,
    description=DESCRIPTION,
    mobility=MOBILITY,
    screws=SCREWS,
    singularities=SINGULARITIES,
    schemes=SCHEMES,
    manipulability=Undecided("the length 'd5' has no value; give one with --set"),
    claims=(
        ClaimCheck(
            "mobility.instantaneous_mobility",
            4,
            4,
            True,
            "published",
            "Long, Caro, Khalil 2012, equation (15)",
        ),
        ClaimCheck(
            "schemes.total",
            100,
            210,
            False,
            "published",
            "Long, Caro, Khalil 2012, section 5.2.2",
            holds=False,
            note="100 is the number with two actuators in each arm",
        ),
        ClaimCheck(
            "singularities.limb.right", [T2], None, None, "derived", "six minors"
        ),
    ),
)

REFUSED = Undecided(
    "expanding 6 wrenches, 36 symbols: about 15 million terms, 2.3 GB, more than the "
    "2.0 GB allowed; try: fix the gauge (A1 = B1 = 0), or --set some of the dimensions"
)
