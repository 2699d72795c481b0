"""LPC by brute force on quadratic networks: nothing here comes from nearsight.

A graph, an instance with its clairvoyant optimum and LPC's trajectory, samples of instances,
constrained play, and one local problem with its sensitivities, each in a file of its own.
"""

from .graph import Graph, connected_graph
from .instance import Instance
from .play import everywhere, play, random_sets
from .samples import STYLES, angles, climb, random_instance, uniform
from .sensitivity import sensitivity

__all__ = [
    "STYLES",
    "Graph",
    "Instance",
    "angles",
    "climb",
    "connected_graph",
    "everywhere",
    "play",
    "random_instance",
    "random_sets",
    "sensitivity",
    "uniform",
]
