"""What a picture is of: a network, constants of the costs, a horizon and a radius."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any

import numpy as np

from ..bounds import Parameters, Setting
from ..graphs import InputError, Network, network_growth, parse_graph

LEAST = {"horizon": 1, "k": 2, "r": 1, "t": 1, "instances": 1, "seed": 0}


@dataclass(frozen=True)
class Subject:
    """What a picture is of; a picture uses the fields that it says it takes.

    Parameters
    ----------
    graph : Network or str
        A network, a file or a family.
    mu, l_f, l_T, l_S : float
        Constants of the costs, see `nearsight.Parameters`.
    horizon : int
        Number of steps H.
    k, r : int
        Prediction horizon ``>= 2`` and communication radius ``>= 1``; for a picture over a range
        of them, the largest.
    t : int
        A step, from 1 to H.
    agent : str
        Name of an agent; empty for the one of largest degree, the first of these.
    target : tuple of float
        Competitive ratios, each above 1.
    instances : int
        Number of random instances.
    seed : int
        Of all that is random.

    Raises
    ------
    InputError
        If a value is out of its range.
    """

    graph: Network | str = "ring:13"
    mu: float = 1.0
    l_f: float = 1.0
    l_T: float = 1.0
    l_S: float = 0.5
    horizon: int = 12
    k: int = 3
    r: int = 2
    t: int = 1
    agent: str = ""
    target: tuple[float, ...] = (1.1, 1.01, 1.001)
    instances: int = 40
    seed: int = 0

    def __post_init__(self) -> None:
        for name, least in LEAST.items():
            value = getattr(self, name)
            if isinstance(value, bool) or int(value) != value or value < least:
                raise InputError(f"{name} = {value}: an integer >= {least} is needed", name)
        if not self.target or not all(np.isfinite(cr) and cr > 1 for cr in self.target):
            raise InputError(f"target = {self.target}: finite ratios > 1 are needed", "target")
        for name in ("mu", "l_f", "l_T", "l_S"):
            object.__setattr__(self, name, float(getattr(self, name)))
        Parameters(self.mu, self.l_f, self.l_T, self.l_S)

    @cached_property
    def network(self) -> Network:
        """The network itself."""
        return parse_graph(self.graph, self.seed) if isinstance(self.graph, str) else self.graph

    @property
    def parameters(self) -> Parameters:
        """The constants of the costs."""
        return Parameters(self.mu, self.l_f, self.l_T, self.l_S)

    @cached_property
    def setting(self) -> Setting:
        """What theorems are asked about: the constants and the growth of the network."""
        return Setting(self.parameters, network_growth(self.network))

    @property
    def centre(self) -> int:
        """The number of the agent.

        Raises
        ------
        InputError
            If no agent of the network has this name.
        """
        if not self.agent:
            return int(self.network.degrees.argmax())
        if self.agent not in self.network.names:
            some = ", ".join(self.network.names[:5])
            raise InputError(f"agent = {self.agent!r}: not in the network ({some}, ...)", "agent")
        return self.network.names.index(self.agent)

    def with_typed(self, typed: dict[str, Any], takes: tuple[str, ...]) -> Subject:
        """Return the subject with those of the values typed that a picture takes."""
        return replace(self, **{name: typed[name] for name in takes if name in typed})

    def written(self, takes: tuple[str, ...]) -> dict[str, str]:
        """Return the fields that a picture takes as text, and a digest of the network."""
        found = {}
        for name in (field.name for field in fields(self) if field.name in takes):
            value = getattr(self, name)
            if name == "graph":
                network = self.network
                pairs = json.dumps([network.indptr.tolist(), network.indices.tolist()])
                digest = hashlib.sha256(pairs.encode()).hexdigest()[:16]
                value = f"{network.source}, {network.vertices} agents, sha256 {digest}"
            found[name] = " ".join(map(repr, value)) if isinstance(value, tuple) else str(value)
        return found
