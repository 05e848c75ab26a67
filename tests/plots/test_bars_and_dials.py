"""Remedies, participation and mode shapes show the numbers of their results."""

import math
from dataclasses import replace

import numpy as np
import pytest
from drawn import find, texts

from ucrit import load, modes, plots, remedies
from ucrit.core import UcritError


@pytest.fixture(scope="module")
def caravan():
    return load("caravan")


@pytest.fixture(scope="module")
def found(caravan):
    return remedies(caravan)


class TestRemedies:
    def test_bars_are_the_relative_changes(self, found):
        figure = plots.plot_remedies(found)
        limit = max(abs(find(figure, f"bar-{r.parameter}")[0].get_width()) for r in found)
        for r in found:
            (bar,) = find(figure, f"bar-{r.parameter}")
            assert bar.get_width() == pytest.approx(math.copysign(min(abs(r.relative), limit), r.relative))

    def test_numbers_stand_beside_the_bars(self, found):
        assert texts(plots.plot_remedies(found))[:2] == [
            "+2.8\N{NO-BREAK SPACE}%",
            "\N{MINUS SIGN}5.4\N{NO-BREAK SPACE}%",
        ]

    def test_a_present_value_of_zero_has_no_percentage(self, found):
        zero = replace(found[0], present=0.0, value=3.0, relative=math.inf)
        assert texts(plots.plot_remedies([zero])) == ["0 to 3\N{NO-BREAK SPACE}m"]

    def test_parameters_that_never_help_are_left_out(self, found):
        helpless = replace(found[0], value=None, relative=math.inf)
        assert len(texts(plots.plot_remedies([helpless, *found[1:]]))) == len(found) - 1
        with pytest.raises(UcritError, match="no remedy to draw"):
            plots.plot_remedies([helpless])


class TestModes:
    def test_participation_in_percent(self, caravan):
        listed = modes(caravan).list()
        figure = plots.plot_participation(listed)
        shown = [f"{100 * share:.0f}" for mode in listed for share in mode.participation.values()]
        assert texts(figure) == shown
        cells = figure.get_axes()[0].patches
        shares = [share for mode in listed for share in mode.participation.values()]
        assert np.argmax([cell.get_alpha() for cell in cells]) == np.argmax(shares)

    def test_hands_point_to_the_phase(self, caravan):
        listed = modes(caravan).list()
        axes = plots.plot_mode_shapes(listed, caravan).get_axes()[0]
        hands = [t for t in axes.texts if getattr(t, "arrow_patch", None)]
        assert len(hands) == 4
        x, y = np.array(hands[1].xy) - np.array(hands[1].xyann)
        value = listed[0].shape["theta"]
        assert math.atan2(-y, x) == pytest.approx(math.atan2(value.imag, value.real))
        assert math.hypot(x, y) == pytest.approx(plots.mode_shapes.RADIUS)

    def test_amplitude_phase_and_unit_are_written(self, caravan):
        written = "\n".join(texts(plots.plot_mode_shapes(modes(caravan).list(), caravan)))
        assert "sway, 0.755 Hz" in written
        assert "$x$  1\N{NO-BREAK SPACE}m\n0°" in written
        assert "$θ$  0.408\N{NO-BREAK SPACE}rad\n\N{MINUS SIGN}135°" in written

    def test_rounding_errors_are_no_motion(self):
        vehicle = load("oversteering-car-on-the-road")
        written = "\n".join(texts(plots.plot_mode_shapes(modes(vehicle).list(), vehicle)))
        assert "10⁻" not in written
        assert "$ψ$  0" in written
