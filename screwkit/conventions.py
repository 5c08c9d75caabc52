"""Conventions of the package, declared once and imported everywhere.

A screw is stored as a pair of 3-vectors *(direction, moment)* -- Plücker ray order --
in the axes of a named frame and about its origin:

==========  ===================  ============================
screw       direction            moment
==========  ===================  ============================
twist       angular velocity ω   velocity v of the origin
wrench      resultant force f    moment m about the origin
==========  ===================  ============================

With this storage the reciprocal product is ``f·v + m·ω`` for every pair of screws.
Planar files use (ωz; vx, vy) and (fx, fy; mz).  Angles are radians.
"""

from typing import Final

DIRECTION: Final = slice(0, 3)
MOMENT: Final = slice(3, 6)
SCREW_DIMENSION: Final = 6
PLANAR_DIMENSION: Final = 3

FORMAT_VERSION: Final = 1
RESULT_SCHEMA: Final = "screwkit/1"
