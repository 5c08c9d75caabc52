"""What the kinds of screw systems are called, for twists and for wrenches.

One sentence a kind serves both: a rotation about a line is to twists what a force along
it is to wrenches, a translation what a couple is.  Words in braces are filled with the
system's own lines and planes where they are known.

References: [Herve1999], [Hunt1978], ch. 12.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from screwkit.systems.screw_shapes import Kind

TWISTS: Mapping[str, str] = {
    "rotation": "rotation about",
    "rotations": "rotations about",
    "translation": "translation along",
    "translations": "translations",
    "all_translations": "all translations",
    "helix": "helical motion about",
    "helices": "helical motions about",
    "one": "a rotation",
    "many": "rotations",
    "held": "wrench",
    "held_one": "a force",
    "held_many": "forces",
    "rest": "no motion",
    "everything": "all motions",
}
WRENCHES: Mapping[str, str] = {
    "rotation": "force along",
    "rotations": "forces along",
    "translation": "couple about",
    "translations": "couples",
    "all_translations": "all couples",
    "helix": "wrench along",
    "helices": "wrenches along",
    "one": "a force",
    "many": "forces",
    "held": "twist",
    "held_one": "a rotation",
    "held_many": "rotations",
    "rest": "no wrench",
    "everything": "all wrenches",
}


@dataclass(frozen=True)
class Words:
    """How a kind is spoken of.

    Attributes:
        motion: Name as a system of twists.
        wrenches: Name as a system of wrenches.
        sentence: What it consists of.
    """

    motion: str
    wrenches: str
    sentence: str


SUBGROUPS: frozenset[tuple[Kind, bool]] = frozenset(
    {
        (Kind.NOTHING, False),
        (Kind.ROTATION, False),
        (Kind.HELIX, False),
        (Kind.TRANSLATION, False),
        (Kind.CYLINDER, False),
        (Kind.TRANSLATIONS_OF_PLANE, False),
        (Kind.ALL_TRANSLATIONS, False),
        (Kind.PLANAR, False),
        (Kind.PLANAR_HELICES, False),
        (Kind.BUNDLE, False),
        (Kind.TRANSLATIONS_OF_PLANE, True),
        (Kind.NOTHING, True),
    }
)
"""The conjugacy classes of the Lie algebras of twists, all of them [Herve1999]."""

WORDS: Mapping[tuple[Kind, bool], Words] = {
    (Kind.NOTHING, False): Words("no motion", "no wrench", "{rest}"),
    (Kind.TRANSLATION, False): Words(
        "translation", "couple", "{translation} {direction}"
    ),
    (Kind.TRANSLATIONS_OF_PLANE, False): Words(
        "planar translation", "couples of a plane", "{translations} {across_normal}"
    ),
    (Kind.ALL_TRANSLATIONS, False): Words(
        "spatial translation", "all couples", "{all_translations}"
    ),
    (Kind.ROTATION, False): Words("rotation", "force", "{rotation} {axis}"),
    (Kind.HELIX, False): Words("helical motion", "wrench", "{helix} {axis}, {pitch}"),
    (Kind.CYLINDER, False): Words(
        "cylindrical motion",
        "force and couple of one axis",
        "{rotation} {axis}, and {translation} its direction",
    ),
    (Kind.PARALLEL_LINES, False): Words(
        "rotations about parallel lines of a plane",
        "parallel forces of a plane",
        "{rotations} all lines in {plane} parallel to {direction}, "
        "and {translation} its normal",
    ),
    (Kind.PARALLEL_HELICES, False): Words(
        "helical motions about parallel lines of a plane",
        "parallel wrenches of a plane",
        "{helices} all lines in {plane} parallel to {direction}, {pitch}, "
        "and {translation} its normal",
    ),
    (Kind.OBLIQUE, False): Words(
        "rotation and oblique translation",
        "force and oblique couple",
        "{rotation} {axis}, and {translation} {second}, oblique to it",
    ),
    (Kind.PLANAR, False): Words(
        "planar motion",
        "parallel forces",
        "{rotations} all lines parallel to {direction}, "
        "and {translations} normal to it",
    ),
    (Kind.PLANAR_HELICES, False): Words(
        "planar translation with a helical motion",
        "parallel wrenches",
        "{helices} all lines parallel to {direction}, {pitch}, "
        "and {translations} normal to it",
    ),
    (Kind.LINES_AND_TRANSLATIONS, False): Words(
        "planar translation and rotations about parallel lines of a plane",
        "couples and parallel forces of a plane",
        "{rotations} all lines in {plane} parallel to {direction}, "
        "and {translations} {across_second}",
    ),
    (Kind.FLAT_PENCIL, False): Words(
        "flat pencil of rotations",
        "flat pencil of forces",
        "{rotations} all lines through {point} in {flat}",
    ),
    (Kind.HELICAL_PENCIL, False): Words(
        "flat pencil of helical motions",
        "flat pencil of wrenches",
        "{helices} all lines through {point} in {flat}, {pitch}",
    ),
    (Kind.CYLINDROID, False): Words(
        "cylindroid",
        "cylindroid",
        "two independent screws, all axes crossing {central} at right angles{real}",
    ),
    (Kind.FIELD, False): Words(
        "planar field of rotations",
        "forces of a plane",
        "{rotations} all lines in {plane}, and {translation} its normal",
    ),
    (Kind.HELICAL_FIELD, False): Words(
        "planar field of helical motions",
        "wrenches of a plane",
        "{helices} all lines in {plane}, {pitch}, and {translation} its normal",
    ),
    (Kind.CYLINDROID_AND_NORMAL, False): Words(
        "cylindroid and the translation along its axis",
        "cylindroid and the couple about its axis",
        "{translation} {normal}, and two independent screws normal to it"
        "{real_directions}",
    ),
    (Kind.PENCIL_AND_TRANSLATION, False): Words(
        "flat pencil of rotations and a translation",
        "flat pencil of forces and a couple",
        "{rotations} all lines through {point} in {flat}, and {translation} {second}",
    ),
    (Kind.CYLINDROID_AND_TRANSLATION, False): Words(
        "cylindroid and a translation",
        "cylindroid and a couple",
        "{translation} {second}, and two independent screws {across_normal}",
    ),
    (Kind.BUNDLE, False): Words(
        "spherical motion",
        "forces through a point",
        "{rotations} all lines through {point}",
    ),
    (Kind.HELICAL_BUNDLE, False): Words(
        "helical motions about all lines through a point",
        "wrenches along all lines through a point",
        "{helices} all lines through {point}, {pitch}",
    ),
    (Kind.PENCIL_AND_NORMAL, False): Words(
        "flat pencil of rotations and a helical motion across it",
        "flat pencil of forces and a wrench across it",
        "{rotations} all lines through {point} in {flat}, "
        "and {helix} the line through it along {normal}, {second_pitch}",
    ),
    (Kind.OF_REVOLUTION, False): Words(
        "three-system of revolution",
        "three-system of revolution",
        "{helices} all lines through {point} in {flat}, {pitch}, "
        "and {helix} the line through it along {normal}, {second_pitch}",
    ),
    (Kind.GENERAL, False): Words(
        "general three-system",
        "general three-system",
        "three independent screws, the axes of the principal ones meeting in {point}"
        "{real_of_three}",
    ),
    # -- four and more: the elements are those of the reciprocal system -------------
    (Kind.NOTHING, True): Words("spatial motion", "all wrenches", "{everything}"),
    (Kind.TRANSLATION, True): Words(
        "all translations and a plane of rotation directions",
        "all couples and a plane of force directions",
        "{all_translations}, and {rotations} all lines normal to {direction}",
    ),
    (Kind.TRANSLATIONS_OF_PLANE, True): Words(
        "Schönflies motion",
        "all couples and parallel forces",
        "{all_translations}, and {rotations} all lines parallel to {normal}",
    ),
    (Kind.ROTATION, True): Words(
        "special linear complex of rotations",
        "special linear complex of forces",
        "{rotations} all lines that meet or are parallel to {axis}, "
        "and {translations} normal to it",
    ),
    (Kind.HELIX, True): Words(
        "linear complex",
        "linear complex",
        "all that is reciprocal to a {held} along {axis}, {pitch}",
    ),
    (Kind.CYLINDER, True): Words(
        "rotations about the lines across an axis",
        "forces along the lines across an axis",
        "{rotations} all lines that cross {axis} at right angles, "
        "and {translations} normal to it",
    ),
    (Kind.OBLIQUE, True): Words(
        "rotations about lines of a plane's directions that meet an axis",
        "forces along lines of a plane's directions that meet an axis",
        "{rotations} all lines normal to {second} that meet {axis}, "
        "and {translations} normal to that axis",
    ),
    (Kind.PARALLEL_LINES, True): Words(
        "planar field of rotations and a translation",
        "forces of a plane and a couple",
        "{rotations} all lines in {plane}, and {translations} normal to {direction}",
    ),
    (Kind.PARALLEL_HELICES, True): Words(
        "rotations and helical motions of a plane's directions",
        "forces and wrenches of a plane's directions",
        "{translations} normal to {direction}, and two independent screws "
        "{across_normal}, reciprocal to a {held} along {direction}, {pitch}",
    ),
    (Kind.FLAT_PENCIL, True): Words(
        "spherical motion and a translation",
        "forces through a point and a couple",
        "{rotations} all lines through {point}, and {translation} {normal}",
    ),
    (Kind.HELICAL_PENCIL, True): Words(
        "four-system of equal pitches",
        "four-system of equal pitches",
        "{translation} {normal}, and screws of all directions, reciprocal to a {held} "
        "along any line through {point} in {flat}, {pitch}",
    ),
    (Kind.CYLINDROID, True): Words(
        "general four-system",
        "general four-system",
        "{translation} {normal}, and screws of all directions{held_real}",
    ),
}
