"""Try to refute what is said of a cost: its curvature, its derivatives, its sign."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...graphs import InputError
from ..arrays import Floats, Ints, at
from ..damped import descend
from .cost import Cost

SLACK = 1e-9  # relative: eigenvalues are computed, and claims are typed in
MODERATE = 1e3  # finite differences are taken at points up to this size


@dataclass(frozen=True)
class Probed:
    """What samples have shown; they can refute a claim, never prove it.

    Parameters
    ----------
    points : int
        How many points were looked at.
    lower, upper : float
        The least and the largest eigenvalue of a Hessian at one of them.
    least : float
        The least cost found.
    """

    points: int
    lower: float
    upper: float
    least: float


def probe(
    cost: Cost,
    H: int,
    count: int,
    name: str,
    *,
    samples: int = 256,
    seed: int = 0,
    near: Floats | None = None,
    member: str = "agent or edge",
) -> Probed:
    """Look for a point that refutes the curvature, the derivatives or the sign of a cost.

    The points are random, of sizes 1e-3 to 1e5; then the minima of the cost; then three rounds
    around those points whose Hessians come closest to a bound.

    Parameters
    ----------
    cost : Cost
    H, count : int
        Steps and members.
    name, member : str
        What the cost is and what its members are, for messages.
    samples : int
        Random points, and at most as many in each later round.
    seed : int
        Of the random points.
    near : ndarray, shape (m, size), optional
        More points to look at, with random steps and members.

    Raises
    ------
    InputError
        If a value is not finite, a Hessian is not symmetric or has an eigenvalue outside of the
        bounds, derivatives are not those of the value, or a cost is negative; with the point.
    """
    rng = np.random.default_rng(seed)
    size = cost.size
    w = rng.standard_normal((samples, size)) * 10 ** rng.uniform(-3, 5, (samples, 1))
    w = np.concatenate([w] if near is None else [w, near])
    t, i = rng.integers(1, H + 1, len(w)), rng.integers(0, count, len(w))
    tester = _Tester(cost, name, member)
    low, high = tester.curvature(t, i, w)
    tester.derivatives(t, i, w, rng)
    bottom = descend(lambda y: _all(cost, t, i, y), np.where(np.abs(w) < MODERATE, w, 0.0), 30)
    least = tester.sign(t, i, bottom)
    pool = (np.concatenate([t, t]), np.concatenate([i, i]), np.concatenate([w, bottom]))
    for scale in (1.0, 0.3, 0.1):
        lows, highs = tester.curvature(*pool)
        low, high = min(low, lows), max(high, highs)
        keep = tester.closest(*pool, max(samples // 2, 1))
        t, i, w = (part[keep] for part in pool)
        moved = w + scale * (1 + np.abs(w)) * rng.standard_normal(w.shape)
        pool = (np.concatenate([t, t]), np.concatenate([i, i]), np.concatenate([w, moved]))
    lows, highs = tester.curvature(*pool)
    return Probed(2 * len(bottom) + 3 * len(w), min(low, lows), max(high, highs), least)


def _all(cost: Cost, t: Ints, i: Ints, w: Floats) -> tuple[Floats, Floats, Floats]:
    return cost.value(t, i, w), cost.gradient(t, i, w), cost.hessian(t, i, w)


@dataclass(frozen=True)
class _Tester:
    """The single tests of one cost; each raises `InputError` at the first point that fails."""

    cost: Cost
    name: str
    member: str

    def refuse(self, t: Ints, i: Ints, w: Floats, j: int, what: str) -> InputError:
        """Return the error about point j."""
        point = np.array2string(w[j], precision=6, max_line_width=10**6, threshold=12)
        return InputError(
            f"{self.name} at step {t[j]}, {self.member} {i[j]}, point w = {point}: {what}"
        )

    def curvature(self, t: Ints, i: Ints, w: Floats) -> tuple[float, float]:
        """Test values and Hessians; return the extreme eigenvalues."""
        m, s = w.shape
        found = _all(self.cost, t, i, w)
        shapes = ((m,), (m, s), (m, s, s))
        names = ("value", "gradient", "Hessian")
        for part, shape, what in zip(found, shapes, names, strict=True):
            if np.shape(part) != shape:
                raise InputError(
                    f"{self.name}: the {what} at {m} points has shape {np.shape(part)}, "
                    f"{shape} is needed"
                )
            bad = ~np.isfinite(part).reshape(m, -1).all(axis=1)
            if bad.any():
                raise self.refuse(t, i, w, int(bad.argmax()), f"the {what} is not finite")
        bend = found[2]
        skew = np.abs(bend - bend.swapaxes(1, 2)).max(axis=(1, 2))
        wrong = skew > SLACK * np.abs(bend).max(axis=(1, 2))
        if wrong.any():
            raise self.refuse(t, i, w, int(wrong.argmax()), "the Hessian is not symmetric")
        values = np.linalg.eigvalsh(bend)
        bounds = self.cost.curvature()
        low, high = at(bounds.lower, t, i), at(bounds.upper, t, i)
        slack = SLACK * high + at(bounds.error, t, i)
        for gap, value, bound, word in (
            (low - values[:, 0], values[:, 0], low, "below the lower"),
            (values[:, -1] - high, values[:, -1], high, "above the upper"),
        ):
            if (gap > slack).any():
                j = int((gap - slack).argmax())
                flaw = "not convex, " if value[j] < -slack[j] else ""
                what = f"{flaw}curvature {value[j]:g} is {word} bound {bound[j]:g}"
                raise self.refuse(t, i, w, j, what)
        return float(values[:, 0].min()), float(values[:, -1].max())

    def closest(self, t: Ints, i: Ints, w: Floats, count: int) -> Ints:
        """Return the points whose eigenvalues come closest to a bound."""
        values = np.linalg.eigvalsh(self.cost.hessian(t, i, w))
        bounds = self.cost.curvature()
        above = np.argsort(at(bounds.upper, t, i) - values[:, -1], kind="stable")
        below = np.argsort(values[:, 0] - at(bounds.lower, t, i), kind="stable")
        return np.concatenate([above[: (count + 1) // 2], below[: count // 2]])

    def derivatives(self, t: Ints, i: Ints, w: Floats, rng: np.random.Generator) -> None:
        """Compare gradients and Hessians with central differences along a random direction."""
        here = np.abs(w).max(axis=1) < MODERATE
        t, i, w = t[here], i[here], w[here]
        along = rng.standard_normal(w.shape)
        along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-3)
        h = 1e-4 * (1 + np.abs(w).max(axis=1))
        value, slope, bend = _all(self.cost, t, i, w)
        coarse, fine = (self._slopes(t, i, w, along, x) for x in (h, h / 2))
        true = ((slope * along).sum(axis=1)[:, None], (bend @ along[:, :, None])[:, :, 0])
        size = (np.abs(value)[:, None], np.abs(slope))
        for a, b, known, top, what in zip(
            coarse, fine, true, size, ("gradient", "Hessian"), strict=True
        ):
            noise = 1e3 * np.finfo(float).eps * top / h[:, None]
            allowed = 10 * np.abs(a - b) + noise + 1e-5 * (np.abs(known) + np.abs(b))
            wrong = (np.abs(b - known) > allowed + 1e-12).any(axis=1)
            if wrong.any():
                j = int(wrong.argmax())
                raise self.refuse(
                    t, i, w, j, f"the {what} is not the derivative that differences give"
                )

    def _slopes(
        self, t: Ints, i: Ints, w: Floats, along: Floats, h: Floats
    ) -> tuple[Floats, Floats]:
        step = h[:, None] * along
        up, down = (
            (self.cost.value(t, i, x)[:, None], self.cost.gradient(t, i, x))
            for x in (w + step, w - step)
        )
        width = 2 * h[:, None]
        return (up[0] - down[0]) / width, (up[1] - down[1]) / width

    def sign(self, t: Ints, i: Ints, w: Floats) -> float:
        """Test that no cost is negative at the points, up to rounding; return the least."""
        value = self.cost.value(t, i, w)
        usual = np.abs(self.cost.value(t, i, np.zeros_like(w)))
        bad = value < -1e-9 * (1e-3 + usual)
        if bad.any():
            j = int(np.where(bad, value, 0.0).argmin())
            raise self.refuse(t, i, w, j, f"the cost is {value[j]:g}; costs are nonnegative")
        return float(value.min())
