"""With constraints no play is worse for LPC than the certificate "vi" promises."""

import numpy as np
import pytest

from nearsight.graphs import network_growth

from . import oracles as oracle
from .oracle_support import GUARD, certificates, graph, network

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
