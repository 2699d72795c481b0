"""Decay factors: every number against a closed form typed anew, in extended precision."""

import mpmath
import pytest
from mpmath import mpf

from nearsight.figures import Subject, picture_named

PICTURE = picture_named("decay-factors")


def table(**changes):
    subject = PICTURE.subject.with_typed(changes, PICTURE.takes)
    return PICTURE.compute(subject, lambda text: None)


def g(y):
    s = mpmath.sqrt(1 + y)
    return (s - 1) / (s + 1)


@pytest.fixture(scope="module")
def cubic():
    return table(graph="complete:4", mu=2.0, l_f=2.0, l_T=1.0, l_S=3.0)


def test_rates_in_time(cubic):
    with mpmath.workdps(60):
        for row in cubic.where(direction="time").records():
            a = mpf(row["coupling"])
            wanted = {
                "rho": mpmath.sqrt(1 - 2 / (mpmath.sqrt(1 + 2 * a) + 1)),
                "gamma": g(2 * a),
                "gamma_squared": g(2 * a) ** 2,
                "lambda_stated": (1 - 2 / (mpmath.sqrt(1 + 4 * a) + 1)) ** 2,
                "lambda_proven": g(2 * a) ** 2,
            }
            for name, value in wanted.items():
                assert row[name] == pytest.approx(float(value), rel=1e-14), name


def test_rates_in_space_depend_on_the_degree(cubic):
    with mpmath.workdps(60):
        for row in cubic.where(direction="space").records():
            a, x = mpf(row["coupling"]), 3 * mpf(row["coupling"])
            printed = x / (3 + 3 * x)
            if x >= 48:
                printed = max(printed, (1 - 4 * mpmath.sqrt(3) / mpmath.sqrt(x)) ** 2)
            wanted = {
                "rho": mpmath.sqrt(1 - 2 / (mpmath.sqrt(1 + x) + 1)),
                "gamma": g(x),
                "lambda_stated": printed,
                "lambda_proven": g(2 * a) ** 2,  # blocks of one vertex: degree 2 of the 3
            }
            for name, value in wanted.items():
                assert row[name] == pytest.approx(float(value), rel=1e-14), name


@pytest.mark.parametrize(
    ("direction", "lower", "upper", "factor", "scale"),
    [
        ("time", "lambda_stated", "rho", "factor_stated", 1),
        ("time", "lambda_proven", "rho", "factor_repaired", 1),
        ("time", "lambda_proven", "gamma_squared", "factor_sharp", 1),
        ("space", "lambda_stated", "rho", "factor_stated", 2),  # h may grow like rho^(-q/4)
        ("space", "lambda_proven", "rho", "factor_repaired", 1),
        ("space", "lambda_proven", "gamma_squared", "factor_sharp", 1),
    ],
)
def test_factors_are_ratios_of_logarithms(cubic, direction, lower, upper, factor, scale):
    for row in cubic.where(direction=direction).records():
        ratio = scale * mpmath.log(row[lower]) / mpmath.log(row[upper])
        assert row[factor] == pytest.approx(float(ratio), rel=1e-9)


def test_the_printed_factors_of_32_do_not_cover_the_printed_rates(cubic):
    rows = cubic.where(direction="space")
    assert rows.numbers("factor_stated").max() > 32 == rows.numbers("factor_printed")[0]
    assert cubic.where(direction="time").numbers("factor_stated").max() <= 4


def test_the_printed_lower_rate_in_time_exceeds_what_is_attained(cubic):
    rows = cubic.where(direction="time")
    assert (rows.numbers("lambda_stated") > rows.numbers("gamma_squared")).all()


def test_the_grid_reaches_the_couplings_given():
    x = table(graph="path:3", l_T=5e-6).where(direction="time").numbers("coupling")
    assert x[0] <= 5e-6
    assert x[-1] == 1e3


def test_without_edges_there_is_no_decay_in_space_and_the_picture_says_so():
    subject = Subject("path:1")
    found = PICTURE.compute(subject, lambda text: None)
    assert found.distinct("direction") == ["time"]
    from nearsight.figures import SIZES

    figure = PICTURE.draw(found, subject, SIZES["paper"])
    assert "no edges" in " ".join(t.get_text() for a in figure.axes for t in a.texts)
