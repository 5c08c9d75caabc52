"""Actuation schemes up to a mechanism's mirror symmetry."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from screwkit.results.schemes import MirrorClasses, Scheme


def with_mirror(scheme: Scheme, pairs: Sequence[tuple[str, str]]) -> Scheme:
    """The scheme with the one that the symmetry maps it to."""
    if not pairs:
        return scheme
    other = _mirror_map(pairs)
    order = list(other)
    image = sorted((other[name] for name in scheme.actuated), key=order.index)
    return replace(scheme, mirror=tuple(image))


def _mirror_map(pairs: Sequence[tuple[str, str]]) -> Mapping[str, str]:
    return {**dict(pairs), **{b: a for a, b in pairs}}


def mirror_classes(
    listed: Sequence[Scheme], pairs: Sequence[tuple[str, str]]
) -> MirrorClasses | None:
    """Schemes counted up to the symmetry; None where there is none."""
    if not pairs:
        return None

    def classes(some: Sequence[Scheme]) -> tuple[int, int]:
        own = sum(set(s.mirror) == set(s.actuated) for s in some)
        return (len(some) + own) // 2, own

    even = [s for s in listed if s.balanced]
    return MirrorClasses(
        tuple(pairs),
        classes(listed),
        classes([s for s in listed if s.admissible]),
        classes(even),
        classes([s for s in even if s.admissible]),
    )
