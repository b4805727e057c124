"""Constants of the statistics, in one place: value, unit, meaning, where each comes from."""
