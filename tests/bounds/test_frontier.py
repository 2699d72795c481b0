import mpmath
import numpy as np
import pytest

from nearsight.bounds import Parameters, Search, Setting
from nearsight.bounds.constants import Regrouped, Tight
from nearsight.bounds.frontier import Pair, frontier
from nearsight.bounds.paper_promise import PaperPromise
from nearsight.bounds.promise import Promise
from nearsight.bounds.sharp_promise import SharpPromise
from nearsight.graphs import parse_growth

from .support import FAMILIES, growth

GRAPHS = ["grid:5x7", "ring:9", "star:6", "complete:5", "path:2", "path:1"]
KINDS = ["stated", "repaired", "tight", "vi", "mix", "smooth"]
LIMIT = 40


def promise_of(kind, s):
    if kind in ("vi", "mix", "smooth"):
        return SharpPromise(s, kind)
    if kind == "tight":
        return PaperPromise(s, Tight("repaired", 0.8, 4.0), kind)
    return PaperPromise(s, Regrouped(kind), kind)


def random_promise(kind, spec, seed):
    """A random setting with a target that some pairs of the grid reach."""
    rng = np.random.default_rng([seed, *spec.encode(), *kind.encode()])
    strong = (-4, -2.5) if kind == "tight" else (-2.5, 0.3)
    l_T, l_S = 10.0 ** rng.uniform(*strong, 2)
    s = Setting(Parameters(1.0, 10.0 ** rng.uniform(0, 2), l_T, l_S), growth(spec))
    promise = promise_of(kind, s)
    k, r = np.arange(2, LIMIT + 1)[:, None], np.arange(1, LIMIT + 1)[None, :]
    values = np.broadcast_to(promise.excess(k, r), (k.size, r.size))
    reached = np.sort(values[np.isfinite(values) & (values > 0)])
    if reached.size:
        target = float(reached[int(rng.uniform(0.02, 0.9) * reached.size)] * (1 + 1e-9))
    else:
        target = 0.1
    return promise, values, target


def pareto(values, target):
    """All pairs of the grid that reach the target and waste neither k nor r."""
    best, high = [], LIMIT + 1
    for i, line in enumerate(values):
        hits = np.flatnonzero(line <= target)
        if hits.size and hits[0] + 1 < high:
            high = int(hits[0]) + 1
            best.append((i + 2, high))
    return best


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("spec", [*FAMILIES, *GRAPHS])
def test_frontier_is_that_of_the_whole_grid(kind, spec):
    for seed in range(2):
        promise, values, target = random_promise(kind, spec, seed)
        found = frontier(promise, target, Search(max_k=LIMIT, max_r=LIMIT))
        assert [(p.k, p.r) for p in found.pairs] == pareto(values, target)
        for p in found.pairs:
            assert p.excess == pytest.approx(values[p.k - 2, p.r - 1], rel=1e-12)
            assert p.excess <= target
            assert promise.certified(p.k, p.r, target)
            assert not promise.certified(p.k, p.r, p.excess * (1 - 1e-6))
        assert bool(found.reason) == (not found.pairs)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("spec", [*FAMILIES, *GRAPHS])
def test_floors_are_floors(kind, spec):
    for seed in range(2):
        promise, values, _ = random_promise(kind, spec, seed)
        slack = 1 + 1e-9  # excess and floor round differently
        finite = np.where(np.isfinite(values), values, np.inf)
        above = np.minimum.accumulate(finite.min(axis=1))  # least excess at any k' <= k
        floors = np.array([float(promise.floor_in_k(k)) for k in range(2, LIMIT + 1)])
        assert np.all(floors <= above * slack)
        assert np.all(
            np.diff(floors[np.isfinite(floors)]) <= floors[:-1][np.isfinite(floors[1:])] * 1e-12
        )
        radii = np.arange(1, LIMIT + 1)
        for k in (4, 5, 7, 12, 25, 40):
            later = finite[k - 2 :].min(axis=0)
            floor = np.broadcast_to(promise.floor_in_r(k, radii), radii.shape)
            assert np.all(~(floor > later * slack))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("spec", ["line", "grid2", "tree:3", "grid:5x7"])
def test_hopeless_radii_are_hopeless(kind, spec):
    for seed in range(2):
        promise, values, target = random_promise(kind, spec, seed)
        for k in (2, 3, 5, 9, 20):
            for r in (1, 3, 10):
                if promise.hopeless(k, r, target):
                    assert np.all(values[k - 2, r - 1 :] > target)


