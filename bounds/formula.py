"""Closed forms on floats: computed wide, rounded once.

The decorator `formula` marks a function written with `bounds.arithmetic`. Called with
plain floats or arrays it computes with `Wide` numbers and rounds the result once, so that
a float result is correct to its last bits even for ``rho**k`` with a large ``k``. Numbers
of any other arithmetic it takes as they are.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, TypeVar

import numpy as np

from .arithmetic import kind_of
from .wide import Wide

_F = TypeVar("_F", bound=Callable[..., Any])
_lifting: ContextVar[bool] = ContextVar("nearsight_lifting", default=True)


def rounded(value: Any) -> Any:
    """Replace every `Wide` number in a value, tuple or mapping by its float."""
    if isinstance(value, Wide):
        return value.to_float()
    if isinstance(value, Mapping):
        return {key: rounded(item) for key, item in value.items()}
    if isinstance(value, tuple):
        items = [rounded(item) for item in value]
        return type(value)(*items) if hasattr(value, "_fields") else tuple(items)
    return value


def rounded_once(function: Callable[..., Any], *args: Any) -> Any:
    """Call a function on `Wide` numbers as they are, and round what it returns."""
    token = _lifting.set(False)
    try:
        return rounded(function(*args))
    finally:
        _lifting.reset(token)


@contextmanager
def plain_floats() -> Iterator[None]:
    """Compute formulas on floats in plain float arithmetic: fast, for searching only."""
    token = _lifting.set(False)
    try:
        with np.errstate(all="ignore"):
            yield
    finally:
        _lifting.reset(token)


def formula(*, counts: tuple[str, ...] = ()) -> Callable[[_F], _F]:
    """Mark a closed form that serves all arithmetics.

    Parameters
    ----------
    counts : tuple of str
        Names of the parameters that are integers (distances, numbers of terms); all
        others are numbers and are lifted to `Wide` when they come as floats.
    """

    def mark(function: _F) -> _F:
        signature = inspect.signature(function)

        @functools.wraps(function)
        def call(*args: Any, **kwargs: Any) -> Any:
            if not _lifting.get():
                return function(*args, **kwargs)
            bound = signature.bind(*args, **kwargs)
            numbers = [name for name in bound.arguments if name not in counts]
            if kind_of(*(bound.arguments[name] for name in numbers)) != "float":
                return function(*args, **kwargs)
            for name in numbers:
                bound.arguments[name] = Wide(bound.arguments[name])
            return rounded_once(lambda: function(*bound.args, **bound.kwargs))

        return call  # type: ignore[return-value]  # wraps keeps the signature of _F

    return mark
