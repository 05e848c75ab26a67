"""Names, units and numbers as drawings and pages print them; knows no drawing library."""

from __future__ import annotations

import math
import re
import unicodedata

from ..analyses.results import digits as written

GREEK = (
    *(
        "alpha",
        "beta",
        "gamma",
        "delta",
        "epsilon",
        "zeta",
        "eta",
        "theta",
        "iota",
        "kappa",
        "lambda",
        "lamda",
    ),
    *("mu", "nu", "xi", "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega"),
)
NOTHING = "\N{EN DASH}"
MINUS = "\N{MINUS SIGN}"
_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def split_symbol(name: str) -> tuple[str, list[str], int]:
    """Split a declared name into its letter, its subscripts and the number of dots.

    >>> split_symbol("theta_1'")
    ('θ', ['1'], 1)
    """
    base = name.rstrip("'")
    dots = len(name) - len(base)
    head, *subscripts = [part for part in base.split("_") if part] or [base]
    numbered = re.fullmatch(r"([A-Za-z]+?)(\d+)", head)
    if numbered:
        head, subscripts = numbered[1], [numbered[2], *subscripts]
    return _letter(head), [_letter(part) for part in subscripts], dots


def _letter(name: str) -> str:
    """Return a Greek letter for its name."""
    if name.lower() not in GREEK:
        return name
    case = "CAPITAL" if name[0].isupper() else "SMALL"
    return unicodedata.lookup(f"GREEK {case} LETTER {name.upper().replace('LAMBDA', 'LAMDA')}")


def math_symbol(name: str) -> str:
    """Return a declared name as mathtext: ``I_c`` with a subscript, ``theta'`` as a dotted letter.

    >>> math_symbol("I_c"), math_symbol("theta'")
    ('$I_{c}$', '$\\\\dot{θ}$')
    """
    head, subscripts, dots = split_symbol(name)
    letter = head if len(head) == 1 else rf"\mathrm{{{head}}}"
    if dots in (1, 2):
        letter = rf"\{'d' * dots}ot{{{letter}}}"
    below = ",".join(part if len(part) == 1 else rf"\mathrm{{{part}}}" for part in subscripts)
    return f"${letter}" + (f"_{{{below}}}$" if below else "$")


def unit_text(unit: str) -> str:
    """Return a unit with raised powers: ``kg m²``; nothing for a bare number.

    >>> unit_text("kg m^2")
    'kg m²'
    """
    if unit == "1":
        return ""
    return re.sub(r"\^(-?\d+)", lambda match: match[1].translate(_SUPERSCRIPT), unit)


def plain(text: str) -> str:
    """Return words so that mathtext leaves them alone."""
    return text.replace("$", r"\$")


def axis_label(words: str, name: str, unit: str) -> str:
    """Return an axis label: what it is, its symbol, its unit."""
    inside = unit_text(unit)
    symbol = f" {math_symbol(name)}" if name else ""
    return plain(words) + symbol + (f" [{inside}]" if inside else "")


def number(value: float, digits: int = 4) -> str:
    """Return a number to so many significant digits, with a true minus sign and a power of ten written out.

    >>> number(0.28732), number(90000.0), number(1.5e7)
    ('0.2873', '90000', '1.5·10⁷')
    """
    if math.isnan(value):
        return NOTHING
    if math.isinf(value):
        return "∞" if value > 0 else MINUS + "∞"
    text = f"{value + 0.0:.{digits}g}"  # -0.0 + 0.0 is 0.0
    if "e" in text:
        shown = float(text)
        if 1e-3 <= abs(shown) < 1e6:
            text = f"{shown:.0f}"
        else:
            mantissa, _, exponent = text.partition("e")
            text = f"{mantissa}·10{str(int(exponent)).translate(_SUPERSCRIPT)}"
    return text.replace("-", MINUS)


def fixed(value: float, digits: int = 4) -> str:
    """Return a number with all its significant digits, also zeros, for columns of numbers.

    >>> fixed(2.4), fixed(1234.0), fixed(0.0)
    ('2.400', '1234', '0')
    """
    if not value or not math.isfinite(value) or not 1e-3 <= abs(value) < 10.0**digits:
        return number(value, digits)
    return f"{value:#.{digits}g}".rstrip(".").replace("-", MINUS)


def quantity(value: float, unit: str, digits: int = 4) -> str:
    """Return a number with its unit, apart by a space that does not break."""
    inside = unit_text(unit)
    return number(value, digits) + (f"\N{NO-BREAK SPACE}{inside}" if inside else "")


def percent(share: float) -> str:
    """Return a relative change as the page's other numbers are set: a true minus, a space that does not break.

    >>> percent(0.0275).split(), percent(1234.0).split(), percent(math.inf) == NOTHING
    (['+2.8', '%'], ['+120000', '%'], True)
    """
    return written.percent(share).replace("-", MINUS).replace(" ", "\N{NO-BREAK SPACE}") or NOTHING
