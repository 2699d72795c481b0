"""Graphs, finite and infinite, and how they grow.

`parse_graph` turns a file or a specification into a `Network`, `network_growth` measures it;
`parse_growth` names an infinite graph by its `Growth`, which is all that the theory needs.
"""

from .errors import InputError, NearsightError
from .files import SUFFIXES, read_graph
from .growth import Growth
from .measured import NetworkGrowth, network_growth
from .network import Network
from .plugins import modules
from .profile import Profile, network_profile
from .source import parse_graph, parse_growth

__all__ = [
    "SUFFIXES",
    "Growth",
    "InputError",
    "NearsightError",
    "Network",
    "NetworkGrowth",
    "Profile",
    "modules",
    "network_growth",
    "network_profile",
    "parse_graph",
    "parse_growth",
    "read_graph",
]
