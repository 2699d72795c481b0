"""The brute force itself: reference numbers, and that its worst instance is the worst."""

import numpy as np
import pytest

from . import oracles as oracle
from .oracle_support import graph

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
