"""``nearsight simulate``: run LPC on an instance, beside the clairvoyant optimum."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .options import FINITE, JSON, input_errors, options, strengths
from .output import Progress, print_json

if TYPE_CHECKING:
    from ..lpc import Problem, Simulation
    from ..lpc.promise import Promise

_INSTANCE = [
    click.option("--horizon", type=int, help="Number of steps H."),
    click.option("--box", metavar="LO,HI", help="Every action lies between two numbers."),
    click.option(
        "--style",
        default="attraction",
        show_default=True,
        help="Costs: attraction repulsion blocks tilted logcosh softplus.",
    ),
    click.option(
        "--targets",
        default="normal",
        show_default=True,
        help="Targets: normal walk alternating last far wave.",
    ),
    click.option(
        "--dimension", "n", type=int, default=1, show_default=True, help="Entries of one action."
    ),
    click.option(
        "--varying", is_flag=True, help="Couplings differ from step to step and edge to edge."
    ),
]

_FILES = [
    click.option(
        "--problem", type=click.Path(path_type=Path), help="A problem file, in place of all above."
    ),
    click.option("--save", type=click.Path(path_type=Path), help="Write the problem to a file."),
    click.option(
        "--actions",
        type=click.Path(path_type=Path),
        help="Write both trajectories (.npz).",
    ),
    click.option(
        "--checkpoint",
        type=click.Path(path_type=Path),
        help="Keep completed steps in a file, and go on after those it holds.",
    ),
]

_RUN = [
    click.option("-k", type=int, required=True, help="Prediction horizon, >= 1."),
    click.option("-r", type=int, required=True, help="Communication radius, >= 0."),
    click.option(
        "--method",
        default="auto",
        show_default=True,
        help="Local solver: policy splitting direct descent barrier osqp casadi.",
    ),
    click.option(
        "--tolerance", type=float, default=1e-9, show_default=True, help="Error of local solutions."
    ),
    click.option(
        "--workers", type=int, default=1, show_default=True, help="Threads; 0 for one a core."
    ),
]


@click.command("simulate", short_help="Run LPC on an instance, beside the optimum.")
@options(FINITE, strengths(required=False), _INSTANCE, _FILES, _RUN, JSON)
def COMMAND(
    k: int,
    r: int,
    method: str,
    tolerance: float,
    workers: int,
    checkpoint: Path | None,
    save: Path | None,
    actions: Path | None,
    as_json: bool,
    **given: Any,
) -> None:
    """Run Localized Predictive Control and compare it with knowing everything.

    The instance is random with exactly the constants given, or read from a file. The
    ratio is certified: it lies in the interval shown, whatever the solvers did. Beside it
    stands what the theory promises at the instance's own constants.
    """
    progress = Progress()
    with input_errors():
        from ..lpc.promise import promise
        from ..simulating import simulate

        problem = _problem(**given)
        if save is not None:
            from ..lpc import save_problem

            save_problem(problem, save)
        run = simulate(
            problem,
            k=k,
            r=r,
            method=method,
            workers=workers,
            tolerance=tolerance,
            checkpoint=checkpoint,
            progress=progress.step,
        )
        progress("measuring the constants")
        promised = promise(problem, k, r)
        if actions is not None:
            _write(actions, run)
        progress.close()
    if as_json:
        print_json(document(run, promised))
        return
    from .simulation_tables import print_simulation

    print_simulation(run, promised)


def _problem(problem: Path | None, box: str | None, horizon: int | None, **given: Any) -> Problem:
    """Read the problem, or draw it."""
    context = click.get_current_context()
    typed = {
        name
        for name in ("graph", "mu", "l_f", "l_T", "l_S", "horizon", "box", "style", "targets", "n")
        if context.get_parameter_source(name) is click.core.ParameterSource.COMMANDLINE
    }
    if problem is not None:
        if typed:
            raise click.UsageError(
                f"--problem: the file says what {', '.join(sorted(typed))} would; leave it out"
            )
        from ..lpc import load_problem

        return load_problem(problem).problem
    needed = {"graph": "--graph", "mu": "--mu", "l_f": "--l-f", "l_T": "--l-t", "l_S": "--l-s"}
    missing = [option for name, option in needed.items() if given[name] is None]
    missing += ["--horizon"] * (horizon is None)
    if missing:
        raise click.UsageError(f"{', '.join(missing)} needed (or --problem FILE)")
    from ..simulating import random_problem

    return random_problem(horizon=horizon, box=_pair(box), **given)


def _pair(text: str | None) -> tuple[float, float] | None:
    if text is None:
        return None
    try:
        low, high = (float(part) for part in text.split(","))
    except ValueError as error:
        raise click.UsageError(f"--box: {text!r}: two numbers, such as -1,1, are needed") from error
    return low, high


def _write(path: Path, run: Simulation) -> None:
    import numpy as np

    from ..graphs import InputError

    try:
        with path.open("wb") as file:
            np.savez_compressed(file, lpc=run.x, optimum=run.optimum.x, x_0=run.problem.x_0)
    except OSError as error:
        raise InputError(f"--actions {path}: {error.strerror or error}") from error


def document(run: Simulation, promised: Promise) -> dict[str, Any]:
    """Return the JSON of `simulate`."""
    lower, upper = run.interval
    p, best = promised.constants, run.optimum
    found: dict[str, Any] = {
        "k": run.k,
        "r": run.r,
        "horizon": run.problem.H,
        "dimension": run.problem.n,
        "cost": run.cost,
        "optimal_cost": best.cost,
        "ratio": run.ratio,
        "ratio_minus_one": run.ratio_minus_one,
        "costs": {name: float(part.sum()) for name, part in run.costs.items()},
        "optimal_costs": {n: float(part.sum()) for n, part in run.problem.costs(best.x).items()},
        "certificate": {
            "ratio_minus_one": [lower, upper],
            "optimum_gap": best.gap,
            "optimum_error": best.error,
            "optimum_method": best.method,
            "action_error": run.action_error,
            "violation": run.violation,
        },
        "parameters": {n: getattr(p, n).value for n in ("mu", "l_f", "l_T", "l_S")},
        "parameters_source": {n: getattr(p, n).source for n in ("mu", "l_f", "l_T", "l_S")},
        "promised_cr_minus_one": promised.cr_minus_one,
        "method": run.method,
        "seconds": run.seconds,
    }
    if best.cost == 0 and run.cost > 0:
        found["ratio_reason"] = "the optimum costs nothing, LPC does: the ratio is unbounded"
    if promised.reason:
        found["promised_reason"] = promised.reason
    return found
