"""What changed between two campaigns of the same material: the rig, the material, or nothing."""

from probation.comparison.compare import compare
from probation.comparison.reference import Reference
from probation.comparison.result import Comparison

__all__ = ["Comparison", "Reference", "compare"]
