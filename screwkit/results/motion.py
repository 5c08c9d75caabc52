"""What `assemble`, `move` and `follow` answer: closed postures, or why none."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class MotionPath:
    """Closed postures of a mechanism, the first one where it started.

    Attributes:
        freedoms: Labels of the freedoms, ``name`` or ``name:k``.
        postures: One tuple a posture, a value for each freedom, in radians and lengths
            of the file; counted from the posture of the file.
        closed: Whether what was asked for was reached; the postures are closed anyway.
        reached: Part of the motion that was made, 0 … 1.
        reason: Why it was not reached: the loop that stays open and by how much.
    """

    case: str
    freedoms: tuple[str, ...]
    postures: tuple[tuple[float, ...], ...]
    closed: bool
    reached: float
    reason: str = ""

    @property
    def last(self) -> dict[str, float]:
        """The last closed posture, by freedom; empty if none was found."""
        if not self.postures:
            return {}
        return dict(zip(self.freedoms, self.postures[-1], strict=True))
