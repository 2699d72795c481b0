"""What does the theory promise? Closed forms, theorems as objects, planning (k, r)."""

from .frontier import Frontier, Pair, Search
from .parameters import Parameters
from .planner import plan
from .plans import Bottleneck, Plan, Prices, TierPlan
from .setting import Setting
from .theorem import Bound, Hypothesis, Result
from .theorems import bounds_for, catalogue

__all__ = [
    "Bottleneck",
    "Bound",
    "Frontier",
    "Hypothesis",
    "Pair",
    "Parameters",
    "Plan",
    "Prices",
    "Result",
    "Search",
    "Setting",
    "TierPlan",
    "bounds_for",
    "catalogue",
    "plan",
]
