"""Numbers in few digits, rounded to the side that is safe."""

import math
from decimal import ROUND_CEILING, ROUND_FLOOR, ROUND_HALF_EVEN, Decimal


def rounded(value: float, digits: int, sense: int) -> Decimal:
    """Round to significant digits: up for a positive sense, down for a negative one, to nearest for 0."""
    exact = Decimal(value)
    if not exact:
        return Decimal(0)
    place = Decimal(1).scaleb(exact.adjusted() - digits + 1)
    how = {1: ROUND_CEILING, -1: ROUND_FLOOR, 0: ROUND_HALF_EVEN}[sense]
    return (exact / place).to_integral_value(how) * place


def decimal_text(value: Decimal) -> str:
    """Return a rounded number as text that reads back as the same number, without an exponent where that is short."""
    if value and not -5 <= value.adjusted() <= 6:
        return f"{value.normalize():e}".replace("E", "e")
    text = f"{value:f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def percent(share: float) -> str:
    """Return a change as a signed percentage in two digits, in four where it takes nearly all away; empty for none.

    >>> percent(1.2613), percent(-0.0544), percent(-0.998), percent(math.inf)
    ('+130 %', '-5.4 %', '-99.8 %', '')
    """
    if not math.isfinite(share):
        return ""
    digits = 4 if -1 < share <= -0.95 else 2  # -99.8 % is not -100 %
    return f"{'+' if share > 0 else ''}{decimal_text(rounded(100 * share, digits, 0))} %"
