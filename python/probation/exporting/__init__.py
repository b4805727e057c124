"""An identified law for finite-element codes: one file per format, each read back and solved again."""
