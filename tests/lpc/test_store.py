"""Units kept in a file: resumed after an interruption, refused where of something else."""

import numpy as np
import pytest

from nearsight.graphs import InputError
from nearsight.lpc.store import Store

HEADER = {"edges": 3, "seed": 0}  # a name that sorts before "format"
UNITS = {(2, 1): [1.5, np.nan], (0, 7): [-np.inf, 1e-300]}


def written(path, header=HEADER, units=UNITS):
    with Store(path, "trial", header, 2) as store:
        for (unit, last), values in units.items():
            store.save(unit, np.array(values), last)
    return path.read_bytes()


def known(path, header=HEADER):
    found = {}
    with Store(path, "trial", header, 2) as store:
        for unit, last in UNITS:
            out = np.zeros(2)
            if store.load(unit, out, last):
                found[unit, last] = out.tolist()
    return found


def test_cut_off_anywhere_the_whole_units_are_left(tmp_path):
    file = tmp_path / "units"
    whole = written(file)
    start = whole.index(b"\n") + 1
    for cut in range(len(whole) + 1):
        file.write_bytes(whole[:cut])
        left = max(0, cut - start) // 40  # three integers and two numbers of 8 bytes
        found = known(file)
        assert list(found) == list(UNITS)[:left]
        for key, values in found.items():
            np.testing.assert_array_equal(values, UNITS[key])
        assert file.read_bytes() == whole[: start + 40 * left]


def test_a_damaged_unit_is_not_used(tmp_path):
    file = tmp_path / "units"
    whole = bytearray(written(file))
    whole[-12] ^= 1
    file.write_bytes(bytes(whole))
    assert list(known(file)) == [(2, 1)]


def test_something_else_is_refused_and_left_as_it_is(tmp_path):
    file = tmp_path / "units"
    whole = written(file)
    with pytest.raises(InputError, match=r"of another trial \(other seed\); name another file"):
        known(file, HEADER | {"seed": 1})
    with pytest.raises(InputError, match="no file of bets"), Store(file, "bet", HEADER, 2):
        pass
    assert file.read_bytes() == whole
    for text in (b"something\n", b"[1, 2]\n", b"\xff\xfe" * 200, b"{}" + b" " * 200):
        file.write_bytes(text)
        with pytest.raises(InputError, match="no file of trials"):
            known(file)
    with pytest.raises(InputError, match="checkpoint"), Store(tmp_path, "trial", HEADER, 2):
        pass


def test_without_a_file_nothing_is_kept():
    with Store(None, "trial", HEADER, 2) as store:
        store.save(0, np.zeros(2))
        assert not store.load(0, np.zeros(2))
