"""What tests can tell apart, and which test to do next."""
