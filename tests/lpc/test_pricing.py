from fractions import Fraction as Q

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from nearsight.graphs import InputError, Network, parse_graph
from nearsight.lpc.pricing import Pricing
from nearsight.lpc.random_pricing import random_pricing
from nearsight.lpc.revenue import Scale, guarantee, revenue_ratio, safe_prices

GRAPHS = ["ring:4", "star:4", "path:2", "complete:3", "path:1"]
ONE, TWO = Network.from_edges(1, []), Network.from_edges(2, [(0, 1)])


def sample(i):
    """A random problem; couplings and caps from loose to very tight."""
    rng = np.random.default_rng([17, i])
    given = {
        "mu": 10 ** rng.uniform(-2, 0.5),
        "spread": rng.choice([1.0, 5.0]),
        "gamma": rng.uniform(0, 2),
        "carry": rng.choice([0.0, 0.01, 1.0]),
        "complements": rng.choice([0.0, 0.5, 1.0]),
        "cap": rng.choice([np.inf, 1.0, 0.2, 0.02]),
        "x_0": rng.choice([0.0, 0.0, 0.1, 3.0]),
    }
    return random_pricing(parse_graph(GRAPHS[i % 5]), int(rng.integers(1, 4)), seed=i, **given)


def brute_revenue(p, x):
    """The paper's definition, in loops."""
    eta = [{} for _ in range(p.H)]
    for t in range(p.H):
        for e, (u, v) in enumerate(p.edges):
            eta[t][u, v], eta[t][v, u] = p.cross[t, e]
    total = 0.0
    for t in range(p.H):
        for v in range(p.network.vertices):
            before = x[t - 1, v] if t else p.x_0[v]
            demand = p.nominal[t, v] - p.elasticity[t, v] * x[t, v] + p.carry[t, v] * before
            for u in p.network.neighbours(v):
                demand -= eta[t][int(u), v] * x[t, u]
            total += x[t, v] * demand
    return total


def optimum(p):
    """The best prices, by bounded least squares on ``x' M x / 2 - q' x`` built in loops."""
    H, N = p.nominal.shape
    M, q = np.zeros((H, N, H, N)), p.nominal.copy()
    q[0] += p.carry[0] * p.x_0
    for t in range(H):
        for v in range(N):
            M[t, v, t, v] += 2 * p.elasticity[t, v]
            if t:
                M[t, v, t - 1, v] -= p.carry[t, v]
                M[t - 1, v, t, v] -= p.carry[t, v]
        for e, (u, v) in enumerate(p.edges):
            M[t, u, t, v] += p.cross[t, e].sum()
            M[t, v, t, u] += p.cross[t, e].sum()
    L = np.linalg.cholesky(M.reshape(H * N, -1))
    bounds = (0.0, p.cap.ravel())
    x = lsq_linear(L.T, np.linalg.solve(L, q.ravel()), bounds, method="bvls", tol=1e-14).x
    return x.reshape(H, N)


@pytest.mark.parametrize("i", range(15))
def test_cost_is_constant_minus_revenue(i):
    p = sample(i)
    problem = p.problem()
    rng = np.random.default_rng(i)
    for scale in (0.0, 0.1, 1.0, 30.0):
        x = scale * rng.standard_normal(p.nominal.shape)  # the identity needs no feasibility
        revenue = brute_revenue(p, x)
        size = p.constant + abs(revenue) + scale**2
        assert p.revenue(x) == pytest.approx(revenue, rel=1e-12, abs=1e-12 * size)
        cost = problem.cost(x[..., None])
        assert cost == pytest.approx(p.constant - revenue, rel=1e-12, abs=1e-12 * size)
    assert p.revenue(x[..., None]) == p.revenue(x)
    assert np.array_equal(problem.edges, p.edges)
    assert np.array_equal(problem.feasible.upper[..., 0], p.cap)


@pytest.mark.parametrize("i", range(10))
def test_constants_are_eigenvalues_and_the_papers_are_no_better(i):
    p = sample(i)
    q, got, stated = p.problem(), p.parameters, p.stated_parameters
    node, temporal, spatial = (c.curvature() for c in (q.node, q.temporal, q.spatial))
    assert (got.mu, got.l_f) == (node.lower.min(), node.upper.max())
    assert got.l_T == pytest.approx(temporal.upper.max(), rel=1e-14)
    assert got.l_S == pytest.approx(spatial.upper.max(), rel=1e-14)
    assert (stated.mu, stated.l_T) == (got.mu, got.l_T)
    assert stated.l_f >= got.l_f
    assert stated.l_S >= got.l_S


