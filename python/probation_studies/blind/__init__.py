"""The sealed benchmark: a laboratory that withholds what it did, seals, answers and scores."""
