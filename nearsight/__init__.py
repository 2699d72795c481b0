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

    __version__: str

# Public name -> module that holds it, relative to this package.
# A subpackage stands under its own name: "graphs": ".graphs".
_EXPORTS: dict[str, str] = {
    "bounds": ".bounds",
    "graphs": ".graphs",
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
