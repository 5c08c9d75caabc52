"""How far postures are from where the actuators lose the platform, for many at once.

With the actuators locked, motions are the null space of [J_p −Gᵀ] in unit directions.
Its determinant vanishes on the singular locus and changes sign there if it is square;
its smallest singular value is a distance in the sense of matrices, not of postures.

References: [LongCaroKhalil2012] §5.2, [GolubVanLoan1996] §2.5 (distance).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.grasping.exact_grasp import exact_grasps
from screwkit.grasping.matrices import grasp_matrices
from screwkit.kinematics.loops import ring_at
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.float_grasp import of_matrices
from screwkit.metrics.indices import FloatGrasp

LocusKind: TypeAlias = Literal["locus", "sigma_min"]

CHUNK = 4096
"""Postures at a time."""


@dataclass(frozen=True)
class LocusFunction:
    """The determinant of the passive part, or its smallest singular value.

    Attributes:
        mechanism: Symbols that are not varied have their numbers.
        kind: Which of them.
        rank: Of [J_p −Gᵀ] at a generic posture; the least singular value that counts.
    """

    mechanism: Mechanism
    kind: LocusKind
    rank: int

    def __call__(self, values: Mapping[str, Array | float]) -> Array:
        """The number at every posture, shape batch.

        Raises:
            UnknownNameError: If a symbol has no value.
        """
        arrays = {name: np.asarray(v, dtype=float) for name, v in values.items()}
        batch = np.broadcast_shapes(*(v.shape for v in arrays.values()))
        flat = {n: np.broadcast_to(v, batch).reshape(-1) for n, v in arrays.items()}
        size = int(np.prod(batch))
        found = np.empty(size)
        for start in range(0, size, CHUNK):
            part = slice(start, start + CHUNK)
            found[part] = self._chunk({n: v[part] for n, v in flat.items()})
        return found.reshape(batch)

    def _chunk(self, values: Mapping[str, Array]) -> Array:
        known: dict[str, Array | float] = {}
        if self.mechanism.geometry != "posture":
            known = dict.fromkeys(self.mechanism.joint_variables, 0.0)
        known.update(values)
        grasp = of_matrices(
            grasp_matrices(self.mechanism, ring_at(self.mechanism, known)), None
        )
        return self.of_grasp(grasp)

    def of_grasp(self, grasp: FloatGrasp) -> Array:
        """The number of a grasp, or of each of a batch of grasps."""
        batch = np.broadcast_shapes(grasp.jp.shape[:-2], grasp.gt.shape[:-2])
        parts = [
            np.broadcast_to(part, (*batch, *part.shape[-2:]))
            for part in (grasp.jp, -grasp.gt)
        ]
        whole = np.concatenate(parts, axis=-1)
        finite = np.asarray(np.isfinite(whole).all(axis=(-2, -1)))
        safe = np.where(finite[..., None, None], whole, 0.0)
        square = whole.shape[-2] == whole.shape[-1] == self.rank
        if self.kind == "locus" and square:
            found = np.linalg.det(safe)
        else:
            sizes = np.linalg.svd(safe, compute_uv=False)[..., : self.rank]
            smallest = self.kind == "sigma_min"
            found = sizes[..., -1] if smallest else np.prod(sizes, axis=-1)
        return np.asarray(np.where(finite, found, np.nan))


def locus_function(mechanism: Mechanism, kind: LocusKind = "locus") -> LocusFunction:
    """The function for a mechanism and its scheme.

    Raises:
        UndecidedError: If there is no exact point.
    """
    (grasp,) = exact_grasps(mechanism, (1,))
    return LocusFunction(mechanism, kind, grasp.ranks.po)
