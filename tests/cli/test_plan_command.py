import json

import numpy as np
import pytest
from click.testing import CliRunner

import nearsight as ns
from nearsight.cli import cli

COSTS = ["--mu", "1", "--l-f", "1", "--l-t", "1", "--l-s", "0.5"]


def run(*words):
    return CliRunner().invoke(cli, ["plan", *words])


def plan(*words, status=0):
    done = run(*words, "--json")
    assert done.exit_code == status, done.output
    return json.loads(done.output)


def test_the_reference_plan_of_the_ring():
    document = plan("--growth", "line", *COSTS, "--target", "1.01")
    by_tier = {p["tier"]: p for p in document["plans"]}
    assert [(t, p["k"], p["r"]) for t, p in by_tier.items()] == [
        ("stated", 24, 19),
        ("repaired", 23, 19),
        ("sharp", 4, 3),
    ]
    assert by_tier["sharp"]["cr"] - 1 == pytest.approx(4.8242e-3, rel=1e-4)
    assert all(p["guarantee"] for p in by_tier.values())
    assert document["target"] == 1.01


def test_the_frontier_holds_the_chosen_pair_and_wastes_nothing():
    document = plan("--growth", "grid2", *COSTS, "--target", "1.001")
    for p in document["plans"]:
        pairs = p["frontier"]
        assert [p["k"], p["r"]] in pairs
        assert p["k"] + p["r"] == min(k + r for k, r in pairs)
        ks, rs = np.array(pairs).T
        assert np.all(np.diff(ks) > 0)
        assert np.all(np.diff(rs) < 0)
        assert max(p["frontier_cr_minus_one"]) <= 1.001 - 1


def test_work_counts_the_free_variables_of_the_largest_local_problem():
    document = plan("--growth", "grid2", *COSTS, "--target", "1.01")
    sharp = document["plans"][2]
    r = sharp["r"] - 1
    ball = 2 * r * r + 2 * r + 1  # the diamond of Z^2
    assert sharp["work"][sharp["frontier"].index([sharp["k"], sharp["r"]])] == (
        (sharp["k"] - 1) * ball
    )


def test_prices_move_the_cheapest_pair_along_the_frontier():
    costs = ["--mu", "1", "--l-f", "1", "--l-t", "20", "--l-s", "10"]
    words = ["--growth", "line", *costs, "--target", "1.01"]
    dear_r = plan(*words, "--price-r", "1000")["plans"][2]
    dear_k = plan(*words, "--price-k", "1000")["plans"][2]
    assert [dear_r["cheapest"]["k"], dear_r["cheapest"]["r"]] == dear_r["frontier"][-1]
    assert [dear_k["cheapest"]["k"], dear_k["cheapest"]["r"]] == dear_k["frontier"][0]
    assert (dear_r["k"], dear_r["r"]) == (dear_k["k"], dear_k["r"])


def test_out_of_reach_is_status_1_with_a_reason_and_nulls():
    costs = ["--mu", "1", "--l-f", "1", "--l-t", "1000", "--l-s", "1000"]
    document = plan("--growth", "tree:3", *costs, "--target", "1.01", status=1)
    for p in document["plans"]:
        assert (p["k"], p["r"], p["cr"], p["frontier"]) == (None, None, None, [])
        assert "no radius" in p["reason"]


def test_unguaranteed_stated_plan_says_why():
    costs = ["--mu", "1", "--l-f", "1", "--l-t", "1", "--l-s", "0.0001"]
    stated, repaired, sharp = plan("--growth", "line", *costs, "--target", "1.01")["plans"]
    assert not stated["guarantee"]
    assert "thm:networked-exp-decay" in stated["reason"]
    assert repaired["guarantee"]
    assert sharp["guarantee"]


def test_unconstrained_needs_no_more():
    words = ["--growth", "line", "--mu", "1", "--l-f", "1", "--l-t", "20", "--l-s", "10"]
    free = plan(*words, "--target", "1.01", "--unconstrained")["plans"][2]
    boxed = plan(*words, "--target", "1.01")["plans"][2]
    assert (free["k"], free["r"]) == (18, 18)
    assert (boxed["k"], boxed["r"]) == (19, 19)


def test_tables_for_people_show_what_json_says():
    text = run("--growth", "line", *COSTS, "--target", "1.01", "--frontier").output
    assert "sharp" in text
    assert "all pairs that waste nothing" in text
    assert all(line == line.rstrip() for line in text.splitlines())


def test_one_call_from_python_gives_the_same():
    document = plan("--graph", "grid:5x7", *COSTS, "--target", "1.05")
    found = ns.plan(mu=1, l_f=1, l_T=1, l_S=0.5, graph="grid:5x7", target=1.05)
    for p in document["plans"]:
        assert p["frontier"] == [[q.k, q.r] for q in found[p["tier"]].frontier]
        assert p["work"] == list(found[p["tier"]].work)


@pytest.mark.parametrize(("l_t", "l_s"), [("1e-300", "0.1"), ("0.1", "1e-160"), ("1e-160", "0")])
def test_vanishing_couplings_need_the_least(l_t, l_s):
    costs = ["--mu", "1", "--l-f", "1", "--l-t", l_t, "--l-s", l_s]
    sharp = plan("--growth", "line", *costs, "--target", "1.01")["plans"][2]
    assert (sharp["k"], sharp["r"]) == (2, 1)


def test_the_star_marks_radii_at_which_nobody_sees_a_boundary():
    costs = ["--mu", "1", "--l-f", "4", "--l-t", "1", "--l-s", "1"]
    near = run("--graph", "path:3", *costs, "--target", "2").output.splitlines()
    sharp = next(line for line in near if line.startswith(" sharp"))
    assert sharp.split()[2] == "2"  # r = 2: the middle sees all three, an end sees two
    far = run("--graph", "path:3", *costs, "--target", "1.0001").output
    assert "3*" in far
    assert "every agent decides for all it is connected to" in far
