import re
from dataclasses import replace
from fractions import Fraction as Q

import flint
import pytest
import z3
from hypothesis import given
from hypothesis import strategies as st

from nearsight.graphs import InputError
from nearsight.verify import Claim
from nearsight.verify.engines.decision import Decision
from nearsight.verify.engines.enclosure import Box, ball, enclosure
from nearsight.verify.engines.exact import Counterexample
from nearsight.verify.engines.interval import Boxes
from nearsight.verify.engines.search import Search
from nearsight.verify.mutation import mutate

from .small import ALGEBRA, BOXES, DECISION, FALSE, SEARCH, curve, squares, too_small

ROOT = {"s": lambda a: 1 + 2 * a}


def claim(*checks):
    return Claim("lemma:x", "x", "x", "", checks)


@pytest.mark.parametrize("check", [DECISION, BOXES, SEARCH, ALGEBRA])
def test_a_true_claim_is_not_refuted_and_its_mutants_are_rejected(check):
    assert check.run("quick").verdict in ("proved", "supported")
    outcomes = mutate(claim(check))
    assert outcomes
    assert all(one.good for one in outcomes)


@pytest.mark.parametrize("check", [DECISION, BOXES])
def test_the_same_answer_each_time(check):
    assert check.run("quick") == check.run("quick")


def test_decision_refutes_with_a_rational_instance_that_fails_without_z3():
    found = replace(DECISION, statement=too_small).run("quick")
    a = Q(found.instance["a"])
    s = float(1 + 2 * a) ** 0.5
    assert found.verdict == "refuted"
    assert (1 + s) ** 2 > 1 + s * s + float(a)
    assert found.measured > found.bound


def test_decision_rounds_an_algebraic_solution_to_a_simple_one():
    def between(x):  # no integer and no half lies between the roots of 5 and 6
        return [x >= 0, x * x > 5, x * x < 6], x, 0

    found = Decision(("x",), between, "roots").run("quick")
    assert found.instance == {"x": "9/4"}


def test_decision_gives_a_proof_that_another_solver_can_replay():
    solver = z3.Solver()
    solver.from_string(DECISION.run("quick").details["smt2"])
    assert solver.check() == z3.unsat


def test_decision_does_not_prove_from_contradictions():
    with pytest.raises(RuntimeError, match="contradict"):
        Decision(("a",), lambda a: ([a > 1, a < 0], a, 0), "empty").run("quick")


def test_decision_says_when_time_runs_out():
    def hard(*x):  # of degree 6 in 7 variables
        products = [x[i] ** 3 * x[i - 1] ** 2 * x[i - 2] for i in range(7)]
        return [sum(v * v for v in x) == 7, sum(products) >= 7], x[0] ** 5 * x[3], 1

    with pytest.raises(RuntimeError, match="steps"):
        Decision(tuple("abcdefg"), hard, "hard", steps=20_000).run("quick")


def test_decision_does_not_believe_what_it_cannot_confirm():
    def nowhere_rational(x):  # only the root of 2 satisfies it
        return [x * x == 2, x > 0], x, 0

    with pytest.raises(RuntimeError, match="not confirmed"):
        Decision(("x",), nowhere_rational, "point").run("quick")


def test_a_strict_conclusion_fails_at_equality():
    touching = Decision(("a",), squares, "s", ROOT, strict=True)
    assert touching.run("quick").instance == {"a": "0"}


@pytest.mark.parametrize("mean_value", [False, True])
def test_boxes_prove_up_to_the_boundary(mean_value):
    found = replace(BOXES, mean_value=mean_value).run("quick")
    assert found.verdict == "proved"
    assert 0 < found.details["lower_bound"] <= 1.0  # the smallest value, at y = z = 1
    assert found.details["boxes"] > 1


def test_derivatives_save_boxes():
    def steep(y):
        return 50 * y * y - 50 * y + flint.fmpq(251, 20)  # 50 (y - 1/2)^2 + 1/20

    plainly, slopes = (
        Boxes(steep, {"y": (0, 1)}, "parabola", Q(1, 10), mean_value=use).run("quick")
        for use in (False, True)
    )
    assert slopes.details["boxes"] < plainly.details["boxes"] / 2


