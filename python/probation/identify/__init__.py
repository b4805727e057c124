"""From records to the law's parameters, and what is known about them."""
