import numpy as np
import pytest

from nearsight.bounds import Parameters
from nearsight.graphs import InputError, Network, parse_graph
from nearsight.lpc.instances import instance, styles, target_kinds

GIVEN = Parameters(0.7, 1.9, 2.0, 0.6)
NETWORKS = {
    "ring": parse_graph("ring:7"),
    "random": parse_graph("barabasi-albert:118x2", seed=3),
    "star": parse_graph("star:6"),
    "isolated": Network.from_edges(1, []),
    "disconnected": Network.from_edges(6, [(0, 1), (1, 2), (3, 4)]),
}
BENT = {"logcosh", "softplus"}  # mu is approached far from the targets


def extremes(cost):
    found = cost.curvature()
    return found.lower.min(), found.upper.max()


def everything(problem):
    """All numbers that an instance is made of, evaluated at the same points."""
    rng = np.random.default_rng(11)
    found = []
    members = (problem.N, problem.N, len(problem.edges))
    costs = (problem.node, problem.temporal, problem.spatial)
    for cost, count in zip(costs, members, strict=True):
        t, i = (x.ravel() for x in np.mgrid[1 : problem.H + 1, :count])
        w = rng.standard_normal((len(t), cost.size))
        found += [cost.value(t, i, w), cost.gradient(t, i, w), cost.hessian(t, i, w)]
    return found


@pytest.mark.parametrize("varying", [False, True])
@pytest.mark.parametrize("n", [1, 2])
@pytest.mark.parametrize("network", NETWORKS)
@pytest.mark.parametrize("style", styles())
def test_constants_are_those_asked_for(style, network, n, varying):
    problem = instance(NETWORKS[network], 4, GIVEN, style=style, n=n, varying=varying)
    alone = problem.N == 1 and n == 1 and not varying
    low, high = extremes(problem.node)
    assert low == pytest.approx(0.7, rel=1e-14)
    assert high == pytest.approx(0.7 if alone else 1.9, rel=1e-14)
    assert extremes(problem.temporal)[1] == pytest.approx(2.0, rel=1e-14)
    l_S = 0.6 if len(problem.edges) else 0.0
    assert extremes(problem.spatial)[1] == pytest.approx(l_S, rel=1e-14)
    if style not in BENT:
        assert problem.steady == (not varying)


@pytest.mark.parametrize("style", styles())
def test_no_hessian_leaves_the_constants(style):
    problem = instance(NETWORKS["random"], 3, GIVEN, style=style, n=2, varying=True)
    node, temporal, spatial = (np.linalg.eigvalsh(x) for x in everything(problem)[2::3])
    assert node.min() >= 0.7 * (1 - 1e-13)
    assert node.max() <= 1.9 * (1 + 1e-13)
    for pair, most in ((temporal, 2.0), (spatial, 0.6)):
        assert pair.min() >= -1e-13
        assert pair.max() <= most * (1 + 1e-13)


@pytest.mark.parametrize("style", sorted(BENT))
def test_bent_styles_reach_l_f_at_targets_and_mu_far_away(style):
    problem = instance(NETWORKS["ring"], 2, GIVEN, style=style, n=2)
    t, v = (x.ravel() for x in np.mgrid[1:3, :7])
    theta = problem.node.centre[t - 1, v]
    near = np.linalg.eigvalsh(problem.node.hessian(t, v, theta))
    away = np.linalg.eigvalsh(problem.node.hessian(t, v, theta + 50.0))
    assert near.max() == pytest.approx(1.9, rel=1e-14)
    assert away == pytest.approx(0.7, rel=1e-14)


@pytest.mark.parametrize("network", NETWORKS)
@pytest.mark.parametrize("kind", target_kinds())
@pytest.mark.parametrize("style", styles())
def test_every_style_meets_every_target(style, kind, network):
    for n in (1, 2):
        given = {"style": style, "targets": kind, "n": n, "box": (-1.0, 1.0)}
        problem = instance(NETWORKS[network], 3, GIVEN, seed=5, **given)
        again = instance(NETWORKS[network], 3, GIVEN, seed=5, **given)
        other = instance(NETWORKS[network], 3, GIVEN, seed=6, **given)
        one, two, three = map(everything, (problem, again, other))
        assert all(np.array_equal(a, b) for a, b in zip(one, two, strict=True))
        assert any(not np.array_equal(a, b) for a, b in zip(one, three, strict=True))
        assert all(np.isfinite(x).all() for x in one)
        assert (problem.n, problem.feasible.kind) == (n, "box")
        theta = problem.node.centre
        t, v = (x.ravel() for x in np.mgrid[1:4, : problem.N])
        at_targets = problem.node.value(t, v, theta.reshape(len(t), n))
        assert at_targets == pytest.approx(0.0, abs=1e-15)
        plain = instance(NETWORKS[network], 3, GIVEN, targets=kind, n=n, seed=5)
        assert np.array_equal(theta, plain.node.centre), "styles share targets"


