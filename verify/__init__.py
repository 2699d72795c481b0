"""Is each claim true? Claims, evidence, verdicts."""

from .catalogue import catalogue
from .check import Check
from .claim import Claim
from .evidence import Evidence, Verdict

__all__ = ["Check", "Claim", "Evidence", "Verdict", "catalogue"]
