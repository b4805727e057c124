"""What every answer has in common; the answers themselves stand beside the methods that find them."""