@pytest.mark.parametrize("i", range(120))
def test_guarantees_hold_and_the_one_with_the_optimal_revenue_is_exact(i):
    p = sample(i)
    best = p.revenue(optimum(p))
    phi = max(p.constant - best, 0.0) / best
    exact = guarantee(p, 1.5, revenue=best)
    known = guarantee(p, 1.5, revenue=p.revenue(safe_prices(p)))
    blind = guarantee(p, 1.5)
    stated = guarantee(p, 1.5, tier="stated")
    assert all(g.guarantee for g in (exact, known, blind))
    assert exact.values["phi"] == phi
    assert phi <= known.values["phi"] * (1 + 1e-9) + 1e-12
    assert known.values["phi"] <= blind.values["phi"] * (1 + 1e-9) + 1e-12
    if stated.guarantee:
        assert phi <= stated.values["phi"] * (1 + 1e-9) + 1e-12
    assert p.base <= blind.values["factor"] * best * (1 + 1e-9)
    rng = np.random.default_rng(i)
    x = rng.random(p.nominal.shape) * np.minimum(p.cap, 3.0)
    cr = p.problem().cost(x[..., None]) / max(p.constant - best, 1e-300)
    if 1 <= cr < 1e6:
        ratio = revenue_ratio(p, x, optimum(p))
        found = guarantee(p, cr, revenue=best).values["ratio"]
        assert ratio == pytest.approx(found, rel=1e-7, abs=1e-7)
        assert ratio >= guarantee(p, cr).values["ratio"] - 1e-7 * (1 + cr)


def test_safe_prices_are_feasible_and_keep_demand():
    for i in range(30):
        p = sample(i)
        x, scale = safe_prices(p), Scale.of(p)
        assert ((x > 0) & (x <= p.cap)).all()
        floor = p.nominal * (1 - scale.felt / scale.safe)
        assert (p.demand(x) >= floor * (1 - 1e-12)).all()
        assert (floor >= p.nominal / 2 * (1 - 1e-12)).all()


# Rational instances inside the hypotheses of le:cr-rev (H = 1) where giving everything away,
# revenue 0, costs exactly CR cost(OPT), and the lemma promises a positive share of rev(OPT).
# Prices x of all products are equal; revenue = N x (a + b x_0 - (k + eta) x), best at x*.
PRINTED = {
    #              N, a, k,        eta,       b,   x_0,       cap
    "complements": (2, Q(1), Q(1), Q(9, 10), Q(1, 10), Q(0), None),
    "a binding cap": (1, Q(1), Q(1), Q(0), Q(9, 5), Q(0), Q(1, 4)),
    "a price before the first": (1, Q(1), Q(1), Q(0), Q(1, 2), Q(10), Q(10)),
}


@pytest.mark.parametrize("why", PRINTED)
def test_the_printed_lemma_fails(why):
    N, a, k, eta, b, x_0, cap = PRINTED[why]
    xi = k - (N - 1) * eta - b / 2
    mu, l_f = 2 * xi, 2 * k
    price = (a + b * x_0) / (2 * (k + eta))
    price = price if cap is None else min(price, cap)
    best = N * price * (a + b * x_0 - (k + eta) * price)
    constant = N * (a**2 / (4 * xi) + b * x_0**2 / 2)
    cr = constant / (constant - best)
    c = a / cap if cap else Q(0)
    lemma = max(2 * (l_f + (N - 1) * eta) / mu, c / mu)
    promised = 1 - lemma / 2 * (cr - 1)
    assert promised > 0
    assert why != "complements" or (cr, lemma, promised) == (Q(38, 37), 58, Q(8, 37))
    # the same with the code
    cross = np.full(2, float(eta))
    limit = np.inf if cap is None else float(cap)
    network = TWO if N == 2 else ONE
    p = Pricing(network, np.full((1, N), float(a)), float(k), cross, float(b), limit, float(x_0))
    assert p.revenue(optimum(p)) == pytest.approx(float(best), rel=1e-12)
    assert p.problem().cost(np.zeros((1, N, 1))) == pytest.approx(float(constant), rel=1e-12)
    stated = guarantee(p, float(cr), tier="stated")
    assert not stated.guarantee
    assert stated.values["eta"] == pytest.approx(float(lemma), rel=1e-12)
    assert stated.values["ratio"] == pytest.approx(float(promised), rel=1e-12)
    repaired = guarantee(p, float(cr))
    assert repaired.guarantee
    assert repaired.values["ratio"] <= 1e-12
    if not x_0:  # here the repaired lemma cannot be improved
        assert repaired.values["ratio"] == pytest.approx(0.0, abs=1e-12)


