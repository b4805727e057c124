"""Records: what laboratories measured, read into MPa, seconds and true strain."""
