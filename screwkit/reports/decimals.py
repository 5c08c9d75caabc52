"""Floats as people read them: few digits, a true minus sign, no trailing noise."""

from __future__ import annotations

from collections.abc import Sequence


def decimal(value: float, digits: int = 6) -> str:
    """A number with so many significant digits.

    >>> decimal(9.736466686424182), decimal(0.0), decimal(-0.5), decimal(1234567.0)
    ('9.73647', '0', '−0.5', '1.23457·10^6')
    """
    if value == 0:
        return "0"
    text = f"{value:.{digits}g}"
    mantissa, mark, exponent = text.partition("e")
    if mark:
        mantissa = f"{mantissa}·10^{int(exponent)}"
    return mantissa.replace("-", "−")


def coordinates(values: Sequence[float], split: int = 0, digits: int = 3) -> str:
    """Coordinates in brackets, a semicolon after the first ``split`` of them.

    >>> coordinates((0.70539, 0.614834, -1e-17), 1)
    '(0.705; 0.615, 0)'
    """
    texts = [decimal(x if abs(x) > 1e-12 else 0.0, digits) for x in values]
    parts = [", ".join(part) for part in (texts[:split], texts[split:]) if part]
    return f"({'; '.join(parts)})"
