import json

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from nearsight.graphs import InputError, Network, parse_graph
from nearsight.lpc.codec import decode, encode
from nearsight.lpc.costs import (
    Callables,
    Hyperbola,
    LogCosh,
    Mixture,
    Quadratic,
    Softplus,
    Symbolic,
    kinds,
)
from nearsight.lpc.files import load_problem, save_problem
from nearsight.lpc.problem import Problem
from nearsight.lpc.sets import Ball, Box, Constraints, Everywhere, FeasibleSet, Functions

NET = Network.from_edges(
    4,
    [(0, 1), (2, 1), (3, 2), (0, 3)],
    names=["a b", "ü\udc80", "", "3\x00"],
    source="a file.gml",
    transitive=True,
)
RNG = np.random.default_rng(0)
CENTRE = np.where(RNG.random((3, 4, 2)) < 0.3, -0.0, RNG.normal(size=(3, 4, 2)))


def same(a, b):
    """Whether two values are equal bit by bit."""
    if isinstance(a, np.ndarray):
        return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()
    if isinstance(a, list | tuple):
        return len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(same(a[k], b[k]) for k in a)
    if hasattr(a, "fields"):
        return type(a) is type(b) and same(a.fields(), b.fields())
    return a == b


def problems():
    pair = np.array([[1.0, -1.0], [-1.0, 1.0]])
    smooth = Symbolic(
        "m*((x - a)**2 + y**2) + log(cosh(x - y))",
        ["x", "y"],
        {"m": 0.7, "a": CENTRE[..., 0]},
        lower=1.4,
        upper=[3.4, 3.5, 3.6, 3.7],
    )
    ridges = [
        kind(RNG.normal(size=(4, 3, 2)), RNG.normal(size=(3, 1, 3)), base=1.0)
        for kind in (LogCosh, Softplus, Hyperbola)
    ]
    mixture = Mixture([Quadratic(np.eye(2), CENTRE), smooth, *ridges], [0.5, 0, [1, 2, 0, 0], 1, 0])
    spatial = Quadratic(np.kron(pair, np.eye(2)), offset=RNG.random((3, 1)))
    box = Box(np.where(CENTRE < 0, -np.inf, -1.0), [np.inf, 0.3])
    ball = Ball(CENTRE, [[1.0, np.inf, 2.0, 3.0]])
    discs = Constraints(["x**2 + y**2 - r**2", "x - 1/3"], ["x", "y"], {"r": [[1], [2], [3.0]]})
    temporal = Symbolic("0.1*((x - u)**2 + (y - v)**2)", ["x", "y", "u", "v"])
    return [
        Problem(NET, 3, Quadratic(np.eye(2), CENTRE), feasible=box, x_0=CENTRE[0]),
        Problem(NET, 3, mixture, temporal, spatial, ball),
        Problem(NET, 3, smooth, None, None, discs),
        Problem(parse_graph("star:5"), 1, Quadratic([[0.1]])),
    ]


@pytest.mark.parametrize("problem", problems())
def test_round_trip(problem, tmp_path):
    path = tmp_path / "problem.npz"
    notes = {"k": 3, "r": None, "from": ["pricing", 0.1, {"seed": True}], "é": "\ud800"}
    save_problem(problem, path, notes)
    first = path.read_bytes()
    again, metadata = load_problem(path)
    assert metadata == notes
    for part in ("node", "temporal", "spatial", "feasible", "x_0"):
        assert same(getattr(problem, part), getattr(again, part)), part
    assert type(again.feasible) is type(problem.feasible)
    for part in ("indptr", "indices", "names", "source"):
        assert same(getattr(problem.network, part), getattr(again.network, part)), part
    x = RNG.normal(size=(problem.H, problem.N, problem.n))
    assert same(problem.costs(x), again.costs(x))
    save_problem(again, path, metadata)
    assert path.read_bytes() == first
    assert [p.name for p in tmp_path.iterdir()] == ["problem.npz"]


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=25)
@given(
    arrays(float, (2, 4, 3), elements=st.floats(allow_nan=False, allow_infinity=False)),
    arrays(float, (4, 3), elements=st.floats(allow_nan=False, max_value=0)),
)
def test_all_doubles_survive(tmp_path, centre, lower):
    lower[lower == -np.inf] = -1.0
    lower[0, 0] = -np.inf
    problem = Problem(NET, 2, Quadratic(np.eye(3), centre), feasible=Box(lower, np.inf))
    save_problem(problem, tmp_path / "p.npz")
    again = load_problem(tmp_path / "p.npz").problem
    assert same(again.node, problem.node)
    assert same(again.feasible, problem.feasible)


