"""Draw the pictures of the pages: ``python docs/images/draw.py [--check] [name ...]``, all of them without a name.

With ``--check`` nothing is written; each picture that no longer shows what the package finds is named.
"""

import argparse
import sys
from pathlib import Path

import matplotlib as mpl

sys.path.insert(0, str(Path(__file__).parent))

import chapters  # noqa: F401
import chapters_control  # noqa: F401
import chapters_first  # noqa: F401
import chapters_flight  # noqa: F401
import chapters_limit  # noqa: F401
import chapters_spin  # noqa: F401
import chapters_stability_control  # noqa: F401
import chapters_tires  # noqa: F401
import cycles  # noqa: F401
import overview  # noqa: F401
from pictures import PICTURES, command, save, stale

from ucrit.plots import style


def check(name):
    """Return a sentence where a picture is stale, empty where it is not."""
    with style.settings():
        told = stale(PICTURES[name](), name)
    return f"{name}.png is stale: {told}. Draw it again: {command(name)}" if told else ""


def main(arguments=None):
    """Draw or check; return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="name", help="a picture, as its file is called (all)")
    parser.add_argument("--check", action="store_true", help="only tell which pictures are stale")
    chosen = parser.parse_args(arguments)
    unknown = sorted(set(chosen.names) - set(PICTURES))
    if unknown:
        parser.error(f"there is no picture {unknown[0]}; there are {', '.join(sorted(PICTURES))}")
    mpl.use("agg")
    wrong = 0
    for name in chosen.names or PICTURES:
        if not chosen.check:
            with style.settings():
                save(PICTURES[name](), name)
        elif told := check(name):
            wrong += 1
            print(told)
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main())
