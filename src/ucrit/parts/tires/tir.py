"""Tire property files (``.tir``): what a file says of itself, and the law that its coefficients make.

The format: sections in brackets, lines ``KEY = value``, texts in single quotes, comments from ``$`` or ``!`` on.
Coefficients have no dimension; what has one (loads, lengths, pressures, stiffnesses, speeds) is converted to SI units
by the file's [UNITS]. The format's axes are those of ISO 8855 at the wheel, whatever the units.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...core.errors import UcritError, near_match
from .magic_formula import MagicFormula
from .magic_formula_89 import NEEDED as OF_1989
from .magic_formula_89 import MagicFormula89

AXES = "ISO 8855 at the wheel (TYDEX W): x forward, y to the left, z up"
AXES_89 = "those of the formula of 1989: the side force goes with the slip angle, and with the camber"

FORMATS = {"PAC2002": ("5.2", "PAC2002 (MF 5.2)"), "MF52": ("5.2", "MF 5.2"), "PAC89": ("1989", "PAC89 (Pacejka '89)")}
FITTYP = {6: ("5.2", "MF 5.2"), 52: ("5.2", "MF 5.2"), 61: ("6.1", "MF 6.1"), 62: ("6.1", "MF 6.2")}
"""Versions that are read: the formulas that belong to them, and their name. MF 6.2 has the forces of 6.1."""

UNITS: dict[str, dict[str, float]] = {
    "LENGTH": {"meter": 1, "m": 1, "mm": 1e-3, "cm": 1e-2, "km": 1e3, "inch": 0.0254, "foot": 0.3048},
    "FORCE": {
        "newton": 1,
        "n": 1,
        "kilonewton": 1e3,
        "kn": 1e3,
        "kg_force": 9.80665,
        "kgf": 9.80665,
        "pound_force": 4.4482216152605,
        "lbf": 4.4482216152605,
    },
    "ANGLE": {"radian": 1, "rad": 1, "degree": 0.017453292519943295, "deg": 0.017453292519943295},
    "MASS": {"kg": 1, "gram": 1e-3, "pound_mass": 0.45359237, "slug": 14.59390293720636},
    "TIME": {"second": 1, "sec": 1, "s": 1, "millisecond": 1e-3, "minute": 60, "hour": 3600},
}

DIMENSIONS: dict[str, dict[str, int]] = {
    **{key: {"FORCE": 1} for key in ("FNOMIN", "FZMIN", "FZMAX")},
    **{key: {"LENGTH": 1} for key in ("UNLOADED_RADIUS", "WIDTH", "RIM_RADIUS", "RIM_WIDTH")},
    **{key: {"FORCE": 1, "LENGTH": -2} for key in ("INFLPRES", "NOMPRES", "PRESMIN", "PRESMAX")},
    **{
        key: {"FORCE": 1, "LENGTH": -1} for key in ("VERTICAL_STIFFNESS", "LATERAL_STIFFNESS", "LONGITUDINAL_STIFFNESS")
    },
    **{key: {"LENGTH": 1, "TIME": -1} for key in ("LONGVL", "VXLOW")},
    **{key: {"ANGLE": 1} for key in ("ALPMIN", "ALPMAX", "CAMMIN", "CAMMAX")},
}
"""Keys with a dimension."""

NEEDED: dict[str, tuple[str, ...]] = {
    "DIMENSION": ("UNLOADED_RADIUS",),
    "VERTICAL": ("FNOMIN",),
    "LONGITUDINAL_COEFFICIENTS": ("PCX1", "PDX1", "PEX1", "PKX1", "RBX1", "RBX2", "RCX1"),
    "LATERAL_COEFFICIENTS": ("PCY1", "PDY1", "PEY1", "PKY1", "PKY2", "RBY1", "RBY2", "RCY1"),
    "ALIGNING_COEFFICIENTS": ("QBZ1", "QCZ1", "QDZ1", "QEZ1"),
}
"""Keys without which no force can be told; all others are variations, which are zero where they are not given."""

SECTIONS_89 = {"A": "LATERAL_COEFFICIENTS", "B": "LONGITUDINAL_COEFFICIENTS", "C": "ALIGNING_COEFFICIENTS"}
NEEDED_89 = {s: tuple(k.upper() for k in OF_1989 if k[0].upper() == letter) for letter, s in SECTIONS_89.items()}
"""The same for the formula of 1989."""

USED = re.compile(r"[PQR][A-Z]{2,3}\d+|SSZ\d|L[A-Z]{2,4}")
USED_89 = re.compile(r"[ABC]\d+")
"""Names of coefficients and scale factors."""

_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eEdD][-+]?\d+)?")


@dataclass(frozen=True)
class TirFile:
    """A tire property file, read.

    Attributes
    ----------
    name
        The file's name, as it was given.
    version
        Name of the format's version, such as ``"MF 6.1"``.
    formulas
        Edition of the formulas that belongs to it, ``"1989"``, ``"5.2"`` or ``"6.1"``.
    units
        The file's own units by kind, such as ``{"LENGTH": "meter"}``; values are in SI units.
    axes
        The axes that its signs belong to.
    values
        All numbers [SI] by key.
    comments
        Lines of comment at the file's beginning.
    """

    name: str
    version: str
    formulas: str
    units: Mapping[str, str]
    axes: str
    values: Mapping[str, float]
    comments: tuple[str, ...] = ()

    def law(self, *, symmetric: bool = True, **switches: Any) -> type[MagicFormula] | type[MagicFormula89]:
        """Return the law: without the shifts of the one tire that was measured, or with them.

        ``switches`` are those of `ucrit.parts.tires.magic_formula`, such as ``SLIP="angle"``, or of
        `ucrit.parts.tires.magic_formula_89`.

        Raises
        ------
        UcritError
            If there is no such switch, or it has no such place.
        """
        of_1989 = self.formulas == "1989"
        law: Any = MagicFormula89 if of_1989 else MagicFormula
        for name in switches:
            if name not in law.switches:
                raise UcritError(f"{self.name}: there is no switch {name}{near_match(name, law.switches)}")
        suffixes = (*(() if symmetric else (AS_MEASURED,)), *(f"{k}={v}" for k, v in switches.items()))
        common = {"SYMMETRIC": "yes" if symmetric else "no", "FILE": ":".join([self.name, *suffixes]), **switches}
        if of_1989:
            kept = {key.lower(): value for key, value in self.values.items() if USED_89.fullmatch(key)}
            found: type[MagicFormula89] = law.of({**kept, **common})
            return found
        kept = {key: value for key, value in self.values.items() if key in DIMENSIONS or USED.fullmatch(key)}
        conventions = {"CAMBER": "angle", "GROWTH": "signed"} if self.formulas == "5.2" else {}
        later: type[MagicFormula] = law.of({**kept, "FORMULAS": self.formulas, **conventions, **common})
        return later


AS_MEASURED = "measured"
"""What is put behind a file's name, after a colon, for the law with the shifts of the one tire that was measured."""


