"""Full-field campaigns: one record per pixel, the law identified on each, on one machine or on many."""

from probation.field.identify import FieldRun, identify_field
from probation.field.maps import FieldMaps, open_maps
from probation.field.source import FieldSource, open_field

__all__ = ["FieldMaps", "FieldRun", "FieldSource", "identify_field", "open_field", "open_maps"]
