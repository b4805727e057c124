"""What tests can discriminate, and which test to do next."""
