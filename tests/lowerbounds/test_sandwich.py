import csv
from dataclasses import fields

import pytest

import nearsight as ns
from nearsight.lowerbounds import Row, Sandwich, sandwich, search_couplings, worst_case, write_csv
from nearsight.lowerbounds.floor import floor
from nearsight.lpc import instance, promise

GIVEN = ns.Parameters(1.0, 1.0, 1.0, 0.5)


@pytest.fixture(scope="module")
def found():
    return sandwich(ns.parse_graph("ring:6"), 4, GIVEN, [3, 2], [1, 2], starts=1)


def test_rows_hold_what_each_part_says(found):
    network = ns.parse_graph("ring:6")
    problem = instance(network, 4, GIVEN)
    assert [(row.k, row.r) for row in found.rows] == [(2, 1), (2, 2), (3, 1), (3, 2)]
    for row in found.rows:
        k, r = row.k, row.r
        setting = ns.Setting(GIVEN, ns.network_growth(network))
        assert row.lower == floor(setting, network, k, r).cr_minus_one
        assert row.worst == worst_case(problem, k, r).cr_minus_one
        assert row.searched == search_couplings(network, 4, GIVEN, k, r, starts=1).cr_minus_one
        promised = promise(problem, k, r).cr_minus_one
        assert row.least == pytest.approx(promised, rel=1e-9)


@pytest.mark.parametrize(
    ("spec", "a", "x"), [("ring:7", 0.1, 0.1), ("star:6", 1.0, 0.01), ("grid:3x3", 0.03, 3.0)]
)
def test_theorems_hold(spec, a, x):
    network = ns.parse_graph(spec)
    given = ns.Parameters(1.0, 1.5, a, x / network.max_degree)
    found = sandwich(network, 4, given, range(2, 5), range(1, 4))
    assert not [v for v in found.violations if v.tier != "stated"]
    assert all(row.sharp is not None for row in found.rows)


def test_the_worst_case_may_be_below_the_lower_bound_over_all_costs():
    weak = ns.Parameters(1.0, 1.0, 0.5, 0.0)
    (row,) = sandwich(ns.parse_graph("path:1"), 1, weak, [2], [1]).rows
    assert row.worst == 0.0 < row.lower <= row.sharp


def test_violations_are_reported():
    rows = (
        Row(2, 1, 0.5, 0.1, None, None, 0.4, 0.6),
        Row(3, 1, 0.1, 0.3, 0.7, 0.2, None, 0.6),
    )
    found = [(v.k, v.tier, v.below, v.certificate, v.value) for v in Sandwich(rows).violations]
    assert found == [
        (2, "repaired", "lower", 0.4, 0.5),
        (3, "stated", "worst", 0.2, 0.3),
        (3, "stated", "searched", 0.2, 0.7),
        (3, "sharp", "searched", 0.6, 0.7),
    ]
    assert [row.least for row in rows] == [0.4, 0.6]


def test_a_file_of_rows_reads_back(found, tmp_path):
    write_csv(found, tmp_path / "rows.csv")
    with (tmp_path / "rows.csv").open(newline="", encoding="utf-8") as stream:
        lines = list(csv.DictReader(stream))
    assert list(lines[0]) == [field.name for field in fields(Row)]
    for line, row in zip(lines, found.rows, strict=True):
        for name, text in line.items():
            value = getattr(row, name)
            assert text == "" if value is None else float(text) == value
    with pytest.raises(ns.InputError, match="cannot be written"):
        write_csv(found, tmp_path / "none" / "rows.csv")


def test_progress_and_bad_arguments():
    said, network = [], ns.parse_graph("path:2")
    sandwich(network, 2, GIVEN, [2], [1, 2], progress=said.append)
    assert [text[:22] for text in said if "policy of step 1" in text] == [
        "row 1/2, k = 2, r = 1:",
        "row 2/2, k = 2, r = 2:",
    ]
    for ks, rs, starts, name in (([1], [1], 0, "k"), ([2], [], 0, "r"), ([2], [1], -1, "starts")):
        with pytest.raises(ns.InputError, match=name):
            sandwich(network, 2, GIVEN, ks, rs, starts=starts)
    with pytest.raises(ns.InputError, match="logcosh"):
        sandwich(network, 2, GIVEN, [2], [1], style="logcosh")


def test_the_printed_ratio_is_exceeded_as_spatial_couplings_vanish():
    # its C_1 vanishes with l_S, and with it the share of a boundary in time
    given = ns.Parameters(1.0, 1.0, 20.0, 1e-14)
    found = sandwich(ns.parse_graph("ring:5"), 12, given, [2, 3], [1])
    assert {(v.tier, v.below) for v in found.violations} >= {("stated", "worst")}
    assert {v.tier for v in found.violations} == {"stated"}
    (first, _) = (v for v in found.violations if v.below == "worst")
    assert (first.k, first.r) == (2, 1)
    problem = worst_case(instance(ns.parse_graph("ring:5"), 12, given), 2, 1).problem
    assert ns.simulate(problem, k=2, r=1).ratio_minus_one > 4 * first.certificate


def test_a_table_goes_on_after_its_finished_rows(found, tmp_path):
    network, file = ns.parse_graph("ring:6"), tmp_path / "rows"

    def stop(text):
        if text.startswith("row 3/"):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sandwich(network, 4, GIVEN, [2, 3], [1, 2], starts=1, checkpoint=file, progress=stop)
    kept = len(file.read_bytes())
    said = []
    again = sandwich(
        network, 4, GIVEN, [2, 3], [1, 2], starts=1, checkpoint=file, progress=said.append
    )
    assert again == found
    assert {text[:7] for text in said} == {"row 3/4", "row 4/4"}
    assert len(file.read_bytes()) > kept
    # a part of the table is there already, a larger one is not
    said.clear()
    part = sandwich(network, 4, GIVEN, [3], [2], starts=1, checkpoint=file, progress=said.append)
    assert (part.rows, said) == (found.rows[-1:], [])
    for wrong, name in (({"starts": 0}, "climbs, .*seed"), ({"starts": 1, "seed": 1}, "seed")):
        with pytest.raises(ns.InputError, match=rf"another table \(other .*{name}\)"):
            sandwich(network, 4, GIVEN, [2], [1], checkpoint=file, **wrong)
