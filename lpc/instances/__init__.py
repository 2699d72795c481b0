"""Random instances with given constants. A style is found by being a file of this folder."""

from ._instance import instance, styles
from ._targets import target_kinds

__all__ = ["instance", "styles", "target_kinds"]
