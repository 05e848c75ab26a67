"""Factors of parameter polynomials: splitting, signs that the declared bounds settle, and a readable form."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sympy.polys.rings import PolyElement


Collected = tuple[int, list[tuple[int, int, list[tuple["PolyElement", int]]]]]
"""A generator's place, and for each of its powers content and factors of what it is multiplied with."""

LONG = 60
"""Terms above which a polynomial's readable form is sought in fewer ways."""


def factors(poly: PolyElement) -> tuple[int, list[tuple[PolyElement, int]]]:
    """Return the integer content and the irreducible factors with their multiplicities.

    python-flint does it where it is installed (some hundred times faster), SymPy otherwise.
    """
    try:
        import flint  # noqa: F401
    except ImportError:
        content, found = poly.factor_list()
        return int(content), [(f, int(m)) for f, m in found]
    if not poly.ring.ngens:
        return int(poly.LC), []
    try:
        content, found = _flint(poly).factor()
    except OverflowError:  # it sorts factors by coefficients, and those of a vehicle's numbers exceed a machine word
        content, found = poly.factor_list()
        return int(content), [(f, int(m)) for f, m in found]
    return int(content), [(poly.ring.from_dict(_exponents(f)), int(m)) for f, m in found]


def common_divisor(one: PolyElement, other: PolyElement) -> PolyElement:
    """Return the greatest common divisor of two polynomials of one ring, by python-flint where it is installed."""
    try:
        import flint  # noqa: F401
    except ImportError:
        return one.gcd(other)
    if not one.ring.ngens or not one or not other:
        return one.gcd(other)
    return one.ring.from_dict(_exponents(_flint(one).gcd(_flint(other))))


def _flint(poly: PolyElement) -> Any:
    import flint

    context = flint.fmpz_mpoly_ctx.get([f"v{i}" for i in range(poly.ring.ngens)], "lex")
    return context.from_dict({tuple(m): int(c) for m, c in poly.terms()})


def _exponents(poly: Any) -> dict[tuple[int, ...], int]:
    return {tuple(int(e) for e in monom): int(c) for monom, c in poly.to_dict().items()}


def definite_sign(poly: PolyElement) -> int | None:
    """Return +1 or -1 where the bounds of the parameters settle the sign, else ``None``.

    Settled means that all terms have one sign and at least one of them cannot vanish. That is sufficient, not
    necessary: a polynomial that is positive for a subtler reason is reported as undecided.
    """
    signs, strict = set(), False
    for monom, c in poly.terms():
        powers = [sign_of_power(g, e) for g, e in zip(poly.ring.symbols, monom, strict=True) if e]
        if any(sign is None for sign, _ in powers):
            return None
        signs.add(math.prod((sign or 0 for sign, _ in powers), start=1 if c > 0 else -1))
        strict = strict or all(surely for _, surely in powers)
    return signs.pop() if len(signs) == 1 and strict else None


def sign_of_power(generator: Any, exponent: int) -> tuple[int | None, bool]:
    """Sign of a power (0 counts as +1) and whether it surely differs from zero."""
    if generator.is_positive:
        return 1, True
    if generator.is_negative:
        return (-1) ** exponent, True
    if generator.is_nonnegative or exponent % 2 == 0:
        return 1, False
    return None, False


@lru_cache(maxsize=4096)
def readable(poly: PolyElement) -> Any:
    """Return a polynomial as the shortest expression found by collecting it in one of its parameters.

    ``C*I_c + C*b**2*m - k*...`` becomes ``C*(I_c + b**2*m) - k*(...)``: the coefficient of every power is factored,
    and the parameter is chosen that leaves the fewest symbols to write.
    """
    found = None if len(poly) <= 2 else _collected(poly) if len(poly) <= LONG else _collected_long(poly)
    if found is None:
        return poly.as_expr()
    import sympy as sp

    generator = poly.ring.symbols[found[0]]
    terms = []
    for power, content, parts in found[1]:
        product = sp.Mul(*(readable(f) ** m for f, m in parts))
        terms.append(content * generator**power * product)
    return sp.Add(*terms)


def _collected(poly: PolyElement) -> Collected | None:
    """Return the parameter that leaves the fewest symbols, and the powers' coefficients; ``None`` if none helps."""
    best, cost = None, _length(poly)
    for i in range(poly.ring.ngens):
        parts = [(power, *factors(part)) for power, part in sorted(_by_power(poly, i).items())]
        length = sum(power > 0 for power, _, _ in parts) + sum(m * _length(f) for _, _, fs in parts for f, m in fs)
        if len(parts) > 1 and length < cost:
            best, cost = (i, parts), length
    return best


def _collected_long(poly: PolyElement) -> Collected | None:
    """Return the same with the parameter chosen before coefficients are factored: all that, for each, takes seconds."""
    split = {i: _by_power(poly, i) for i in range(poly.ring.ngens)}
    lengths = {
        i: sum((power > 0) + _length_apart(part) for power, part in parts.items())
        for i, parts in split.items()
        if len(parts) > 1
    }
    best = min(lengths, key=lambda i: lengths[i], default=None)
    if best is None or lengths[best] >= _length(poly):
        return None
    return best, [(power, *factors(part)) for power, part in sorted(split[best].items())]


def factored(poly: PolyElement) -> Any:
    """Return a polynomial as the product of its factors, each in its readable form."""
    import sympy as sp

    if not poly:
        return sp.S.Zero
    content, found = factors(poly)
    return content * sp.Mul(*(readable(f) ** m for f, m in found))


def _length(poly: PolyElement) -> int:
    return sum(sum(monom) for monom in poly.itermonoms()) + len(poly) - 1


def _length_apart(poly: PolyElement) -> int:
    """Length with what all terms share written once."""
    shared: int = sum(map(min, zip(*poly.itermonoms(), strict=True)))
    return _length(poly) - (len(poly) - 1) * shared


def _by_power(poly: PolyElement, index: int) -> dict[int, PolyElement]:
    """Split a polynomial by the powers of one of its generators."""
    split: dict[int, dict[Any, Any]] = {}
    for monom, c in poly.terms():
        split.setdefault(monom[index], {})[(*monom[:index], 0, *monom[index + 1 :])] = c
    return {power: poly.ring.from_dict(part) for power, part in split.items()}


def readable_ratio(numerator: PolyElement, denominator: PolyElement) -> Any:
    """Return a quotient with both parts factored, whole-number contents reduced, and signs where they read best."""
    import sympy as sp

    if not numerator:
        return sp.S.Zero
    (cn, above), (cd, below) = factors(numerator), factors(denominator)
    divisor = math.gcd(cn, cd)
    cn, cd = cn // divisor, cd // divisor
    for parts in (above, below):
        for i, (f, m) in enumerate(parts):
            if definite_sign(f) == -1:
                parts[i] = (-f, m)
                if m % 2:
                    cn = -cn
    if cn * cd < 0 and any(m % 2 and definite_sign(f) is None for f, m in below):
        i = next(i for i, (f, m) in enumerate(below) if m % 2 and definite_sign(f) is None)
        below[i] = (-below[i][0], below[i][1])
        cn = -cn
    if cd < 0:
        cn, cd = -cn, -cd
    top = sp.Mul(*(readable(f) ** m for f, m in above))
    bottom = sp.Mul(*(readable(f) ** m for f, m in below))
    return sp.Rational(cn, cd) * top / bottom
