"""Bond graphs as text: one declaration, element, junction or bond a line.

::

    title Mass on a spring with dry friction        # what comes after # is a remark
    param m [kg] above 0: mass
    param k [N/m] above 0: stiffness
    param F_0 [N] at_least 0 default 0: friction
    param v_0 [m/s] above 0: velocity at which friction is fully there
    input F [N]: force

    1 x
    I mass = m                                      # one number: momentum = m*flow
    C spring = 1/k                                  # displacement = effort/k
    R friction: effort = F_0*tanh(flow/v_0)         # any other law
    Se push = F
    push -> x -> mass
    x -> spring
    x -> friction

A field has a matrix, ``I body = [m, 0; 0, m]``, or laws ``effort_1 = ...; effort_2 = ...``. Laws read other elements
as ``f.x``, ``e.x``, ``p.x``, ``q.x``, and ports of fields as ``p.body.2``. ``speed U: forward speed`` declares the
speed, ``speed U reverse: ...`` one that may be negative, ``speed U default 20: ...`` one with a value.

Laws with corners and branches are written with ``abs``, ``min``, ``max`` and ``where(condition, then, otherwise)``;
conditions are comparisons joined by ``and``, ``or`` and ``not``.
"""

from __future__ import annotations

import keyword
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from ..core.contract.declare import Input, Parameter, param, speed
from ..core.errors import ModelError, UcritError, near_match
from .elements import JUNCTIONS, KINDS, MODULATED, SOURCES, TWO_PORTS, Element
from .graph import ARROW, Graph
from .laws import TAKES, VARIABLES, Law, linear_law, placeholders, reading

DECLARATIONS = ("title", "param", "speed", "input")
READING = re.compile(r"\b([efpq])\.([A-Za-z_]\w*)(?:\.(\d+))?")
PARAM = re.compile(r"(\w+)\s*\[([^\]]*)\]\s*([^:]*):\s*(.+)")
BOND = re.compile(r"\w+(\s*->\s*\w+)+")
BOUNDS = ("above", "below", "at_least", "at_most", "default")


@dataclass(frozen=True)
class Sheet:
    """What a text holds: a title, declared quantities by name, and the numbered lines that state the graph."""

    where: str
    title: str
    parameters: Mapping[str, Parameter]
    inputs: Mapping[str, Input]
    lines: tuple[tuple[int, str], ...]

    def graph(self, names: Mapping[str, Any]) -> Graph:
        """Return the graph; ``names`` gives the meaning of the parameters' and inputs' names."""
        parts: list[Element | str] = []
        line_of: dict[str, int] = {}
        bond_lines: list[int] = []
        for number, text in self.lines:
            with_line = _Line(f"{self.where}, line {number}")
            for part in with_line.do(_parts, text, names):
                if isinstance(part, Element) and part.name in line_of:
                    first = line_of[part.name]
                    raise ModelError(f"{with_line.where}: there is an element '{part.name}' in line {first} already")
                parts.append(part)
                if isinstance(part, Element):
                    line_of[part.name] = number
                else:
                    bond_lines += [number] * part.count(ARROW)
        if not parts:
            raise ModelError(f"{self.where}: there is no element")
        graph = Graph(*parts)
        for thing, fault in graph.faults():
            line = line_of[thing.name] if isinstance(thing, Element) else bond_lines[thing.number - 1]
            raise ModelError(f"{self.where}, line {line}: {fault}")
        return graph


@dataclass(frozen=True)
class _Line:
    """Puts the line before the message of an error."""

    where: str

    def do(self, work: Callable[..., Any], *arguments: Any) -> Any:
        try:
            return work(*arguments)
        except UcritError as error:
            raise ModelError(f"{self.where}: {error}") from None


