"""Diagnosing the sim-to-real gap: where it sits, which effect causes it, how far it shrinks."""
