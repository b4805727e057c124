"""The paper's own experiments, tables and figures."""
