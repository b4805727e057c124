"""Results to plots and pages."""
