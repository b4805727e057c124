"""Whether a law departs from its records, and where."""
