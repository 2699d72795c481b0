"""Settings shared by all tests: how Hypothesis searches, and a clean global precision."""

import os

# One thread for linear algebra, as many tests run side by side; read when numpy is imported.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import mpmath
import pytest
from hypothesis import settings

# "ci" gives the same examples on every run and machine, so that plain `uv run pytest` says what
# the gate says. "dev" searches anew each time: HYPOTHESIS_PROFILE=dev uv run pytest
# Neither has a deadline: how long one example takes says more about the machine than the code.
settings.register_profile("ci", derandomize=True, deadline=None, database=None)
settings.register_profile("dev", deadline=None, print_blob=True)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci"))

DOUBLE = 53  # bits of a double, with which mpmath and python-flint start


@pytest.fixture(autouse=True)
def _global_precision():
    """Begin each test with the libraries' own precision, whatever the test before it did."""
    mpmath.mp.prec = DOUBLE
    mpmath.iv.prec = DOUBLE
    try:
        import flint
    except ImportError:  # the extra `certify` is not installed
        return
    flint.ctx.prec = DOUBLE
