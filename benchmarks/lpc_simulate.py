"""LPC against one call of a general solver per agent and step, in one run.

    python benchmarks/lpc_simulate.py            # the two comparisons, the growth with N
    python benchmarks/lpc_simulate.py --large    # and 10^5 agents, the optimum of 10^6 unknowns

On a torus of 100 x 100 agents, H = 50, k = 5, r = 3:

* unconstrained, against CVXPY with Clarabel, its problem compiled once with parameters (DPP) and
  solved again and again; extrapolated from a sample of agents;
* with boxes, against OSQP, set up once (all interior agents have the same Hessian) and updated
  with each linear term; extrapolated from the same sample.

Both sides run on one thread of linear algebra; the second figure of each comparison lets two
threads share the agents.
"""

import os

os.environ["OPENBLAS_NUM_THREADS"] = os.environ["OMP_NUM_THREADS"] = "1"

import argparse
import resource
import time

import numpy as np

import nearsight as ns
from nearsight.lpc import Controller, optimum
from nearsight.lpc.local import LocalProblem

MU, L_F, L_T, L_S, K, R = 1.0, 1.0, 1.0, 0.25, 5, 3


def timed(function, *arguments):
    """Return the seconds a call takes, and what it returns."""
    start = time.perf_counter()
    found = function(*arguments)
    return time.perf_counter() - start, found


def drawn(graph, horizon, box=None):
    """Return the uniform instance of one network."""
    return ns.random_problem(
        graph=graph, mu=MU, l_f=L_F, l_T=L_T, l_S=L_S, horizon=horizon, box=box, seed=1
    )


def play(problem, workers):
    """Return the seconds of all steps, those of a middle step, and the controller."""
    controller = Controller(problem, K, R, workers=workers)
    before, steps = problem.x_0, []
    start = time.perf_counter()
    for t in range(1, problem.H + 1):
        seconds, before = timed(controller.step, t, before)
        steps.append(seconds)
    return time.perf_counter() - start, float(np.median(steps)), controller


def sample(problem, count):
    """Return Hessians and linear terms of local problems at random agents and inner steps."""
    rng, found = np.random.default_rng(0), []
    for _ in range(count):
        t, v = int(rng.integers(2, problem.H - K)), int(rng.integers(problem.N))
        local = LocalProblem(problem, t, v, K, R)
        terms = local.terms
        fixed = rng.normal(size=(len(terms.fixed), 1))
        zero = np.zeros((len(terms.free), 1))
        found.append((terms.hessian(zero, fixed)[0], terms.gradient(zero, fixed).ravel()))
    return found


def clarabel(programs):
    """Return the seconds a program of CVXPY with Clarabel, compiled once with a parameter."""
    import cvxpy as cp

    matrix = programs[0][0].toarray()
    x, q = cp.Variable(len(matrix)), cp.Parameter(len(matrix))
    root = np.linalg.cholesky(matrix).T
    problem = cp.Problem(cp.Minimize(0.5 * cp.sum_squares(root @ x) + q @ x))
    q.value = programs[0][1]
    problem.solve(solver=cp.CLARABEL, warm_start=True)
    start = time.perf_counter()
    for _, linear in programs:
        q.value = linear
        problem.solve(solver=cp.CLARABEL, warm_start=True)
    return (time.perf_counter() - start) / len(programs)


def osqp(programs, bound, accuracy):
    """Return the seconds a program of OSQP, set up once and warm-started."""
    import osqp as library
    from scipy import sparse

    matrix = programs[0][0]
    size = matrix.shape[0]
    limit = np.full(size, bound)
    solver = library.OSQP()
    solver.setup(
        sparse.csc_matrix(sparse.triu(matrix)),
        np.zeros(size),
        sparse.csc_matrix(sparse.eye(size)),
        -limit,
        limit,
        verbose=False,
        eps_abs=accuracy,
        eps_rel=accuracy,
        polishing=False,
    )
    start = time.perf_counter()
    for _, linear in programs:
        solver.update(q=linear)
        solver.solve()
    return (time.perf_counter() - start) / len(programs)


def compare(count):
    """Print the two comparisons."""
    free, boxed = drawn("torus:100x100", 50), drawn("torus:100x100", 50, (-0.5, 0.5))
    solves = free.N * free.H
    programs = sample(free, count)
    theirs = clarabel(programs[: max(10, count // 5)]) * solves
    seconds, step, controller = play(free, 1)
    matrix = controller._engine.matrix(1)
    data = np.ones(matrix.shape[1])
    product = min(timed(matrix.__matmul__, data)[0] for _ in range(20))
    print(f"torus 100 x 100, H = 50, k = {K}, r = {R}; {solves} local problems")
    print(f"unconstrained: {seconds:.2f} s; CVXPY + Clarabel {theirs:.0f} s (extrapolated)")
    print(f"  {theirs / seconds:.0f} times faster; two threads {theirs / play(free, 2)[0]:.0f}")
    print(f"  a step {1e3 * step:.2f} ms, {step / product:.2f} products with the policy matrix")
    for accuracy in (1e-6, 1e-9):
        other = osqp(programs, 0.5, accuracy) * solves
        one, two = play(boxed, 1)[0], play(boxed, 2)[0]
        print(f"boxes: {one:.2f} s, two threads {two:.2f} s; OSQP at {accuracy:g} {other:.0f} s")
        print(f"  {other / one:.1f} times faster; two threads {other / two:.1f}")


def growth(sides):
    """Print seconds and memory of tori, and the exponent of the growth with N."""
    found = []
    for side in sides:
        problem = drawn(f"torus:{side}x{side}", 20)
        seconds = min(play(problem, 2)[0] for _ in range(2))
        memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
        found.append((problem.N, seconds))
        print(f"N = {problem.N}: {seconds:.2f} s for 20 steps; at most {memory:.2f} GiB so far")
    n, s = np.log(np.array(found)).T
    print(f"  time grows as N^{np.polyfit(n, s, 1)[0]:.2f}")


def offline():
    """Print what the optimum of 10^6 unknowns takes."""
    for box in (None, (-0.5, 0.5)):
        problem = drawn("torus:100x100", 100, box)
        seconds, best = timed(optimum, problem)
        kind = "boxes" if box else "unconstrained"
        print(f"optimum of 10^6 unknowns, {kind}: {seconds:.1f} s ({best.method}), ", end="")
        print(f"relative gap {best.gap / best.cost:.1e}")


def main():
    """Run."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--large", action="store_true", help="10^5 agents and 10^6 unknowns, too")
    parser.add_argument("--sample", type=int, default=500, help="local problems of the others")
    options = parser.parse_args()
    compare(options.sample)
    growth((32, 100, 316) if options.large else (32, 100))
    if options.large:
        offline()


if __name__ == "__main__":
    main()
