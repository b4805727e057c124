"""What the paper prints, and synthetic data of its experiments."""
