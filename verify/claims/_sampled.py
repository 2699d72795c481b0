"""Trials for `Search`: random local problems beside the bounds that are claimed for them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..engines.search import Trial

Draw = Callable[[np.random.Generator], Trial]
NOTHING: Trial = (0.0, 1.0, {})


def seed_of(rng: np.random.Generator) -> int:
    """Return a seed for the generators of `perturbation`."""
    return int(rng.integers(1 << 31))


def lemma(label: str, *parts: str) -> Draw:
    """Return the trial that measures parts of a lemma of `perturbation.lemmas`.

    An instance on which a part has nothing to say counts as one without violation.

    Parameters
    ----------
    label : str
    *parts : str
        Of the comparisons that count.
    """

    def trial(rng: np.random.Generator) -> Trial:
        from ...perturbation.lemmas import lemmas

        seed = seed_of(rng)
        found = [c for c in lemmas()[label].measure(seed) if c.hypotheses and c.part in parts]
        if not found:
            return NOTHING
        worst = max(found, key=lambda c: c.ratio)
        about = {"lemma": label, "part": worst.part, "seed": seed, "instance": worst.instance}
        if worst.relation == "==":
            return abs(worst.measured - worst.bound), worst.tolerance, about
        return worst.measured, worst.bound, about

    return trial


def local(tier: str, *parts: str) -> Draw:
    """Return the trial that compares the sensitivities of a local problem with a tier's bound.

    Parameters
    ----------
    tier : {"repaired", "sharp"}
    *parts : str
        Of the boundary: ``top``, ``bottom``, ``lateral``.
    """

    def repaired(specimen: Any, part: str, dt: Any, ds: Any) -> Any:
        from ...bounds.local_bound import local_repaired

        p = specimen.parameters
        c = local_repaired(p.a_T, p.a_S, specimen.shape.growth.max_degree)
        return (c.C_2 if part == "bottom" else c.C_1) * c.rho_T**dt * c.rho_S**ds

    def sharp(specimen: Any, part: str, dt: Any, ds: Any) -> Any:
        from ...bounds.joint import best_tilt, lateral_bound, top_bound

        p, degree = specimen.parameters, specimen.shape.growth.max_degree
        x = degree * p.a_S
        if part == "lateral":
            tilt = best_tilt(p.a_T, x, dt, ds - 1)
            return lateral_bound(p.a_T, p.a_S, degree, dt, ds, *tilt)
        return top_bound(p.a_T, x, dt, ds, *best_tilt(p.a_T, x, dt - 1, ds))

    return entries({"repaired": repaired, "sharp": sharp}[tier], *parts)


def entries(bound: Callable[[Any, str, Any, Any], Any], *parts: str) -> Draw:
    """Return the trial that compares entries of a local problem's sensitivity with a bound.

    Parameters
    ----------
    bound : callable
        Of a `Specimen`, the part of the boundary, and the distances in time and space.
    *parts : str
        Of the boundary: ``top``, ``bottom``, ``lateral``.
    """

    def trial(rng: np.random.Generator) -> Trial:
        from ...bounds.formula import plain_floats
        from ...perturbation import sensitivity
        from ...perturbation.lemmas._specimen import drawn
        from ...perturbation.sensitivity import PARTS

        seed = seed_of(rng)
        specimen = drawn(seed)
        window, n = specimen.local, specimen.shape.n
        y, z = (rng.normal(size=(len(a), n)) for a in (window.bottom, window.boundary))
        found, agents = sensitivity(window, y, z), specimen.hierarchy
        hops = agents.distance[np.searchsorted(agents.agents, found.free[:, 1])][
            :, found.fixed[:, 1]
        ]
        best: Trial = NOTHING
        for part in parts:
            columns = found.part == PARTS.index(part)
            reach = np.isfinite(hops[:, columns])
            measured = found.norms[:, columns][reach]
            if not measured.size:
                continue
            dt = found.time_gaps[:, columns][reach]
            ds = hops[:, columns][reach].astype(int)
            with plain_floats():
                limit = np.asarray(bound(specimen, part, dt, ds))
            if np.any(measured > limit * (1 - 1e-6)):  # where rounding could matter
                limit = np.asarray(bound(specimen, part, dt, ds))
            ratio = np.where(measured > 0, measured / np.maximum(limit, 1e-300), 0.0)
            i = int(np.argmax(ratio))
            if best is NOTHING or measured[i] * best[1] > best[0] * limit[i]:
                about = {"seed": seed, "part": part, "instance": specimen.text}
                best = (float(measured[i]), float(limit[i]), about)
        return best

    return trial


def pair_hessian(rng: np.random.Generator, n: int, strength: float) -> Any:
    """Return a random symmetric matrix of two n-vectors with eigenvalues in [0, strength].

    Half of them are ``strength`` times a projection: the extreme points.
    """
    Q = np.linalg.qr(rng.standard_normal((2 * n, 2 * n)))[0]
    if rng.random() < 0.5:
        values = (rng.random(2 * n) < 0.5).astype(float)
    else:
        values = rng.random(2 * n) ** rng.choice([0.2, 1.0, 5.0])
    return strength * Q @ np.diag(values) @ Q.T
