"""Stability over regions of parameters: maps, boundaries, sweeps, uncertainty, proofs."""
