"""The noise of records: its estimation, its model, and coordinates in which it is white."""
