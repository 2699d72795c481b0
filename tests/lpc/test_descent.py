import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nearsight.lpc.certify import certify
from nearsight.lpc.descent import descend
from nearsight.lpc.slope import narrow
from nearsight.lpc.solve import solve
from nearsight.lpc.terms import Terms

from .support import COSTS, SETS, random_problem


def many_copies(problem, count=12, skip=()):
    """Windows of different sizes, a copy each."""
    free = [
        (c, t, (v + c) % 5)
        for c in range(count)
        if c not in skip
        for t in range(1 + c % 3, 2 + c % 3 + c % 2)
        for v in range(1 + c % 4)
    ]
    return Terms.of(problem, np.array(free))


def fixed_values(terms, seed=0, scale=1.0):
    """Values that are the same for a copy whatever the other copies are."""
    size = np.array([scale if c % 2 else 1.0 for c in terms.fixed[:, 0]])[:, None]
    wave = np.sin(terms.fixed @ [1.7, 2.3, 3.1] + seed)[:, None] * np.arange(1, terms.problem.n + 1)
    return size * wave


@pytest.mark.parametrize("n", [1, 2])
@pytest.mark.parametrize("feasible", SETS)
@pytest.mark.parametrize("costs", COSTS)
def test_a_copy_knows_nothing_of_the_others(costs, feasible, n):
    problem = random_problem(2, n, 4, costs, feasible)
    terms = many_copies(problem)
    start = np.zeros((len(terms.free), n))
    fixed = fixed_values(terms)
    together = solve(terms, fixed, start=start)
    assert together.converged.all()
    # change half of the copies: they take other numbers of steps, the rest keep every bit
    changed = solve(terms, fixed_values(terms, scale=1e3), start=start)
    even = terms.free[:, 0] % 2 == 0
    assert np.array_equal(together.x[even], changed.x[even])
    assert not np.array_equal(together.x[~even], changed.x[~even])
    for c in range(12):
        kept = terms.free[:, 0] == c
        alone, mine = narrow(terms, kept)
        single = solve(alone, fixed[mine], start=start[kept])
        assert np.array_equal(single.x, together.x[kept])
        assert single.iterations[0] == together.iterations[c]
        assert single.error[0] == together.error[c]
    fewer = many_copies(problem, skip=(0, 5, 7))
    some = solve(fewer, fixed_values(fewer))
    assert np.array_equal(some.x, together.x[np.isin(terms.free[:, 0], fewer.free[:, 0])])


def test_copies_finish_at_different_steps_and_start_from_where_they_are_told():
    problem = random_problem(2, 2, feasible="box")
    terms = many_copies(problem)
    fixed = fixed_values(terms, scale=1e3)
    found = descend(terms, fixed, np.zeros((len(terms.free), 2)))
    assert len(np.unique(found.iterations)) > 4
    again = descend(terms, fixed, found.x)
    assert (again.iterations < found.iterations).all()
    assert np.abs(again.x - found.x).max() <= 1e-9


@given(
    st.integers(0, 10**6),
    st.integers(1, 3),
    st.sampled_from(["everywhere", "box", "ball"]),
    st.floats(-8, 8),
)
def test_any_point_can_be_certified(seed, n, feasible, magnitude):
    problem = random_problem(seed, n, 4, feasible=feasible)
    terms = many_copies(problem, 3)
    rng = np.random.default_rng(seed)
    fixed = fixed_values(terms)
    best = solve(terms, fixed)
    known = certify(terms, fixed, rng.normal(size=best.x.shape) * 10**magnitude)
    for c, bound in enumerate(known.error):
        rows = terms.free[:, 0] == c
        assert np.linalg.norm((known.x - best.x)[rows]) <= bound + best.error[c]


def test_the_limit_is_kept_and_reported():
    problem = random_problem(2, 2, feasible="box")
    terms = many_copies(problem)
    fixed, start = fixed_values(terms), np.zeros((len(terms.free), 2))
    short = descend(terms, fixed, start, limit=3)
    best = descend(terms, fixed, start)
    assert short.iterations.max() == 3
    assert not short.converged.all()
    assert np.linalg.norm(short.x - best.x) <= np.linalg.norm(short.error + best.error)


def test_more_than_rounding_allows_ends_at_its_floor():
    problem = random_problem(2, 2, feasible="ball")
    terms = many_copies(problem)
    fixed = fixed_values(terms)
    found = descend(terms, fixed, np.zeros((len(terms.free), 2)), tolerance=0.0)
    assert found.converged.all()
    assert found.iterations.max() < 500
    assert (found.error <= 1e-12).all()


def test_progress_is_told_and_nothing_to_do_is_done():
    problem = random_problem(2, 2, feasible="box")
    terms = many_copies(problem)
    heard = []
    descend(
        terms,
        fixed_values(terms),
        np.zeros((len(terms.free), 2)),
        progress=lambda step, done: heard.append((step, done)),
    )
    assert heard
    assert all(0 <= done <= 1 for _, done in heard)
    nothing = Terms.of(problem, np.zeros((0, 3), dtype=np.int64))
    assert solve(nothing, np.zeros((0, 2))).x.shape == (0, 2)


def test_the_floor_and_the_answer_do_not_depend_on_units():
    problem = random_problem(2, 2)
    terms = many_copies(problem)
    fixed = fixed_values(terms)
    plain = descend(terms, fixed, np.zeros((len(terms.free), 2)))
    tiny = 2.0**-300
    small = dataclasses.replace(
        problem,
        node=type(problem.node)(problem.node.matrix, tiny * problem.node.centre),
        temporal=type(problem.node)(problem.temporal.matrix, tiny * problem.temporal.centre),
        spatial=type(problem.node)(problem.spatial.matrix, tiny * problem.spatial.centre),
    )
    scaled = descend(many_copies(small), tiny * fixed, np.zeros((len(terms.free), 2)))
    assert np.array_equal(scaled.x, tiny * plain.x)