def test_boxes_refute_with_an_instance_in_the_claims_own_numbers():
    found = Boxes(
        lambda y: 1 - 3 * y * (1 - y) * 2,
        {"y": (0, 1)},
        "a = y/(1-y)",
        back=lambda y: {"a": y / (1 - y)},
    ).run("quick")
    y = Q(found.instance["y"])
    assert 0 < y < 1
    assert 1 - 6 * y * (1 - y) < 0
    assert Q(found.instance["a"]) == y / (1 - y)


def test_boxes_do_not_decide_equality():
    with pytest.raises(RuntimeError, match="not decided with 50 boxes"):
        Boxes(lambda y: y * (1 - y), {"y": (0, 1)}, "touches", quick=50).run("quick")


def test_boxes_do_not_pass_over_points_where_nothing_is_known():
    with pytest.raises(RuntimeError, match="nan"):
        Boxes(lambda y: 1 / y, {"y": (0, 1)}, "pole", quick=50).run("quick")


def test_boxes_run_the_closed_forms_of_bounds():
    from nearsight.bounds.arithmetic import sqrt

    # sqrt(1+2a) <= 1+a with a = y^2/(1-y^2), divided by a^2 and times the denominators
    def gap(y):
        y = y * y
        return 1 / (1 + sqrt((1 + y) * (1 - y) + 1 - (1 - y)) * 1)

    assert Boxes(gap, {"y": (0, 1)}, "root").run("quick").verdict == "proved"


@given(
    st.tuples(st.fractions(0, 1), st.fractions(0, 1)).map(sorted),
    st.tuples(st.fractions(0, 1), st.fractions(0, 1)).map(sorted),
    st.fractions(0, 1),
    st.fractions(0, 1),
)
def test_enclosures_contain_all_values(first, second, s, t):
    box = Box((tuple(first), tuple(second)))
    whole, _ = enclosure(curve, box, curve(*box.middle_balls()), True)
    point = [ball(a + (b - a) * share) for (a, b), share in zip(box.sides, (s, t), strict=True)]
    assert whole.overlaps(curve(*point))


@pytest.mark.parametrize(
    ("ranges", "nudge"), [({}, 0), ({"y": (1, 1)}, 0), ({"y": (0, 1)}, Q(-1, 2))]
)
def test_unusable_boxes(ranges, nudge):
    with pytest.raises(InputError):
        Boxes(curve, ranges, "r", nudge)


def test_unusable_decisions():
    with pytest.raises(InputError):
        Decision(("a", "a"), squares, "r")


def test_proved_and_refuted_at_once_is_an_error():
    with pytest.raises(RuntimeError, match="at once"):
        claim(ALGEBRA, FALSE).judge("quick")


def test_a_check_that_cannot_fail_is_found():
    blind = Search(lambda rng: (0.0, 1.0, {}), "always zero")
    (found,) = mutate(claim(blind))
    assert (found.outcome, found.good) == ("accepted", False)
    loose = replace(BOXES, nudge=Q(1, 1000))
    (found,) = mutate(claim(loose))
    assert found.outcome == "accepted"


@pytest.mark.parametrize("check", [replace(BOXES, nudge=0), replace(DECISION, false=())])
def test_a_check_without_mutants_is_found(check):
    (found,) = mutate(claim(check))
    assert found.outcome == "missing"
    assert re.search("no false statement", found.text)


def test_exact_evidence_and_refutations_need_no_mutants():
    refuting = Decision(("a",), too_small, "s", ROOT)
    refuting = replace(refuting, statement=lambda a, s: too_small(a, s))
    assert mutate(claim(FALSE, refuting)) == ()


def test_a_counterexample_that_is_none_raises():
    with pytest.raises(RuntimeError, match="no counterexample"):
        Counterexample(lambda: (Q(1), Q(1)), {"x": 1}, "equal").run("quick")
