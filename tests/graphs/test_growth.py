import dataclasses
import math

import flint
import mpmath
import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

from nearsight.graphs import modules, network_growth, parse_graph, parse_growth

EXACT = [
    "line",
    "grid2",
    "grid3",
    "tree:2",
    "tree:3",
    "tree:6",
    "ring-of-blocks:1",
    "ring-of-blocks:2",
    "ring-of-blocks:5",
]
BOUNDS = [
    ("poly:4,1", 4),
    ("poly:2,0", 2),
    ("poly:6.5,2", 6),
    ("poly:3,3", 3),
    ("poly:2.5,1.5", 2),
    ("poly:3,0.3", 3),
    ("values:1,4,8,12", 4),
    ("values:1", 0),
]
ALL = [(spec, None) for spec in EXACT] + BOUNDS


@pytest.fixture(params=ALL, ids=lambda pair: pair[0])
def growth(request):
    return parse_growth(*request.param)


def term(growth, q):
    """h(q) as the transform takes it: for poly without rounding down."""
    if q and hasattr(growth, "exponent"):
        c, p = growth.coefficient, growth.exponent
        power = mpmath.mpf(p.numerator) / p.denominator
        return mpmath.mpf(int(q)) ** power * c.numerator / c.denominator
    return mpmath.mpf(growth.h(int(q)))


def pole(growth):
    return 1 / (growth.degree - 1) if growth.source.startswith("tree") else 1.0


def test_every_family_is_tested():
    assert {spec.partition(":")[0] for spec, _ in ALL} == set(modules("infinite"))
    for family in modules("infinite").values():
        assert family.SYNTAX.startswith(family.NAME)
        assert family.DESCRIPTION


def test_origin_and_relations(growth):
    assert (growth.h(0), growth.ball(0), growth.eta(0)) == (1, 1, 0)
    assert growth.h(1) == growth.max_degree or not growth.exact
    running = 1
    for q in range(1, 30):
        running += growth.h(q)
        assert growth.ball(q) - growth.ball(q - 1) >= 0
        assert growth.ball(q) == running if growth.exact else growth.ball(q) >= running
        assert growth.eta(q) <= growth.max_degree * min(growth.h(q), growth.h(q - 1))
        assert all(type(f(q)) is int for f in (growth.h, growth.ball, growth.eta))


def test_ends(growth):
    if growth.infinite:
        assert growth.radius is None
        with pytest.raises(ValueError, match="is infinite"):
            growth.values()
    else:
        assert growth.values() == list(growth.listed)
        assert growth.radius == len(growth.listed) - 1
    assert growth.vertices is None
    assert growth.edges is None


@pytest.mark.parametrize(
    ("spec", "finite", "radius"),
    [
        ("line", "ring:60", 29),
        ("line", "path:60", 29),
        ("grid2", "torus:25x25", 10),
        ("grid2", "grid:25x25", 12),
        ("ring-of-blocks:1", "ring-of-blocks:50x1", 24),
        ("ring-of-blocks:2", "ring-of-blocks:40x2", 18),
        ("ring-of-blocks:5", "ring-of-blocks:30x5", 13),
        ("tree:3", "tree:2x9", 4),
        ("tree:6", "tree:5x4", 2),
        ("tree:2", "tree:1x20", 9),
    ],
)
def test_limits_of_finite_graphs(spec, finite, radius):
    infinite, large = parse_growth(spec), network_growth(parse_graph(finite))
    for q in range(radius + 1):
        assert (infinite.h(q), infinite.ball(q)) == (large.h(q), large.ball(q))
        assert infinite.eta(q) == large.eta(q)


def test_cubic_grid_by_enumeration():
    growth = parse_growth("grid3")
    points = np.abs(np.indices((21, 21, 21)).reshape(3, -1) - 10)
    distance = points.sum(axis=0)
    for q in range(1, 11):
        sphere = distance == q
        assert growth.h(q) == sphere.sum()
        assert growth.ball(q) == (distance <= q).sum()
        # towards the origin: one edge for every coordinate that is not 0
        assert growth.eta(q) == (points[:, sphere] > 0).sum()


def test_arrays_are_rounded_correctly(growth):
    q = np.array([[0, 1, 2], [3, 70, 5]])
    for f in (growth.h, growth.ball, growth.eta):
        values = f(q)
        assert values.dtype == np.float64
        assert values.tolist() == [[float(f(int(x))) for x in row] for row in q]
    assert type(growth.h(np.int64(3))) is int
    assert growth.h(np.array([], dtype=int)).shape == (0,)


def test_overflow_becomes_infinite():
    tree = parse_growth("tree:3")
    assert tree.h(np.array([1000, 1024, 5000, 10**18])).tolist() == [
        float(3 * 2**999),
        math.inf,
        math.inf,
        math.inf,
    ]
    assert tree.h(3000) == 3 * 2**2999
    assert parse_growth("poly:4,64", 4).h(np.array([10**6]))[0] == math.inf


