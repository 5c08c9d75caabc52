"""Vectors, displacements and systems of screws over any ring."""
