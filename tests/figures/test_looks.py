"""Colours that everybody tells apart, and that differ in grey or in line and mark."""

from itertools import combinations

import numpy as np
import pytest
from matplotlib.colors import to_rgb

from nearsight.figures.looks import LOOKS, TIERS, VERDICTS

# How the colours look with a cone type missing (Machado, Oliveira, Fernandes 2009, severity 1).
VISION = {
    "normal": np.eye(3),
    "protan": np.array(
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ]
    ),
    "deutan": np.array(
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ]
    ),
    "tritan": np.array(
        [
            [1.255528, -0.076749, -0.178779],
            [-0.078411, 0.930809, 0.147602],
            [0.004733, 0.691367, 0.303900],
        ]
    ),
}
JUST = 10  # CIE 1976 colour differences: 2.3 are just noticeable


def linear(colour):
    c = np.array(to_rgb(colour))
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)


def lab(rgb):
    to_xyz = np.array(
        [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    )
    t = to_xyz @ np.clip(rgb, 0, 1) / np.array([0.95047, 1.0, 1.08883])
    f = np.where(t > 0.008856, np.cbrt(t), 7.787 * t + 16 / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


@pytest.mark.parametrize("eye", VISION)
@pytest.mark.parametrize("group", ["looks", "verdicts"])
def test_colours_are_told_apart(group, eye):
    found = {name: look.colour for name, look in LOOKS.items()} if group == "looks" else VERDICTS
    seen = {name: lab(VISION[eye] @ linear(colour)) for name, colour in found.items()}
    for one, two in combinations(seen, 2):
        assert np.linalg.norm(seen[one] - seen[two]) > JUST, (one, two)


def test_lines_and_marks_are_told_apart_in_grey():
    for one, two in combinations(LOOKS.values(), 2):
        assert (one.line, one.mark) != (two.line, two.mark)
        assert one.mark != two.mark
    assert {LOOKS[tier].label for tier in TIERS} == set(TIERS)