class Staircase(Promise):
    """Reaches 1 where ``r >= width(k)``; records what it is asked."""

    steps = 2
    variant = "staircase"

    def __init__(self, width, honest=True):
        self.width, self.honest = width, honest

    def excess(self, k, r):
        return np.where(np.asarray(r) >= self.width(np.asarray(k)), 0.5, 2.0)

    def floor_in_k(self, k):
        return np.asarray(0.5)

    def floor_in_r(self, k, r):
        return np.zeros(np.shape(r))

    def hopeless(self, k, r, excess):
        return False

    def settled(self, k, r):
        return False  # a staircase has no limit that it approaches exponentially

    def upper(self, k, r):
        return 0.5 if self.honest or (k + r) % 2 == 0 else np.inf


@pytest.mark.parametrize(
    "width",
    [
        lambda k: np.maximum(60 - 2 * k, 1),
        lambda k: 50 - 10 * (k // 7) + 3 * (k % 2),  # not monotone in k
        lambda k: np.where(k == 23, 1, 30),
        lambda k: np.where(k < 30, 1000, 7),
    ],
)
def test_any_staircase_is_found(width):
    promise, search = Staircase(width), Search(max_k=60, max_r=45)
    k, r = np.arange(2, 61)[:, None], np.arange(1, 46)[None, :]
    expected, high = [], 46
    for i, line in enumerate(promise.excess(k, r)):
        hits = np.flatnonzero(line <= 1)
        if hits.size and hits[0] + 1 < high:
            high = int(hits[0]) + 1
            expected.append(Pair(i + 2, high, 0.5, "staircase"))
    assert frontier(promise, 1.0, search).pairs == tuple(expected)


def test_only_certified_pairs_count():
    search = Search(max_k=12, max_r=12)
    pairs = frontier(Staircase(lambda k: 12 - k, honest=False), 1.0, search).pairs
    assert pairs
    for p in pairs:
        assert (p.k + p.r) % 2 == 0
        for k in range(2, p.k + 1):
            for r in range(max(12 - k, 1), p.r + 1):
                assert (k, r) == (p.k, p.r) or (k + r) % 2 == 1


def test_limits_and_reasons():
    promise = Staircase(lambda k: 60 - 2 * k)
    assert frontier(promise, 1.0, Search(max_k=10, max_r=39)).pairs == ()
    assert "radius" in frontier(promise, 1.0, Search(max_k=10, max_r=39)).reason
    assert [(p.k, p.r) for p in frontier(promise, 1.0, Search(10, 40)).pairs] == [(10, 40)]
    found = frontier(promise, 0.25, Search(10, 40))
    assert found.pairs == ()
    assert "horizon" in found.reason


def test_progress_is_reported():
    lines = []
    frontier(Staircase(lambda k: 60 - 2 * k), 1.0, Search(30, 60, lines.append))
    assert lines
    assert all(isinstance(line, str) and "\n" not in line for line in lines)


def test_certified_is_decided_in_intervals():
    s = Setting(Parameters(1.0, 1.0, 1.0, 0.5), growth("line"))
    promise = SharpPromise(s, "vi")
    value = float(promise.excess(4, 3))
    assert promise.certified(4, 3, value * (1 + 1e-12))
    assert not promise.certified(4, 3, value * (1 - 1e-12))
    mpmath.iv.prec = 20  # wide intervals decide less, never more
    assert not promise.certified(4, 3, value * (1 - 1e-12))


def test_a_bound_that_still_falls_after_the_top_has_faded_is_followed():
    # what the top does to the sides fades like e^(-alpha j), slower than gamma_T^k
    s = Setting(Parameters(1.0, 1.0, 3.409518983315859, 37.120913688729246), parse_growth("line"))
    promise, excess = SharpPromise(s, "vi"), 0.01906581933821519
    assert np.all(promise.excess(np.arange(2, 37), 30) > excess)
    (pair,) = frontier(promise, excess, Search(1000, 30)).pairs
    assert pair.r == 30
    assert pair.k == 2 + np.argmax(promise.excess(np.arange(2, 100), 30) <= excess)


def test_huge_boundaries_are_reached_by_longer_horizons():
    s = Setting(Parameters(1.0, 1.0, 0.01, 0.01), parse_growth("poly:1000000000000,0", 4))
    promise = PaperPromise(s, Regrouped("repaired"))
    best = frontier(promise, 0.01, Search(1000, 200)).pairs
    grid = promise.excess(np.arange(2, 60)[:, None], np.arange(1, 60))
    k, r = np.nonzero(grid <= 0.01)
    assert min(p.k + p.r for p in best) == np.min(k + 2 + r + 1)
