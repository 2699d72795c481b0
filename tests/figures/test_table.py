"""Data of pictures: what is written is what is read."""

import csv
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nearsight.figures import Table
from nearsight.graphs import InputError

TEXTS = st.text("abcd xyz,\"'é$\\", min_size=1).filter(lambda text: text.strip("abcd") != "")
VALUES = st.none() | st.integers(-(10**18), 10**18) | st.floats(allow_nan=False) | TEXTS


@given(st.lists(st.tuples(VALUES, VALUES), max_size=5))
def test_reading_gives_the_same_values(rows):
    table = Table(("one", "two"), tuple(rows))
    found, head = Table.from_csv(table.to_csv({"figure": "none", "graph": "a: b, c"}))
    assert found == table
    assert [list(map(type, row)) for row in found.rows] == [list(map(type, row)) for row in rows]
    assert head == {"figure": "none", "graph": "a: b, c"}


def test_other_programs_read_it():
    table = Table.of([{"x": 0.1, "who": "a, b"}, {"x": np.float64(1e-300)}, {"y": np.int64(3)}])
    lines = table.to_csv({"figure": "none"}).splitlines()
    found = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    assert [row["x"] for row in found] == ["0.1", "1e-300", ""]
    assert [row["who"] for row in found] == ["a, b", "", ""]
    assert float(found[0]["x"]) == 0.1


def test_rows_are_chosen_and_gaps_are_not_numbers():
    table = Table.of([{"k": 2, "y": 1.5}, {"k": 3}, {"k": 3, "y": True}])
    assert table.where(k=3).numbers("y").tolist()[1] == 1.0
    assert math.isnan(table.where(k=3).numbers("y")[0])
    assert table.distinct("k") == [2, 3]
    assert table.distinct("y") == [1.5, 1]
    assert table.records()[1] == {"k": 3, "y": None}


def test_bad_tables_are_refused():
    with pytest.raises(InputError, match="needs 2 values"):
        Table(("a", "b"), ((1,),))
    with pytest.raises(InputError, match="no column 'c': a, b"):
        Table(("a", "b"), ()).numbers("c")
    for text in ("", "# only: a head\n", "a,b\n1\n"):
        with pytest.raises(InputError, match="no table"):
            Table.from_csv(text)
