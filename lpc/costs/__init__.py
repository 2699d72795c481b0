"""Costs: one kind a file. A file here is found by lying here, also in problem files."""

from .cost import Cost, Curvature
from .quadratic import Quadratic

__all__ = ["Cost", "Curvature", "Quadratic"]
