"""What the pictures of one agent's sight say, against distances counted by networkx."""

import networkx as nx
import pytest

from nearsight.figures import picture_named
from nearsight.graphs import InputError, parse_graph

GRAPHS = ["grid:4x4", "barabasi-albert:60x1", "erdos-renyi:9x0.15", "ring:7"]


def _compute(name, graph, **changes):
    picture = picture_named(name)
    typed = {"graph": parse_graph(graph, 3), "horizon": 5, "t": 2, **changes}
    subject = picture.subject.with_typed(typed, picture.takes)
    graph = nx.convert_node_labels_to_integers(subject.network.to_networkx())
    hops = nx.single_source_shortest_path_length(graph, subject.centre)
    return picture.compute(subject, print), graph, hops


@pytest.mark.parametrize("graph", GRAPHS)
@pytest.mark.parametrize(("t", "k", "r"), [(1, 2, 1), (2, 3, 2), (5, 2, 1)])
def test_known_are_k_steps_and_r_hops(graph, t, k, r):
    table, whole, hops = _compute("information", graph, t=t, k=k, r=r)

    def state(tau, *ends):
        if tau > 5:
            return "beyond"
        seen = t <= tau <= t + k - 1 and all(hops.get(u, 99) <= r for u in ends)
        return "known" if seen else "unknown"

    for row in table.where(kind="node").records():
        u, tau = row["agent"], row["step"]
        assert row["state"] == state(tau, u)
        assert row["action"] == (tau == t - 1 and hops.get(u, 99) <= r)
    for row in table.where(kind="temporal").records():
        assert row["state"] == state(row["step"], row["agent"])
    for row in table.where(kind="spatial").records():
        assert whole.has_edge(row["agent"], row["other"])
        assert row["state"] == state(row["step"], row["agent"], row["other"])
    drawn = set(table.where(kind="agent").values("agent"))
    want = set(whole) if len(whole) <= 40 else {u for u, d in hops.items() if d <= r + 1}
    assert drawn == want
    edges = {(a, b) for a, b in whole.subgraph(drawn).edges}
    at_t = table.where(kind="spatial", step=t).records()
    assert {(row["agent"], row["other"]) for row in at_t} == {(min(e), max(e)) for e in edges}


@pytest.mark.parametrize("graph", GRAPHS)
@pytest.mark.parametrize(("t", "k", "r"), [(1, 2, 1), (2, 3, 2), (4, 4, 1)])
def test_parts_of_the_local_problem(graph, t, k, r):
    table, whole, hops = _compute("decision-boundary", graph, t=t, k=k, r=r)

    def free(tau, u):
        return t <= tau <= t + k - 2 and hops.get(u, 99) <= r - 1

    def part(tau, u):
        far = hops.get(u, 99)
        if far > r:
            return "outside"
        if tau in (t - 1, t + k - 1):
            return "bottom" if tau < t else "top"
        return "lateral" if far == r else "free" if (tau, far) != (t, 0) else "own"

    for row in table.where(kind="node").records():
        tau, u = row["step"], row["agent"]
        assert row["part"] == part(tau, u)
        around = [(tau - 1, u), (tau + 1, u), *((tau, w) for w in whole[u])]
        acts = [pair for pair in ((tau, u), *around) if free(*pair) and pair[0] <= 5]
        assert row["matters"] == (tau <= 5 and bool(acts))


def test_the_network_of_the_paper_is_seen_by_v():
    picture = picture_named("fig:information")
    table = picture.compute(picture.subject, print)
    names = {row["agent"]: row["name"] for row in table.where(kind="agent").records()}
    step = picture.subject.t
    known = table.where(kind="spatial", step=step, state="known").records()
    edges = {frozenset((names[row["agent"]], names[row["other"]])) for row in known}
    assert edges == {frozenset(e) for e in (("u2", "v"), ("v", "u3"), ("u2", "u3"))}
    acted = {names[row["agent"]] for row in table.where(kind="node", action=1).records()}
    assert acted == {"u2", "v", "u3"}


@pytest.mark.parametrize("name", ["information", "decision-boundary"])
def test_a_step_beyond_the_horizon_is_bad_input(name):
    with pytest.raises(InputError, match=r"t = 6: there are the steps 1\.\.5"):
        _compute(name, "ring:7", t=6)
