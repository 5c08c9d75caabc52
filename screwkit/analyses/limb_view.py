"""A limb as a person meets it in Python: its joints, its twists, its wrenches.

Both systems are exact, in the base frame, and found when first asked for.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

from screwkit.analyses.screws import constraint_wrenches, limb_twists
from screwkit.kinematics.assembly import Assembly, LimbChain
from screwkit.screw.nullspace import annihilator, basis_of
from screwkit.screw.system import TwistSystem, WrenchSystem, conditions


@dataclass(frozen=True, eq=False)
class LimbView:
    """A limb of a case.

    Attributes:
        name: As in the file, or ``limb_1``, …
        joints: Its moving joints, from base to platform.
    """

    _assembly: Assembly = field(repr=False)
    _limb: LimbChain = field(repr=False)

    def __repr__(self) -> str:
        return f"<limb {self.name!r}: {' '.join(self.joints)}>"

    @property
    def name(self) -> str:
        """The name of the limb."""
        return self._limb.name

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of its moving joints, from base to platform."""
        return self._limb.joints

    @cached_property
    def twists(self) -> TwistSystem:
        """The twists of the joints, one column each, in the base frame."""
        framed = self._assembly.base_twists
        return TwistSystem(
            framed.ring,
            limb_twists(self._assembly, self._limb),
            self._assembly.mechanism.base,
            self._assembly.assumptions,
        )

    @cached_property
    def wrenches(self) -> WrenchSystem:
        """What the limb can transmit with all its joints passive, in the base frame.

        The basis is that of `screwkit.screw`: couples and forces where they exist.
        """
        assembly, ring = self._assembly, self.twists.ring
        columns = constraint_wrenches(assembly, self._limb)
        known: frozenset[str] = frozenset()
        if columns:
            basis = basis_of(ring, self.twists.columns)
            for spanning in (basis.columns, columns):
                pivot = annihilator(ring, spanning).pivot
                known |= conditions(ring, pivot, assembly.assumptions)
        return WrenchSystem(
            ring, columns, self.twists.frame, assembly.assumptions, known
        )
