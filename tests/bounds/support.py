"""What the tests of bounds/ share: random settings, and distances in units of the last place."""

from functools import cache

import numpy as np
from hypothesis import strategies as st
from mpmath import mp, mpf

from nearsight.bounds import Parameters, Setting
from nearsight.graphs import network_growth, parse_graph, parse_growth

FAMILIES = {"line": None, "grid2": None, "tree:3": None, "ring-of-blocks:2": None, "poly:3,2": 3}
TINY, LARGEST = mpf(2) ** -1022, mpf(2) ** 1024 * (1 - mpf(2) ** -54)


@cache
def growth(spec):
    """The growth of an infinite family, or of a finite graph where the name is none."""
    if spec in FAMILIES:
        return parse_growth(spec, FAMILIES[spec])
    return network_growth(parse_graph(spec))


def reference(a):
    """Theory section 4: ring, l_f = mu, a = x, so l_S = x/2."""
    return Setting(Parameters(1.0, 1.0, a, a / 2), growth("line"))


def ulps(value, exact):
    """How far a float is from an exact number, in units in the last place of the latter."""
    with mp.workdps(60):
        exact = +exact
        if mp.isinf(exact) or abs(exact) >= LARGEST:
            return 0.0 if value == (np.inf if exact > 0 else -np.inf) else mp.inf
        if np.isnan(value):
            return mp.inf
        if exact == 0:
            return 0.0 if value == 0 else mp.inf
        unit = mpf(2) ** (mp.frexp(max(abs(exact), TINY))[1] - 53)
        return float(abs(mpf(float(value)) - exact) / unit)


def log_uniform(low, high):
    """Floats between ``10**low`` and ``10**high``, their logarithms uniform."""
    return st.floats(low, high).map(lambda e: float(10.0**e))


ratios = log_uniform(-150, 150)
moderate = log_uniform(-3, 2)


conditions = log_uniform(0, 6)


@st.composite
def parameters(draw, ratio=ratios, condition=conditions):
    mu = draw(log_uniform(-100, 100))
    l_f = max(mu, mu * draw(condition))
    return Parameters(mu, l_f, mu * draw(ratio), mu * draw(ratio))


@st.composite
def settings_of(draw, specs=tuple(FAMILIES), ratio=ratios, k=(2, 200), r=(1, 60), **more):
    """Settings with everything drawn; ``more`` goes to `Setting` as it is."""
    return Setting(
        draw(parameters(ratio)),
        growth(draw(st.sampled_from(list(specs)))),
        draw(st.integers(*k)),
        draw(st.integers(*r)),
        **more,
    )


def exact(s):
    """``l_T/mu, l_S/mu, l_f/mu`` as mpmath numbers with 500 digits."""
    p = s.parameters
    with mp.workdps(500):
        return mpf(p.l_T) / mpf(p.mu), mpf(p.l_S) / mpf(p.mu), mpf(p.l_f) / mpf(p.mu)


def spheres(s):
    """``h(0), ..., h(r)``."""
    return [s.growth.h(q) for q in range(s.r + 1)]
