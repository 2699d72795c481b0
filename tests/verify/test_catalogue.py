"""What holds for every claim: a check that can fail, a verdict on record, a repair that holds."""

import re

import pytest

from nearsight.verify import catalogue
from nearsight.verify.engines.exact import Counterexample
from nearsight.verify.engines.search import Search
from nearsight.verify.mutation import mutate
from nearsight.verify.recorded import recorded
from nearsight.verify.report.prose import coded

from . import test_claims_competitive as competitive
from . import test_claims_perturbation as perturbation

CLAIMS = {claim.key: claim for claim in catalogue()}
REFUTED = sorted(key for key, word in recorded().items() if word == "refuted")


def test_every_claim_has_a_verdict_on_record_and_a_test():
    assert set(recorded()) == set(CLAIMS) == set(competitive.CLAIMS) | set(perturbation.CLAIMS)
    assert set(REFUTED) == competitive.REFUTED | perturbation.REFUTED
    assert len(CLAIMS) >= 200


@pytest.mark.parametrize("key", CLAIMS)
def test_every_check_can_fail(key):
    found = mutate(CLAIMS[key])
    assert [one.text for one in found if not one.good] == []
    assert found or all(not isinstance(check, Search) for check in CLAIMS[key].checks)


@pytest.mark.parametrize("key", REFUTED)
def test_what_is_refuted_names_a_claim_that_holds_instead(key):
    named = re.findall(r"`([^`]+)`", coded(CLAIMS[key].repaired, CLAIMS))
    assert [name for name in named if recorded().get(name) in ("proved", "supported")]
    assert any(isinstance(check, Counterexample) for check in CLAIMS[key].checks) or (
        key == "le:cr-rev[C]"  # found by the decision procedure
    )


def test_what_is_only_supported_has_no_proof_among_its_checks():
    for key, word in recorded().items():
        if word == "supported":
            assert all(isinstance(check, Search) for check in CLAIMS[key].checks)
