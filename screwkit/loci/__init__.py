"""Singular loci: where a system of screws loses rank, exactly and completely.

Between kinematics, which says where the screws are, and the analyses, which say what
it means.  Everything here is polynomials and branches; nothing is text.
"""
