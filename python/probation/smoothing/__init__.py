"""From measured, noisy strain to the strain and rate that drive the law."""
