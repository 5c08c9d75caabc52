"""Manipulability in numbers: indices, ellipsoids, cooperating arms, many postures."""
