"""The fuzzer of everything that the program reads from files; docs/robustness.md says what it checks."""