def test_bad_distances(growth):
    with pytest.raises(ValueError, match="a distance is at least 0, not -1"):
        growth.h(-1)
    with pytest.raises(ValueError, match="a distance is at least 0, not -2"):
        growth.ball(np.array([1, -2]))
    with pytest.raises(TypeError):
        growth.eta(1.0)
    with pytest.raises(TypeError, match="distances are integers, not float64"):
        growth.eta(np.array([1.0]))


@pytest.mark.parametrize("share", ["0.05", "0.5", "0.9"])
def test_transform_is_the_sum(growth, share):
    with mpmath.workdps(50):
        z = mpmath.mpf(share) * mpmath.mpf(pole(growth))
        last = 2000 if growth.infinite else growth.radius
        total = mpmath.fsum(term(growth, q) * z**q for q in range(last + 1))
        assert mpmath.almosteq(growth.transform(z), total, rel_eps=mpmath.mpf(10) ** -45)


@given(share=st.floats(0, 1, exclude_max=True), pair=st.sampled_from(ALL))
def test_floats_are_accurate(share, pair):
    growth = parse_growth(*pair)
    z = min(share * pole(growth), math.nextafter(pole(growth), 0))
    with mpmath.workdps(60):
        exact = growth.transform(mpmath.mpf(z))
    found = growth.transform(z)
    assert type(found) is float
    assert abs(found - exact) <= 2e-15 * exact * (1 + getattr(growth, "exponent", 0))


def test_next_to_the_pole():
    # 3 z rounds to 1 in binary64, though the double z is below 1/3
    z = 1 / 3
    assert parse_growth("tree:4").transform(z) == pytest.approx((1 + z) * 3 / 1.6653e-16, rel=1e-3)
    assert parse_growth("tree:4").transform(math.nextafter(z, 1)) == math.inf
    assert parse_growth("tree:4").transform(1e308) == math.inf


@pytest.mark.parametrize("share", [0.25, 0.875])
def test_transform_in_other_arithmetics(growth, share):
    z = share * pole(growth) if growth.infinite else share
    expected = growth.transform(z)
    assert growth.transform(np.array([[z, 0.0]])).tolist() == [[pytest.approx(expected), 1.0]]
    assert growth.transform(np.float64(z)) == expected
    assert float(growth.transform(mpmath.mpf(z))) == pytest.approx(expected, rel=1e-14)
    assert float(growth.transform(sympy.Float(z, 30))) == pytest.approx(expected, rel=1e-14)
    with mpmath.workdps(40):
        exact = growth.transform(mpmath.mpf(z))
    enclosure = growth.transform(mpmath.iv.mpf(z))
    assert enclosure.a <= exact * (1 + mpmath.mpf(2) ** -99)
    assert enclosure.b >= exact
    assert enclosure.delta <= 1e-10 * exact
    ball = growth.transform(flint.arb(z))
    assert float(ball.mid()) == pytest.approx(expected, rel=1e-10)
    assert not ball < flint.arb(mpmath.nstr(exact, 40))


def test_symbols():
    z = sympy.Symbol("z", positive=True)
    assert sympy.simplify(parse_growth("tree:4").transform(z) - (1 + z) / (1 - 3 * z)) == 0
    blocks = sympy.series(parse_growth("ring-of-blocks:3").transform(z), z, 0, 5).removeO()
    assert sympy.expand(blocks - (1 + 6 * z + 8 * z**2 + 6 * z**3 + 6 * z**4)) == 0
    assert parse_growth("poly:2,0.5", 2).transform(z) == 1 + 2 * sympy.polylog(
        -sympy.Rational(1, 2), z
    )


@pytest.mark.parametrize(
    "number", [mpmath.mpf, mpmath.iv.mpf, sympy.Rational, flint.arb, float], ids=str
)
@pytest.mark.parametrize("z", [1, 7])
def test_divergence(growth, number, z):
    value = growth.transform(number(z))
    if growth.infinite:
        assert not value < 1e300
        assert "inf" in str(value) or "oo" in str(value)
    else:
        assert value == sum(h * z**q for q, h in enumerate(growth.values()))


def test_an_interval_that_reaches_the_pole():
    assert mpmath.iv.mpf("inf") == parse_growth("line").transform(mpmath.iv.mpf([0.5, 1]))


def test_nan_and_negative(growth):
    found = growth.transform(np.array([np.nan, 0.0]))
    assert math.isnan(found[0]) or found.tolist() == [1.0, 1.0]  # one listed value is a constant
    for z in (-0.5, np.array([0.5, -0.5]), mpmath.mpf("-0.5")):
        with pytest.raises(ValueError, match=r"transform needs z >= 0, not -0\.5"):
            growth.transform(z)


def test_immutable():
    with pytest.raises(dataclasses.FrozenInstanceError):
        parse_growth("tree:3").degree = 4
    assert parse_growth("tree:3") == parse_growth("tree:3")