def read_sheet(text: str, where: str = "bond graph") -> Sheet:
    """Read the declarations of a text and keep the rest, line by line."""
    title = ""
    parameters: dict[str, Parameter] = {}
    inputs: dict[str, Input] = {}
    lines = []
    for number, raw in enumerate(text.splitlines(), 1):
        line = raw.partition("#")[0].strip()
        word, _, rest = line.partition(" ")
        at = _Line(f"{where}, line {number}")
        if BOND.fullmatch(line):
            lines.append((number, line))
        elif word == "title":
            title = rest.strip()
        elif word in DECLARATIONS:
            name, quantity = at.do(_quantity, word, rest.strip())
            if name in parameters or name in inputs:
                raise ModelError(f"{at.where}: '{name}' is declared twice")
            (inputs if word == "input" else parameters)[name] = quantity
        elif line:
            lines.append((number, line))
    return Sheet(where, title, parameters, inputs, tuple(lines))


def read_graph(text: str, names: Mapping[str, Any] | None = None, where: str = "bond graph") -> Graph:
    """Read a bond graph from text, see the module's description.

    Parameters
    ----------
    text
        The lines.
    names
        Meaning of names in laws, such as SymPy symbols; those that the text declares by default.
    where
        What to call the text in messages.

    Raises
    ------
    ModelError
        Naming the line that is wrong.

    Examples
    --------
    >>> from ucrit.bondgraph.writing import write_graph
    >>> graph = read_graph("1 x\\nI mass = 3\\nC spring = 0.5\\nx -> mass\\nx -> spring")
    >>> print(write_graph(graph))
    1 x
    I mass = 3
    C spring = 1/2
    x -> mass
    x -> spring
    """
    sheet = read_sheet(text, where)
    return sheet.graph(declared_symbols(sheet) if names is None else names)


def declared_symbols(sheet: Sheet, direction: int | None = 1) -> dict[str, Any]:
    """Return the symbols of what a text declares, by name."""
    import sympy as sp

    from ..core.derivation.trace import parameter_symbol

    symbols = {name: parameter_symbol(_named(p, name), direction) for name, p in sheet.parameters.items()}
    return symbols | {name: sp.Symbol(name, real=True) for name in sheet.inputs}


def _named(parameter: Parameter, name: str) -> Parameter:
    return replace(parameter, name=name)


def _quantity(word: str, rest: str) -> tuple[str, Any]:
    if word == "speed":
        return _speed(rest)
    match = PARAM.fullmatch(rest)
    if match is None:
        raise ModelError(f"a quantity is declared by '{word} m [kg]: meaning', got '{word} {rest}'")
    name, unit, bounds, meaning = match.groups()
    if word == "input":
        if bounds.strip():
            raise ModelError(f"an input has no bounds, got '{bounds.strip()}'")
        return _checked(name), Input(unit, meaning)
    return _checked(name), param(unit, meaning, **_bounds(bounds, BOUNDS))


def _speed(rest: str) -> tuple[str, Parameter]:
    head, colon, meaning = (part.strip() for part in rest.partition(":"))
    name, _, more = head.partition(" ")
    reverse, more = more.startswith("reverse"), more.removeprefix("reverse")
    if not colon or not name:
        raise ModelError(f"a speed is declared by 'speed U: forward speed' or 'speed U reverse: ...', got '{rest}'")
    default = _bounds(more, ("default",)).get("default")
    return _checked(name), replace(speed(meaning, reverse=reverse), default=default)


def _bounds(text: str, allowed: tuple[str, ...]) -> dict[str, float]:
    words, values = text.split(), {}
    for key, value in zip(words[::2], [*words[1::2], ""], strict=False):
        if key not in allowed:
            raise ModelError(f"there is no bound '{key}'{near_match(key, allowed)}")
        try:
            values[key] = float(value)
        except ValueError:
            raise ModelError(f"{key} must be followed by a number, got '{value}'") from None
    return values


