r"""``le:J-properties``: which blocks of ``J^l`` vanish, and how many terms the others have."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from math import comb

import numpy as np

from ...lpc.arrays import Floats
from ..comparison import Comparison, Relation
from ._hierarchy import Hierarchy, block_norms
from ._specimen import drawn

LABEL = "le:J-properties"
TITLE = "blocks of a power of J are sums of few terms"
LONGEST = 9  # the largest power


def most(power: int, gap: int) -> int:
    """Return ``binom(l, (l - |i-j|)/2)``, 0 if that is not an integer or negative."""
    rest = power - gap
    return comb(power, rest // 2) if rest >= 0 and rest % 2 == 0 else 0


def away(S: int, power: int, i: int, j: int) -> bool:
    """Whether no walk of l steps from i to j can leave ``1..S``: then the bound is attained."""
    beyond = (power - abs(i - j)) // 2
    return min(i, j) - beyond >= 1 and max(i, j) + beyond <= S


def counts(S: int, power: int) -> Floats:
    """Return the numbers of terms of all blocks of ``J^l``, shape (S, S)."""
    path = np.eye(S, k=1) + np.eye(S, k=-1)
    found: Floats = np.linalg.matrix_power(path, power)
    return found


def compare(
    hierarchy: Hierarchy, *, instance: str = "", seed: int | None = None
) -> tuple[Comparison, ...]:
    r"""Compare the blocks of ``J^l`` with their structure.

    * *zero pattern*: the largest entry of a block ``(J^l)_{i,j}`` with ``l < |i-j|`` or
      ``l - |i-j|`` odd; it is exactly 0, in floating point, too.
    * *number of terms*: walks of l steps from i to j on the path ``1..k-1``, at most
      ``binom(l, (l-|i-j|)/2)``.
    * *number of terms, away from the ends*: the same where `away`; there it is attained.

    Parameters
    ----------
    hierarchy : Hierarchy
    instance, seed
        As in `Comparison`.

    References
    ----------
    Paper, ``le:J-properties``. Its convention for binomials has to cover negative lower numbers,
    too: ``l - |i-j|`` may be even and negative.
    """
    S, size = hierarchy.S, hierarchy.size
    forbidden, found = 0.0, {"<=": _Most(), "==": _Most()}
    power = np.eye(len(hierarchy.M))
    for l in range(1, LONGEST + 1):  # noqa: E741 - the paper's letter
        power = power @ hierarchy.J
        norms, number = block_norms(power, size), counts(S, l)
        for i, j in product(range(S), repeat=2):
            bound, terms = most(l, abs(i - j)), int(number[i, j])
            if not bound:
                forbidden = max(forbidden, float(norms[i, j]), float(terms))
                continue
            at = f"{instance}; l = {l}, block ({i + 1}, {j + 1})"
            found["<="].see(terms / bound, terms, bound, at)
            if away(S, l, i + 1, j + 1):
                found["=="].see(abs(terms - bound), terms, bound, at)
    zero = Comparison(LABEL, "zero pattern", forbidden, 0.0, "==", 0.0, instance, seed)
    parts: dict[Relation, str] = {
        "<=": "number of terms",
        "==": "number of terms, away from the ends",
    }
    return zero, *(
        Comparison(LABEL, part, one.terms, one.bound, relation, 0.0, one.at, seed)
        for relation, part in parts.items()
        if (one := found[relation]).share >= 0
    )


def measure(seed: int) -> tuple[Comparison, ...]:
    """Compare on a random local problem with ``k <= 8``."""
    specimen = drawn(seed, k=8)
    return compare(specimen.hierarchy, instance=specimen.text, seed=seed)


@dataclass
class _Most:
    """The block with the largest share seen so far."""

    share: float = -1.0
    terms: int = 0
    bound: int = 0
    at: str = ""

    def see(self, share: float, terms: int, bound: int, at: str) -> None:
        if share > self.share:
            self.share, self.terms, self.bound, self.at = share, terms, bound, at
