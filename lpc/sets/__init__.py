"""Feasible sets: one kind a file. A file here is found by lying here, also in problem files."""

from .box import Box
from .everywhere import Everywhere
from .feasible import FeasibleSet

__all__ = ["Box", "Everywhere", "FeasibleSet"]
