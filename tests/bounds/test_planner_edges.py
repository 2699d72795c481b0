"""Where there is no plan, the least plan, a plan that is no guarantee, or bad input."""

import numpy as np
import pytest

from nearsight.bounds import Parameters, Prices, Search, Setting, plan
from nearsight.graphs import InputError

from .support import growth, reference


def test_unreachable_on_a_growing_tree():
    s = Setting(Parameters(1.0, 1.0, 1.0, 100.0), growth("tree:3"))
    for found in plan(s, 1.01, search=Search(max_k=2000, max_r=200)).tiers:
        assert found.pair is None
        assert "radius" in found.reason or "horizon" in found.reason


def test_stated_plan_where_the_statement_is_not_proved_is_no_guarantee():
    s = Setting(Parameters(1.0, 1.0, 1.0, 1e-6), growth("line"))
    found = plan(s, 1.5)
    assert found["stated"].pair is not None
    assert not found["stated"].guarantee
    assert "no guarantee here" in found["stated"].reason
    assert found["repaired"].guarantee
    assert found["sharp"].guarantee
    assert plan(reference(1.0), 1.5)["stated"].guarantee


def test_an_uncoupled_network_needs_the_least():
    for spec in ("line", "path:1", "tree:3", "star:6"):
        found = plan(Setting(Parameters(1.0, 1.0, 0.0, 0.0), growth(spec)), 1 + 1e-9)
        for tier in ("repaired", "sharp"):
            assert (found[tier].pair.k, found[tier].pair.r) == (2, 1)


def test_a_single_agent_needs_no_radius():
    s = Setting(Parameters(1.0, 1.0, 1.0, 7.0), growth("path:1"))
    found = plan(s, 1.01)
    assert found["sharp"].pair.r == found["repaired"].pair.r == 1


def test_unknown_tier():
    with pytest.raises(KeyError, match="stated, repaired, sharp"):
        plan(reference(0.1), 1.5)["shrap"]


@pytest.mark.parametrize("target", [1.0, 0.5, -1.0, np.inf, np.nan])
def test_bad_target(target):
    with pytest.raises(InputError, match=r"^target = [^\n]*$"):
        plan(reference(1.0), target)


def test_arrays_are_not_planned():
    s = Setting(Parameters(1.0, 1.0, np.array([0.1, 1.0]), 0.1), growth("line"))
    with pytest.raises(InputError, match=r"^[^\n]*scalar[^\n]*$"):
        plan(s, 1.01)


@pytest.mark.parametrize("price", [-1.0, np.inf, np.nan])
@pytest.mark.parametrize("name", ["k", "r"])
def test_bad_price(name, price):
    with pytest.raises(InputError, match=rf"^price of {name} = [^\n]*$"):
        Prices(**{name: price})