def _checked(name: str) -> str:
    taken = name in VARIABLES or re.sub(r"_\d+$", "", name) in VARIABLES
    if not name.isidentifier() or keyword.iskeyword(name) or taken:
        why = "it stands for a variable of a law" if taken else "it is no name"
        raise ModelError(f"a quantity cannot be called '{name}', {why}")
    return name


def _parts(line: str, names: Mapping[str, Any]) -> list[Element | str]:
    if ARROW in line:
        if not BOND.fullmatch(line):
            raise ModelError(f"a bond is written 'a -> b', got '{line}'")
        return [line]
    kind, _, rest = line.partition(" ")
    if kind in JUNCTIONS:
        if not rest.split():
            raise ModelError(f"a {kind}-junction needs a name")
        return [Element(kind, name) for name in rest.split()]
    plain = MODULATED.get(kind, kind)
    if plain not in KINDS:
        words = (*KINDS, *MODULATED, *DECLARATIONS)
        raise ModelError(f"a line begins with a kind of element or is a bond, got '{kind}'{near_match(kind, words)}")
    return [_element(plain, rest.strip(), names)]


def _element(kind: str, rest: str, names: Mapping[str, Any]) -> Element:
    match = re.fullmatch(r"(\w+)\s*([:=])\s*(.+)", rest)
    if match is None:
        raise ModelError(f"an element is written '{kind} name = number' or '{kind} name: effort = ...', got '{rest}'")
    name, sign, law = match.groups()
    if kind in (*SOURCES, *TWO_PORTS):
        if sign == ":":
            raise ModelError(f"{kind} '{name}': write '{kind} {name} = ...'")
        gives = {"Se": "effort", "Sf": "flow"}.get(kind, "ratio")
        return Element(kind, name, Law(gives, "", (_expression(law, names, kind, name),)))
    if sign == "=":
        return Element(kind, name, linear_law(kind, _matrix(law, names, kind, name)))
    return Element(kind, name, _stated(kind, name, law, names))


def _expression(text: str, names: Mapping[str, Any], kind: str, name: str) -> Any:
    from ..core.formulas.expressions import LAWS, parse

    known = dict(names)
    for match in READING.finditer(text):
        variable, element, port = match.groups()
        key = f"{variable}.{element}" + (f"._{port}" if port else "")
        known[key] = reading(variable, element, int(port) if port else None)
    formula = READING.sub(lambda m: f"{m[1]}.{m[2]}" + (f"._{m[3]}" if m[3] else ""), text).replace("^", "**")
    return parse(formula, known, f"{kind} '{name}'", LAWS)


def _matrix(law: str, names: Mapping[str, Any], kind: str, name: str) -> Any:
    if not law.startswith("["):
        return _expression(law, names, kind, name)
    if not law.endswith("]"):
        raise ModelError(f"{kind} '{name}': a matrix is written [a, b; c, d], got {law}")
    rows = [[_expression(x, names, kind, name) for x in row.split(",")] for row in law[1:-1].split(";")]
    if any(len(row) != len(rows) for row in rows):
        raise ModelError(f"{kind} '{name}': a field needs a square matrix, got {law}")
    return rows


def _stated(kind: str, name: str, law: str, names: Mapping[str, Any]) -> Law:
    sides = [piece.partition("=")[::2] for piece in law.split(";")]
    left = [side.strip() for side, _ in sides]
    gives = re.sub(r"_1$", "", left[0])
    expected = [gives] if len(left) == 1 else [f"{gives}_{k}" for k in range(1, len(left) + 1)]
    if gives not in TAKES[kind] or left != expected:
        ways = " or ".join(f"{g} = ..." for g in TAKES[kind])
        raise ModelError(f"{kind} '{name}': its law is {ways}, numbered in a field, got '{law}'")
    taken = placeholders(TAKES[kind][gives], len(left))
    known = {**names, **{symbol.name: symbol for symbol in taken}}
    return Law(gives, TAKES[kind][gives], tuple(_expression(x, known, kind, name) for _, x in sides))
