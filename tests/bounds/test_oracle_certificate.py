"""No instance found by brute force is worse for LPC than the certificates promise."""

from functools import cache
from pathlib import Path

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nearsight.bounds import Parameters, Setting, bounds_for
from nearsight.graphs import Network, network_growth, parse_graph

from . import oracle_lpc as oracle

IEEE = Path(__file__).resolve().parents[2] / "examples" / "data" / "ieee118.graphml"
GUARD = 1 + 1e-9  # what the brute force may round
CUBIC = [(0, 1), (0, 2), (0, 3), (1, 4), (1, 5), (2, 6), (2, 7), (3, 8), (3, 9)]
SMALL = [
    "ring:6",
    "ring:9",
    "path:5",
    "star:5",
    "complete:4",
    "cubic tree",
    "grid:3x3",
    "ring-of-blocks:4x2",
]
PAIRS = [(2, 1), (2, 2), (3, 1), (3, 2), (4, 2), (4, 3), (5, 3)]
COUPLINGS = [(0.02, 0.05), (0.3, 0.02), (0.1, 0.3), (1.0, 1.0), (3.0, 0.5)]  # a and x
MU = 0.375  # the brute force has mu = 1: a competitive ratio has no unit


@cache
def network(spec):
    if spec == "cubic tree":
        return Network.from_networkx(nx.Graph(CUBIC))
    return parse_graph(spec)


@cache
def graph(spec):
    return oracle.Graph.of(network(spec))


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


REFERENCE = {
    (1.0, 1.0, 2, 1): "3.1653e-01",
    (1.0, 1.0, 3, 2): "6.9643e-03",
    (1.0, 1.0, 4, 3): "3.9760e-04",
    (0.1, 0.1, 3, 2): "1.6145e-06",
}


@pytest.mark.parametrize(("case", "digits"), REFERENCE.items())
def test_brute_force_reproduces_the_reference(case, digits):
    a, x, k, r = case
    ring = graph("ring:13")
    worst, _ = oracle.uniform(ring, 12, a, x / 2).worst(k, r)
    assert f"{worst:.4e}" == digits


@pytest.mark.parametrize(("style", "n"), [("difference", 1), ("tilted", 1), ("any", 2)])
def test_the_worst_instance_is_as_bad_when_played(style, n):
    # another way to the same number: every agent's problem by projected gradient
    rng = np.random.default_rng(1)
    cubic = graph("cubic tree")
    instance = oracle.random_instance(
        rng, cubic, 3, 0.7, 0.3, l_f=2.0, n=n, style=style, shifts=True
    )
    worst, omega = instance.worst(2, 2)
    omega = omega[:, None]
    played = oracle.play(instance, omega, oracle.everywhere(instance, 1), 2, 2)
    costs = [instance.cost(x, omega)[0] for x in (played.lpc, played.optimum)]
    assert costs[0] / costs[1] - 1 == pytest.approx(worst, rel=1e-8)


def test_the_worst_instance_is_worse_than_others():
    rng = np.random.default_rng(2)
    instance = oracle.random_instance(rng, graph("ring:6"), 4, 1.0, 0.5, style="any", shifts=True)
    worst, _ = instance.worst(3, 2)
    omega = rng.normal(size=(instance.rows[1].shape[1], 1000))
    lpc, optimum = instance.lpc(3, 2) @ omega, instance.optimum @ omega
    ratios = instance.cost(lpc, omega) / instance.cost(optimum, omega) - 1
    assert ratios.min() >= 0
    assert worst / 1000 < ratios.max() <= worst


@pytest.mark.parametrize("spec", SMALL)
def test_no_instance_exceeds_a_certificate(spec):
    rng = np.random.default_rng(SMALL.index(spec))
    small, growth = graph(spec), network_growth(network(spec))
    a, x = np.repeat(COUPLINGS, 2, axis=0).T
    l_f = np.tile([1.0, 8.0], len(COUPLINGS))
    k, r = np.array(PAIRS).T
    promised = certificates(growth, a[:, None], x[:, None], k, r, l_f[:, None])
    highest = 0.0
    for i, style in [(i, style) for i in range(len(a)) for style in oracle.STYLES]:
        instance = oracle.random_instance(
            rng,
            small,
            H=int(rng.integers(3, 6)),
            a=a[i],
            a_S=x[i] / small.degree,
            l_f=l_f[i],
            n=int(rng.choice([1, 1, 2])) if small.vertices <= 6 else 1,
            style=style,
            shifts=bool(rng.integers(2)),
        )
        for j, (kk, rr) in enumerate(PAIRS):
            least = min(promised[kind][i, j] for kind in promised)
            if np.isfinite(least):
                worst, _ = instance.worst(kk, rr)
                assert worst <= least * GUARD, (a[i], x[i], l_f[i], style, kk, rr)
                highest = max(highest, worst / least)
    assert highest > 0.1  # the certificate is within reach: a smaller one would be caught


