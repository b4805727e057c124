"""An identified law for finite-element codes: one file per format, each read back and solved again."""

from probation.export.exporting import export
from probation.export.formats import FORMATS
from probation.export.result import Export

__all__ = ["FORMATS", "Export", "export"]
