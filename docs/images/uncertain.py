"""Draw the picture of the page on uncertainty: ``python docs/images/uncertain.py``."""

from pathlib import Path

from ucrit import load, plot, uncertainty

if __name__ == "__main__":
    figure = plot(uncertainty(load("caravan"), samples=4096, indices=True))
    figure.savefig(Path(__file__).with_name("uncertainty.png"), dpi=108, metadata={"Software": None})
