"""Linear and quadratic forms in the sizes D and y, in any arithmetic."""

from __future__ import annotations

from typing import NamedTuple

from .arithmetic import Number


class Form(NamedTuple):
    """The linear form ``D D + y y`` in the sizes D and y."""

    D: Number
    y: Number

    def plus(self, other: Form) -> Form:
        """Return the sum of two forms."""
        return Form(self.D + other.D, self.y + other.y)

    def times(self, factor: Number) -> Form:
        """Return the form scaled by a number."""
        return Form(factor * self.D, factor * self.y)


class Gap(NamedTuple):
    """The quadratic form ``P_0 D^2 + P_1 D y + P_2 y^2`` that bounds the cost gap over mu."""

    P_0: Number
    P_1: Number
    P_2: Number

    @classmethod
    def product(cls, u: Form, v: Form) -> Gap:
        """Return ``u v``."""
        return cls(u.D * v.D, u.D * v.y + u.y * v.D, u.y * v.y)

    def plus(self, other: Gap, factor: Number = 1) -> Gap:
        """Return ``self + factor other``."""
        return Gap(*(p + factor * q for p, q in zip(self, other, strict=True)))

    def at(self, y: Number) -> Number:
        """Return the value at ``D = 1`` and ``y``."""
        return self.P_0 + y * (self.P_1 + y * self.P_2)
