"""``thm:graph-induced-band-mat-inverse``: inverses of graph-banded matrices decay."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from ..arithmetic import Number, power
from ..decay import demko, g, gamma_S, gamma_T
from ..formula import formula
from ..setting import Setting
from ..theorem import Bound, Hypothesis, Tier

BLOCKS = Hypothesis("A is positive definite and banded on the graph, D >= 0 block diagonal")


@formula(counts=("q", "d"))
def inverse_entry(least: Number, largest: Number, q: int, d: Any) -> Number:
    r"""Return the sharp bound on a block of ``(A + D)^{-1}`` between sets at distance d.

    ``c(kappa)/a_0 * g(kappa - 1)^{ceil(2d/q)}`` with ``kappa = b_0/a_0``,
    ``(sqrt(kappa)-1)/(sqrt(kappa)+1) = g(kappa-1)``, for a q-banded A (blocks vanish at
    graph distances above ``q/2``).

    Parameters
    ----------
    least, largest : number
        Extreme eigenvalues ``a_0`` and ``b_0`` of A.
    q : int
        Bandwidth, even.
    d : int or array of int
        Distance between the two sets of vertices.
    """
    kappa = largest / least
    return demko(kappa) / least * power(g((largest - least) / least), -(-2 * d // q))


class Stated(Bound):
    """``C = 2/a_0`` as printed, for the Hessian of a local problem with ``a_0 = mu = 1``.

    Its temporal part alone (``gamma_T``), its spatial part alone (``gamma_S``) and both
    together (``gamma``, on the product of time and network, condition ``1 + 2a + x``).
    """

    label = "thm:graph-induced-band-mat-inverse"
    tier: ClassVar[Tier] = "stated"
    title = "decay of the inverse of a banded matrix"

    def values(self, s: Setting) -> dict[str, Number]:
        """Return ``C`` (times mu) and the three rates."""
        return {"C": 2 + 0 * s.a_T, **_rates(s)}

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the lemma's."""
        return (BLOCKS,)


class Sharp(Stated):
    """The constant of Demko, Moss and Smith, ``c(kappa) <= 2``, one for each of the three."""

    tier: ClassVar[Tier] = "sharp"

    def values(self, s: Setting) -> dict[str, Number]:
        """Return ``C_T, C_S, C`` (times mu) and the three rates."""
        kappas = {"C_T": 1 + 2 * s.a_T, "C_S": 1 + s.x, "C": 1 + 2 * s.a_T + s.x}
        return {name: demko(kappa) for name, kappa in kappas.items()} | _rates(s)


def _rates(s: Setting) -> dict[str, Number]:
    joint = g(2 * s.a_T + s.x)
    return {"gamma_T": gamma_T(s.a_T), "gamma_S": gamma_S(s.x), "gamma": joint}


BOUNDS: tuple[Bound, ...] = (Stated(), Sharp())