HARD = [
    ("path:2", 4, 2, 1, 1.0, 0.1, 0.25),
    ("path:3", 4, 2, 1, 0.3, 0.3, 0.25),
    ("complete:4", 3, 3, 1, 0.3, 0.03, 0.1),
    ("ring:5", 4, 2, 1, 0.1, 0.1, 0.4),
    ("star:5", 4, 2, 1, 0.1, 0.1, 0.25),
    ("ring:6", 5, 3, 2, 1.0, 1.0, 0.06),
]


def climbed(spec, H, k, r, a, x, rounds):
    """The worst couplings that hill climbing finds, and the least certificate."""
    rng = np.random.default_rng(7)
    here = graph(spec)
    cut = H * here.vertices
    size = cut + H * len(here.edges)

    def value(phi):
        temporal, spatial = phi[:cut].reshape(H, -1), phi[cut:].reshape(H, -1)
        return oracle.angles(here, H, a, x / here.degree, temporal, spatial).worst(k, r)[0]

    lean = np.arctan(np.sqrt(1 + a))  # as in the worst single step
    starts = [np.full(size, phi) for phi in (np.pi / 4, lean, np.pi / 2 - lean)]
    worst, _ = oracle.climb(rng, value, max(starts, key=value), rounds)
    return worst, min(certificates(network_growth(network(spec)), a, x, k, r).values())


@pytest.mark.parametrize(("spec", "H", "k", "r", "a", "x", "near"), HARD)
def test_climbing_stays_below_the_certificate(spec, H, k, r, a, x, near):
    worst, promised = climbed(spec, H, k, r, a, x, 60)
    assert near * promised < worst <= promised * GUARD


@pytest.mark.slow
@pytest.mark.parametrize(("spec", "H", "k", "r", "a", "x", "near"), HARD)
def test_climbing_long_stays_below_the_certificate(spec, H, k, r, a, x, near):
    worst, promised = climbed(spec, H, k, r, a, x, 3000)
    assert near * promised < worst <= promised * GUARD


def test_uniform_couplings_are_not_the_worst():
    ring = graph("ring:6")
    even, _ = oracle.uniform(ring, 5, 1.0, 0.5).worst(3, 2)
    worst, promised = climbed("ring:6", 5, 3, 2, 1.0, 1.0, 300)
    assert 1.3 * even < worst <= promised * GUARD


@pytest.mark.parametrize(("k", "r"), [(2, 1), (3, 1)])
@pytest.mark.parametrize("style", ["difference", "tilted"])
def test_power_grid(k, r, style):
    growth, grid = network_growth(parse_graph(IEEE)), oracle.Graph.of(parse_graph(IEEE))
    a, x = 0.1, 0.1
    instance = oracle.random_instance(
        np.random.default_rng(3), grid, 2, a, x / grid.degree, style=style
    )
    worst, _ = instance.worst(k, r)
    for bound in bounds_for("nearsight:sharp-cr"):
        result = bound.evaluate(setting(growth, a, x, k, r))
        assert result.guarantee
        assert worst <= result.values["cr_minus_one"] * GUARD
    assert worst > 1e-5


@st.composite
def cases(draw):
    vertices = draw(st.integers(2, 7))
    parents = draw(st.lists(st.integers(0, 6), min_size=vertices - 1, max_size=vertices - 1))
    extra = draw(st.lists(st.integers(0, 20), max_size=6))
    strength = st.floats(-2.5, 0.5).map(lambda e: 10.0**e)
    return {
        "graph": oracle.connected_graph(vertices, parents, extra),
        "H": draw(st.integers(1, 5)),
        "k": draw(st.integers(2, 5)),
        "r": draw(st.integers(1, 4)),
        "a": draw(strength),
        "x": draw(strength),
        "l_f": draw(st.sampled_from([1.0, 1.5, 30.0])),
        "style": draw(st.sampled_from(oracle.STYLES)),
        "seed": draw(st.integers(0, 2**32 - 1)),
    }


