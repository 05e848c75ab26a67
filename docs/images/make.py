"""Draw the picture of the caravan that the front page shows: ``python docs/images/make.py``."""

from pathlib import Path

from ucrit import analyze, plot
from ucrit.plots import style

if __name__ == "__main__":
    figure = style.new_figure(width=14, height=5.5)
    plot(analyze("caravan", upto="100 km/h"), figure=figure)
    figure.savefig(Path(__file__).with_name("caravan.png"), dpi=100, metadata={"Software": None})
