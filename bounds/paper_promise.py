"""``coro:CR-LPC`` as a planner sees it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .arithmetic import Number, upper_end
from .constants import Constants, Source
from .formula import plain_floats
from .promise import Floats, Promise
from .ratio import RatioParts, Reach, ratio_parts, smoothness
from .reach import table
from .setting import Setting


@dataclass(frozen=True)
class PaperPromise(Promise):
    """``CR - 1 = lateral(r) + C(r) rho_T^{k-1}`` under the condition (e2-0).

    Parameters
    ----------
    setting : Setting
        Scalar float parameters and the network; its k and r are not used.
    source : Source
        The perturbation bounds the ratio is built on.
    variant : str
        Name of the statement.
    """

    setting: Setting
    source: Source
    variant: str = ""
    _seen: list[tuple[Floats, Floats]] = field(default_factory=list, repr=False, compare=False)
    _table: list[tuple[Number, Number]] = field(default_factory=list, repr=False, compare=False)

    def _parts(self, s: Setting, found: Constants, size: Reach, k: Any, r: Any) -> RatioParts:
        weight = smoothness(s.parameters.condition, s.a_T, s.a_S, s.max_degree)
        return ratio_parts(found.local, found.whole, weight, size, k, r)

    def _floats(self, k: Any, r: Any, *, sides: bool = True, top: bool = True) -> RatioParts:
        """Return the parts in floats, without the sides (h = 0) or the top (C_3 = 0)."""
        with plain_floats():
            found = self.source(self.setting)
            sizes, sums = self._network(float(found.local.rho_S), int(np.max(r)))
            kept = Reach(sizes[r] if sides else 0.0, sums[r] if top else 0.0)
            return self._parts(self.setting, found, kept, k, r)

    def _network(self, rho_S: float, last: int) -> tuple[Floats, Floats]:
        """Return ``h`` and ``C_3`` by radius, from a table that doubles where needed."""
        if not self._seen or len(self._seen[0][0]) <= last:
            self._seen[:] = [table(self.setting.growth, rho_S, max(2 * last, 16))]
        return self._seen[0]

    def excess(self, k: Any, r: Any) -> Floats:
        """Return (e1) where (e2-0) holds."""
        p = self._floats(k, r)
        return np.where(p.condition <= 0.5, p.lateral + p.top, np.inf)

    def floor_in_k(self, k: Any) -> Floats:
        """Return the top part at ``r = 0``, where ``C_3`` is least, 1."""
        return np.asarray(self._floats(k, 0).top)

    def floor_in_r(self, k: int, r: Any) -> Floats:
        """Return the lateral part, infinite where it breaks the condition on its own."""
        p = self._floats(k, r, top=False)
        return np.where(p.condition <= 0.5, p.lateral, np.inf)

    def hopeless(self, k: int, r: int, excess: float) -> bool:
        """Compare the part due to the top alone: ``C_3`` grows with r."""
        p = self._floats(k, r, sides=False)
        return bool(p.top > excess) or not bool(p.condition <= 0.5)

    def _sums(self, rho_S: Number, r: int) -> Number:
        """Return ``C_3(r)`` in intervals from a table of partial sums, longer where needed."""
        table = self._table
        while len(table) <= r:
            q = len(table)
            before, last = table[-1] if table else (0 * rho_S, 1 + 0 * rho_S)
            table.append((before + self.setting.growth.h(q) * last, last * rho_S))
        return table[r][0]

    def upper(self, k: int, r: int) -> float:
        """Evaluate (e1), (e2-0) and the conditions of the local bound in intervals."""
        s = self.setting.converted("interval")
        found = self.source(s)
        size = Reach(s.growth.h(r), self._sums(found.local.rho_S, r))
        p = self._parts(s, found, size, k, r)
        sound = all(bool(m >= 0) for m in found.margins)
        closes = bool(p.condition <= 0.5) and bool(found.local.one_minus_rho_T > 0)
        return upper_end(p.lateral + p.top) if sound and closes else np.inf
