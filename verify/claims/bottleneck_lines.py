"""``thm:bottleneck``: its instance, its constants, and what the conclusion makes of it."""

from __future__ import annotations

from fractions import Fraction as Q

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample

E2 = "thm:bottleneck:e2"


def curvature() -> tuple[Q, Q]:
    """Return the form of the Hessian of ``(x-y)^2/2`` in the direction (1, -1), and ``l |d|^2``."""
    x, y, l_T = Q(1), Q(-1), Q(1)
    return l_T * (x - y) ** 2, l_T * (x * x + y * y)


CLAIMS: tuple[Claim, ...] = (
    Claim(
        E2,
        "the instance is in the class",
        "c_t = (l_T/2)(x_t - x_{t-1})^2 is l_T-smooth",
        "Assumption 2.1",
        (
            Counterexample(
                curvature,
                {"l_T": 1, "direction": (1, -1)},
                "d'Hd = (1 + 1)^2 = 4 > 2 = l_T |d|^2: the Hessian [[1, -1], [-1, 1]] has the "
                "eigenvalue 2, so the cost is 2 l_T-smooth, as the (b/2)(x - y)^2 of the pricing "
                "example is called",
            ),
        ),
        part="class",
        kind="step",
        repaired="(l_T/4)(x_t - x_{t-1})^2, with l_T/2 for l_T in lambda_T: "
        "nearsight:temporal-lower-bound",
    ),
    Claim(
        E2,
        "from a gap to a ratio",
        "R L >= (2/l_T) sum (f_t + c_t)(v) >= (2/l_T) cost(OPT) turns the 96 of (e1) into 48 l_T",
        "f_t(v_t) = 0 at v_t = theta_t, c_t = (l_T/2)(v_t - v_{t-1})^2",
        (
            Decision(
                ("l_T", "K", "path", "at_v", "opt", "gap"),
                lambda l_T, K, path, at_v, opt, gap: (
                    [
                        l_T > 0,
                        K >= 0,
                        path * l_T == 2 * at_v,
                        at_v >= opt,
                        96 * gap >= K * path,
                    ],
                    K * opt,
                    48 * l_T * gap,
                ),
                "K = mu^3 (1 - sqrt(lambda_T))^2 lambda_T^k/(mu+1)^2, path = R L",
                false=(
                    lambda l_T, K, path, at_v, opt, gap: (
                        [
                            l_T > 0,
                            K >= 0,
                            path * l_T == 2 * at_v,
                            at_v >= opt,
                            96 * gap >= K * path,
                        ],
                        K * opt,
                        40 * l_T * gap,
                    ),
                ),
            ),
        ),
        part="factor",
        kind="step",
        uses=(f"{E2}[path]",),
    ),
    Claim(
        "sec:concluding-remarks#both-resources",
        "one resource is not enough",
        "With k fixed the ratio stays away from 1 whatever r is, and with r fixed whatever k is.",
        "l_T, l_S > 0, Delta >= 2: the bounds of nearsight:temporal-lower-bound (r is not in it) "
        "and nearsight:ring-of-blocks (one step: k is not in it) are positive",
        (
            Decision(
                ("g", "W", "s"),
                lambda g, W, s: (
                    [g > 0, g < 1, W > 0, W < 1, s >= 1],
                    0,
                    W * (1 + g) * (1 + g) * s,
                ),
                "in time g^{2k-1} (1+g)^2/((1+g^{2k+1}) sqrt(1+2a)) > 0 with W = g^{2k-1}, g = "
                "gamma_T; in space 2 q^{2(r+1)}/(d s (1+q^{2(r+1)}) (1-B_jj)) > 0 alike",
                false=(lambda g, W, s: ([g > 0, g < 1, s >= 1], 0, W * (1 + g) * (1 + g) * s),),
                strict=True,
            ),
        ),
        kind="remark",
        uses=("nearsight:temporal-lower-bound", "nearsight:ring-of-blocks"),
    ),
)
