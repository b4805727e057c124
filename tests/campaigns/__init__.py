"""Made-up campaigns with noises and gaps of known kind and size, for tests and studies of the statistics."""
