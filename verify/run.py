"""Judge claims: in parallel, resumable, and against the recorded verdicts."""

from __future__ import annotations

import json
import time
from bisect import bisect_left
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict
from difflib import get_close_matches
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import networkx as nx

from ..graphs import InputError
from ..perturbation import Runner
from .catalogue import catalogue
from .claim import Claim
from .evidence import Evidence, Level, Verdict
from .journal import Journal
from .mutation import mutate
from .recorded import changes, recorded
from .results import Mutation, Report

Progress = Callable[[int, int], None]
_EXTRA = {"z3": "z3-solver", "flint": "python-flint"}


def run(
    labels: Sequence[str] = (),
    level: Level = "quick",
    *,
    claims: Sequence[Claim] | None = None,
    mutation: bool = False,
    runner: Runner | None = None,
    checkpoint: Path | None = None,
    progress: Progress | None = None,
) -> Report:
    """Judge claims and compare with the recorded verdicts.

    Parameters
    ----------
    labels : sequence of str
        Labels, or keys (``label[part]``); none for all claims.
    level : {"quick", "full"}
    claims : sequence of Claim, optional
        The claims there are; the catalogue if omitted.
    mutation : bool
        Also run all mutants.
    runner : Runner, optional
    checkpoint : Path, optional
        A file that keeps what is done; a later run with the same code goes on after it.
    progress : callable, optional
        Called as ``progress(done, total)``.

    Raises
    ------
    InputError
        If there is no such level or label; the message lists near ones.
    """
    if level not in ("quick", "full"):
        raise InputError(f"level = {level!r}: quick or full", "level")
    there = catalogue() if claims is None else tuple(claims)
    chosen = choose(there, labels)
    tasks = [("verdict", level, claim) for claim in chosen]
    tasks += [("mutation", "quick", claim) for claim in chosen if mutation]
    with Journal(checkpoint) as journal:
        done = _all_done(tasks, claims is None, runner or Runner(), journal, progress)
    found, seconds, errors = {}, {}, {}
    for claim in chosen:
        result = done["verdict", level, claim.key]
        seconds[claim.key] = result["seconds"]
        if "error" in result:
            errors[claim.key] = result["error"]
        else:
            found[claim.key] = Evidence(**result["evidence"])
    mutations = [
        Mutation(**one)
        for claim in chosen
        if mutation
        for one in done["mutation", "quick", claim.key]
    ]
    verdicts = judge(there, found)
    return Report(
        level,
        chosen,
        verdicts,
        seconds,
        errors,
        changes(verdicts, [claim.key for claim in chosen], everything=not labels),
        tuple(mutations) if mutation else None,
    )


def choose(claims: Sequence[Claim], labels: Sequence[str]) -> tuple[Claim, ...]:
    """Return the claims with one of the labels or keys, or all; in their own order."""
    names = sorted({claim.label for claim in claims} | {claim.key for claim in claims})
    for label in labels:
        if label not in names:
            near = get_close_matches(label, names, 5, 0.5) or [n for n in names if label in n][:5]
            hint = "near it" if near else "next to it in the alphabet"
            near = near or _neighbours(label, {claim.label for claim in claims})
            raise InputError(f"LABEL: no claim {label!r}; {hint}: {', '.join(near)}")
    return tuple(c for c in claims if not labels or c.label in labels or c.key in labels)


def _neighbours(label: str, labels: Iterable[str], count: int = 5) -> list[str]:
    """Return the labels that would stand around this one in the alphabet."""
    ordered = sorted(labels, key=str.casefold)
    place = bisect_left(ordered, label.casefold(), key=str.casefold)
    first = max(0, min(place - count // 2, len(ordered) - count))
    return ordered[first : first + count]


def uses(claims: Iterable[Claim]) -> nx.DiGraph[str]:
    """Return the graph with an edge from each claim to every claim that its proof uses."""
    graph: nx.DiGraph[str] = nx.DiGraph()
    for claim in claims:
        graph.add_node(claim.key)
        graph.add_edges_from((claim.key, key) for key in claim.uses)
    return graph


def judge(claims: Sequence[Claim], found: dict[str, Evidence]) -> tuple[Verdict, ...]:
    """Return the verdicts on claims with evidence, and the refuted claims that they rest on.

    A claim without evidence here, as in a run of a few claims, is taken as recorded.
    """
    words = {**recorded(), **{key: evidence.verdict for key, evidence in found.items()}}
    refuted = {key for key, word in words.items() if word == "refuted"}
    graph = uses(claims)
    return tuple(
        Verdict(
            claim.label,
            claim.part,
            found[claim.key].verdict,
            tuple(sorted(nx.descendants(graph, claim.key) & refuted)),
            found[claim.key],
        )
        for claim in claims
        if claim.key in found
    )


def _all_done(
    tasks: list[tuple[str, Level, Claim]],
    by_key: bool,
    runner: Runner,
    journal: Journal,
    progress: Progress | None,
) -> dict[tuple[str, ...], Any]:
    """Return the result of every task, from the journal or computed."""
    names: list[tuple[str, ...]] = [(kind, level, claim.key) for kind, level, claim in tasks]
    done = {name: known for name in names if (known := journal.get(name)) is not None}
    units: dict[int, Any] = {
        # a process of its own finds the claim by its key: its functions need not be sent
        i: partial(_compute, kind, level, claim.key if by_key else claim)
        for i, (kind, level, claim) in enumerate(tasks)
        if names[i] not in done
    }
    if progress:
        progress(len(done), len(tasks))
    for i, result in runner.run(units):
        done[names[i]] = result
        journal.add(names[i], result)
        if progress:
            progress(len(done), len(tasks))
    return done


def _compute(kind: str, level: Level, claim: Claim | str) -> Any:
    """Return one result as a JSON value, so that it does not matter whether it was on disk."""
    if isinstance(claim, str):
        (claim,) = (one for one in catalogue() if one.key == claim)
    start = time.perf_counter()
    result: Any
    try:
        if kind == "mutation":
            result = [asdict(one) for one in mutate(claim)]
        else:
            result = {"evidence": asdict(claim.judge(level))}
    except ImportError as error:
        raise InputError(_missing(error)) from error
    except RuntimeError as error:
        result = {"error": str(error)}
    if kind == "verdict":
        result["seconds"] = round(time.perf_counter() - start, 3)
    return json.loads(json.dumps(result, default=_value))


def _missing(error: ImportError) -> str:
    """Return what to install, all of it at once."""
    name = (error.name or "").partition(".")[0]
    packages = [p for m, p in _EXTRA.items() if name in _EXTRA and (m == name or not find_spec(m))]
    packages = packages or [name or str(error)]
    extra = " (the extra certify)" if name in _EXTRA else ""
    return f"verification needs {' and '.join(packages)}: pip install {' '.join(packages)}{extra}"


def _value(value: Any) -> Any:
    """Return a JSON value for what json does not know: numbers of NumPy, SymPy, flint."""
    return value.tolist() if hasattr(value, "tolist") else str(value)
