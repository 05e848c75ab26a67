"""Formulas for the page: well-formed MathML, names as symbols, long sums broken into lines."""

from __future__ import annotations

import ast
import re
from collections.abc import Sequence
from html import escape, unescape
from xml.etree import ElementTree

from markupsafe import Markup

LONGEST = 6000
"""A formula of more characters than this is not printed: nobody reads it, and it would swell the page."""

LINE = 90
"""Characters after which a sum goes on in a new line."""

MINUS = "\N{MINUS SIGN}"
SIGNS = ("+", "-", MINUS)
TALL = ("mfrac", "mtable", "msqrt", "munderover")
FUNCTIONS = ("arctan", "atan", "cos", "exp", "ln", "log", "sgn", "sign", "sin", "tan", "tanh")
INVISIBLE_TIMES = "\N{INVISIBLE TIMES}"

_ENTITY = re.compile(r"&(?!(?:amp|lt|gt|quot|apos);)(#?\w+);")
_DOTS = {1: "˙", 2: "¨", 3: "\N{COMBINING THREE DOTS ABOVE}"}
Element = ElementTree.Element


def formula(mathml: str, tail: str = "", left: str = "") -> Markup:
    """Return a displayed formula from SymPy's MathML.

    Parameters
    ----------
    mathml
        A sum; a long one is broken before a plus or minus sign of its outermost level.
    tail
        What follows it, such as ``"> 0"``; not printed where there is a left side.
    left
        MathML of the left side of ``left = sum``.
    """
    root = _parsed(mathml)
    for piece in () if left else tail.split():
        root.append(_leaf("mn" if piece.isdigit() else "mo", piece))
    rows = _rows(root)
    if left:
        rows[0] = [_parsed(left), _leaf("mo", "="), *rows[0]]
    math = ElementTree.Element("math", {"display": "block"})
    if len(rows) == 1:
        math.extend(rows[0])
    else:
        table = ElementTree.SubElement(math, "mtable", {"class": "lines", "displaystyle": "true"})
        for row in rows:
            cell = ElementTree.SubElement(ElementTree.SubElement(table, "mtr"), "mtd")
            ElementTree.SubElement(cell, "mrow").extend(row)
    return Markup(_text(math))


def inline(mathml: str) -> Markup:
    """Return a formula that stands in a line of text."""
    math = ElementTree.Element("math")
    math.extend(list(_parsed(mathml)))
    return Markup(_text(math))


def equality(*sides: str) -> Markup:
    """Return ``a = b = ...`` as a displayed formula."""
    math = ElementTree.Element("math", {"display": "block"})
    for i, side in enumerate(sides):
        if i:
            math.append(_leaf("mo", "="))
        math.append(_parsed(side))
    return Markup(_text(math))


def from_text(expression: str) -> Markup:
    """Return an inline formula from a polynomial written in Python, without waking SymPy for it."""
    return inline(_typeset(ast.parse(expression, mode="eval").body))


def _typeset(node: ast.AST, inside: bool = False) -> str:
    """MathML of a sum of products of powers; ``inside`` a product a sum gets brackets."""
    if isinstance(node, ast.Name):
        return symbol_mathml(node.id)
    if isinstance(node, ast.UnaryOp):
        return f"<mo>-</mo>{_typeset(node.operand, True)}"
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
        return f"<msup><mrow>{_typeset(node.left, True)}</mrow><mrow>{_typeset(node.right)}</mrow></msup>"
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div):
        return f"<mfrac><mrow>{_typeset(node.left)}</mrow><mrow>{_typeset(node.right)}</mrow></mfrac>"
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult):
        return f"{_typeset(node.left, True)}<mo>{INVISIBLE_TIMES}</mo>{_typeset(node.right, True)}"
    if isinstance(node, ast.BinOp):
        sign = "+" if isinstance(node.op, ast.Add) else "-"
        text = f"{_typeset(node.left)}<mo>{sign}</mo>{_typeset(node.right, sign == '-')}"
        return f"<mrow><mo>(</mo>{text}<mo>)</mo></mrow>" if inside else text
    if isinstance(node, ast.Call):
        return f"<mi>{escape(ast.unparse(node.func))}</mi><mo>(</mo>{_typeset(node.args[0])}<mo>)</mo>"
    return f"<mn>{escape(ast.unparse(node))}</mn>"


