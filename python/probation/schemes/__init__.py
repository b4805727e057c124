"""The schemes side by side: what `probation.crosscheck` is made of."""
