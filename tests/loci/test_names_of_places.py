"""A point in which axes meet is called as the file calls it, where it does."""

from __future__ import annotations

import screwkit
from screwkit.loci.features import Statement, statements
from screwkit.loci.placed_features import features_of


def words_about(statement_of: str, *joints: str) -> set[str]:
    """What may be said of some joints' axes in a mechanism."""
    framed = screwkit.load(statement_of).assembly.common_twists
    found: list[Statement] = [*statements(features_of(framed))]
    return {own.words for own in found if {*own.joints} == {*joints}}


def test_points_of_the_file_name_the_places_where_axes_meet() -> None:
    """Points B1 and C1 are the centres of the universal joints of the first leg."""
    framed = screwkit.load("4ruu").assembly.common_twists
    names = {point.name for point in features_of(framed).points}
    assert {f"{letter}{leg}" for letter in "BC" for leg in "1234"} <= names
    told = words_about("4ruu", "U12:0", "U12:1", "U13:0", "U13:1", "R11")
    assert "the line through C1 and B1 meets axis R11" in told


def test_axes_name_them_where_the_file_does_not() -> None:
    framed = screwkit.load("puma").assembly.common_twists
    names = {point.name for point in features_of(framed).points}
    assert "the common point of axes 4, 5 and 6" in names