def symbol(name: str) -> Markup:
    """Return a declared name as an inline formula: ``I_c`` with a subscript, ``theta'`` with a dot."""
    return inline(symbol_mathml(name))


def symbol_mathml(name: str) -> str:
    """Return the MathML of a declared name."""
    from ..plots.labels import split_symbol

    letter, subscripts, dots = split_symbol(name)
    element = _leaf("mi", letter)
    if dots:
        element = _over(element, dots)
    if subscripts:
        below = ElementTree.Element("msub")
        below.append(element)
        below.append(_leaf("mi", ",".join(subscripts)))
        element = below
    return _text(element)


def matrix(cells: Sequence[Sequence[str]]) -> str:
    """Return the MathML of a matrix; the style sheet draws its brackets, which not every font can stretch."""
    rows = "".join("<mtr>" + "".join(f"<mtd><mrow>{cell}</mrow></mtd>" for cell in row) + "</mtr>" for row in cells)
    return f'<mtable class="matrix" displaystyle="true">{rows}</mtable>'


def power(name: str, exponent: int) -> str:
    """Return the MathML of a declared name to a whole power."""
    if exponent == 1:
        return symbol_mathml(name)
    return f"<msup>{symbol_mathml(name)}<mn>{exponent}</mn></msup>"


def too_long(expression: str, most: int | None = None) -> bool:
    """Tell whether an expression is longer than a page should print: `LONGEST`, or less where there are several."""
    return len(expression) > (LONGEST if most is None else most)


def _parsed(mathml: str) -> Element:
    """Parse MathML whose named entities XML does not know; one row around it all."""
    text = _ENTITY.sub(lambda match: unescape(match[0]), mathml)
    root = ElementTree.fromstring(f"<mrow>{text}</mrow>")
    while len(root) == 1 and root[0].tag == "mrow":
        root = root[0]
    for element in root.iter():
        if element.tag in ("mo", "mn") and (element.text or "").startswith("-"):
            element.text = MINUS + (element.text or "")[1:]
        elif element.tag == "mi" and element.text in FUNCTIONS:  # as an operator it keeps a distance to what it follows
            element.tag = "mo"
            element.attrib.update(form="prefix", lspace="0.17em", rspace="0")
        elif element.tag == "mrow" and not any(inner.tag in TALL for inner in element.iter()):
            for bracket in (inner for inner in element if inner.text in ("(", ")")):
                bracket.set("stretchy", "false")  # a font's next larger one stands off
    return root


def _over(element: Element, dots: int) -> Element:
    over = ElementTree.Element("mover", {"accent": "true"})
    over.append(element)
    over.append(_leaf("mo", _DOTS.get(dots, f"({dots})"), {"stretchy": "false"}))
    return over


def _leaf(tag: str, text: str, attributes: dict[str, str] | None = None) -> Element:
    element = ElementTree.Element(tag, attributes or {})
    element.text = text
    return element


def _length(element: Element) -> int:
    return len("".join(element.itertext()).replace(INVISIBLE_TIMES, ""))


def _rows(root: Element) -> list[list[Element]]:
    """Split the outermost sum into lines."""
    if root.tag != "mrow" or _length(root) <= LINE:
        return [list(root)]
    rows: list[list[Element]] = [[]]
    used = 0
    for part in _terms(list(root)):
        length = sum(map(_length, part))
        if used and used + length > LINE:
            rows.append([])
            used = 0
        rows[-1] += part
        used += length
    return rows


def _terms(children: list[Element]) -> list[list[Element]]:
    """Group what stands between plus and minus signs, the sign first."""
    terms: list[list[Element]] = [[]]
    for child in children:
        if child.tag == "mo" and (child.text or "") in SIGNS and terms[-1]:
            terms.append([])
        terms[-1].append(child)
    return terms


def _text(element: Element) -> str:
    return ElementTree.tostring(element, encoding="unicode", short_empty_elements=False)
