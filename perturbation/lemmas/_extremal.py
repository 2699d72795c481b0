"""Where Demko's bound is attained."""

from __future__ import annotations

import numpy as np
from scipy import optimize

from ...graphs import InputError
from ...lpc.arrays import Floats


def extremal_path(d: int, kappa: float) -> Floats:
    r"""Return the A on the path of ``d + 1`` vertices whose inverse decays least.

    Its eigenvalues fill ``[1, kappa]`` and

    .. math:: |(A^{-1})_{0,d}| = \frac{(1+\sqrt\kappa)^2}{2\kappa}
        \Big(\frac{\sqrt\kappa-1}{\sqrt\kappa+1}\Big)^d,

    so that Demko's bound cannot be improved at any distance ``d >= 1``, even for ``q = 2``.

    *Why.* The error of the best approximation of 1/x by polynomials of degree ``d - 1`` is
    that number, taken with alternating signs at ``d + 1`` points. The persymmetric tridiagonal
    matrix with these points as eigenvalues has ``(p(A))_{0,d} = 0`` for all such p, and its
    eigenvectors' products ``u_j(0) u_j(d)`` alternate and add up to 1 in modulus, so that
    ``(A^{-1})_{0,d}`` is the error.

    Parameters
    ----------
    d : int
        At least 1.
    kappa : float
        Above 1.

    Returns
    -------
    ndarray, shape (d + 1, d + 1)

    References
    ----------
    Meinardus, *Approximation of Functions* (1967), for the best approximation;
    Hochstadt, Linear Algebra Appl. 8 (1974), for the matrix.
    """
    if d < 1 or not kappa > 1:
        raise InputError(f"d = {d}, kappa = {kappa:g}: d >= 1 and kappa > 1 are needed")
    # On [-1, 1] the error is cos((d-1) phi + delta) with x = cos(phi) and the pole at -c.
    c = (kappa + 1) / (kappa - 1)

    def phase(phi: float) -> float:
        x = np.cos(phi)
        delta = np.arccos(np.clip((1 + c * x) / (x + c), -1.0, 1.0))
        return float((d - 1) * phi + delta)

    inner = [optimize.brentq(lambda p, j=j: phase(p) - j * np.pi, 0.0, np.pi) for j in range(1, d)]
    points = np.cos(np.array([np.pi, *inner[::-1], 0.0]))
    values = 1 + (kappa - 1) / 2 * (points + 1)
    gaps = np.abs(np.subtract.outer(values, values)) + np.eye(d + 1)
    logs = -np.log(gaps).sum(axis=1)
    weights = np.exp(logs - logs.max())
    return _jacobi(values, weights / weights.sum())


def _jacobi(values: Floats, weights: Floats) -> Floats:
    """Return the tridiagonal matrix with given eigenvalues and squared first entries (Lanczos)."""
    size = len(values)
    basis = np.zeros((size, size))
    basis[:, 0] = np.sqrt(weights)
    for j in range(1, size):
        new = values * basis[:, j - 1]
        for _ in range(2):
            new -= basis[:, :j] @ (basis[:, :j].T @ new)
        basis[:, j] = new / np.linalg.norm(new)
    full = basis.T @ (values[:, None] * basis)
    found: Floats = np.triu(np.tril(full, 1), -1)
    return 0.5 * (found + found.T)
