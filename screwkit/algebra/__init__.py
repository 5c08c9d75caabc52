"""Exact algebra: rings, minors, factors, and the zeros of polynomials."""
