import contextlib
import io
import json
import zipfile

import numpy as np
import pytest

from nearsight.graphs import InputError, parse_graph
from nearsight.lpc.costs import Quadratic
from nearsight.lpc.files import load_problem, save_problem
from nearsight.lpc.problem import Problem

PLAIN = Problem(parse_graph("ring:4"), 2, Quadratic([[1.0]]))


def rewritten(path, **changes):
    """Save a problem, change its JSON (a dict, or a function of it), and write it back."""
    save_problem(PLAIN, path)
    with np.load(path) as archive:
        entries = {name: archive[name] for name in archive.files}
    head = json.loads(bytes(entries["problem.json"]))
    for name, change in changes.items():
        head[name] = change(head[name]) if callable(change) else change
    text = json.dumps(head).encode()
    np.savez(path, **{**entries, "problem.json": np.frombuffer(text, dtype=np.uint8)})


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"version": 2}, "version 2 of the format; this program reads 1"),
        ({"version": True}, "version True"),
        ({"format": "other"}, "its format is 'other'"),
        ({"problem": None}, "damaged"),
        ({"problem": lambda p: {**p, "H": 0}}, "H = 0"),
        ({"problem": lambda p: {**p, "node": {"cost": "cubic", "fields": {}}}}, "unknown kind"),
        ({"problem": lambda p: {**p, "node": {"cost": [], "fields": {}}}}, "unknown|damaged"),
        ({"problem": lambda p: {**p, "node": {"cost": "ridge", "fields": {}}}}, "unknown kind"),
        ({"problem": lambda p: {**p, "node": {"cost": "quadratic", "fields": {}}}}, "fields of"),
        ({"problem": lambda p: {**p, "node": {"cost": "callables", "fields": {}}}}, "fields of"),
        ({"problem": lambda p: {**p, "node": {"array": "a99"}}}, "array 'a99' is missing"),
        ({"problem": lambda p: {**p, "node": {"other": 1}}}, "unknown entry"),
        ({"problem": lambda p: {**p, "node": None}}, "node: a NoneType where a Cost"),
        ({"problem": lambda p: {**p, "feasible": 3}}, "feasible: a int where a FeasibleSet"),
        ({"problem": lambda p: {**p, "network": {}}}, "damaged"),
        ({"problem": lambda p: {n: x for n, x in p.items() if n != "x_0"}}, "damaged.*x_0"),
        ({"metadata": 3}, "damaged"),
    ],
)
def test_changed_files_are_refused(changes, message, tmp_path):
    path = tmp_path / "p.npz"
    rewritten(path, **changes)
    with pytest.raises(InputError, match=message) as caught:
        load_problem(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def npy(array, **options):
    stream = io.BytesIO()
    np.save(stream, array, **options)
    return stream.getvalue()


def archive(**entries):
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as z:
        for name, data in entries.items():
            z.writestr(name, data)
    return stream.getvalue()


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"hello",
        b"PK\x03\x04 broken",
        npy(np.arange(3)),
        npy(np.array([{}], dtype=object), allow_pickle=True),
        archive(),
        archive(**{"problem.json.npy": b"junk"}),
        archive(**{"problem.json": b"{}"}),
        archive(**{"problem.json.npy": npy(np.frombuffer(b"[1, 2", dtype=np.uint8))}),
        archive(**{"problem.json.npy": npy(np.frombuffer(b"[]", dtype=np.uint8))}),
        archive(**{"problem.json.npy": npy(np.array([{}], dtype=object), allow_pickle=True)}),
        archive(**{"problem.json.npy": npy(np.frombuffer(b"[" * 99999, dtype=np.uint8))}),
        b'{"nodes": [{"id": 0}], "edges": []}',
    ],
)
def test_foreign_files_are_refused(data, tmp_path):
    path = tmp_path / "p.npz"
    path.write_bytes(data)
    with pytest.raises(InputError, match="not a problem file") as caught:
        load_problem(path)
    assert "\n" not in str(caught.value)
    assert "pickle" not in str(caught.value)


def test_a_network_given_as_a_problem_is_sent_where_it_belongs(tmp_path):
    path = tmp_path / "g.json"
    path.write_text('{"nodes": [{"id": 0}], "edges": []}')
    with pytest.raises(InputError, match=r"written by --save .*\(a network goes to --graph\)$"):
        load_problem(path)


def test_truncated_and_flipped_files_are_refused(tmp_path):
    path = tmp_path / "p.npz"
    save_problem(PLAIN, path)
    whole = path.read_bytes()
    for length in range(0, len(whole), 97):
        path.write_bytes(whole[:length])
        with pytest.raises(InputError):
            load_problem(path)
    for position in range(0, len(whole), 41):
        path.write_bytes(whole[:position] + bytes([whole[position] ^ 255]) + whole[position + 1 :])
        with contextlib.suppress(InputError):  # the only error there may be
            assert load_problem(path).problem.node.matrix.item() == 1.0
