"""One call for what ``nearsight figures`` does."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .figures import Drawn


def draw(
    names: str | Sequence[str] = (),
    *,
    out: str | PathLike[str],
    size: str = "paper",
    formats: Sequence[str] = ("pdf", "png", "svg"),
    reuse: bool = False,
    workers: int = 1,
    progress: Callable[[int, int, str], None] | None = None,
    **subject: Any,
) -> tuple[Drawn, ...]:
    """Draw figures, each with the data behind it as CSV.

    Parameters
    ----------
    names : str or sequence of str
        Names, or labels of the paper (``"fig:information"``); all figures if omitted.
    out : path
        The folder that gets ``NAME.csv`` and ``NAME.pdf``, ``.png``, ``.svg``.
    size : {"paper", "slides"}
        Columns and pages of ICML, or 16:9 slides.
    formats : sequence of str
        Which of pdf, png and svg.
    reuse : bool
        Take the data that lie in the folder already, if they are of the same subject.
    workers : int
        Processes; 0 for one a core. More than one need joblib (the extra ``parallel``).
    progress : callable, optional
        Called as ``progress(done, total, text)`` now and then.
    **subject
        What to draw in place of each figure's own choice: ``graph, mu, l_f, l_T, l_S, horizon,
        k, r, t, agent, target, instances, seed, clean``; a figure takes what it says it takes.

    Raises
    ------
    InputError
        If an argument cannot be used, or none of the figures takes it.

    Examples
    --------
    >>> import nearsight as ns
    >>> ns.draw("sandwitch", out="pictures")
    Traceback (most recent call last):
        ...
    nearsight.graphs.errors.InputError: no figure 'sandwitch'; near it: sandwich
    """
    from .api import network
    from .figures import draw_all, picture_named, pictures
    from .graphs import InputError
    from .perturbation import Runner

    wanted = (names,) if isinstance(names, str) else tuple(names)
    chosen = tuple(picture_named(name) for name in dict.fromkeys(wanted)) or pictures()
    typed = {name: value for name, value in subject.items() if value is not None}
    clean = typed.pop("clean", False)
    if clean and "graph" not in typed:
        raise InputError("clean without a graph would have no effect; leave it out", "clean")
    if "graph" in typed:
        typed["graph"] = network(typed["graph"], typed.get("seed", 0), clean)
    for name in typed:
        # a seed also serves the random families of graphs
        if not any(name in p.takes for p in chosen) and not (name == "seed" and "graph" in typed):
            takers = ", ".join(p.name for p in pictures() if name in p.takes)
            of = f"those that take it: {takers}" if takers else "no figure takes it"
            raise InputError(f"{name} would have no effect on this; {of}", name)
    return draw_all(
        chosen,
        Path(out),
        typed,
        size=size,
        formats=formats,
        reuse=reuse,
        runner=Runner(workers),
        progress=progress,
    )
