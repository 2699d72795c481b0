"""``coro:CR-LPC``: the lines of its proof."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.search import Search, Trial
from ._sums import geometric


def _smoothness(rng: Any) -> Trial:
    """Largest Hessian eigenvalue of one f_t beside ``l_f + Delta l_S``."""
    from ...lowerbounds.energy import Energy
    from ._networks import sample

    given = sample(rng, a=(-3, -2), x=(-1, 2), H=2)
    size = given.problem.N * given.problem.n
    last = Energy.of(given.problem).hessian.toarray()[-size:, -size:]
    p = given.parameters
    l_T = 0.0 if p.l_T == 0 else _temporal(given.problem)
    bound = p.l_f + given.growth.max_degree * p.l_S
    return float(np.linalg.eigvalsh(last)[-1]) - l_T, bound, given.about


def _temporal(problem: Any) -> float:
    """Return the largest diagonal entry that the temporal costs add at the last step."""
    matrix = problem.temporal.matrix[-1]
    return float(np.max(matrix[..., : problem.n, : problem.n]))


def _eta(p: Any, q: Any, A: Any, B: Any, factor: int) -> tuple[list[Any], Any, Any]:
    inside = [p >= 0, p <= 1, q >= 0, q <= 1, p + q > 0, A >= 0, B >= 0]
    total = A * p * p + B * q * q
    return inside, 16 * (p + q + 1) * total, factor * (p + q) * (A * p + B * q)


CLAIMS: tuple[Claim, ...] = (
    Claim(
        "coro:CR-LPC:e2",
        "errors of the past are errors of the trajectory",
        "sum_{t=1}^H |x_{t-1} - x*_{t-1}|^2 <= sum_{t=1}^H |x_t - x*_t|^2",
        "x_0 = x_0*",
        (
            Decision(
                ("rest", "first", "last"),
                lambda rest, first, last: (
                    [rest >= 0, first == 0, last >= 0],
                    first + rest,
                    rest + last,
                ),
                "both sums without the terms they share",
                false=(
                    lambda rest, first, last: (
                        [rest >= 0, first >= 0, last >= 0],
                        first + rest,
                        rest + last,
                    ),
                ),
            ),
        ),
        kind="step",
        uses=("thm:alg-perf-bound-err-inject", "thm:per-step-err"),
    ),
    Claim(
        "coro:CR-LPC:e3",
        "the sum of squared distances",
        "S <= c S + R and c <= 1/2 give S <= 2R (2 * 8 = 16), each f_tau with weight at most "
        "1/(1-rho_T)",
        "(e2-0); past the horizon f_tau(x*_tau) = 0",
        (
            Decision(
                ("S", "c", "R"),
                lambda S, c, R: ([S >= 0, 2 * c <= 1, c * S + R >= S], S, 2 * R),
                "as it stands",
                false=(lambda S, c, R: ([S >= 0, c < 1, c * S + R >= S], S, 2 * R),),
            ),
            geometric("rho_T"),
        ),
        kind="step",
        uses=("coro:CR-LPC:e2",),
    ),
    Claim(
        "coro:CR-LPC:e4-0",
        "the smoothness of f_t",
        "f_t, node and spatial costs together, is (l_f + Delta l_S)-smooth",
        "each pair cost of two blocks is l_S-smooth",
        (
            Search(
                _smoothness,
                "largest Hessian eigenvalue of node and spatial costs, attained on bipartite "
                "regular graphs; weak temporal costs are subtracted",
                quick=40,
                full=2000,
                nudge=0.9,
            ),
            Decision(
                ("degree", "Delta", "z", "l_S"),
                lambda degree, Delta, z, l_S: (
                    [degree >= 0, degree <= Delta, z >= 0, l_S >= 0],
                    degree * l_S * z,
                    Delta * l_S * z,
                ),
                "xi'Hess(s) xi <= l_S (|xi_u|^2 + |xi_v|^2), summed over edges: every |xi_v|^2 = z "
                "deg(v) times",
                false=(
                    lambda degree, Delta, z, l_S: (
                        [degree >= 0, z >= 0, l_S >= 0],
                        degree * l_S * z,
                        Delta * l_S * z,
                    ),
                ),
            ),
        ),
        kind="step",
        uses=("lemma:smooth-difference",),
    ),
    Claim(
        "coro:CR-LPC:e4",
        "the cost of LPC",
        "(Lam/2)(1 + 1/eta) S <= (1 + 1/eta) 16 K Lam cost(OPT) for S <= 16 K sum f_t(x*)",
        "Lam = l_f + Delta l_S + 2 l_T; each step lies in two temporal costs (half would do: 8)",
        (
            Decision(
                ("Lam", "eta", "S", "K", "f", "opt"),
                lambda Lam, eta, S, K, f, opt: (
                    [Lam >= 0, eta > 0, K >= 0, S >= 0, 16 * K * f >= S, f <= opt],
                    Lam * (1 + eta) * S,
                    (1 + eta) * 32 * K * Lam * opt,
                ),
                "multiplied by 2 eta",
                false=(
                    lambda Lam, eta, S, K, f, opt: (
                        [Lam >= 0, eta > 0, K >= 0, S >= 0, 16 * K * f >= S, f <= opt],
                        Lam * (1 + eta) * S,
                        (1 + eta) * 8 * K * Lam * opt,
                    ),
                ),
            ),
        ),
        kind="step",
        uses=("coro:CR-LPC:e3", "coro:CR-LPC:e4-0"),
    ),
    Claim(
        "coro:CR-LPC:e1",
        "the choice of eta",
        "eta + (1 + 1/eta) 16 (A rho_S^{2r} + B rho_T^{2(k-1)}) <= (1 + 32 A) rho_S^r + (1 + 32 B) "
        "rho_T^{k-1} for eta = rho_S^r + rho_T^{k-1}",
        "eta > 0 (not l_T = l_S = 0); eta may exceed 1",
        (
            Decision(
                ("p", "q", "A", "B"),
                lambda p, q, A, B: _eta(p, q, A, B, 32),
                "p = rho_S^r, q = rho_T^{k-1}, multiplied by eta = p + q",
                false=(lambda p, q, A, B: _eta(p, q, A, B, 23),),
            ),
        ),
        kind="step",
        uses=("coro:CR-LPC:e4",),
    ),
)
