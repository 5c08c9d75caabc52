"""What an elimination may take, counted in products and not in seconds."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass
class Effort:
    """What may still be spent on an elimination.

    Attributes:
        left: Products of terms.
    """

    left: int

    def spend(self, products: int) -> bool:
        """Whether so many could be paid for."""
        self.left -= products
        return self.left >= 0
