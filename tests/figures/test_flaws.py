"""Flaws are found where they are, and only there."""

import pytest

from nearsight.figures import SIZES, flaws


def panel(span="column"):
    figure = SIZES["paper"].figure(span, 1.0)
    return figure, figure.subplots()


def test_a_plain_plot_has_none():
    figure, axes = panel()
    axes.plot([1, 2, 3], [1, 4, 9], label="squares")
    axes.set_xlabel("number")
    axes.legend()
    assert flaws(figure) == ()


def test_two_texts_on_one_spot_overlap():
    figure, axes = panel()
    axes.text(0.5, 0.5, "here")
    axes.text(0.52, 0.51, "there")
    assert flaws(figure) == ("overlap: 'here' and 'there'",)


def test_a_text_that_leaves_the_figure_is_cut_off():
    figure, axes = panel()
    figure.set_layout_engine("none")
    axes.text(0.9, 0.5, "a rather long remark")
    assert flaws(figure) == ("cut off: 'a rather long remark'",)


def test_a_hidden_text_is_none():
    figure, axes = panel()
    axes.text(0.5, 0.5, "here")
    axes.text(0.5, 0.5, "there", visible=False)
    axes.text(7, 7, "far away", clip_on=True)
    axes.set(xlim=(0, 1), ylim=(0, 1))
    assert flaws(figure) == ()


def test_tiny_print_is_too_small():
    figure, axes = panel()
    axes.text(0.5, 0.5, "small print", fontsize=4)
    assert flaws(figure) == ("smaller than 5.0 points: 'small print'",)


def test_a_legend_over_a_text_hides_it():
    figure, axes = panel()
    axes.plot([0, 1], [0, 1], label="a line")
    axes.text(0.9, 0.05, "under it", ha="right")
    axes.legend(loc="lower right")
    found = flaws(figure)
    assert "under a legend: 'under it'" in found


@pytest.mark.parametrize("size", SIZES)
def test_sizes_are_those_that_are_asked_for(size):
    at = SIZES[size]
    assert at.figure("column", 0.5).get_figwidth() == at.column
    assert at.figure("page", 0.5).get_figheight() == pytest.approx(at.height or 0.5 * at.page)
