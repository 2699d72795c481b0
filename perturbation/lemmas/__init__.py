"""Lemmas on matrices, measured against their bounds: one a file.

A lemma is found by being a file of this folder that does not start with an underscore. It names
its `LABEL` in the paper and its `TITLE`, and has a function ``measure(seed)``.
"""

from ._registry import Lemma, lemmas, measure_lemma

__all__ = ["Lemma", "lemmas", "measure_lemma"]
