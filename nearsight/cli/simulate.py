"""``nearsight simulate``: run LPC on an instance, beside the clairvoyant optimum."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .options import FINITE, JSON, box_of, input_errors, option_of, options, strengths
from .output import Progress, print_json
from .paths import writable

if TYPE_CHECKING:
    from ..lpc import Problem, Simulation

_FILE = click.Path(dir_okay=False, path_type=Path)

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
    click.option("--problem", type=_FILE, help="A problem file, in place of all above."),
    click.option("--save", type=_FILE, help="Write the problem to a file."),
    click.option("--actions", type=_FILE, help="Write both trajectories (.npz)."),
    click.option(
        "--checkpoint",
        type=_FILE,
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

            with _naming("--save"):
                save_problem(problem, save)
        writable("--actions", actions)  # rather than find out after hours
        progress("measuring the constants")
        promised = promise(problem, k, r)  # it refutes false claims, so before the long part
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
        if actions is not None:
            _write(actions, run)
        progress.close()
    from .simulation_tables import document, print_simulation

    if as_json:
        print_json(document(run, promised))
    else:
        print_simulation(run, promised)


def _problem(problem: Path | None, box: str | None, horizon: int | None, **given: Any) -> Problem:
    """Read the problem, or draw it."""
    context = click.get_current_context()
    typed = [
        option_of(name)
        for name in ("horizon", "box", *given)
        if context.get_parameter_source(name) is click.core.ParameterSource.COMMANDLINE
    ]
    if problem is not None:
        if typed:
            raise click.UsageError(
                f"--problem {problem}: the file says what {', '.join(typed)} would; leave it out"
            )
        from ..lpc import load_problem

        with _naming("--problem"):
            return load_problem(problem).problem
    needed = {"graph": "--graph", "mu": "--mu", "l_f": "--l-f", "l_T": "--l-t", "l_S": "--l-s"}
    missing = [option for name, option in needed.items() if given[name] is None]
    missing += ["--horizon"] * (horizon is None)
    if missing or horizon is None:
        raise click.UsageError(f"{', '.join(missing)} needed (or --problem FILE)")
    from ..simulating import random_problem

    return random_problem(horizon=horizon, box=box_of(box), **given)


@contextmanager
def _naming(option: str) -> Iterator[None]:
    """Put the option before what is wrong with its file."""
    from ..graphs import InputError

    try:
        yield
    except InputError as error:
        raise InputError(f"{option} {error}") from error


def _write(path: Path, run: Simulation) -> None:
    import numpy as np

    from ..graphs import InputError

    try:
        with path.open("wb") as file:
            np.savez_compressed(file, lpc=run.x, optimum=run.optimum.x, x_0=run.problem.x_0)
    except OSError as error:
        raise InputError(f"--actions {path}: {error.strerror or error}") from error