def split_name(name: str) -> tuple[str, dict[str, Any]]:
    """Return the file of a tire's name and what is behind it, for `TirFile.law`."""
    file, chosen = name, {}
    while match := _BEHIND.fullmatch(file):
        file, switch, value = match["file"], match["switch"], match["value"]
        found: Any = int(value) if value and _WHOLE.fullmatch(value) else value
        chosen[switch or "symmetric"] = found if switch else False
    return file, dict(reversed(chosen.items()))


_WHOLE = re.compile(r"[-+]?\d+")
_BEHIND = re.compile(rf"(?P<file>.+):(?:{AS_MEASURED}|(?P<switch>\w+)=(?P<value>[\w.+-]+))")


def read_tir(path: Path, name: str = "") -> TirFile:
    """Read a tire property file.

    Raises
    ------
    UcritError
        One sentence that names file, section and key: what is missing, unreadable or of an unsupported version.
    """
    name = name or str(path)
    sections, texts, comments = _sections(_text(path), name)
    version, formulas = _version(texts, sections, name)
    units, factors = _units(texts, name)
    needed, axes = (NEEDED_89, AXES_89) if formulas == "1989" else (NEEDED, AXES)
    for section, keys in needed.items():
        for key in keys:
            if key not in sections:
                near = near_match(key, [k for k, (_, where) in sections.items() if where == section])
                raise UcritError(f"{name}: section [{section}]: key {key} is missing{near}")
    values = {key: value * _factor(key, factors) for key, (value, _) in sections.items()}
    for key in ("FNOMIN", "UNLOADED_RADIUS"):
        if key in values and not values[key] > 0:
            raise UcritError(f"{name}: section [{sections[key][1]}]: {key} must be above 0, got {values[key]:g}")
    return TirFile(name, version, formulas, units, axes, values, comments)


