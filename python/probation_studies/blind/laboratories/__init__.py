"""Laboratories written independently of each other, beside the project's own one in `blind/laboratory`.

A laboratory is a package with

- ``SPLITS`` and ``STRATA``, tuples of str,
- ``make(seed, index, split="develop", stratum=None)``: one campaign, the same for the same arguments; without a stratum
  it is drawn. What it returns has ``truth.to_json()`` (schema probation.blind.truth/1) and ``write(folder)``, which
  writes campaign.toml and the records, nothing of the truth, and returns the folder.

It imports NumPy, SciPy, `probation.errors` and what writes files whole, nothing else; a test follows every import.
It has one line in `probation_studies.blind.laboratory_named`.
"""
