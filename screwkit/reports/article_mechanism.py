"""The mechanism as an article describes it: geometry table, symbols, limbs."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from typing import Final

from screwkit.algebra.names import counted, limb_called
from screwkit.reports.blocks import (
    Block,
    Citation,
    Column,
    Heading,
    Loose,
    Math,
    Paragraph,
    Reference,
    Table,
    Text,
    Words,
    joined,
    math,
    prose,
    words,
)
from screwkit.results.analysis import Description

_SIGMA: Final = {"revolute": "0", "prismatic": "1", "fixed": "2"}
_MDH: Final = frozenset({"gamma", "b", "alpha", "d", "theta", "r"})


def mechanism_section(description: Description) -> tuple[Block, ...]:
    """Section 1."""
    intro: list[Text] = [
        words(
            f"The mechanism has {counted(description.links, 'body', 'bodies')}; "
            f"{_ends(description)}."
        )
    ]
    if description.limbs:
        limbs = [
            f"{limb_called(name)} with {_joints(joints)}"
            for name, joints in description.limbs
        ]
        several = "limb is" if len(limbs) == 1 else "limbs are"
        intro.append(words(f"Its {several} {'; '.join(limbs)}."))
    if description.source:
        intro.append(words(f"Source: {description.source.rstrip('.')}."))
    blocks: list[Block] = [Heading(words("The mechanism"), 1)]
    if description.rows:
        intro.append(
            (
                Words("Its geometry is given in Table "),
                Reference("table:geometry", "1"),
                Words("."),
            )
        )
    blocks.append(Paragraph(joined(intro, " ")))
    if description.rows:
        blocks.append(geometry_table(description))
    if description.values:
        blocks.append(values_table(description))
    return tuple(blocks)


def _ends(description: Description) -> str:
    """Which bodies are base and platform, said once where they are called so."""
    base, platform = description.base, description.platform
    if base == platform:
        return f"{base} is both base and platform"
    first = "one is the base" if base == "base" else f"{base} is the base"
    if platform == "platform":
        last = "another the platform" if base == "base" else "one the platform"
    else:
        last = f"{platform} the platform"
    return f"{first}, {last}"


def _joints(joints: tuple[str, ...]) -> str:
    noun = "joint" if len(joints) == 1 else "joints"
    return f"{noun} {', '.join(joints)}"


def geometry_table(description: Description) -> Table:
    """Table 1: MDH parameters in the manner of the literature, else what there is."""
    is_mdh = _MDH.issuperset(description.columns) and "alpha" in description.columns
    as_sigma = is_mdh and all(row.type in _SIGMA for row in description.rows)
    heads = [
        Column(math("j"), "centre"),
        Column((Loose("a(j)"),) if is_mdh else words("parent"), "centre"),
        Column(math("sigma") if as_sigma else words("type"), "centre"),
    ]
    wide = max(
        map(len, (p for row in description.rows for p in row.parameters)), default=0
    )
    for column in description.columns:
        align = "wrap" if not is_mdh and wide > 24 else "centre"
        head = math(column) if is_mdh else words(column)
        heads.append(Column(head, "wrap" if align == "wrap" else "centre"))
    rows = tuple(
        (
            words(row.joint),
            words(row.antecedent),
            words(_SIGMA[row.type] if as_sigma else row.type),
            *(_entry(text) for text in row.parameters),
        )
        for row in description.rows
    )
    caption: Text = words("Geometry of the joints")
    if is_mdh:
        caption = (
            Words("MDH parameters "),
            Citation("KhalilKleinfinger1986"),
            Words("; "),
            Math("sigma"),
            Words(": 0 revolute, 1 prismatic, 2 fixed")
            if as_sigma
            else Words("j the joint, a(j) its antecedent"),
        )
    return Table(tuple(heads), rows, caption, "table:geometry", long=len(rows) > 24)


def _entry(text: str) -> Text:
    """A cell of the geometry table: mathematics where it is a single expression."""
    return math(text) if text and text[0] not in "[(" else prose(text)


def _value(text: str) -> Text:
    """A value; short decimals as decimals."""
    if not text:
        return words("free")
    try:
        exact = Fraction(text.replace(" ", ""))
    except ValueError:
        return math(text)
    scaled = exact * 10**6
    if scaled.denominator != 1:
        return math(text)
    return words(f"{Decimal(scaled.numerator) / 10**6:f}".replace("-", "−"))


def values_table(description: Description) -> Table:
    """The symbols with their values and what is assumed of them."""
    unit = f" ({description.units})" if description.units else ""
    columns = (
        Column(words("Symbol")),
        Column(words(f"Value{unit}"), "right"),
        Column(words("Assumed")),
    )
    rows = tuple(
        (
            math(name),
            _value(value),
            (Math(f"{name} {assumption}"),)
            if assumption.startswith((">", "<", "!", "≠"))
            else words(assumption),
        )
        for name, value, assumption in description.values
    )
    return Table(columns, rows, words("Symbols"), "table:symbols", long=len(rows) > 24)
