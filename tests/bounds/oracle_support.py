"""What the oracle tests share: small networks, and what the bounds promise for them."""

from functools import cache

import networkx as nx
import numpy as np

from nearsight.bounds import Parameters, Setting, bounds_for
from nearsight.graphs import Network, network_growth, parse_graph

from . import oracles as oracle

GUARD = 1 + 1e-9  # what the brute force may round
CUBIC = [(0, 1), (0, 2), (0, 3), (1, 4), (1, 5), (2, 6), (2, 7), (3, 8), (3, 9)]
MU = 0.375  # the brute force has mu = 1: a competitive ratio has no unit


@cache
def network(spec):
    if spec == "cubic tree":
        return Network.from_networkx(nx.Graph(CUBIC))
    return parse_graph(spec)


@cache
def growth(spec):
    return network_growth(network(spec))


@cache
def graph(spec):
    return oracle.Graph.of(network(spec))


def result(label, tier, spec, a, x, k=None, r=None, variant="", l_f=1.0):
    (bound,) = (b for b in bounds_for(label) if (b.tier, b.variant) == (tier, variant))
    g = growth(spec)
    return bound.evaluate(Setting(Parameters(1.0, l_f, a, x / max(g.max_degree, 1)), g, k, r))


def setting(growth, a, x, k, r, l_f=1.0):
    a_S = np.divide(x, growth.max_degree)
    return Setting(Parameters(MU, MU * l_f, MU * a, MU * a_S), growth, k, r, unconstrained=True)


def certificates(growth, a, x, k, r, l_f=1.0):
    """The bounds on ``CR - 1`` of all three kinds, infinite where there is none."""
    found = {}
    for bound in bounds_for("nearsight:sharp-cr"):
        value = bound.evaluate(setting(growth, a, x, k, r, l_f)).values["cr_minus_one"]
        value = np.inf if value is None else value
        found[bound.variant] = np.where(np.isnan(value), np.inf, value)
    assert set(found) == {"vi", "mix", "smooth"}
    return found
