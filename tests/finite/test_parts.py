"""What proofs say of parts of a mechanism."""

from __future__ import annotations

from finite.linkages import hinge, network

from screwkit.finite.finite_proofs import proved_mobility


def test_a_shaky_part_is_not_called_the_whole() -> None:
    """A hinge carries a flat loop of bars that are all stretched: the hinge moves."""
    places = [(0, 0, 0), (1, 0, 0), (3, 0, 0), (6, 0, 0)]
    ends = (("b", "c"), ("c", "d"), ("d", "e"), ("e", "b"))
    flat = [
        hinge(f"J{k}", one, other, place)
        for k, ((one, other), place) in enumerate(zip(ends, places, strict=True))
    ]
    of = network(hinge("root", "base", "b", (9, 9, 9), (1, 0, 0)), *flat, platform="d")
    proof = proved_mobility(of, of.motion)
    assert proof is not None
    assert proof.mobility == (1,)
    assert "this part is shaky and rests" in proof.reason
    assert "the posture is isolated" not in proof.reason
