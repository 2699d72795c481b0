"""What blindness to one random number costs, source by source, without subtracting."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..graphs import InputError
from ..lpc.arrays import Floats, Ints
from .grounded import Grounded

BATCH = 64  # sources solved for at once


@dataclass(frozen=True, eq=False)
class Charges:
    r"""Expected costs by source, in units of ``(mu/2) Var(w_j)``.

    For the cost ``(mu/2) (|x + w|^2 + x'(M - I)x)``, w independent with mean zero, where only the
    actions in ``S_j`` may depend on ``w_j``; ``B = M^{-1}``, O the rest of the vertices.

    Attributes
    ----------
    agents : ndarray of int, shape (c,)
        The sources j.
    optimal : ndarray, shape (c,)
        ``1 - B_jj``: what knowing everything costs.
    team : ndarray, shape (c,)
        ``B_jj - ((M_SS)^{-1})_jj``: how much more the best policies cost together [Radner 1962].
    conditional : ndarray, shape (c,)
        ``(B e_j)_O' M_OO (B e_j)_O``: how much more if each action is the conditional expectation
        of the optimal one, the policies of the paper's proof.
    deviation : ndarray, shape (c,)
        ``sum_{i in O} B_ij^2``: the paper's lower bound on `team`, by strong convexity.
    """

    agents: Ints
    optimal: Floats
    team: Floats
    conditional: Floats
    deviation: Floats

    @property
    def ratios(self) -> Floats:
        """``team/optimal`` by source; 0 where a source costs nobody anything."""
        safe = np.where(self.team > 0, self.optimal, 1.0)
        return np.where(self.team > 0, self.team / safe, 0.0)

    @property
    def best(self) -> int:
        """The place of the source with the largest ratio.

        The ratio of two sums ``sum_j Var_j team_j / sum_j Var_j optimal_j`` is a mean of the
        ratios by source, so that all the variance belongs to one best source.
        """
        return int(np.argmax(self.ratios))

    def ratio(self, variances: Floats | float = 1.0) -> float:
        """Return ``sum_j Var_j team_j / sum_j Var_j optimal_j``; 0 if the optimum costs nothing."""
        weights = np.broadcast_to(np.asarray(variances, dtype=float), self.team.shape)
        if not (np.isfinite(weights).all() and (weights >= 0).all() and weights.any()):
            raise InputError("variances: finite numbers >= 0, not all 0, are needed", "variances")
        best = float(weights @ self.optimal)
        return float(weights @ self.team) / best if best > 0 else 0.0


def charges(
    system: Grounded,
    sources: Ints,
    seen: Callable[[Ints], Sequence[Ints]],
    progress: Callable[[int, int], None] | None = None,
) -> Charges:
    r"""Return what sources cost.

    With ``z = (M_SS)^{-1} e_j`` and ``u = -M_OS z >= 0`` the difference that cancels,
    ``B_jj - z_j``, is ``u' B_OO u``: a Schur complement, and a sum of positive terms. Rows of
    ``B`` times the ground 1 + e sum to 1, so ``1 - B_jj = sum_{i != j} B_ij (1 + e_i) + B_jj e_j``.

    Parameters
    ----------
    system : Grounded
        M.
    sources : ndarray of int, shape (c,)
    seen : callable
        Returns the sets ``S_j`` of some sources; each contains j.
    progress : callable, optional
        Called as ``progress(done, total)``.
    """
    parts = list(_batches(system, sources, seen, progress))
    return Charges(sources, *np.concatenate(parts, axis=1))


def _batches(
    system: Grounded,
    sources: Ints,
    seen: Callable[[Ints], Sequence[Ints]],
    progress: Callable[[int, int], None] | None,
) -> Iterator[Floats]:
    for first in range(0, len(sources), BATCH):
        some = sources[first : first + BATCH]
        order = np.arange(len(some))
        right = np.zeros((system.size, len(some)))
        blind = np.ones(right.shape, dtype=bool)
        for c, (j, members) in enumerate(zip(some, seen(some), strict=True)):
            blind[members, c] = False
            part, inner, outer, weight = system.part(members)
            z = part.solve((members == j).astype(float))
            np.add.at(right[:, c], outer, weight * z[inner])
        column = np.zeros(right.shape)
        column[some, order] = 1.0
        column = system.solve(column)
        team = (right * system.solve(right)).sum(axis=0)
        rest = system.ground[:, None] * column
        rest[some, order] = column[some, order] * system.extra[some]
        off = np.where(blind, column, 0.0)
        yield np.stack([rest.sum(axis=0), team, system.energy(off), (off**2).sum(axis=0)])
        if progress is not None:
            progress(first + len(some), len(sources))
