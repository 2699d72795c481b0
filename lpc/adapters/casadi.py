"""CasADi and IPOPT: any costs and any constraints, through their derivatives."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ...graphs import InputError, NearsightError
from ..arrays import Floats
from ..terms import Terms
from ._model import Model

Named = list[tuple[str, Any]]  # names and sparsities

ADVICE = {
    "Infeasible_Problem_Detected": "a feasible set seems to be empty",
    "Maximum_Iterations_Exceeded": "give a start nearer to the answer, or use method = barrier",
    "Invalid_Number_Detected": "a cost or a constraint is not finite on the way",
}


def minimise(
    terms: Terms, fixed: Floats, *, start: Floats | None = None, tolerance: float = 1e-9
) -> Floats:
    """Return ``argmin cost(x)`` with ``g_i(x_j) <= 0`` for any costs and sets, shape (F, n).

    Parameters
    ----------
    terms : Terms
    fixed : ndarray, shape (G, n)
    start : ndarray, shape (F, n), optional
        A guess; need not be feasible. 0 if omitted.
    tolerance : float
        IPOPT's tolerance, at least 1e-12.

    Raises
    ------
    InputError
        If CasADi is not installed.
    NearsightError
        If IPOPT does not succeed.

    References
    ----------
    J. Andersson et al., CasADi (2019).
    A. Wachter, L. Biegler, On the implementation of an interior-point filter line-search algorithm
    for large-scale nonlinear programming (2006).
    """
    try:
        import casadi
    except ImportError as error:
        text = "method = casadi: not installed; pip install casadi (the extra nlp)"
        raise InputError(text, "method") from error
    shape = (len(terms.free), terms.problem.n)
    first = np.zeros(shape) if start is None else np.asarray(start)
    program, derivatives, _alive = _program(casadi, Model.of(terms, fixed, first))
    options = {
        "print_time": False,
        "ipopt": {
            "print_level": 0,
            "sb": "yes",
            "tol": max(tolerance, 1e-12),
            "bound_relax_factor": 0.0,
            "mu_strategy": "adaptive",
        },
        **derivatives,
    }
    solver = casadi.nlpsol("nearsight", "ipopt", program, options)
    found = solver(x0=first.ravel(), lbg=-np.inf, ubg=0.0)
    status = solver.stats()["return_status"]
    if status not in ("Solve_Succeeded", "Solved_To_Acceptable_Level"):
        advice = ADVICE.get(status, "give a start nearer to the answer, or ask for less accuracy")
        raise NearsightError(f"IPOPT: {status}; {advice}")
    answer: Floats = np.asarray(found["x"], dtype=np.float64).reshape(shape)
    return answer


def _program(casadi: Any, model: Model) -> tuple[dict[str, Any], dict[str, Any], list[Any]]:
    """Return a program for CasADi, options with its derivatives, and what has to outlive both."""
    size, count = model.size, model.count
    dense, single = casadi.Sparsity.dense(size), casadi.Sparsity.dense(1)
    multipliers = casadi.Sparsity.dense(count)
    jacobian, hessian = (
        casadi.Sparsity(*shape, pattern.indptr.tolist(), pattern.indices.tolist())
        for shape, pattern in (((count, size), model.steep), ((size, size), model.bent))
    )
    point = [("x", dense), ("p", casadi.Sparsity.dense(0, 0))]

    def flat(x: Any) -> Floats:
        return np.asarray(x, dtype=np.float64).ravel()

    f = _callback(casadi, "f", point[:1], [("f", single)], lambda x: [model.cost(flat(x))])
    g = _callback(
        casadi, "g", point[:1], [("g", multipliers)], lambda x: [model.constraints(flat(x))]
    )
    grad_f = _callback(
        casadi,
        "nlp_grad_f",
        point,
        [("f", single), ("grad_f_x", dense)],
        lambda x, _: [model.cost(flat(x)), model.gradient(flat(x))],
    )
    jac_g = _callback(
        casadi,
        "nlp_jac_g",
        point,
        [("g", multipliers), ("jac_g_x", jacobian)],
        lambda x, _: [model.constraints(flat(x)), casadi.DM(jacobian, model.jacobian(flat(x)))],
    )
    hess_lag = _callback(
        casadi,
        "nlp_hess_l",
        [*point, ("lam_f", single), ("lam_g", multipliers)],
        [("triu_hess_gamma_x_x", hessian)],
        lambda x, _, a, b: [casadi.DM(hessian, model.hessian(flat(x), float(a), flat(b)))],
    )
    x = casadi.MX.sym("x", size)
    options = {"grad_f": grad_f, "jac_g": jac_g, "hess_lag": hess_lag, "no_nlp_grad": True}
    return {"x": x, "f": f(x), "g": g(x)}, options, [f, g]


def _callback(
    casadi: Any, name: str, inputs: Named, outputs: Named, function: Callable[..., list[Any]]
) -> Any:
    """Return a Python function as one of CasADi's."""

    class Callback(casadi.Callback):  # type: ignore[misc]
        def __init__(self) -> None:
            casadi.Callback.__init__(self)
            self.construct(name, {})

        def get_n_in(self) -> int:
            return len(inputs)

        def get_n_out(self) -> int:
            return len(outputs)

        def get_name_in(self, i: int) -> str:
            return inputs[i][0]

        def get_name_out(self, i: int) -> str:
            return outputs[i][0]

        def get_sparsity_in(self, i: int) -> Any:
            return inputs[i][1]

        def get_sparsity_out(self, i: int) -> Any:
            return outputs[i][1]

        def eval(self, arguments: list[Any]) -> list[Any]:
            return function(*arguments)

    return Callback()
