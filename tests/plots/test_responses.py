"""Drawings of responses hold what the results hold."""

import numpy as np
import pytest

from ucrit import UcritError, frequency_response, impulse_response, load, locus, margins, plot, step_response
from ucrit.control import place


def lines(figure):
    return {line.get_gid(): line for axes in figure.axes for line in axes.lines}


def test_bode_diagram_has_gain_and_phase():
    found = frequency_response(load("bmw-320i"), "delta_f", ["r", "V"])
    drawn = lines(plot(found))
    assert set(drawn) == {"gain r", "gain V", "phase r", "phase V"}
    np.testing.assert_array_equal(drawn["gain r"].get_ydata(), found.gain("r"))
    np.testing.assert_array_equal(drawn["phase V"].get_ydata(), found.phase_deg("V"))
    assert repr(found).startswith("FrequencyResponse(frequency response to delta_f: r, V; ")
    with pytest.raises(UcritError, match="one value each for U"):
        plot(frequency_response(load("bmw-320i").with_(U=[10.0, 20.0]), "delta_f", "r"))


@pytest.mark.parametrize("response", [step_response, impulse_response])
def test_responses_in_time_tend_to_their_final_values(response):
    found = response(load("bmw-320i"), "delta_f", ["r", "beta"])
    drawn = lines(plot(found))
    np.testing.assert_array_equal(drawn["r"].get_ydata(), found["r"])
    assert set(drawn["final beta"].get_ydata()) == {found.final[1]}


def test_margins_find_the_only_driven_input_and_ask_where_there_are_two():
    car = load("oversteering-car")
    assert margins(place(car, "delta_f", [-5, -6])) == margins(place(car, "delta_f", [-5, -6]), "delta_f")
    with pytest.raises(UcritError, match="say where the loop is cut: delta_f, delta_r"):
        margins(place(car, ["delta_f", "delta_r"], [-5, -6]))


def test_range_of_a_locus_that_is_no_number_is_refused():
    with pytest.raises(UcritError, match="lower must be a number or a text, got array"):
        locus(load("caravan"), "U", np.linspace(10, 20, 3))