def theta_of(kind, network, H, **given):
    return instance(network, H, GIVEN, targets=kind, **given).node.centre


def test_alternating_targets_differ_in_sign_from_all_neighbours_of_a_bipartite_graph():
    network = parse_graph("grid:3x4")
    theta = theta_of("alternating", network, 5, n=2)
    signs = np.sign(theta)
    assert (signs[1:] == -signs[:-1]).all()
    u, v = instance(network, 5, GIVEN).edges.T
    assert (signs[:, u] == -signs[:, v]).all()
    assert 0.5 <= np.abs(theta).min() <= np.abs(theta).max() <= 1.5


def test_last_and_walk_targets():
    network = NETWORKS["ring"]
    theta = theta_of("last", network, 5)
    assert not theta[:-1].any()
    assert theta[-1].all()
    steps = np.diff(theta_of("walk", network, 400, seed=1), axis=0)
    assert abs(steps.mean()) < 0.1
    assert abs(steps.std() - 1) < 0.1


def test_far_targets_are_zero_within_horizon_and_radius():
    network = parse_graph("ring:12")
    theta = theta_of("far:2,3,4", network, 5)[..., 0]
    away = np.abs(np.arange(12) - 4)
    away = np.minimum(away, 12 - away)
    inside = (np.arange(1, 6)[:, None] <= 2) & (away <= 3)
    assert np.array_equal(theta == 0.0, inside)
    assert (theta_of("far", network, 5) == 0.0).any()


def test_wave_targets_travel_outwards():
    theta = theta_of("wave", parse_graph("path:400"), 2, n=1)[..., 0]
    assert np.abs(theta).max() <= 1.0
    # one frequency in space: theta_(v+1) + theta_(v-1) is the same multiple of theta_v everywhere
    middle, around = theta[:, 1:-1], theta[:, 2:] + theta[:, :-2]
    ratio = (middle * around).sum() / (middle**2).sum()
    assert around == pytest.approx(ratio * middle, abs=1e-10)


def test_targets_may_be_given():
    given = np.arange(6.0).reshape(2, 3)
    theta = theta_of(given[..., None], parse_graph("path:3"), 2)
    assert np.array_equal(theta[..., 0], given)
    assert np.array_equal(theta_of([3.0], parse_graph("path:3"), 2)[..., 0], np.full((2, 3), 3.0))


def test_uniform_difference_couplings_are_those_of_the_theory():
    problem = instance(NETWORKS["ring"], 2, Parameters(1, 1, 2.0, 3.0), style="attraction")
    w, one = np.array([[0.3, 1.7]]), np.array([1])
    assert problem.temporal.value(one, one, w) == pytest.approx(2.0 / 4 * 1.4**2, rel=1e-14)
    assert problem.spatial.value(one, one, w) == pytest.approx(3.0 / 4 * 1.4**2, rel=1e-14)
    repelled = instance(NETWORKS["ring"], 2, Parameters(1, 1, 2.0, 3.0), style="repulsion")
    assert repelled.spatial.value(one, one, w) == pytest.approx(3.0 / 4 * 2.0**2, rel=1e-14)


@pytest.mark.parametrize("style", styles())
def test_couplings_may_vanish(style):
    problem = instance(NETWORKS["ring"], 2, Parameters(1, 1, 0, 0), style=style, varying=True)
    assert extremes(problem.temporal) == extremes(problem.spatial) == (0.0, 0.0)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"style": "magnetic"}, "style = 'magnetic': one of attraction, blocks"),
        ({"targets": "cloudy"}, "targets = 'cloudy': one of normal"),
        ({"targets": "walk:3"}, "targets = 'walk:3': one of"),
        ({"targets": "far:3"}, "targets = 'far:3': far:K,R"),
        ({"targets": "far:9,9"}, "something has to lie beyond"),
        ({"targets": "far:1,1,7"}, "an agent within 0..6"),
        ({"targets": np.zeros((2, 7, 3))}, "targets: 3 entries, not n = 1"),
        ({"targets": np.zeros((5, 7, 1))}, "the first axis is 1 or H = 2"),
        ({"n": 0}, "n = 0: an integer >= 1"),
        ({"seed": -1}, "seed = -1: an integer >= 0"),
        ({"seed": 1.5}, "seed = 1.5: an integer >= 0"),
        ({"box": (1.0, -1.0)}, "box at step 1, agent 0"),
    ],
)
def test_bad_input_says_what_is_accepted(change, message):
    with pytest.raises(InputError, match=message):
        instance(NETWORKS["ring"], 2, GIVEN, **change)


def test_parameters_are_one_float_each():
    with pytest.raises(InputError, match="one float each"):
        instance(NETWORKS["ring"], 2, Parameters(1, [1, 2], 1, 1))
