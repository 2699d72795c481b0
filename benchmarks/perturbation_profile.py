"""Profiles of 1000 local problems of 200 variables, and what a user would otherwise do.

    python benchmarks/perturbation_profile.py

On a torus of 20 x 20 agents, k = 9, r = 4: 25 agents times 8 steps are free, 200 variables. All
sensitivities of 1000 random instances, of all styles of costs, in blocks by distance, with slices,
jumps, bounds and fits, in one process and in two. Without the package one would solve a local
problem once more for every boundary variable and divide the differences (forward differences):

* CVXPY with Clarabel, compiled once with the boundary as a parameter (DPP), quadratic costs only;
* SciPy's L-BFGS-B with exact gradients from this package, begun at the solution, for all styles.

Both are extrapolated from a sample, and compared in seconds of CPU, which other programs disturb
less; their smaller sensitivities are lost in the solvers' errors.
Every process runs on one thread of linear algebra.
"""

import os

os.environ["OPENBLAS_NUM_THREADS"] = os.environ["OMP_NUM_THREADS"] = "1"

import argparse
import time

import numpy as np
from scipy.optimize import minimize

import nearsight as ns
from nearsight.perturbation import Runner, Spec, measure, sensitivity

NETWORK, K, R, STEP = "torus:20x20", 9, 4, 1e-4
PARAMETERS = ns.Parameters(1.0, 2.0, 1.0, 0.25)


def timed(function, *arguments, **named):
    """Return the seconds a call takes, and what it returns."""
    start = time.perf_counter()
    found = function(*arguments, **named)
    return time.perf_counter() - start, found


def boundary(drawn):
    """Return the fixed actions that touch a free one."""
    return drawn.window.fixed(drawn.y, drawn.z)


def columns(drawn, count):
    """Return some boundary variables, evenly spread."""
    return np.linspace(0, len(boundary(drawn)) - 1, count).astype(int)


def clarabel(drawn, chosen):
    """Return seconds and derivatives by CVXPY with Clarabel, one solve a boundary variable."""
    import cvxpy as cp

    terms, fixed = drawn.window.terms, boundary(drawn)
    zero = np.zeros((len(terms.free), 1))
    hessian, mixed = (part.toarray() for part in terms.hessian(zero, fixed))
    linear = terms.gradient(zero, 0 * fixed).ravel()
    x, given = cp.Variable(len(hessian)), cp.Parameter(len(fixed))
    root = np.linalg.cholesky(hessian).T
    cost = 0.5 * cp.sum_squares(root @ x) + linear @ x + x @ (mixed @ given)
    problem = cp.Problem(cp.Minimize(cost))

    def solved(values):
        given.value = values.ravel()
        problem.solve(solver=cp.CLARABEL, warm_start=True)
        return x.value[:, None].copy()

    return differences(solved, fixed, chosen)


def lbfgs(drawn, chosen):
    """Return the same by L-BFGS-B."""
    terms, fixed = drawn.window.terms, boundary(drawn)
    before = drawn.window.solved(drawn.y, drawn.z).x

    def solved(values):
        def gradient(x):
            return terms.gradient(x.reshape(before.shape), values).ravel()

        def cost(x):
            return terms.value(x.reshape(before.shape), values)

        options = {"ftol": 1e-15, "gtol": 1e-9, "maxiter": 1000}
        found = minimize(cost, before.ravel(), jac=gradient, method="L-BFGS-B", options=options)
        return found.x.reshape(before.shape)

    return differences(solved, fixed, chosen)


def differences(solved, fixed, chosen):
    """Return the seconds a solve, and derivatives in the chosen boundary variables."""
    before, found = solved(fixed), []  # the first solve also compiles
    start = time.process_time()
    for column in chosen:
        moved = fixed.copy()
        moved[column] += STEP
        found.append((solved(moved) - before)[:, 0] / STEP)
    return (time.process_time() - start) / len(chosen), np.stack(found, axis=1)


def other(method, spec, sample, chosen):
    """Return the seconds an instance of the others, and the largest error of a sensitivity."""
    seconds, error = [], 0.0
    for i in range(sample):
        drawn = spec.draw(i)
        some = columns(drawn, chosen)
        each, found = method(drawn, some)
        seconds.append(each * (1 + len(boundary(drawn))))
        true = sensitivity(drawn.window, drawn.y, drawn.z).derivative[:, 0, :, 0][:, some]
        error = max(error, float(np.abs(found - true).max()))
    return float(np.mean(seconds)), error


def main():
    """Run."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--instances", type=int, default=1000)
    parser.add_argument("--sample", type=int, default=6, help="instances of the others")
    parser.add_argument("--columns", type=int, default=20, help="boundary variables of each")
    options = parser.parse_args()
    spec = Spec(ns.parse_graph(NETWORK), PARAMETERS, K, R)
    drawn, count = spec.draw(0), options.instances
    free, fixed = len(drawn.window.terms.free), len(boundary(drawn))
    print(f"{NETWORK}, k = {K}, r = {R}: {free} variables, {fixed} boundary variables")
    print(f"{count} instances; one thread of linear algebra a process")
    measure(spec, 1)  # imports and caches are not counted
    before = time.process_time()
    seconds, found = timed(measure, spec, count)
    mine = time.process_time() - before
    print(f"1 worker: {seconds:.1f} s ({mine:.1f} s of CPU)", flush=True)
    seconds, again = timed(measure, spec, count, runner=Runner(2))
    print(f"2 workers: {seconds:.1f} s", flush=True)
    if again.profiles != found.profiles:
        raise SystemExit("two workers give other numbers")
    guaranteed = {tier for tier, _ in found.violations} & {"repaired", "sharp", "tight"}
    if guaranteed:  # a fast wrong answer is none
        raise SystemExit(f"violated: {guaranteed}")
    quadratic = Spec(spec.network, PARAMETERS, K, R, ("attraction", "repulsion", "blocks"))
    for name, method, which in (
        ("CVXPY + Clarabel", clarabel, quadratic),
        ("SciPy L-BFGS-B", lbfgs, spec),
    ):
        each, error = other(method, which, options.sample, options.columns)
        theirs = each * count
        print(f"{name}: {theirs:.0f} s of CPU (extrapolated), errors up to {error:.0e}")
        print(f"  {theirs / mine:.0f} times faster with one worker")


if __name__ == "__main__":
    main()