def _text(path: Path) -> str:
    try:
        content = path.read_bytes()
    except FileNotFoundError:
        raise UcritError(f"there is no file '{path}'") from None
    except OSError as error:
        raise UcritError(f"'{path}' cannot be read: {error.strerror or error}") from None
    if b"\0" in content:
        raise UcritError(f"'{path}' is not a text file")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")


def _sections(text: str, name: str) -> tuple[dict[str, tuple[float, str]], dict[str, tuple[str, str]], tuple[str, ...]]:
    """Return numbers and texts by key, each with its section, and the comments."""
    section, numbers, texts, comments = "", {}, {}, []
    for count, whole in enumerate(text.splitlines(), 1):
        line = re.split(r"[$!]", whole, maxsplit=1)[0].strip()
        if not line and whole.strip() and not section.startswith(("MODEL", "UNITS")):
            comments.append(whole.strip(" $!-"))
        if line.startswith("["):
            section = line.strip("[] \t").upper()
        elif "=" in line:
            key, value = (part.strip() for part in line.split("=", 1))
            key = key.upper()
            old: Any = numbers.get(key) or texts.get(key)
            if value[:1] in ("'", '"'):
                new: Any = (value.strip("'\" "), section)
                texts[key] = new
            elif _NUMBER.fullmatch(value):
                new = (float(re.sub("[dD]", "e", value)), section)
                numbers[key] = new
            else:
                raise UcritError(f"{name}: section [{section}]: {key} must be a number, got '{value}' in line {count}")
            if old is not None and old != new:
                raise UcritError(f"{name}: section [{section}]: {key} is given twice, as {old[0]} and as {new[0]}")
        elif line and (section.endswith("COEFFICIENTS") or section in NEEDED):
            raise UcritError(f"{name}: section [{section}]: line {count} is not KEY = value, got '{line}'")
    return numbers, texts, tuple(c for c in comments if c)


def _version(texts: Mapping[str, Any], numbers: Mapping[str, Any], name: str) -> tuple[str, str]:
    given = texts.get("PROPERTY_FILE_FORMAT", ("", ""))[0].upper()
    if given in FORMATS:
        formulas, version = FORMATS[given]
        return version, formulas
    if "FITTYP" not in numbers:
        if not given:
            raise UcritError(f"{name}: section [MODEL]: neither FITTYP nor PROPERTY_FILE_FORMAT tells the version")
        raise UcritError(
            f"{name}: section [MODEL]: PROPERTY_FILE_FORMAT '{given}' without FITTYP is not supported; "
            f"supported are {', '.join(FORMATS)}, and FITTYP {', '.join(map(str, FITTYP))}"
        )
    fit = numbers["FITTYP"][0]
    if fit not in FITTYP:
        raise UcritError(
            f"{name}: section [MODEL]: FITTYP {fit:g} is not supported; supported are "
            f"{', '.join(f'{n} ({version})' for n, (_, version) in FITTYP.items())}"
        )
    formulas, version = FITTYP[fit]
    return version, formulas


def _units(texts: Mapping[str, Any], name: str) -> tuple[dict[str, str], dict[str, float]]:
    units, factors = {}, {}
    for kind, allowed in UNITS.items():
        if kind not in texts:
            raise UcritError(f"{name}: section [UNITS]: key {kind} is missing")
        units[kind] = texts[kind][0]
        unit = units[kind].lower()
        found = next((u for u in (unit, unit.rstrip("s")) if u in allowed), None)
        if found is None:
            raise UcritError(f"{name}: section [UNITS]: {kind} '{units[kind]}' is no unit{near_match(unit, allowed)}")
        factors[kind] = allowed[found]
    return units, factors


def _factor(key: str, factors: Mapping[str, float]) -> float:
    total = 1.0
    for kind, power in DIMENSIONS.get(key, {}).items():
        total *= factors[kind] ** power
    return total
