"""Whether speed can turn a model's static term over: what divides a car, which may spin, from an airplane.

The static term is the characteristic polynomial's last one, a_0, with the first, a_n, made 1. Where it turns
negative a real root passes zero: divergence.
"""

from __future__ import annotations

from typing import Any

from ...core.contract.model import Model
from ...core.numeric.cache import cached


def static_term(model: type[Model], direction: int = 1) -> str:
    """Tell in words how the sign of the static term depends on speed.

    Parameters
    ----------
    model
        A model class.
    direction
        +1 forward, -1 backing up.

    Returns
    -------
    str
        Words for a table; empty for a model without speed, with speed inside a function, or of zero roots only.

    Examples
    --------
    >>> from ucrit import find_model
    >>> static_term(find_model("car"))
    'its sign may change with speed'
    >>> static_term(find_model("airplane-plane"))
    'grows like U**2, its sign does not depend on speed'
    """
    return str(cached(model, f"static-term{direction:+d}", lambda: {"words": _words(model, direction)})["words"])


def _words(model: type[Model], direction: int) -> str:
    from ...core.derivation.derive import symbolic
    from ...core.formulas.factor import common_divisor, definite_sign

    name = model.declaration.speed
    polynomial = symbolic(model, direction).polynomial
    symbol = next((s for s in polynomial.ring.symbols if s.name == name), None)
    inside = any(s.name == name for f in polynomial.functions.values() for s in f.free_symbols)
    if name is None or inside or polynomial.zeros == polynomial.order:
        return ""
    last, first = polynomial.static, polynomial.leading
    common = common_divisor(last, first)
    last, first = last.exquo(common), first.exquo(common)
    signs = definite_sign(last), definite_sign(first)
    powers = [_powers(part, symbol) for part in (last, first)]
    if None not in signs:
        return f"{'positive' if signs[0] == signs[1] else 'negative'}, whatever the parameters"
    if any(len(found) > 1 for found in powers):
        return "its sign may change with speed"
    power = powers[0].pop() - powers[1].pop()
    grows = f"{'grows' if power > 0 else 'falls'} like {name if abs(power) == 1 else f'{name}**{abs(power)}'}, "
    return (grows if power else "") + "its sign does not depend on speed"


def _powers(polynomial: Any, symbol: Any) -> set[int]:
    """Return the powers of a symbol that occur in a polynomial."""
    if symbol is None:
        return {0}
    index = polynomial.ring.symbols.index(symbol)
    return {monom[index] for monom in polynomial.itermonoms()}
