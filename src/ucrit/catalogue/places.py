"""Where what is shipped lies, and how its files are named."""

from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
VEHICLES = HERE / "data" / "vehicles"
PUBLISHED = HERE / "data" / "published"
TIRES = HERE / "data" / "tires"
BONDS = ".bonds"
"""Ending of files that hold a bond graph as text."""
