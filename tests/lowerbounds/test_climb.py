import numpy as np
import pytest

import nearsight as ns
from nearsight.bounds import Setting
from nearsight.lowerbounds import search_couplings, worst_case
from nearsight.lowerbounds.couplings import Couplings
from nearsight.lowerbounds.sandwich import certificates
from nearsight.lowerbounds.slope import Slope
from nearsight.lpc import instance
from nearsight.lpc.constants import constants

from ..bounds import oracles as oracle

RING = (ns.parse_graph("ring:6"), 5, ns.Parameters(1.0, 1.0, 1.0, 0.5), 3, 2)


def family(spec, H, l_f=1.0, a=1.0, x=1.0):
    network = ns.parse_graph(spec)
    return Couplings(network, H, ns.Parameters(1.0, l_f, a, x / max(network.max_degree, 1)))


def inner(couplings, rng):
    """A point in the interior of the box."""
    low, high = couplings.bounds
    share = np.where(high > 0, 0.1 + 0.8 * rng.random(low.size), 0.0)
    return np.where(np.isfinite(low), share, rng.uniform(0.0, 3.0, low.size))


CASES = [
    ("ring:6", 5, 3, 2, 1.0),
    ("star:5", 4, 2, 1, 2.0),
    ("path:4", 4, 7, 2, 3.0),
    ("path:1", 4, 2, 1, 2.0),
    ("complete:4", 3, 1, 0, 2.0),
]


@pytest.mark.parametrize(("spec", "H", "k", "r", "l_f"), CASES)
def test_the_gradient_is_that_of_finite_differences(spec, H, k, r, l_f):
    couplings = family(spec, H, l_f)
    slope = Slope(couplings, k, r)
    point = inner(couplings, np.random.default_rng(1))
    value, gradient = slope(point)
    step = 1e-6
    some = slice(0 if l_f > 1 else couplings.nodes, couplings.size)
    found = [
        (slope(point + step * e)[0] - slope(point - step * e)[0]) / (2 * step)
        for e in np.eye(couplings.size)[some]
    ]
    assert gradient[some] == pytest.approx(found, abs=1e-7 * np.abs(gradient).max())
    assert value > 0


@pytest.mark.parametrize(("spec", "H", "k", "r", "l_f"), CASES)
def test_its_value_is_the_worst_case_and_the_brute_force(spec, H, k, r, l_f):
    couplings = family(spec, H, l_f)
    point = inner(couplings, np.random.default_rng(2))
    value = Slope(couplings, k, r)(point)[0]
    exact = worst_case(couplings.problem(point), k, r).cr_minus_one
    assert value == pytest.approx(exact, rel=1e-12)
    if k > 1:
        m, P = couplings.matrices(point)
        N, E = couplings.network.vertices, len(couplings.edges)
        root = np.linalg.cholesky(P).swapaxes(1, 2)
        temporal = root[: couplings.nodes, :, ::-1].reshape(H, N, 2, 2)
        spatial = root[couplings.nodes :].reshape(H, E, 2, 2)
        node = np.sqrt(m).reshape(H, N, 1, 1)
        brute = oracle.Instance(oracle.Graph.of(couplings.network), node, temporal, spatial)
        assert value == pytest.approx(brute.worst(k, r)[0], rel=1e-8)


def test_the_corners_of_the_box_have_the_constants_given():
    couplings = family("star:5", 3, 2.5, 1.3, 0.7)
    rng = np.random.default_rng(0)
    for point in (couplings.random(rng), couplings.point(0.1, 0.2), couplings.bounds[1]):
        point = np.where(np.isfinite(point), point, 0.7)
        found = constants(couplings.problem(point)).parameters()
        given = couplings.parameters
        for name in ("l_f", "l_T", "l_S"):
            assert getattr(found, name) <= getattr(given, name)
        assert found.mu >= given.mu
        assert found.l_T == pytest.approx(given.l_T, rel=1e-12)


def test_differences_are_a_point():
    couplings = family("ring:6", 5)
    uniform = instance(couplings.network, 5, couplings.parameters)
    point = couplings.point(np.pi / 4, np.pi / 4)
    value = Slope(couplings, 3, 2)(point)[0]
    assert value == pytest.approx(worst_case(uniform, 3, 2).cr_minus_one, rel=1e-10)


