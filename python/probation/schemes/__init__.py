"""The schemes side by side: what `probation.schemes.crosscheck` is made of."""