def test_single_values_survive():
    values = [None, True, 3, 10**30, "text", 0.1, -0.0, float("inf"), 5e-324, [1, [2.5]]]
    tree = json.loads(json.dumps(encode({"a": values}, {}), allow_nan=False))
    back = decode(tree, {})
    assert back == {"a": values}
    assert np.signbit(back["a"][6])
    assert [type(v) for v in back["a"]] == [type(v) for v in values]


PLAIN = Problem(NET, 2, Quadratic([[1.0]]))


def test_missing_files_and_folders(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        load_problem(tmp_path / "none.npz")
    with pytest.raises(InputError, match="not a problem file"):
        load_problem(tmp_path)
    with pytest.raises(InputError, match="cannot be written"):
        save_problem(PLAIN, tmp_path / "none" / "p.npz")
    (tmp_path / "folder").mkdir()
    with pytest.raises(InputError, match="cannot be written"):
        save_problem(PLAIN, tmp_path / "folder")
    assert [p.name for p in tmp_path.iterdir()] == ["folder"]


@pytest.mark.parametrize(
    "notes", [{"a": float("nan")}, {"a": {1}}, {1: 2}, {"a": (1, 2)}, {"a": np.ones(2)}]
)
def test_metadata_that_would_change_are_refused(notes, tmp_path):
    with pytest.raises(InputError, match="metadata"):
        save_problem(PLAIN, tmp_path / "p.npz", notes)
    assert not list(tmp_path.iterdir())


def square(t, i, w):
    return w[:, 0] ** 2


def slope(t, i, w):
    return 2 * w


def bend(t, i, w):
    return np.full((len(w), 1, 1), 2.0)


def test_functions_and_foreign_kinds_cannot_be_saved(tmp_path):
    class Elsewhere(Everywhere):
        kind = "elsewhere"

    sets: list[FeasibleSet] = [
        Functions(
            1,
            lambda t, v, y: y - 1,
            lambda t, v, y: np.ones((len(y), 1, 1)),
            lambda t, v, y: np.zeros((len(y), 1, 1, 1)),
        ),
        Elsewhere(),
    ]
    path = tmp_path / "p.npz"
    costs = Problem(NET, 2, Callables(1, square, slope, bend, 2, 2))
    for problem in (costs, *(Problem(NET, 2, PLAIN.node, feasible=s) for s in sets)):
        with pytest.raises(InputError, match=r"not saved: .*cannot be saved"):
            save_problem(problem, path)
    assert not list(tmp_path.iterdir())


def test_an_existing_file_survives_a_failure(tmp_path, monkeypatch):
    path = tmp_path / "p.npz"
    save_problem(PLAIN, path, {"first": True})

    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("numpy.savez", full)
    with pytest.raises(InputError, match="No space left"):
        save_problem(PLAIN, path)
    assert load_problem(path).metadata == {"first": True}
    assert [p.name for p in tmp_path.iterdir()] == ["p.npz"]


def test_every_kind_is_found():
    assert set(kinds()) >= {
        *("callables", "hyperbola", "log_cosh", "mixture", "quadratic", "softplus", "symbolic")
    }
    assert all(kind.kind == name for name, kind in kinds().items())
