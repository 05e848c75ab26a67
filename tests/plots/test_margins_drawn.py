"""The drawing of margins over a parameter."""

import numpy as np
import pytest
from drawn import find

import ucrit
from ucrit import load, margins

REAR = load("motorcycle-steered-at-the-rear")


def test_the_drawing_shows_the_margins_and_shades_where_there_are_none():
    found = margins(REAR.with_(U=np.linspace(10, 75, 27)), "delta_r")
    figure = ucrit.plot(found)
    for name, factor in (("disk", 1), ("gain_up", 1), ("phase", 180 / np.pi), ("delay", 1e3)):
        (line,) = find(figure, name)
        np.testing.assert_allclose(line.get_ydata(), factor * getattr(found, name))
    shaded = [(span.get_x(), span.get_x() + span.get_width()) for span in find(figure, "unstable")]
    np.testing.assert_allclose(shaded, [(10, 13.75), (68.75, 75)] * 4)
    with pytest.raises(ucrit.UcritError, match="over one parameter, such as U=9:40:60"):
        ucrit.plot(margins(REAR, "delta_r"))
    with pytest.raises(ucrit.UcritError, match="unstable at every value"):
        ucrit.plot(margins(REAR.with_(U=[1.0, 2.0]), "delta_r"))
