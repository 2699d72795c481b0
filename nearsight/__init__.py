"""How nearsighted an agent may be, in time (k) and in space (r).

Constants, bounds and plans of Localized Predictive Control in networked online convex
optimisation. Every public name is found here: ``nearsight.<name>``.

Importing the package loads nothing else: a name is fetched from its module when it is first
asked for (PEP 562), so that the command line starts at once.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    # What the table below does at run time, told to type checkers and editors: one line a name.
    # A test compares the two.
    from . import bounds as bounds
    from . import graphs as graphs
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
    from .graphs import Growth as Growth
    from .graphs import InputError as InputError
    from .graphs import NearsightError as NearsightError
    from .graphs import Network as Network
    from .graphs import network_growth as network_growth
    from .graphs import parse_graph as parse_graph
    from .graphs import parse_growth as parse_growth
    from .graphs import read_graph as read_graph

    __version__: str

# Public name -> module that holds it, relative to this package.
# A subpackage stands under its own name: "graphs": ".graphs".
_EXPORTS: dict[str, str] = {
    "Bottleneck": ".bounds",
    "Bound": ".bounds",
    "Growth": ".graphs",
    "Hypothesis": ".bounds",
    "InputError": ".graphs",
    "NearsightError": ".graphs",
    "Network": ".graphs",
    "Pair": ".bounds",
    "Parameters": ".bounds",
    "Plan": ".bounds",
    "Prices": ".bounds",
    "Result": ".bounds",
    "Search": ".bounds",
    "Setting": ".bounds",
    "TierPlan": ".bounds",
    "bound": ".api",
    "bounds": ".bounds",
    "catalogue": ".bounds",
    "graphs": ".graphs",
    "network_growth": ".graphs",
    "parse_graph": ".graphs",
    "parse_growth": ".graphs",
    "plan": ".api",
    "read_graph": ".graphs",
    "setting": ".api",
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
