"""Formulas for the page, from SymPy's MathML and from text."""

from xml.etree import ElementTree

from ucrit.report import formulas


def test_long_sums_are_broken_before_signs():
    terms = "<mo>+</mo>".join(f"<mi>abcdefghij{chr(97 + i)}</mi>" for i in range(20))
    root = ElementTree.fromstring(formulas.formula(f"<mrow>{terms}</mrow>", "> 0"))
    rows = ["".join(row.itertext()) for row in root.iter("mtr")]
    assert len(rows) > 1
    assert "".join(rows) == "".join(ElementTree.fromstring(f"<m>{terms}</m>").itertext()) + ">0"
    assert all(row.startswith("+") for row in rows[1:])
    assert all(len(row) <= formulas.LINE + 2 for row in rows)


def test_text_becomes_a_formula():
    root = ElementTree.fromstring(formulas.from_text("C*(a + b)**2*k - 2*I_c/3"))
    assert "".join(root.itertext()).replace(formulas.INVISIBLE_TIMES, "") == f"C(a+b)2k{formulas.MINUS}2Ic3"
    assert [element.tag for element in root.iter() if element.tag in ("msup", "msub", "mfrac")] == [
        "msup",
        "mfrac",
        "msub",
    ]


def test_a_negative_sum_keeps_its_brackets():
    root = ElementTree.fromstring(formulas.from_text("a - (b - c)"))
    assert "".join(root.itertext()) == f"a{formulas.MINUS}(b{formulas.MINUS}c)"


def test_functions_keep_their_distance_and_low_brackets_their_size():
    given = "<mi>C</mi><mrow><mi>cos</mi><mrow><mo>(</mo><mi>x</mi><mo>)</mo></mrow></mrow>"
    tall = "<mrow><mo>(</mo><mfrac><mi>a</mi><mi>b</mi></mfrac><mo>)</mo></mrow>"
    root = ElementTree.fromstring(formulas.formula(given + tall))
    cosine = next(e for e in root.iter() if e.text == "cos")
    assert (cosine.tag, cosine.get("lspace")) == ("mo", "0.17em")
    assert [e.get("stretchy") for e in root.iter() if e.text in ("(", ")")] == ["false", "false", None, None]
