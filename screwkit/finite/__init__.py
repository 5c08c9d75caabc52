"""Finite motion: closed postures, branches sampled, and proofs of mobility."""
