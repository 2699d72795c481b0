"""Inequalities between sums of any number of terms, as decisions: a first term and a step."""

from __future__ import annotations

from ..engines.decision import Decision


def cauchy_schwarz() -> Decision:
    """Return the step of ``(sum w z)^2 <= (sum w) (sum w z^2)``, ``w >= 0``, from n to n + 1.

    With ``W, S, Q`` the sums of ``w, w z, w z^2`` so far; for no terms both sides are 0.
    """
    return Decision(
        ("W", "S", "Q", "w", "z"),
        lambda W, S, Q, w, z: (
            [W >= 0, Q >= 0, w >= 0, S * S <= W * Q],
            (S + w * z) ** 2,
            (W + w) * (Q + w * z * z),
        ),
        "induction on the number of terms (W, S, Q: the sums of w, w z, w z^2 so far; 0 <= 0 to "
        "begin with), one more term",
        false=(
            lambda W, S, Q, w, z: (
                [W >= 0, Q >= 0, w >= 0, S * S <= W * Q],
                (S + w * z) ** 2,
                (W + w) * (Q + w * z),
            ),
        ),
    )


def geometric(name: str = "p") -> Decision:
    """Return the step of ``1 + p + ... + p^n <= 1/(1-p)`` for ``0 <= p < 1``; p is `name`."""
    return Decision(
        ("p", "S"),
        lambda p, S: ([p >= 0, p < 1, S >= 1, S * (1 - p) <= 1], (1 + p * S) * (1 - p), 1),
        f"p = {name}; Horner: a geometric sum S becomes 1 + p S with one more term, and "
        "S (1 - p) <= 1 is kept",
        false=(lambda p, S: ([p >= 0, p < 1, S >= 1, S * (1 - p) <= 1], (1 + S) * (1 - p), 1),),
    )


def counted(most: str, reason: str) -> Decision:
    """Return ``n w <= N w`` for ``n <= N``, ``w >= 0``: as many terms as there may be.

    Parameters
    ----------
    most : str
        What N is.
    reason : str
        What is counted, and which claims the rest of the argument is.
    """
    return Decision(
        ("n", "N", "w"),
        lambda n, N, w: ([n >= 0, n <= N, w >= 0], n * w, N * w),
        f"{reason}; here n <= N = {most} times w >= 0",
        false=(lambda n, N, w: ([n >= 0, n <= 2 * N, w >= 0], n * w, N * w),),
    )


def two_squares() -> Decision:
    """Return ``(a+b)^2 <= 2 a^2 + 2 b^2``."""
    return Decision(
        ("a", "b"),
        lambda a, b: ([], (a + b) ** 2, 2 * a * a + 2 * b * b),
        "as it stands",
        false=(lambda a, b: ([], (a + b) ** 2, 2 * a * a + b * b),),
    )


def terms(reason: str) -> Decision:
    """Return the step of ``sum of n terms <= n B`` from n to n + 1, for terms of at most B.

    Parameters
    ----------
    reason : str
        What the terms are, and why each is at most B.
    """
    return Decision(
        ("n", "S", "term", "B"),
        lambda n, S, term, B: (
            [n >= 0, B >= 0, n * B >= S, term <= B],
            S + term,
            (n + 1) * B,
        ),
        reason,
        false=(
            lambda n, S, term, B: (
                [n >= 0, B >= 0, n * B >= S, term <= 2 * B],
                S + term,
                (n + 1) * B,
            ),
        ),
    )
