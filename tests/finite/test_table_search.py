"""Of several closed postures of a table a regular one is taken."""

from __future__ import annotations

from pathlib import Path

import screwkit as sk

ROW = (
    "  - {{name: {name}, type: {kind}, parent: {parent}, child: {child}, "
    'mdh: {{d: "{d}", alpha: "{alpha}"}}}}'
)


def trihedral(*lengths: int) -> str:
    """Six hinges, neighbours at right angles, with these distances and no offsets."""
    bodies = ["b", "l1", "l2", "l3", "l4", "l5"]
    rows: list[tuple[object, ...]] = [("J1", "revolute", "b", "l1", 0, "0")]
    for k in range(1, 5):
        alpha = "pi/2" if k % 2 else "-pi/2"
        rows.append(
            (f"J{k + 1}", "revolute", *bodies[k : k + 2], lengths[k - 1], alpha)
        )
    rows.append(("F", "fixed", "l5", "tip", lengths[4], "pi/2"))
    rows.append(("J6", "revolute", "b", "tip", -lengths[5], "pi/2"))
    names = ("name", "kind", "parent", "child", "d", "alpha")
    head = ["screwkit: 1", "name: trihedral", "geometry: mdh", "base: b"]
    links = f"links: [{', '.join([*bodies, 'tip'])}]"
    written = [ROW.format(**dict(zip(names, row, strict=True))) for row in rows]
    return "\n".join([*head, "platform: l3", links, "joints:", *written])


def test_a_trihedral_linkage_is_not_looked_at_where_it_is_folded(
    tmp_path: Path,
) -> None:
    """Bricard's condition a² + c² + e² = b² + d² + f² makes it move, at rank 5.

    Folded into a line it closes as well, 1 + 5 + 6 = 2 + 3 + 7, at other ranks.
    """
    lengths = (1, 2, 5, 3, 6, 7)
    squares = [length**2 for length in lengths]
    assert sum(squares[::2]) == sum(squares[1::2])
    path = tmp_path / "linkage.yaml"
    path.write_text(trihedral(*lengths))
    answer = sk.mobility(sk.load(path))
    assert answer.full_cycle.mobility == (1,)
    assert answer.loop_rank == 5
