"""Proofs of singular loci that somebody else can check: derived, written, checked.

`derivation` looks for a proof with the whole exact engine; `checking` checks it with
residues at random points alone, and knows nothing of how it was found.
"""
