"""The reduction to explicit form: its eigenvalues are the roots of the determinant, whatever is constrained."""

from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sp
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from ucrit.catalogue import find_model, load, model_names
from ucrit.core.derivation.characteristic import characteristic_polynomial
from ucrit.core.derivation.explicit import explicit
from ucrit.core.derivation.linear import LinearSystem
from ucrit.core.errors import ModelError, UcritError
from ucrit.core.numeric.compiled import coefficients, compiled, state_space


def system_of(matrices):
    n = matrices[0].rows
    model = SimpleNamespace(
        model_id=lambda: "random",
        declaration=SimpleNamespace(variables={f"q{i}": None for i in range(n)}, parameters={}),
    )
    return LinearSystem(
        SimpleNamespace(model=model, u=(), parameters={}),
        matrices,
        sp.zeros(n, 0),
        (sp.zeros(0, n),) * len(matrices),
        sp.zeros(0, 0),
    )


def eigenvalues_of(reduced):
    """Eigenvalues of ``L z = R w`` with exact numbers, from its own chains of integrators."""
    order = sum(reduced.orders)
    A = sp.zeros(order, order)
    if not order:
        return []
    z = reduced.L.LUsolve(reduced.R)
    row = 0
    for j, k in enumerate(reduced.orders):
        for i in range(k):
            if i + 1 < k:
                A[row, row + 1] = 1
            else:
                A[row, :] = z[j, :]
            row += 1
    s = sp.Symbol("s")
    return A.charpoly(s).all_coeffs()[::-1]


entry = st.sampled_from([0, 0, 0, 1, -1, 2, 3])


@settings(max_examples=150)
@given(
    st.integers(1, 3).flatmap(
        lambda n: st.lists(st.lists(entry, min_size=n * n, max_size=n * n), min_size=3, max_size=3).map(
            lambda m: (n, m)
        )
    )
)
def test_reduction_keeps_the_characteristic_polynomial(drawn):
    n, entries = drawn
    P = tuple(sp.Matrix(n, n, list(map(sp.Integer, e))) for e in entries)
    try:
        a = characteristic_polynomial(P).expressions
    except ModelError:
        s = sp.Symbol("s")
        assert sum((M * s**k for k, M in enumerate(P)), sp.zeros(n, n)).det().expand() == 0
        return
    reduced = explicit(system_of(P))
    assert sum(reduced.orders) == len(a) - 1
    assert reduced.L.det() != 0
    found = eigenvalues_of(reduced)
    if len(a) > 1:
        assert [sp.Rational(c) / a[-1] for c in a] == found


def test_dependent_equations_are_refused():
    P = (sp.zeros(2, 2), sp.Matrix([[1, 1], [2, 2]]), sp.zeros(2, 2))
    with pytest.raises(ModelError, match="not independent"):
        explicit(system_of(P))


@pytest.mark.parametrize("name", model_names())
def test_exact_coefficients_are_exact(name):
    """With fractions, A's determinant identity holds to the last digit, not to rounding."""
    functions = compiled(find_model(name))
    parameters = find_model(name).declaration.parameters
    values = [
        Fraction(k + 2, 7)
        if p.allows(float(Fraction(k + 2, 7)))
        else Fraction(str(p.upper if np.isfinite(p.upper) else 1)) / 2
        for k, p in enumerate(parameters.values())
    ]
    exact = functions.exact_coefficients(values)
    rounded = functions.coefficients([float(v) for v in values])
    assert [float(v) for v in exact] == pytest.approx([float(v) for v in rounded], rel=1e-12)
    assert all(isinstance(v, int | Fraction) for v in exact)


def test_speeds_of_both_signs_in_one_array():
    caravan = load("caravan")
    both = state_space(caravan.with_(U=[-5.0, 5.0])).A
    assert np.array_equal(both[0], state_space(caravan.with_(U=-5.0)).A)
    assert np.array_equal(both[1], state_space(caravan.with_(U=5.0)).A)
    a = coefficients(caravan.with_(U=[-5.0, 5.0]))
    held = a[0] * a[-1]
    assert held[0] < 0 < held[1]


def test_arrays_give_what_scalars_give():
    caravan = load("caravan")
    U, m = np.linspace(5, 40, 7), np.linspace(900, 1500, 5)
    stacked = state_space(caravan.with_(U=U, m=m)).A
    assert stacked.shape == (5, 7, 4, 4)
    assert stacked[3, 2] == pytest.approx(state_space(caravan.with_(U=U[2], m=m[3])).A, rel=1e-14)


def test_singular_parameters_are_refused():
    from ucrit.core import Model, param, state

    class Singular(Model):
        """Leading coefficient a - b (a source)."""

        a: float = param("s", "one time")
        b: float = param("s", "another time")
        x = state("m", "position")

        def equations(self, x, dx):
            return (self.a - self.b) * dx.x + x.x

    with pytest.raises(UcritError, match="cannot be solved"):
        state_space(Singular(a=1, b=1))
    assert state_space(Singular(a=2, b=1)).A.item() == -1


@given(st.floats(0.01, 100), st.floats(0.01, 100))
def test_roots_of_the_coefficients_are_eigenvalues(m, c):
    assume(abs(m - c) > 1e-6)
    caravan = load("caravan").with_(m=1200 * m, c=4000 * c)
    a = [float(v) for v in coefficients(caravan)]
    values = np.linalg.eigvals(state_space(caravan).A)
    terms = np.array([abs(x) * abs(values) ** k for k, x in enumerate(a)]).sum(axis=0)
    assert np.all(abs(np.polyval(a[::-1], values)) <= 1e-10 * terms)
