"""Draw the picture of the caravan that the front page shows: ``python docs/images/make.py``."""

from pathlib import Path

from ucrit import analyze, plot
from ucrit.plots import style

if __name__ == "__main__":
    figure = style.new_figure(width=10.4, height=4.1)
    plot(analyze("caravan", upto="100 km/h"), figure=figure)
    figure.savefig(Path(__file__).with_name("caravan.png"), dpi=135, metadata={"Software": None})
