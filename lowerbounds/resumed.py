"""What finished climbs and rows are of: a file of others is refused."""

from __future__ import annotations

from ..bounds import Parameters
from ..lpc.identity import digest
from ..lpc.problem import Problem


def identity(problem: Problem, parameters: Parameters, **others: int | None) -> dict[str, object]:
    """Return what tells one run from another, as JSON values for `nearsight.lpc.store.Store`.

    Parameters
    ----------
    problem : Problem
        One of the class: it holds the network, the horizon and the couplings.
    parameters : Parameters
        mu, l_f, l_T, l_S: one float each.
    **others : int or None
        Whatever else the numbers depend on.
    """
    p = parameters
    constants = [float(value).hex() for value in (p.mu, p.l_f, p.l_T, p.l_S)]
    numbers = {name: None if n is None else int(n) for name, n in others.items()}
    return {"problem": digest(problem), "constants": constants, **numbers}