def test_a_carry_beyond_the_horizon_would_move_the_optimum():
    # xi with b_2 = b_1 = 1/2 is 1/2: the cost is least at 2/3, the revenue x (1 - x) largest at 1/2
    p = Pricing(ONE, [[1.0]], 1.0, carry=0.5)
    assert p.xi[0, 0] == 0.75
    assert optimum(p)[0, 0] == pytest.approx(0.5, rel=1e-12)
    less, least, more = (p.problem().cost(np.full((1, 1, 1), x)) for x in (0.49, 0.5, 0.51))
    assert least < min(less, more)


def test_demand_may_be_negative_at_the_optimum():
    # today's price is raised beyond what anybody pays, for the demand it leaves for tomorrow
    p = Pricing(ONE, [[0.1], [4.0]], 1.0, carry=[[0.0], [1.0]])
    x = optimum(p)
    assert x[:, 0] == pytest.approx([1.4, 2.7], rel=1e-12)
    assert p.demand(x)[0, 0] == pytest.approx(-1.3, rel=1e-12)


def test_hypotheses_decide_what_is_given():
    p = Pricing(TWO, [[1.0, 1.0]], 1.0, [0.2, 0.2], 0.1, x_0=[-1.0, 0.0])
    blind = guarantee(p, 1.1)
    assert not blind.guarantee
    assert blind.values["ratio"] is None
    assert blind.reasons["ratio"] == "hypothesis fails: x_0 >= 0"
    assert guarantee(p, 1.1, revenue=0.1).guarantee
    assert guarantee(p, 1.1, revenue=-0.1).values["phi"] is None
    mild = Pricing(TWO, [[1.0, 1.0]], 1.0, [0.2, 0.2])
    assert guarantee(mild, 1.1, tier="stated").guarantee
    assert guarantee(mild, 1.0).values["ratio"] == 1.0


def test_random_problems_keep_their_margins():
    p = random_pricing(parse_graph("grid:3x4"), 6, seed=4, mu=0.5, spread=3.0)
    assert p.parameters.mu == pytest.approx(0.5, rel=1e-12)
    assert p.parameters.l_f <= 1.5 * (1 + 1e-12)
    assert p.cross.min() < 0 < p.cross.max()
    for seed in (4, 5):
        q = random_pricing(parse_graph("grid:3x4"), 6, seed=seed, mu=0.5, spread=3.0)
        assert np.array_equal(p.elasticity, q.elasticity) == (seed == 4)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"nominal": [1.0, 1.0]}, r"nominal demand: shape \(2,\); \(H, 2\)"),
        ({"nominal": [[1.0, 1.0], [1.0, 0.0]]}, "nominal demand a at step 2, product 1: 0"),
        ({"elasticity": [[2.0, -2.0]]}, "elasticity k at step 1, product 1: -2"),
        ({"elasticity": 0.9}, r"elasticity k at step 1, product 0: 0.9; more than .* 1.2"),
        ({"carry": [[0.1, 0.1], [0.1, -0.1]]}, "carry b at step 2, product 1: -0.1"),
        ({"cap": [[1.0, 0.0]]}, "cap at step 1, product 1: 0"),
        ({"cap": [[1.0, np.nan]]}, "cap: nan at agent or edge 1"),
        ({"cross": [[0.1]]}, "two numbers an edge"),
        ({"cross": np.zeros((2, 3, 2))}, "the second 1 or 1"),
        ({"x_0": [1.0, 2.0, 3.0]}, r"x_0: numbers of shape \(2, 1\)"),
    ],
)
def test_bad_input_names_step_and_product(change, message):
    given = {"nominal": np.ones((2, 2)), "elasticity": 2.0, "cross": [1.0, 1.0], "carry": 0.2}
    with pytest.raises(InputError, match=message):
        Pricing(TWO, **{**given, **change})


def test_bad_arguments_of_the_guarantee():
    p = Pricing(ONE, [[1.0]], 1.0)
    with pytest.raises(InputError, match=r"cr = 0\.5: a finite number >= 1"):
        guarantee(p, 0.5)
    with pytest.raises(InputError, match="one of stated, repaired"):
        guarantee(p, 1.5, tier="sharp")
    with pytest.raises(InputError, match="a positive revenue"):
        revenue_ratio(p, [[1.0]], [[0.0]])
    with pytest.raises(InputError, match=r"prices: shape \(1,\)"):
        p.revenue([1.0])
    with pytest.raises(InputError, match=r"spread = 0\.5: a number >= 1"):
        random_pricing(ONE, 1, spread=0.5)
