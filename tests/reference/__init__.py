"""Independent ways to the numbers that the engine must give; nothing here imports probation."""
