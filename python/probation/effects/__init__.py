"""Effects that a law may leave out, and the registry of those that a diagnosis considers."""
