"""Sweeps: one measurement a spec, kept in a folder."""

import pytest

from nearsight.bounds import Parameters
from nearsight.graphs import InputError, parse_graph
from nearsight.perturbation import Runner, Spec, measure, sweep


def specs():
    for graph in ("ring:9", "grid:4x4"):
        for l_T in (0.5, 2.0):
            yield Spec(parse_graph(graph), Parameters(1, 2, l_T, 0.5), 3, 2, seed=3)


def test_a_sweep_is_its_measurements_whoever_computes_them(tmp_path):
    alone = [measure(spec, 25) for spec in specs()]
    seen = []
    found = sweep(specs(), 25, progress=lambda done, total: seen.append((done, total)))
    two = sweep(specs(), 25, runner=Runner(2), folder=tmp_path)
    for a, b, c in zip(alone, found, two, strict=True):
        assert a.profiles == b.profiles == c.profiles
        assert a.fit == b.fit == c.fit
    assert seen[-1] == (100, 100)
    assert seen == sorted(seen)


def test_a_sweep_goes_on(tmp_path):
    first, seen = sweep(list(specs())[:2], 25, folder=tmp_path), []
    whole = sweep(specs(), 25, folder=tmp_path, progress=lambda done, _: seen.append(done))
    assert [m.profiles for m in whole[:2]] == [m.profiles for m in first]
    assert min(seen) > 50  # the first two are not computed again
    assert len(list(tmp_path.iterdir())) == 4


def test_a_folder_that_cannot_be_made(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="folder"):
        sweep(specs(), 5, folder=tmp_path / "file" / "within")
