"""The exact worst case of LPC, matrix-free, against SciPy's dense generalised eigenvalues.

    python benchmarks/lowerbounds_worst_case.py            # 1000 and 2000 unknowns
    python benchmarks/lowerbounds_worst_case.py --large    # and 10^5: a ring, then a torus

The other side does what the definition says: LPC and the optimum as dense matrices of the targets,
the two quadratic forms of their costs, ``scipy.linalg.eigh`` of the pair for its largest
eigenvalue. Every run prints both values and how far they are apart. One thread of linear algebra.
"""

import os

os.environ["OPENBLAS_NUM_THREADS"] = os.environ["OMP_NUM_THREADS"] = "1"

import argparse
import resource
import time

import numpy as np
from scipy.linalg import eigh

import nearsight as ns
from nearsight.lowerbounds import worst_case

MU, L_F, L_T, L_S, K, R = 1.0, 1.0, 1.0, 0.5, 3, 2


def timed(function, *arguments):
    """Return the seconds a call takes, and what it returns."""
    start = time.perf_counter()
    found = function(*arguments)
    return time.perf_counter() - start, found


def drawn(graph, horizon):
    """Return the uniform instance of one network."""
    return ns.random_problem(graph=graph, mu=MU, l_f=L_F, l_T=L_T, l_S=L_S, horizon=horizon)


def distances(adjacency):
    """Return the distances of a small graph."""
    N = len(adjacency)
    found, reach = np.full((N, N), np.inf), np.eye(N, dtype=bool)
    for d in range(N):
        found[reach & np.isinf(found)] = d
        reach = reach | (reach @ adjacency)
    return found


def dense(N, H):
    """Return ``CR - 1`` on the ring from dense matrices only, all data but ``x_0 = 0``."""
    adjacency = np.roll(np.eye(N, dtype=bool), 1, axis=0)
    adjacency |= adjacency.T
    apart = distances(adjacency)
    L = np.diag(adjacency.sum(0)) - adjacency
    chain = np.diag([2.0] * (H - 1) + [1.0]) - np.eye(H, k=1) - np.eye(H, k=-1)
    M = MU * np.eye(H * N) + L_T / 2 * np.kron(chain, np.eye(N)) + L_S / 2 * np.kron(np.eye(H), L)
    played = np.zeros((H * N, H * N))
    for t in range(H):
        for v in range(N):
            steps = np.arange(t, min(t + K - 1, H))[:, None] * N
            free = (steps + np.flatnonzero(apart[v] <= R - 1)).ravel()
            first = np.zeros(len(free))
            first[np.flatnonzero(free == t * N + v)] = 1.0
            row = np.linalg.solve(M[np.ix_(free, free)], first)
            pull = -row @ M[free]
            pull[free] = MU * row
            played[t * N + v] = pull[: t * N] @ played[: t * N]
            played[t * N + v, t * N :] += pull[t * N :]
    off = played - MU * np.linalg.inv(M)
    paid, least = off.T @ M @ off, MU * np.eye(H * N) - MU**2 * np.linalg.inv(M)
    top = [H * N - 1, H * N - 1]
    return float(eigh(paid, least, eigvals_only=True, subset_by_index=top)[0])


def matrix_free(graph, horizon):
    """Return the worst case by the iteration."""
    return worst_case(drawn(graph, horizon), K, R, method="lanczos")


def memory():
    """Return the largest memory so far, in MiB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**10


def compare(sizes):
    """Print both sides at some sizes of a ring."""
    for N, H in sizes:
        seconds, found = timed(matrix_free, f"ring:{N}", H)
        theirs, value = timed(dense, N, H)
        print(f"ring of {N}, H = {H}, k = {K}, r = {R}: {N * H} unknowns")
        print(f"  matrix-free {seconds:.2f} s, dense {theirs:.2f} s: {theirs / seconds:.0f} times")
        off = abs(found.cr_minus_one / value - 1)
        print(f"  CR - 1 = {found.cr_minus_one:.10e}, apart by {off:.1e} (relative)")


def large():
    """Print what 10^5 unknowns take."""
    for graph, horizon in (("ring:1000", 100), ("torus:100x100", 10)):
        before = memory()
        seconds, found = timed(matrix_free, graph, horizon)
        print(
            f"{graph}, H = {horizon}: {seconds:.1f} s, CR - 1 = {found.cr_minus_one:.6e}, ", end=""
        )
        print(f"residual {found.residual:.1e}; {memory():.0f} MiB at most ({before:.0f} before)")


def main():
    """Run."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--large", action="store_true", help="10^5 unknowns, too")
    options = parser.parse_args()
    if options.large:
        large()
    compare(((40, 25), (50, 40)))


if __name__ == "__main__":
    main()
