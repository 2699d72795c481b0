"""What does the controller do? Problems, the clairvoyant optimum, Localized Predictive Control."""

from .audit import Audit, audit
from .controller import Controller
from .costs import Cost, Quadratic
from .files import load_problem, save_problem
from .information import InformationSet, information_set
from .instances import instance
from .offline import Optimum, optimum
from .problem import Problem
from .promise import Promise, promise
from .sets import Box, Everywhere, FeasibleSet
from .simulation import Simulation, simulate

__all__ = [
    "Audit",
    "Box",
    "Controller",
    "Cost",
    "Everywhere",
    "FeasibleSet",
    "InformationSet",
    "Optimum",
    "Problem",
    "Promise",
    "Quadratic",
    "Simulation",
    "audit",
    "information_set",
    "instance",
    "load_problem",
    "optimum",
    "promise",
    "save_problem",
    "simulate",
]
