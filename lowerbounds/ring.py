"""The ring of blocks of ``fig:G_exp_decay_lower``, and the claims about it."""

from __future__ import annotations

from dataclasses import dataclass
from math import comb

from ..bounds.arithmetic import Number, power, sqrt
from ..bounds.formula import rounded_once
from ..bounds.wide import Wide
from ..graphs import InputError, Network, parse_graph
from .claimed import Claimed, Tier
from .resolvent import between_blocks

LABEL = "lemma:inverse-graph-lower-bound"


@dataclass(frozen=True)
class Ring:
    """N blocks of d vertices in a ring, neighbouring blocks completely joined.

    Parameters
    ----------
    d : int
        Vertices a block, at least 1; the degree is 2 d.
    blocks : int, optional
        N, at least 3; infinitely many if omitted.

    Raises
    ------
    InputError
        If a size is too small.

    References
    ----------
    Paper, ``lemma:inverse-graph-lower-bound`` and ``fig:G_exp_decay_lower``.
    """

    d: int
    blocks: int | None = None

    def __post_init__(self) -> None:
        if self.d < 1:
            raise InputError(f"d = {self.d}: at least 1 vertex a block is needed", "d")
        if self.blocks is not None and self.blocks < 3:
            raise InputError(f"blocks = {self.blocks}: at least 3 are needed", "blocks")

    @property
    def network(self) -> Network:
        """The graph itself; for finitely many blocks."""
        if self.blocks is None:
            raise InputError("a ring of infinitely many blocks is no finite graph", "blocks")
        return parse_graph(f"ring-of-blocks:{self.blocks}x{self.d}")

    def walks(self, kappa: int, length: int) -> int:
        r"""Return ``(M^length)_ij``: walks between vertices of blocks kappa apart, exactly.

        ``d^{length-1}`` times the walks on the ring of N blocks, ``length >= 1``: those of Z that
        end at ``kappa + n N`` for some n.
        """
        if length < 1:
            raise InputError(f"length = {length}: at least 1 is needed", "length")
        N = self.blocks
        ends = range(kappa, length + 1, N) if N else [kappa]
        back = range(kappa - N, -length - 1, -N) if N else []
        steps = (length + end for end in (*ends, *back) if abs(end) <= length)
        lines = sum(comb(length, m // 2) for m in steps if m % 2 == 0)
        return int(self.d ** (length - 1)) * lines

    def walk_claim(self, kappa: int, m: int, tier: Tier = "stated") -> Claimed:
        """Return ``(M^{kappa+2m})_ij >= binom(kappa+2m, m) d^{kappa+2m-2}`` of the proof.

        A walk of ``kappa + 2m`` steps has ``kappa + 2m - 1`` vertices between its ends: *sharp*
        has that exponent, and is an equality until walks around the ring come in.
        """
        self._check(kappa)
        length = kappa + 2 * m
        exponent = length - (1 if tier == "sharp" else 2)
        claimed = comb(length, m) * self.d**exponent
        return Claimed(LABEL, "walks", tier, self.walks(kappa, length), claimed, kappa >= 3)

    def first_claim(self, ell: Number, kappa: int, tier: Tier = "stated") -> Claimed:
        r"""Return the first claim for an entry of ``(I + l L)^{-1}`` at distance kappa.

        *stated*: ``kappa/(d^2 (2dl+1)) (dl/(2dl+1))^kappa``; its proof takes the term ``m = 0`` of
        a sum, whose binomial coefficient is 1, not kappa. The quotient of the exact entry and the
        claim is ``(d m/(s kappa)) ((4+2x)/(2+x+2s))^kappa``, ``x = 4 d l``, ``s = sqrt(1+x)``,
        ``m = 1 + x/2``, on the infinite ring: below 1 for weak couplings as soon as ``kappa > d``.
        *repaired*: without the factor kappa. *sharp*: and ``d`` in place of ``d^2``; true for
        ``kappa >= 1`` and any number of blocks.
        """
        self._check(kappa)

        def claimed(ell: Number) -> Number:
            weight = d * ell / (2 * d * ell + 1)
            scale = {"stated": kappa, "repaired": 1, "sharp": d}[tier]
            return scale * power(weight, kappa) / (d**2 * (2 * d * ell + 1))

        d = self.d
        exact = between_blocks(ell, d, kappa, self.blocks)
        return Claimed(LABEL, "first", tier, exact, _rounded(claimed, ell), kappa >= 3)

    def second_claim(self, ell: Number, kappa: int) -> Claimed:
        r"""Return the second claim, for ``d l > 16``.

        ``(1 - 4/sqrt(dl))^kappa / (4 sqrt(pi kappa sqrt(dl)) d^2 (2dl+1))``. It holds: the exact
        rate is ``g(4dl) = 1 - 2/(sqrt(1+4dl)+1) >= 1 - 1/sqrt(dl)``.
        """
        self._check(kappa)
        d, strong = self.d, bool(self.d * ell > 16)
        exact = between_blocks(ell, d, kappa, self.blocks)

        def claimed(ell: Number) -> Number:
            root = sqrt(d * ell)
            front = 4 * sqrt(_pi(ell) * kappa * root) * d**2 * (2 * d * ell + 1)
            return power(1 - 4 / root, kappa) / front

        value = _rounded(claimed, ell) if strong else 0 * ell
        return Claimed(LABEL, "second", "stated", exact, value, kappa >= 3 and strong)

    def _check(self, kappa: int) -> None:
        """Raise `InputError` unless there are vertices at distance kappa."""
        N = self.blocks
        if kappa < 1 or (N is not None and kappa > N // 2):
            most = "" if N is None else f" and <= {N // 2}, as far as vertices are apart"
            raise InputError(f"kappa = {kappa}: an integer >= 1{most} is needed", "kappa")


def _rounded(function: object, ell: Number) -> Number:
    """Evaluate on a float in wide arithmetic, rounded once; on other numbers as they are."""
    if isinstance(ell, int | float):
        return rounded_once(function, Wide(ell))  # type: ignore[arg-type]
    return function(ell)  # type: ignore[operator]


def _pi(ell: Number) -> Number:
    """Return pi in the arithmetic of l (rounded up where that is binary64 or wide)."""
    module = type(ell).__module__.partition(".")[0]
    if module == "mpmath":
        return ell.context.pi if hasattr(ell, "context") else ell.ctx.pi
    if module == "sympy":
        import sympy

        return sympy.pi
    if module == "flint":
        import flint

        return flint.arb.pi()
    return 3.1415926535897936
