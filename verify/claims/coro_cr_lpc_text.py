"""What the text says about ``coro:CR-LPC``: the ratio without ``h(r)``."""

from __future__ import annotations

from fractions import Fraction as Q

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample

CLAIMS: tuple[Claim, ...] = (
    Claim(
        "sec:main:CR#iota",
        "the ratio without h(r)",
        "if h(r) <= poly(r) rho_S^{-(1-iota) r/2} then 1 + O(h(r)^2 rho_S^r) is 1 + O(rho_S^{iota "
        "r}); on a grid iota = 1 works",
        "a constant that does not depend on r",
        (
            Counterexample(
                lambda: (Q(16 * 10**6), Q(10**6)),
                {"iota": 1, "h": "4 r", "r": 1000, "constant": 10**6},
                "On the grid h(r)^2 rho_S^r = 16 r^2 rho_S^r is not at most K rho_S^r: here "
                "K = 10^6 "
                "and r = 1000; for other K take r > sqrt(K)",
            ),
        ),
        kind="remark",
        repaired="1 + O(poly(r)^2 rho_S^{iota r}), or any smaller iota: sec:main:CR#iota[repaired]",
    ),
    Claim(
        "sec:main:CR#iota",
        "the ratio without h(r), repaired",
        "poly(r)^2 rho_S^{iota r} = O(rho_S^{iota' r}) for iota' < iota: (r z^r)^2 <= 1/(1-z)^2",
        "0 <= z = rho_S^{(iota - iota')/2} < 1, for poly(r) = r; C_3(r) <= sum_q poly(q) "
        "rho_S^{(1+iota) q/2}",
        (
            Decision(
                ("r", "w", "z"),
                lambda r, w, z: (
                    [r >= 0, z >= 0, z < 1, w >= 0, w <= 1, r * w * (1 - z) <= 1],
                    (r + 1) * z * w * (1 - z),
                    1,
                ),
                "induction on r with w = z^r: (r+1) z^{r+1} = z (r z^r + z^r) keeps r z^r "
                "(1-z) <= 1",
                false=(
                    lambda r, w, z: (
                        [r >= 0, z >= 0, z < 1, w >= 0, w <= 1, r * w * (1 - z) <= 1],
                        (r + 1) * w * (1 - z),
                        1,
                    ),
                ),
            ),
        ),
        part="repaired",
        kind="remark",
    ),
    Claim(
        "sec:main:CR#degree",
        "bounded degree and weak coupling",
        "h(r) <= Delta^r = O(rho_S^{-r/4}) for l_S/mu <= 4 Delta^{-9}: iota = 1/2 works",
        "rho_S of thm:networked-exp-decay; rho_S <= Delta^{-4}",
        (
            Decision(
                ("Delta", "x"),
                lambda Delta, x, s: (
                    [Delta >= 1, x >= 0, x * Delta**8 <= 4],
                    (s - 1) * Delta**8,
                    s + 1,
                ),
                "x = Delta l_S/mu, s = sqrt(1+x), rho_S^2 = (s-1)/(s+1) <= Delta^{-8}",
                roots={"s": lambda Delta, x: 1 + x},
                false=(
                    lambda Delta, x, s: (
                        [Delta >= 1, x >= 0, x * Delta**8 <= 16],
                        (s - 1) * Delta**8,
                        s + 1,
                    ),
                ),
            ),
        ),
        kind="remark",
    ),
    Claim(
        "sec:main:CR#degree",
        "bounded degree and weak coupling, rate of the tight bound",
        "h(r) <= Delta^r <= rho_S^{-r/4} for l_S/mu <= Delta^{-7}, rho_S of "
        "thm:networked-exp-decay-tight: iota = 1/2 works",
        "b_1 = 2 Delta - 1, b_2 = 4 Delta^2 - 2 Delta: rho_S = 4 Delta^2 g(x) <= Delta^{-4}; and "
        "16 l_T <= mu, as that theorem asks for",
        (
            Decision(
                ("Delta", "x"),
                lambda Delta, x, s: (
                    [Delta >= 1, x >= 0, x * Delta**6 <= 1],
                    4 * Delta**6 * (s - 1),
                    s + 1,
                ),
                "x = Delta l_S/mu, s = sqrt(1+x), g(x) = (s-1)/(s+1)",
                roots={"s": lambda Delta, x: 1 + x},
                false=(
                    lambda Delta, x, s: (
                        [Delta >= 1, x >= 0, x * Delta**5 <= 1],
                        4 * Delta**6 * (s - 1),
                        s + 1,
                    ),
                ),
            ),
        ),
        part="tight",
        kind="remark",
        uses=("sec:main:perturb#b1b2-choice[a]",),
    ),
)
