"""The probation test: whether a law is intrinsic to its material."""
