"""Draw the bond graphs of the page on them: ``python docs/images/chapters_bonds.py [name ...]``."""

import sys
from pathlib import Path

from ucrit import bonds, plot

GRAPHS = {
    "trailer": "trailer",
    "car": "car",
    "body": "rigid-body-symmetric",
    "sidewall": "caster-flexible-sidewall",
}

if __name__ == "__main__":
    for name in sys.argv[1:] or GRAPHS:
        path = Path(__file__).with_name(f"bonds-{name}.png")
        plot(bonds(GRAPHS[name])).savefig(path, dpi=120, metadata={"Software": None})
