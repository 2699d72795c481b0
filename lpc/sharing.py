"""Which local problems are equal, so that they share one factorisation."""

from __future__ import annotations

import numpy as np

from .arrays import Floats, Ints
from .blocks import Blocks
from .cohorts import Cohort


class Labels:
    """Numbers for the blocks of a Hessian: equal ones, and only those, have the same number.

    Parameters
    ----------
    blocks : Blocks
    """

    def __init__(self, blocks: Blocks) -> None:
        self._blocks = blocks
        self._known: dict[tuple[str, int], Ints] = {}
        across = blocks.beside
        self._symmetric = bool(np.array_equal(across, across.swapaxes(2, 3)))

    def _labels(self, name: str, t: int) -> Ints:
        H = len(self._blocks.linear)
        array = {"own": "diagonal", "back": "before", "across": "beside"}[name]
        if len(getattr(self._blocks, array)) == 1:  # one block for all steps
            t = H if name == "own" and t == H else 1
        if (name, t) not in self._known:
            block: Floats = getattr(self._blocks, name)(t)
            self._known[name, t] = _numbered(block.reshape(len(block), block.shape[1] ** 2))
        return self._known[name, t]

    def signatures(self, cohort: Cohort, t: int, m: int) -> Ints:
        """Return one row of numbers an agent; equal rows belong to equal matrices.

        The numbers of one step are only compared with those of the same step.
        """
        A, b = cohort.ball.shape
        parts, seen = [], set()
        links = cohort.inside
        for j in range(m):
            for name in ("own", "back") if j else ("own",):
                label = self._labels(name, t + j)
                if id(label) not in seen:
                    seen.add(id(label))
                    parts.append(label[cohort.ball])
            label = self._labels("across", t + j)
            if id(label) not in seen:
                seen.add(id(label))
                graph = np.zeros((A, b, b), dtype=np.int64)
                turned = links.flip & (not self._symmetric)
                graph[links.a, links.i, links.other] = 2 * label[links.edge] + 2 + turned
                parts.append(graph.reshape(A, b * b))
        return np.concatenate(parts, axis=1)

    def distinct(self, cohort: Cohort, t: int, m: int) -> tuple[Ints, Ints]:
        """Return agents (positions) with different matrices, and which of them each equals."""
        rows = np.ascontiguousarray(self.signatures(cohort, t, m))
        if len(rows) == 1:
            return np.zeros(1, dtype=np.int64), np.zeros(1, dtype=np.int64)
        packed = rows.view(np.dtype((np.void, rows.dtype.itemsize * rows.shape[1])))[:, 0]
        _, first, which = np.unique(packed, return_index=True, return_inverse=True)
        return first, which


def _numbered(rows: Floats) -> Ints:
    """Return one number for each row, the same for equal rows (0.0 and -0.0 are equal)."""
    if rows.shape[0] == 0:
        return np.zeros(0, dtype=np.int64)
    if rows.shape[1] == 1:
        return np.unique(rows[:, 0], return_inverse=True)[1].astype(np.int64)
    return np.unique(rows, axis=0, return_inverse=True)[1].astype(np.int64).reshape(-1)
