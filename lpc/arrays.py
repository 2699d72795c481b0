"""Arrays over steps and agents (or edges) that may be constant in either."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..graphs import InputError

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def family(value: ArrayLike, trailing: int, name: str, *, infinite: bool = False) -> Floats:
    """Return an array of shape ``(T, I, ...)`` from one that leaves out leading axes.

    Parameters
    ----------
    value : array_like
        With `trailing` axes: the same at all steps, for all agents; with one more: an agent (or
        edge) each; with two more: a step and an agent each. An axis of length 1 is constant.
    trailing : int
        The number of axes of one value: 0 for numbers, 1 for vectors, 2 for matrices.
    name : str
        What the array is, for messages.
    infinite : bool
        Whether infinities are accepted; NaN never is.

    Returns
    -------
    ndarray, shape (T, I, ...)
        Read-only. ``T`` is 1 or the number of steps, ``I`` is 1 or the number of agents or edges.

    Raises
    ------
    InputError
        If it is not an array of numbers, has too few or too many axes, or a value is not finite.
    """
    try:
        array = np.array(value, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name}: an array of numbers is needed ({error})") from error
    if not trailing <= array.ndim <= trailing + 2:
        raise InputError(
            f"{name}: shape {array.shape}; {trailing} axes are needed for one value, and at most "
            "two before them, for steps and agents (or edges)"
        )
    array = array.reshape((1,) * (trailing + 2 - array.ndim) + array.shape)
    bad = np.isnan(array) if infinite else ~np.isfinite(array)
    if bad.any():
        at = tuple(int(j) for j in np.argwhere(bad)[0])
        what = "a number" if infinite else "a finite number"
        raise InputError(f"{name}: {array[at]} at {_place(array.shape, at)}; {what} is needed")
    array.setflags(write=False)
    return array


def integer(value: object, name: str, least: int, most: int | None = None) -> int:
    """Return a whole number within bounds as an int.

    Raises
    ------
    InputError
        If it is of another type (a float, a truth value), or out of bounds.
    """
    wanted = f"an integer >= {least}" if most is None else f"an integer from {least} to {most}"
    if isinstance(value, bool | np.bool_) or not isinstance(value, int | np.integer):
        raise InputError(f"{name} = {value!r}: {wanted} is needed", name)
    if value < least or (most is not None and value > most):
        raise InputError(f"{name} = {value}: {wanted} is needed", name)
    return int(value)


def fits(array: Floats, H: int, count: int, name: str) -> None:
    """Raise `InputError` unless the leading axes are (1 or H, 1 or count)."""
    T, members = array.shape[:2]
    if T not in (1, H) or members not in (1, count):
        raise InputError(
            f"{name}: shape {array.shape}; the first axis is 1 or H = {H} (steps), the second 1 "
            f"or {count} (agents or edges)"
        )


def at(array: Floats, t: Ints, i: Ints) -> Floats:
    """Return the values of steps ``t = 1, 2, ...`` and agents or edges i, shape (m, ...)."""
    T, members = array.shape[:2]
    picked: Floats = array[t - 1 if T > 1 else 0, i if members != 1 else 0]
    if T == members == 1:
        return np.broadcast_to(picked, (*np.shape(t), *picked.shape))
    return picked


def spread(array: Floats, H: int, count: int) -> Floats:
    """Return the array with all steps and members written out, shape (H, count, ...)."""
    return np.broadcast_to(array, (H, count, *array.shape[2:]))


def _place(shape: tuple[int, ...], index: tuple[int, ...]) -> str:
    """Say where an entry is, as a user counts: steps from 1, agents and edges from 0."""
    words: list[Any] = []
    if shape[0] > 1:
        words.append(f"step {index[0] + 1}")
    if shape[1] > 1:
        words.append(f"agent or edge {index[1]}")
    if index[2:]:
        words.append(f"entry {list(index[2:])}")
    return ", ".join(words) or "its only entry"
