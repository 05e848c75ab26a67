"""Pictures of chapter 4."""

import numpy as np
from pictures import curve, figure_with_axes, picture

from ucrit import plot, tire, tire_curves
from ucrit.parts.tires import axle_coefficient
from ucrit.plots import style

ROADS = {"dry": 1.0, "wet": 0.6, "ice": 0.12}


@picture("chapter-04-curves")
def four_panels():
    figure = style.new_figure(7.4, 6.2)
    plot(tire_curves(tire("pac2002-235-60r16")), figure=figure)
    return figure


@picture("chapter-04-roads")
def roads():
    figure, panels = figure_with_axes(3.1, 2)
    curves = tire_curves(tire("pac2002-235-60r16"), [5000.0], ROADS)
    for number, name in enumerate(ROADS):
        curve(panels[0], np.degrees(curves.alpha), -curves.F_y[number, 0] / 5000, number, name)
        braking = curves.kappa <= 0
        curve(panels[1], -100 * curves.kappa[braking], -curves.F_x[number, 0, braking] / 5000, number, name)
    panels[0].set_xlabel("slip angle [degrees]")
    panels[0].set_ylabel("side force / load")
    panels[1].set_xlabel("braking slip [%]")
    panels[1].set_ylabel("braking force / load")
    for axes in panels:
        axes.set_ylim(0, 1.45)
        axes.legend(frameon=False, loc="upper right", ncols=3)
    return figure


@picture("chapter-04-load")
def load_transfer():
    figure, (single, axle) = figure_with_axes(3.1, 2)
    load, transfer = np.linspace(100, 9000, 200), np.linspace(0, 3900, 100)
    for number, name in enumerate(("pac2002-235-60r16", "pacejka-205-60r15")):
        one = tire(name)
        curve(single, load / 1000, one.cornering_coefficient(load) / 1000, number, name)
        curve(axle, transfer / 1000, axle_coefficient(one, 4000, transfer) / 1000, number, name)
    single.set_xlabel("load of a wheel [kN]")
    single.set_ylabel("cornering coefficient [kN/rad]")
    axle.set_xlabel("load transfer, 4 kN each at rest [kN]")
    axle.set_ylabel("sum of the axle [kN/rad]")
    axle.set_ylim(bottom=0)
    single.legend(frameon=False, loc="lower right", fontsize=8)
    return figure


@picture("chapter-04-laws")
def laws():
    figure, axes = figure_with_axes(3.1)
    alpha = np.radians(np.linspace(0, 15, 151))
    book = tire("pacejka-205-60r15")
    C = float(book.cornering_coefficient(4000))
    for number, (name, one) in enumerate(
        {
            "magic formula": book,
            "brush": tire("brush", C=C, mu=0.99),
            "Dugoff": tire("dugoff", C=C, mu=0.99),
            "linear": tire("linear", C=C),
        }.items()
    ):
        curve(axes, np.degrees(alpha), -one.side_force(4000, alpha) / 1000, number, name)
    axes.set_xlabel("slip angle [degrees]")
    axes.set_ylabel("side force under 4 kN [kN]")
    axes.set_ylim(0, 6)
    axes.legend(frameon=False, loc="lower right")
    return figure
