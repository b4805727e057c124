"""What answers to a split are worth."""