def as_network(found):
    lattice = nx.Graph()
    lattice.add_nodes_from(range(found.vertices))
    lattice.add_edges_from(found.edges.tolist())
    return Network.from_networkx(lattice)


@settings(max_examples=60)
@given(case=cases())
def test_random_networks(case):
    small, k, r, a, x = (case[name] for name in ("graph", "k", "r", "a", "x"))
    rng = np.random.default_rng(case["seed"])
    instance = oracle.random_instance(
        rng,
        small,
        case["H"],
        a,
        x / small.degree,
        l_f=case["l_f"],
        n=int(rng.integers(1, 3)),
        style=case["style"],
        shifts=bool(rng.integers(2)),
    )
    worst, _ = instance.worst(k, r)
    growth = network_growth(as_network(small))
    for kind, promised in certificates(growth, a, x, k, r, case["l_f"]).items():
        assert worst <= promised * GUARD + 1e-24, kind


@pytest.mark.parametrize("spec", ["ring:6", "path:5", "star:5", "ring-of-blocks:4x2"])
def test_the_repaired_corollary_holds_where_it_says_something(spec):
    rng = np.random.default_rng(5)
    small, growth = graph(spec), network_growth(network(spec))
    numbers = 0
    for a, x, k, r in [
        (1e-3, 1e-3, 3, 2),
        (1e-3, 1e-2, 3, 3),
        (1e-2, 1e-3, 4, 2),
        (0.02, 0.02, 4, 3),
    ]:
        at = setting(growth, a, x, k, r, 2.0)
        for bound in bounds_for("coro:CR-LPC"):
            if bound.tier != "repaired":
                continue
            result = bound.evaluate(at)
            promised = result.values["cr_minus_one"]
            if promised is None:
                continue
            assert result.guarantee
            numbers += 1
            for style in oracle.STYLES:
                instance = oracle.random_instance(
                    rng, small, 4, a, x / small.degree, l_f=2.0, style=style
                )
                assert instance.worst(k, r)[0] <= promised * GUARD
    assert numbers >= 3


CONSTRAINED = [
    ("path:3", 3, 2, 1, 0.3, 0.3, 1.0, 1),
    ("ring:5", 3, 2, 1, 0.1, 0.3, 4.0, 1),
    ("star:5", 3, 3, 1, 1.0, 0.1, 1.0, 1),
    ("path:2", 4, 2, 1, 1.0, 0.1, 1.0, 2),
    ("ring:5", 3, 3, 2, 0.3, 0.3, 3.0, 2),
]


@pytest.mark.parametrize(("spec", "H", "k", "r", "a", "x", "l_f", "n"), CONSTRAINED)
def test_constrained_play_obeys_vi(spec, H, k, r, a, x, l_f, n):
    rng = np.random.default_rng(11)
    small = graph(spec)
    promised = certificates(network_growth(network(spec)), a, x, k, r, l_f)["vi"]
    highest, binding = 0.0, 0.0
    for style in ("tilted", "any", "difference"):
        instance = oracle.random_instance(
            rng, small, H, a, x / small.degree, l_f=l_f, n=n, style=style, shifts=True
        )
        _, hardest = instance.worst(k, r)
        omega = np.repeat(hardest[:, None] / np.abs(hardest).max(), 60, axis=1)
        omega = omega * (1 + rng.choice([0, 0.3], 60) * rng.normal(size=omega.shape))
        sets = oracle.random_sets(rng, instance, 60, np.abs(omega).mean())
        played = oracle.play(instance, omega, sets, k, r)
        costs, least = (instance.cost(z, omega) for z in (played.lpc, played.optimum))
        assert np.all(costs >= least * (1 - 1e-12))
        highest = max(highest, np.max(costs / least - 1))
        binding = max(binding, np.abs(played.optimum - instance.optimum @ omega).max())
        # E4, with constraints: OPT pays for every deviation from the targets
        square = np.sum((played.optimum - played.theta) ** 2, axis=0)
        assert np.all(least >= 0.5 * (1 + 1 / (2 * a + x)) * square * (1 - 1e-9))
    assert 0.005 * promised < highest <= promised * GUARD
    assert binding > 0.01
