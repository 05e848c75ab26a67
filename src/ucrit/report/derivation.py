"""The steps from the equations of motion to the conditions for stability, in words and formulas."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from markupsafe import Markup

from ..plots.labels import unit_text
from . import formulas

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..analyses.about.show import Formula, Matrix, ModelDescription
    from ..core.contract.declare import Quantity


@dataclass(frozen=True)
class Step:
    """One step: what is done, the formulas it gives, what screen readers call them, a remark."""

    text: str | Markup
    label: str
    formulas: tuple[Markup, ...]
    note: str = ""


def steps(described: ModelDescription) -> list[Step]:
    """Return the derivation of a model, step by step."""
    found = [_motion(described), _linear(described)]
    if described.inputs:
        found.append(_inputs(described))
    return [*found, _polynomial(described), _conditions(described)]


def _named(quantities: Sequence[Quantity]) -> Markup:
    """List quantities as symbol, meaning and unit."""
    entries = [
        Markup('<span class="whole">{},</span> {} [{}]').format(
            formulas.symbol(q.name), q.meaning, unit_text(q.unit) or "1"
        )
        for q in quantities
    ]
    return Markup("; ").join(entries)


def _printed(parts: Sequence[Formula], left: Sequence[str] | None = None) -> tuple[tuple[Markup, ...], str]:
    """Typeset formulas but the too long ones, with a remark that counts these."""
    shown = []
    for i, part in enumerate(parts):
        if not formulas.too_long(part.text, formulas.LONGEST // 2):
            shown.append(formulas.formula(part.mathml, "= 0", "" if left is None else left[i]))
    missing = len(parts) - len(shown)
    note = f"{missing} of {len(parts)} formulas are too long to print; ucrit.show returns them." if missing else ""
    return tuple(shown), note


def _motion(described: ModelDescription) -> Step:
    shown, note = _printed(described.equations)
    if described.definitions:
        left = [formulas.symbol_mathml(name) for name in described.definitions]
        defined, more = _printed(tuple(described.definitions.values()), left)
        shown, note = (*shown, *defined), " ".join(text for text in (note, more) if text)
    told = [note, described.notes]
    return Step(
        Markup("The equations of motion, with a dot for each time derivative. Unknowns are {}.").format(
            _named(described.variables)
        ),
        "Equations of motion",
        shown,
        " ".join(text for text in told if text),
    )


def _linear(described: ModelDescription) -> Step:
    unknowns = [[formulas.symbol_mathml(name)] for name in described.unknowns]
    shown = [
        formulas.equality(_sum(len(described.P)), "<mi>Q</mi><mi>u</mi>" if described.inputs else "<mn>0</mn>"),
        formulas.equality("<mi>q</mi>", formulas.matrix(unknowns)),
    ]
    missing = 0
    for k, P in enumerate(described.P):
        if _too_long(P):
            missing += 1
        else:
            shown.append(formulas.equality(formulas.symbol_mathml(f"P_{k}"), _cells(P)))
    return Step(
        "Differentiated with respect to each unknown and its rates, and evaluated on the basic motion, "
        "they become linear.",
        "Linear equations",
        tuple(shown),
        f"{missing} matrices are too long to print; ucrit.show returns them." if missing else "",
    )


def _sum(count: int) -> str:
    """MathML of ``P_0 q + P_1 q' + ...``."""
    terms = [formulas.symbol_mathml(f"P_{k}") + formulas.symbol_mathml("q" + "'" * k) for k in range(count)]
    return "<mo>+</mo>".join(terms)


def _inputs(described: ModelDescription) -> Step:
    long = _too_long(described.Q)
    shown = () if long else (formulas.equality("<mi>Q</mi>", _cells(described.Q)),)
    note = "The matrix is too long to print; ucrit.show returns it." if long else ""
    text = Markup("The inputs, {}, act through Q. They do not touch stability.").format(_named(described.inputs))
    return Step(text, "Input matrix", shown, note)


def _polynomial(described: ModelDescription) -> Step:
    left = [formulas.symbol_mathml(f"a_{k}") for k in range(len(described.polynomial))]
    shown, note = _printed(described.polynomial, left)
    s, term = (
        formulas.symbol("s"),
        formulas.inline(formulas.symbol_mathml("a_k") + "<msup><mi>s</mi><mi>k</mi></msup>"),
    )
    text = Markup(
        "A motion that goes as exp({} t) is possible where the determinant of the matrices, each times its "
        "power of {}, vanishes. Freed of denominators and common factors it is the characteristic "
        "polynomial, the sum of {} with"
    )
    return Step(
        text.format(s, s, term),
        "Characteristic polynomial",
        shown,
        note,
    )


def _conditions(described: ModelDescription) -> Step:
    found = described.criteria
    if found is None or found.free is not None:
        return Step("The conditions on these coefficients in symbols are too long to be of use.", "Conditions", ())
    text = (
        "All its roots lie in the left half plane if and only if the coefficients and every second Hurwitz "
        "determinant are positive. Each is factored; factors that are positive for all allowed parameters "
        "are dropped"
    )
    if found.zeros:
        text += f"; {_count(found.zeros)} zero whatever the parameters, a free position or speed, and divided out first"
    if found.settled is not None:
        return Step(f"{text}. Nothing is left that depends on the parameters.", "Conditions", ())
    return Step(f"{text}. What is left stands above under Criteria.", "Conditions", ())


def _count(zeros: int) -> str:
    return "one root is" if zeros == 1 else f"{zeros} roots are"


def _cells(M: Matrix) -> str:
    return formulas.matrix([[entry.mathml for entry in row] for row in M])


def _too_long(M: Matrix) -> bool:
    return sum(len(entry.text) for row in M for entry in row) > formulas.LONGEST
