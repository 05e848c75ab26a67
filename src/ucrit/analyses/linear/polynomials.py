"""Polynomials in s with symbolic coefficients as people write them: falling powers, coefficients factored."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

Texts = dict[str, str]


def product(polynomial: Any, functions: Mapping[Any, Any]) -> Any:
    """Return a polynomial in the parameters as an expression, split into its factors."""
    from ...core.formulas.factor import factored

    return factored(polynomial).xreplace(dict(functions))


def in_s(coefficients: Sequence[Any]) -> Texts:
    """Return ``sum c_k s**k`` (expressions, ascending) as text, LaTeX and MathML, highest power first."""
    from ...core.formulas import typeset

    texts, latexs, mathmls = [], [], []
    for k, c in reversed([*enumerate(coefficients)]):
        if not c:
            continue
        negative = c.could_extract_minus_sign() and not c.is_Add
        size = -c if negative else c
        sign = "-" if negative else "+"
        one = size == 1 and k > 0
        plain = "" if one else f"({typeset.text(size)})" if size.is_Add and k else typeset.text(size)
        texts.append((sign, plain + ("*" if plain and k else "") + ("" if not k else "s" if k == 1 else f"s**{k}")))
        inner = "" if one else rf"\left({typeset.latex(size)}\right)" if size.is_Add and k else typeset.latex(size)
        latexs.append((sign, inner + ("" if not k else " s" if k == 1 else f" s^{{{k}}}")))
        power = "" if not k else "<mi>s</mi>" if k == 1 else f"<msup><mi>s</mi><mn>{k}</mn></msup>"
        body = "" if one else typeset.mathml(size)
        body = f"<mo>(</mo>{body}<mo>)</mo>" if size.is_Add and k else body
        mathmls.append((f"<mo>{sign}</mo>", f"<mrow>{body}{power}</mrow>"))
    return {
        "text": _joined(texts, " ", "+") or "0",
        "latex": _joined(latexs, " ", "+") or "0",
        "mathml": f"<mrow>{_joined(mathmls, '', '<mo>+</mo>') or '<mn>0</mn>'}</mrow>",
    }


def _joined(terms: list[tuple[str, str]], space: str, plus: str) -> str:
    """Join terms by their signs; a leading plus is left out."""
    if not terms:
        return ""
    first = terms[0][1] if terms[0][0] == plus else terms[0][0] + terms[0][1]
    return first + "".join(f"{space}{sign}{space}{term}" for sign, term in terms[1:])


def factored_in_s(polynomial: Any, functions: Mapping[Any, Any]) -> Texts:
    """Return a polynomial in parameters and s, the ring's last generator, factored, ready to be shown."""
    import sympy as sp

    from ...core.derivation.cramer import split_in_s

    content, found = split_in_s(polynomial)
    constant = sp.Integer(content)
    pieces: list[tuple[Texts, int, bool]] = []
    for coefficients, multiplicity in found:
        if len(coefficients) == 1:
            constant *= product(coefficients[0], functions) ** multiplicity
        else:
            terms = [product(c, functions) for c in coefficients]
            if _negative(terms[-1]):
                terms, constant = [-t for t in terms], constant * (-1) ** multiplicity
            pieces.append((in_s(terms), multiplicity, sum(bool(t) for t in terms) > 1))
    if not pieces:
        return in_s([constant])
    if constant == 1 and len(pieces) == 1 and pieces[0][1] == 1:
        return pieces[0][0]
    sign, size = ("-", -constant) if _negative(constant) else ("", constant)
    head = in_s([size])
    if size.is_Add:
        head = {"text": f"({head['text']})", "latex": rf"\left({head['latex']}\right)", "mathml": _bracketed(head)}
    signs = {"text": sign, "latex": sign, "mathml": sign and "<mo>-</mo>"}
    result = {key: signs[key] + ("" if size == 1 else head[key]) for key in head}
    for texts, m, several in pieces:
        body = f"({texts['text']})" if several else texts["text"]
        result["text"] += ("*" if result["text"] not in ("", "-") else "") + body + (f"**{m}" if m > 1 else "")
        inner = rf"\left({texts['latex']}\right)" if several else texts["latex"]
        result["latex"] += " " + inner + (f"^{{{m}}}" if m > 1 else "")
        row = _bracketed(texts) if several else texts["mathml"]
        result["mathml"] += f"<msup>{row}<mn>{m}</mn></msup>" if m > 1 else row
    result["mathml"] = f"<mrow>{result['mathml']}</mrow>"
    return result


def _negative(expression: Any) -> bool:
    """Tell whether every term of an expression has a minus sign."""
    terms = expression.args if expression.is_Add else (expression,)
    return all(term.could_extract_minus_sign() for term in terms)


def _bracketed(texts: Texts) -> str:
    return f"<mrow><mo>(</mo>{texts['mathml']}<mo>)</mo></mrow>"
