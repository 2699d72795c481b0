"""Responses in the picture of the worst costs, against what is known of the class."""

import networkx as nx
import numpy as np
import pytest

from nearsight.figures import picture_named
from nearsight.graphs import InputError, parse_graph

GRAPHS = ["grid:3x3", "ring:9", "erdos-renyi:9x0.15", "path:3"]


def _compute(graph, **changes):
    picture = picture_named("worst-response")
    typed = {"graph": parse_graph(graph), "l_T": 0.8, "l_S": 0.6, "k": 3, "r": 2, **changes}
    subject = picture.subject.with_typed(typed, picture.takes)
    return picture.compute(subject, lambda text: None), subject


@pytest.mark.parametrize("graph", GRAPHS)
def test_responses_stay_below_the_promised_ones_at_true_distances(graph):
    table, subject = _compute(graph)
    whole = nx.convert_node_labels_to_integers(subject.network.to_networkx())
    hops = nx.single_source_shortest_path_length(whole, subject.centre)
    rows = table.where(kind="node").records()
    (star,) = (row for row in rows if row["part"] not in ("free", "outside"))
    lateral = [u for u, d in hops.items() if d == 2]
    assert star["step"] == (2 if lateral else 3)
    assert star["agent"] in lateral if lateral else star["agent"] == subject.centre
    free = {(row["step"], row["agent"]) for row in rows if row["part"] == "free"}
    assert free == {(tau, u) for tau in (1, 2) for u, d in hops.items() if d <= 1}
    away = nx.single_source_shortest_path_length(whole, star["agent"])
    for row in rows:
        if row["part"] == "free":
            assert row["hops"] == away[row["agent"]]
            assert row["gap"] == abs(row["step"] - star["step"])
            assert 0 <= row["response"] <= row["promised"] * (1 + 1e-9)


@pytest.mark.parametrize(
    ("graph", "strengths", "star"),
    [
        ("ring:9", {"l_S": 0.0}, ("top", 3)),
        ("ring:9", {"l_T": 0.0}, ("lateral", 1)),
        ("complete:4", {"l_S": 0.0}, ("top", 3)),
    ],
)
def test_without_some_couplings_the_variable_is_one_that_can_be_followed(graph, strengths, star):
    table, subject = _compute(graph, **strengths)
    rows = table.where(kind="node").records()
    assert [(r["part"], r["step"]) for r in rows if r["part"] not in ("free", "outside")] == [star]
    own = [r for r in rows if (r["step"], r["agent"]) == (1, subject.centre)]
    assert own[0]["response"] > 0


@pytest.mark.parametrize("graph", ["ring:9", "complete:4"])
def test_nothing_to_follow_is_bad_input(graph):
    l_S = 0.0 if graph == "ring:9" else 0.6
    with pytest.raises(InputError, match=r"l_T = 0: > 0 is needed"):
        _compute(graph, l_T=0.0, l_S=l_S)


def test_one_free_agent_follows_as_far_as_the_class_allows():
    # one free action: w = -m12/(mu + m11 + ...), and the largest |m12|/(1 + m11) over
    # [[m11, m12], [m12, m22]] <= l I, rank one: sqrt(1 + l) tilt gives l/(2 sqrt(1 + l))
    table, _ = _compute("path:2", k=2, r=1, l_T=0.0, l_S=3.0)
    (row,) = table.where(kind="node", part="free").records()
    assert row["response"] == pytest.approx(3 / (2 * np.sqrt(4)), rel=1e-6)


def test_the_agents_action_moves_no_less_than_under_uniform_costs():
    table, subject = _compute("ring:9")
    rows = table.where(kind="node").records()
    (star,) = (row for row in rows if row["part"] == "lateral")
    free = [(row["step"], row["agent"]) for row in rows if row["part"] == "free"]
    index = {pair: i for i, pair in enumerate(free)}
    matrix, cross = np.zeros((len(free), len(free))), np.zeros(len(free))
    for (tau, u), i in index.items():
        around = [(tau - 1, u, 0.8), (tau + 1, u, 0.8)]
        around += [(tau, (u + s) % 9, 0.6) for s in (1, -1)]
        matrix[i, i] = 1 + sum(weight / 2 for *_, weight in around)
        for step, agent, weight in around:
            if (step, agent) in index:
                matrix[i, index[step, agent]] = -weight / 2
            elif (step, agent) == (star["step"], star["agent"]):
                cross[i] = weight / 2
    uniform = np.linalg.solve(matrix, cross)
    own = index[1, subject.centre]
    found = {(row["step"], row["agent"]): row["response"] for row in rows}
    assert found[1, subject.centre] > uniform[own]
