"""How nearsighted an agent may be, in time (k) and in space (r).

Constants, bounds, plans and simulations of Localized Predictive Control in networked online
convex optimisation. Every public name is found here: ``nearsight.<name>``.

Importing the package loads nothing else: a name is fetched from its module when it is first
asked for (PEP 562), so that the command line starts at once.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    # What the table below does at run time, told to type checkers and editors: one line a name.
    # A test compares the two.
    from . import bounds as bounds
    from . import figures as figures
    from . import graphs as graphs
    from . import lowerbounds as lowerbounds
    from . import lpc as lpc
    from . import perturbation as perturbation
    from . import verify as verify
    from .api import bound as bound
    from .api import plan as plan
    from .api import setting as setting
    from .bounds import Bottleneck as Bottleneck
    from .bounds import Bound as Bound
    from .bounds import Hypothesis as Hypothesis
    from .bounds import Pair as Pair
    from .bounds import Parameters as Parameters
    from .bounds import Plan as Plan
    from .bounds import Prices as Prices
    from .bounds import Result as Result
    from .bounds import Search as Search
    from .bounds import Setting as Setting
    from .bounds import TierPlan as TierPlan
    from .bounds import catalogue as catalogue
    from .drawing import draw as draw
    from .flooring import lower_bound as lower_bound
    from .graphs import Growth as Growth
    from .graphs import InputError as InputError
    from .graphs import NearsightError as NearsightError
    from .graphs import Network as Network
    from .graphs import network_growth as network_growth
    from .graphs import parse_graph as parse_graph
    from .graphs import parse_growth as parse_growth
    from .graphs import read_graph as read_graph
    from .lpc import Box as Box
    from .lpc import Controller as Controller
    from .lpc import Problem as Problem
    from .lpc import Quadratic as Quadratic
    from .lpc import Simulation as Simulation
    from .lpc import audit as audit
    from .lpc import instance as instance
    from .lpc import load_problem as load_problem
    from .lpc import optimum as optimum
    from .lpc import save_problem as save_problem
    from .measuring import measure as measure
    from .measuring import search_sensitivity as search_sensitivity
    from .perturbation import Measurement as Measurement
    from .perturbation import sensitivity as sensitivity
    from .sandwiching import augmentation as augmentation
    from .sandwiching import sandwich as sandwich
    from .simulating import random_problem as random_problem
    from .simulating import simulate as simulate
    from .verifying import verify_claims as verify_claims
    from .worsening import worst_case as worst_case

    __version__: str

# Public name -> module that holds it, relative to this package.
# A subpackage stands under its own name: "graphs": ".graphs".
_EXPORTS: dict[str, str] = {
    "Bottleneck": ".bounds",
    "Bound": ".bounds",
    "Box": ".lpc",
    "Controller": ".lpc",
    "Growth": ".graphs",
    "Hypothesis": ".bounds",
    "InputError": ".graphs",
    "Measurement": ".perturbation",
    "NearsightError": ".graphs",
    "Network": ".graphs",
    "Pair": ".bounds",
    "Parameters": ".bounds",
    "Plan": ".bounds",
    "Prices": ".bounds",
    "Problem": ".lpc",
    "Quadratic": ".lpc",
    "Result": ".bounds",
    "Search": ".bounds",
    "Setting": ".bounds",
    "Simulation": ".lpc",
    "TierPlan": ".bounds",
    "audit": ".lpc",
    "augmentation": ".sandwiching",
    "bound": ".api",
    "bounds": ".bounds",
    "catalogue": ".bounds",
    "draw": ".drawing",
    "figures": ".figures",
    "graphs": ".graphs",
    "instance": ".lpc",
    "load_problem": ".lpc",
    "lower_bound": ".flooring",
    "lowerbounds": ".lowerbounds",
    "lpc": ".lpc",
    "measure": ".measuring",
    "network_growth": ".graphs",
    "optimum": ".lpc",
    "parse_graph": ".graphs",
    "parse_growth": ".graphs",
    "perturbation": ".perturbation",
    "plan": ".api",
    "random_problem": ".simulating",
    "read_graph": ".graphs",
    "sandwich": ".sandwiching",
    "save_problem": ".lpc",
    "search_sensitivity": ".measuring",
    "sensitivity": ".perturbation",
    "setting": ".api",
    "simulate": ".simulating",
    "verify": ".verify",
    "verify_claims": ".verifying",
    "worst_case": ".worsening",
}


def __getattr__(name: str) -> object:
    if name == "__version__":
        from importlib.metadata import version

        value: object = version("nearsight")
    elif name in _EXPORTS:
        module = import_module(_EXPORTS[name], __name__)
        value = module if _EXPORTS[name] == f".{name}" else getattr(module, name)
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value  # the next look-up does not come here
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_EXPORTS, "__version__"})
