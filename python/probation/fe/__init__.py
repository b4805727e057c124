"""The law inside finite elements: the compiled material point, and where its C++ headers are."""

from probation.fe.point import CutStep, MaterialPoint
from probation.fe.where import cmake_prefix, include_path, interface_path

__all__ = ["CutStep", "MaterialPoint", "cmake_prefix", "include_path", "interface_path"]
