"""What does the theory promise? Closed forms, theorems as objects, planning (k, r)."""

from .frontier import Frontier, Pair, Search
from .parameters import Parameters
from .planner import Bottleneck, Plan, Prices, TierPlan, plan
from .theorem import Bound, Hypothesis, Result, Setting
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
