import subprocess
import sys

import networkx as nx
import numpy as np
import pytest

import nearsight as ns

COSTS = {"mu": 1, "l_f": 1, "l_T": 1, "l_S": 0.5}


def test_importing_loads_nothing_heavy():
    heavy = "{'numpy', 'scipy', 'networkx', 'sympy'}"
    code = f"import nearsight, sys; print(sorted({heavy} & {{*sys.modules}}))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize("graph", ["ring:9", nx.cycle_graph(9), ns.parse_graph("ring:9")])
def test_a_graph_may_come_in_many_forms(graph):
    found = ns.plan(**COSTS, graph=graph, target=1.01)
    assert found.setting.growth.values() == [1, 2, 2, 2, 2]


def test_a_growth_may_be_an_object():
    line = ns.parse_growth("line")
    assert ns.plan(**COSTS, growth=line, target=1.01)["sharp"].pair.k == 4


def test_arrays_of_parameters_are_evaluated_at_once():
    l_T = np.array([0.1, 1.0, 10.0])
    found = ns.bound(mu=1, l_f=1, l_T=l_T, l_S=0.5, growth="line", label="thm:global-exp-decay")[2]
    s = np.sqrt(1 + 2 * l_T)
    assert found.values["rho_G"] == pytest.approx((s - 1) / (s + 1), rel=1e-14)


def test_a_wrong_label_names_the_right_ones():
    with pytest.raises(KeyError, match="coro:CR-LPC"):
        ns.bound(**COSTS, growth="line", label="thm:none")


def test_a_directed_graph_is_refused_unless_cleaned():
    graph = nx.DiGraph([(0, 1), (1, 2)])
    with pytest.raises(ns.InputError, match="directed"):
        ns.plan(**COSTS, graph=graph, target=1.1)
    assert ns.plan(**COSTS, graph=graph, clean=True, target=1.1)["sharp"].guarantee
