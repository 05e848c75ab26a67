"""Pictures of the front page, of uncertainty and of bond graphs."""

from pictures import picture

from ucrit import analyze, bonds, load, plot, uncertainty
from ucrit.plots import style

GRAPHS = {
    "trailer": "trailer",
    "car": "car",
    "body": "rigid-body-symmetric",
    "sidewall": "caster-flexible-sidewall",
}


@picture("caravan")
def caravan():
    figure = style.new_figure(width=10.4, height=4.1)
    plot(analyze("caravan", upto="100 km/h"), figure=figure)
    return figure


@picture("uncertainty")
def tolerances():
    return plot(uncertainty(load("caravan"), samples=4096, indices=True))


for name, model in GRAPHS.items():
    picture(f"bonds-{name}")(lambda model=model: plot(bonds(model)))