@pytest.fixture(scope="module")
def searched():
    return search_couplings(*RING, starts=10, rounds=1, seed=0)


def test_couplings_that_are_worse_than_uniform_ones(searched):
    # hill climbing had seen 1.1876e-2; uniform couplings have 5.1e-3
    network, _, given, k, r = RING
    assert searched.cr_minus_one >= 1.13e-2
    here = Setting(given, ns.network_growth(network), k, r, unconstrained=True)
    assert searched.cr_minus_one <= certificates(here, k, r)[2]
    found = searched.constants.parameters()
    assert (found.mu, found.l_f) == (1.0, 1.0)
    assert found.l_T <= given.l_T
    assert found.l_S <= given.l_S
    run = ns.simulate(searched.worst.problem, k=k, r=r)
    assert run.ratio_minus_one == pytest.approx(searched.cr_minus_one, rel=1e-9)


def test_the_history_climbs(searched):
    assert len(searched.history) == 10
    assert searched.history[0].start == "uniform differences"
    ends = [climb.values[-1] for climb in searched.history]
    assert searched.cr_minus_one == pytest.approx(max(ends), rel=1e-12)
    for climb in searched.history:
        assert list(climb.values) == sorted(climb.values)


def test_a_seed_repeats_a_search_and_climbs_do_not_depend_on_each_other(searched):
    again = search_couplings(*RING, starts=2, rounds=1, seed=0)
    assert again.history == searched.history[:2]
    other = search_couplings(*RING, starts=2, rounds=1, seed=1)
    assert other.history != again.history


@pytest.mark.parametrize(("a", "x", "k", "r"), [(0.0, 0.0, 2, 1), (1.0, 1.0, 9, 9)])
def test_where_no_couplings_help(a, x, k, r):
    network = ns.parse_graph("ring:4")
    found = search_couplings(network, 3, ns.Parameters(1.0, 1.0, a, x / 2), k, r, starts=1)
    assert found.cr_minus_one <= 1e-28


def test_bad_arguments():
    for wrong in ({"starts": 0}, {"rounds": 0}, {"steps": 1.5}):
        with pytest.raises(ns.InputError, match=next(iter(wrong))):
            search_couplings(*RING, **wrong)
    with pytest.raises(ns.InputError, match="at most 2000 actions"):
        search_couplings(ns.parse_graph("ring:500"), 5, *RING[2:])


@pytest.mark.slow
def test_longer_horizons_and_larger_rings_are_worse_yet():
    # no copy of our output: each is compared with the network it contains
    given, k, r = RING[2:]
    short = search_couplings(*RING, starts=40, rounds=1).cr_minus_one
    longer = search_couplings(RING[0], 8, given, k, r, starts=20, rounds=1).cr_minus_one
    assert short >= 1.187e-2
    assert longer >= 1.3e-2


class StopError(Exception):
    pass


def stopping(after):
    """Progress that ends a run as soon as it speaks of a part."""

    def progress(text):
        if text.startswith(after):
            raise StopError

    return progress


def test_a_search_goes_on_after_its_finished_climbs(searched, tmp_path):
    file, options = tmp_path / "climbs", {"rounds": 1, "seed": 0}
    with pytest.raises(StopError):
        search_couplings(*RING, starts=3, checkpoint=file, progress=stopping("climb 3/"), **options)
    for torn in (b"", b"half a climb"):
        file.write_bytes(file.read_bytes() + torn)
        said = []
        found = search_couplings(*RING, starts=3, checkpoint=file, progress=said.append, **options)
        assert found.history == searched.history[:3]
        assert {text[:9] for text in said} == ({"climb 3/3"} if not torn else set())
    more = search_couplings(*RING, starts=10, checkpoint=file, **options)
    assert more.history == searched.history
    assert more.cr_minus_one == searched.cr_minus_one
    np.testing.assert_array_equal(
        more.worst.problem.node.centre, searched.worst.problem.node.centre
    )
    network, H, given, k, r = RING
    other = ns.Parameters(1.0, 1.0, 1.0, 0.4)
    for wrong, name in (
        ((network, H, given, k, 1), "r"),
        ((network, H + 1, given, k, r), "problem"),
        ((network, H, other, k, r), "constants, problem"),
    ):
        with pytest.raises(ns.InputError, match=rf"another climb \(other {name}\)"):
            search_couplings(*wrong, starts=1, checkpoint=file, **options)
