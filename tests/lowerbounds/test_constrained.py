import numpy as np
import pytest

import nearsight as ns
from nearsight.bounds import Setting, bounds_for
from nearsight.lowerbounds import search_constrained, worst_case
from nearsight.lpc import instance
from nearsight.lpc.constants import constants

NETWORK = ns.parse_graph("ring:5")
GIVEN = ns.Parameters(1.0, 1.0, 1.0, 0.5)


@pytest.fixture(scope="module")
def worst():
    return worst_case(instance(NETWORK, 3, GIVEN), 2, 1)


def promised(k, r):
    here = Setting(GIVEN, ns.network_growth(NETWORK), k, r)
    (vi,) = (b for b in bounds_for("nearsight:sharp-cr") if b.variant == "vi")
    return vi.evaluate(here).values["cr_minus_one"]


@pytest.mark.parametrize("kind", ["box", "smooth"])
def test_a_search_climbs_within_the_class_and_below_the_promise(worst, kind):
    found = search_constrained(worst.problem, 2, 1, kind=kind, evaluations=25, seed=3)
    assert len(found.history) == 25
    assert found.history[0] == found.start
    assert list(found.history) == sorted(found.history)
    assert found.history[-1] == found.ratio_minus_one <= found.upper <= promised(2, 1)
    p = constants(found.problem).parameters()
    assert (p.mu, p.l_f, p.l_T, p.l_S) == pytest.approx((1.0, 1.0, 1.0, 0.5), rel=1e-13)
    assert ns.simulate(found.problem, k=2, r=1).ratio_minus_one == found.ratio_minus_one
    again = search_constrained(worst.problem, 2, 1, kind=kind, evaluations=25, seed=3)
    assert again.history == found.history


def test_wide_boxes_begin_where_the_quadratic_problem_is(worst):
    found = search_constrained(worst.problem, 2, 1, evaluations=1)
    assert found.start == pytest.approx(worst.cr_minus_one, rel=1e-7)
    assert not found.problem.feasible.everywhere


def test_bends_are_tangent_to_the_quadratic_costs(worst):
    found = search_constrained(worst.problem, 2, 1, kind="smooth", evaluations=1)
    at, who = np.array([1]), np.array([0])
    for name in ("temporal", "spatial"):
        bent, flat = (
            getattr(p, name).hessian(at, who, np.zeros((1, 2)))
            for p in (found.problem, worst.problem)
        )
        assert bent == pytest.approx(flat, abs=1e-14)


def test_networks_without_edges():
    alone = worst_case(instance(ns.parse_graph("path:1"), 3, GIVEN), 2, 1)
    found = search_constrained(alone.problem, 2, 1, kind="smooth", evaluations=3)
    assert found.ratio_minus_one > 0


def test_bad_arguments(worst):
    with pytest.raises(ns.InputError, match="box, smooth"):
        search_constrained(worst.problem, 2, 1, kind="ball")
    with pytest.raises(ns.InputError, match="evaluations"):
        search_constrained(worst.problem, 2, 1, evaluations=0)
    boxed = instance(NETWORK, 3, GIVEN, box=(-1.0, 1.0))
    for kind in ("box", "smooth"):
        with pytest.raises(ns.InputError, match="without constraints"):
            search_constrained(boxed, 2, 1, kind=kind)
