"""Multiproduct pricing: prices of products that complement or replace one another."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..bounds.parameters import Parameters
from ..graphs import InputError, Network
from .arrays import Floats, Ints, family, fits, spread
from .costs import Quadratic
from .problem import Problem
from .sets import Box


@dataclass(frozen=True, eq=False)
class Pricing:
    """Maximise ``sum_t sum_v x_t^v d_t^v`` over prices ``0 <= x_t^v <= cap_t^v``, with demand::

        d_t^v = a_t^v - k_t^v x_t^v - sum_{u ~ v} eta_t^{u->v} x_t^u + b_t^v x_{t-1}^v

    With ``gamma_t^{uv} = (eta_t^{u->v} + eta_t^{v->u})/2`` and, ``b_{H+1}`` being 0, ::

        xi_t^v = k_t^v - sum_{u ~ v} |gamma_t^{uv}| - (b_t^v + b_{t+1}^v)/2  > 0

    the nonnegative costs ``xi (x - a/(2 xi))^2``, ``|gamma| (x_u + sgn(gamma) x_v)^2`` and
    ``(b/2) (x_t - x_{t-1})^2`` add up, exactly and for all prices, to ::

        cost(x) = constant - revenue(x),   constant = sum a^2/(4 xi) + sum_v b_1^v (x_0^v)^2/2

    *Why.* The squares of x_t^v have the coefficient ``xi + sum |gamma| + (b_t + b_{t+1})/2 = k``,
    where ``b_{t+1}/2`` comes from the temporal cost of the next step, which step H has not; the
    products are ``2 gamma x_u x_v`` and ``-b x_t x_{t-1}``, and the temporal cost of step 1 leaves
    ``b_1 x_0^2/2``. The paper does not say what b_{H+1} is, and leaves the last term out.

    Demand may be negative, also at the optimum: the model does not forbid it.

    Parameters
    ----------
    network : Network
        The products, joined where they are complements or substitutes.
    nominal : array_like, shape (H, N)
        The demand a > 0 at prices 0. It tells the number of steps.
    elasticity : array_like, shape ([[H,] N])
        How much demand k > 0 a unit of the own price costs.
    cross : array_like, shape ([[H,] E,] 2)
        ``(eta^{u->v}, eta^{v->u})`` for the edges ``u < v``, in the order of `edges`: positive for
        complements, negative for substitutes.
    carry : array_like, shape ([[H,] N])
        How much demand ``b >= 0`` a unit of the last price leaves for today.
    cap : array_like, shape ([[H,] N])
        The highest prices, > 0 or infinite.
    x_0 : array_like, shape (N,) or a number
        The prices before the first step.

    Raises
    ------
    InputError
        If shapes do not fit or a number is out of its range; the message names step and product.

    References
    ----------
    Paper, Appendix "Example: Multiproduct Pricing" (``apx:application``).
    """

    network: Network
    nominal: Floats
    elasticity: Floats
    cross: Floats = 0.0  # type: ignore[assignment]
    carry: Floats = 0.0  # type: ignore[assignment]
    cap: Floats = np.inf  # type: ignore[assignment]
    x_0: Floats = 0.0  # type: ignore[assignment]

    def __post_init__(self) -> None:
        N, E = self.network.vertices, self.network.edges
        nominal = family(self.nominal, 0, "nominal demand")
        if np.ndim(self.nominal) != 2 or nominal.shape[1] != N or not len(nominal):
            raise InputError(
                f"nominal demand: shape {np.shape(self.nominal)}; (H, {N}) with H >= 1 is needed",
                "nominal",
            )
        H = len(nominal)
        for name, meaning, infinite in (
            ("nominal", "nominal demand a", False),
            ("elasticity", "elasticity k", False),
            ("carry", "carry b", False),
            ("cap", "cap", True),
        ):
            array = family(getattr(self, name), 0, meaning, infinite=infinite)
            fits(array, H, N, meaning)
            array = spread(array, H, N)
            object.__setattr__(self, name, array)
            least = ">= 0" if name == "carry" else "> 0"
            bad = np.argwhere(array < 0 if name == "carry" else array <= 0)
            if len(bad):
                t, v = bad[0]
                raise InputError(
                    f"{meaning} at step {t + 1}, product {self.network.names[v]}: "
                    f"{array[t, v]:g}; a number {least} is needed",
                    name,
                )
        given = np.zeros(2) if np.ndim(self.cross) == 0 and not np.any(self.cross) else self.cross
        cross = family(given, 1, "cross elasticity eta")
        if cross.shape[-1] != 2:
            raise InputError(
                f"cross elasticity eta: shape {cross.shape}; two numbers an edge are needed: "
                "(eta of u on v, eta of v on u)",
                "cross",
            )
        fits(cross, H, E, "cross elasticity eta")
        object.__setattr__(self, "cross", spread(cross, H, E))
        self._diagonally_dominant()
        object.__setattr__(self, "x_0", self.problem().x_0[:, 0])

    def _diagonally_dominant(self) -> None:
        bad = np.argwhere(~(self.xi > 0))
        if len(bad):
            t, v = bad[0]
            raise InputError(
                f"elasticity k at step {t + 1}, product {self.network.names[v]}: "
                f"{self.elasticity[t, v]:g}; more than the sum of |gamma| and of half the carries "
                f"of this step and the next, {self.elasticity[t, v] - self.xi[t, v]:g}, is needed",
                "elasticity",
            )

    @property
    def H(self) -> int:
        """The number of steps."""
        return len(self.nominal)

    @cached_property
    def edges(self) -> Ints:
        """The two ends ``u < v`` of every edge, in lexicographic order, shape (E, 2)."""
        return ends(self.network)

    @cached_property
    def gamma(self) -> Floats:
        """``(eta^{u->v} + eta^{v->u})/2`` of every edge, shape (H, E)."""
        found: Floats = 0.5 * self.cross[..., 0] + 0.5 * self.cross[..., 1]
        return found

    @cached_property
    def xi(self) -> Floats:
        """``k - sum |gamma| - (b_t + b_{t+1})/2``, ``b_{H+1} = 0``, shape (H, N)."""
        found: Floats = self.elasticity - load(self.edges, self.gamma, self.carry)
        return found

    @property
    def base(self) -> float:
        """``sum a^2/(4 xi)``: the paper's C, all of `constant` if ``x_0 = 0``."""
        return float((self.nominal**2 / (4 * self.xi)).sum())

    @property
    def constant(self) -> float:
        """``cost(x) + revenue(x)``, the same for all prices x."""
        return self.base + float((self.carry[0] * self.x_0**2).sum() / 2)

    @property
    def parameters(self) -> Parameters:
        """The constants of `problem`: 2 min xi, 2 max xi, 2 max b, 4 max |gamma|."""
        l_S = 4 * float(np.abs(self.gamma).max(initial=0.0))
        l_T = 2 * float(self.carry.max())
        return Parameters(2 * float(self.xi.min()), 2 * float(self.xi.max()), l_T, l_S)

    @property
    def stated_parameters(self) -> Parameters:
        """The paper's constants, none smaller: mu, l_f = 2 max k, 2 max b, 4 max |eta|."""
        l_S = 4 * float(np.abs(self.cross).max(initial=0.0))
        l_f = 2 * float(self.elasticity.max())
        return Parameters(self.parameters.mu, l_f, self.parameters.l_T, l_S)

    def problem(self) -> Problem:
        """Return the networked problem whose cost is ``constant - revenue``; actions are prices."""
        sign = np.sign(self.gamma)[..., None, None] * np.array([[0.0, 1.0], [1.0, 0.0]])
        pattern = np.array([[1.0, -1.0], [-1.0, 1.0]])
        strength = 2 * np.abs(self.gamma)[..., None, None]
        spatial = Quadratic(strength * (np.eye(2) + sign) if len(self.edges) else np.zeros((2, 2)))
        start = np.asarray(self.x_0, dtype=np.float64)
        return Problem(
            self.network,
            self.H,
            Quadratic(2 * self.xi[..., None, None], (self.nominal / (2 * self.xi))[..., None]),
            Quadratic(self.carry[..., None, None] * pattern),
            spatial,
            Box(np.zeros(1), self.cap[..., None]),
            start[..., None] if start.ndim else start,
        )

    def demand(self, x: ArrayLike) -> Floats:
        """Return the demands d at prices x, both of shape (H, N) or (H, N, 1)."""
        given = np.asarray(x, dtype=np.float64)
        shape = self.nominal.shape
        if given.shape not in (shape, (*shape, 1)):
            raise InputError(f"prices: shape {given.shape}; {shape} is needed")
        prices = given.reshape(shape)
        before = np.concatenate([self.x_0[None], prices[:-1]])
        found: Floats = self.nominal - self.elasticity * prices + self.carry * before
        u, v = self.edges.T
        np.subtract.at(found.T, v, (self.cross[..., 0] * prices[:, u]).T)
        np.subtract.at(found.T, u, (self.cross[..., 1] * prices[:, v]).T)
        return found.reshape(given.shape)

    def revenue(self, x: ArrayLike) -> float:
        """Return ``sum_t sum_v x_t^v d_t^v`` of prices of shape (H, N) or (H, N, 1)."""
        return float((np.asarray(x) * self.demand(x)).sum())


def ends(network: Network) -> Ints:
    """Return the two ends ``u < v`` of every edge, in lexicographic order, shape (E, 2)."""
    rows = np.repeat(np.arange(network.vertices), network.degrees)
    forward = rows < network.indices
    return np.stack([rows[forward], network.indices[forward]], axis=1).astype(np.int64)


def load(edges: Ints, gamma: Floats, carry: Floats) -> Floats:
    """Return what an elasticity has to exceed, shape (H, N)::

    sum_{u ~ v} |gamma_t^{uv}| + (b_t^v + b_{t+1}^v)/2,   b_{H+1} = 0
    """
    found = 0.5 * carry
    found[:-1] += 0.5 * carry[1:]
    for end in edges.T:
        np.add.at(found.T, end, np.abs(gamma).T)
    return found
