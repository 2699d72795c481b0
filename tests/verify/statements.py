"""Statements tried at random in extended precision: what the tests of them share."""

import random

from mpmath import mp, mpf, sqrt


def g(y):
    return y / (sqrt(1 + y) + 1) ** 2


def wide(r, low=-8, high=8):
    """Return a number between two powers of ten."""
    return mpf(10) ** r.uniform(low, high)


def share(r, low=0, high=1):
    return mpf(r.uniform(low, high))


def marker(tried):
    """Return a decorator that files a function under the keys of claims."""

    def of(*keys):
        def mark(function):
            tried.update(dict.fromkeys(keys, function))
            return function

        return mark

    return of


def least(key, function, draws=30):
    """Return the least slack of some draws."""
    r = random.Random(key)
    with mp.workdps(60):
        return min(function(r) for _ in range(draws))
