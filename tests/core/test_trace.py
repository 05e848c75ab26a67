import pytest
import sympy as sp

from ucrit.core import Model, ModelError, algebraic, coordinate, cos, input, output, param, sin, speed, state
from ucrit.core.derivation.linear import linear_system
from ucrit.core.derivation.trace import trace


class Pendulum(Model):
    """A pendulum on a trolley, by energies."""

    m: float = param("kg", "bob", above=0)
    M: float = param("kg", "trolley", above=0)
    l: float = param("m", "length", above=0)
    g: float = param("m/s^2", "gravity", above=0)

    x = coordinate("m", "trolley position")
    phi = coordinate("rad", "angle from hanging")
    F = input("N", "push on the trolley")

    def kinetic_energy(self, x, dx):
        horizontal = dx.x + self.l * cos(x.phi) * dx.phi
        vertical = self.l * sin(x.phi) * dx.phi
        return self.M * dx.x**2 / 2 + self.m * (horizontal**2 + vertical**2) / 2

    def potential_energy(self, x):
        return -self.m * self.g * self.l * cos(x.phi)

    def forces(self, x, dx, u):
        return ((u.F, dx.x),)


def test_lagrange_gives_the_textbook_equations():
    traced = trace(Pendulum)
    s = {str(k): k for e in traced.residuals for k in e.free_symbols}
    m, M, l, g, phi, dphi, F = (s[n] for n in ("m", "M", "l", "g", "phi", "phi'", "F"))
    ddx, ddphi = s["x''"], s["phi''"]
    expected = (
        (M + m) * ddx + m * l * (ddphi * sp.cos(phi) - dphi**2 * sp.sin(phi)) - F,
        m * l**2 * ddphi + m * l * ddx * sp.cos(phi) + m * g * l * sp.sin(phi),
    )
    for found, wanted in zip(traced.residuals, expected, strict=True):
        assert sp.simplify(found - wanted) == 0


def test_structural_zeros_are_found():
    assert linear_system(Pendulum).polynomial.zeros == 2


def make(equations, **body):
    common = {
        "m": param("kg", "mass", above=0),
        "U": speed(),
        "y": state("m", "position"),
        "F": input("N", "force"),
    }
    return type("Made", (Model,), {**common, **body, "equations": equations})


@pytest.mark.parametrize(
    ("equations", "message"),
    [
        (lambda self, x, dx: dx.y + x.y, "combines unlike units"),
        (lambda self, x, dx: dx.y - self.U * sin(x.y), "function of 'y', which has the unit m"),
        (lambda self, x, dx: dx.y - self.U * 2**x.y, "exponent"),
        (lambda self, x, dx: dx.y - self.U, "does not hold on the basic motion"),
        (lambda self, x, dx: dx.yy - self.U, "'dx.yy', which is not declared; did you mean 'y'"),
        (lambda self, x, dx: (dx.y, dx.y), "2 equations for 1 variables"),
        (lambda self, x, dx: 0 * dx.y, "not independent"),
    ],
)
def test_wrong_equations_are_refused(equations, message):
    with pytest.raises(ModelError, match=message):
        linear_system(make(equations)).polynomial  # noqa: B018


def test_outputs_have_to_match_their_declaration():
    right = make(lambda self, dx: dx.y, v=output("m/s", "rate"), outputs=lambda self, dx: {"v": dx.y})
    assert len(trace(right).outputs) == 1
    wrong = make(lambda self, dx: dx.y, v=output("m", "rate"), outputs=lambda self, dx: {"v": dx.y})
    with pytest.raises(ModelError, match="declared in m but comes out in m s\\^-1"):
        trace(wrong)
    missing = make(lambda self, dx: dx.y, v=output("m", "rate"), outputs=lambda self, dx: {"w": dx.y})
    with pytest.raises(ModelError, match="differ in v, w"):
        trace(missing)


def test_floats_become_exact_numbers():
    (residual,) = trace(make(lambda self, dx: 0.1 * dx.y)).residuals
    assert residual.atoms(sp.Number) == {sp.Rational(1, 10)}


def test_a_declared_basic_motion_is_where_the_equations_are_linearised():
    class Hinged(Model):
        """A pendulum standing up."""

        l: float = param("m", "length", above=0)
        g: float = param("m/s^2", "gravity", above=0)
        phi = coordinate("rad", "angle")

        def equations(self, x, ddx):
            return self.l * ddx.phi + self.g * sin(x.phi)

        def basic_motion(self):
            return {"x": {"phi": sp.pi}}

    a0, _, a2 = linear_system(Hinged).polynomial.expressions
    l, g = linear_system(Hinged).traced.parameters.values()
    assert sp.simplify(a0 / a2 + g / l) == 0


def test_an_algebraic_unknown_is_eliminated():
    class Lagged(Model):
        """Force through an algebraic unknown."""

        m: float = param("kg", "mass", above=0)
        k: float = param("N/m", "stiffness", above=0)
        y = coordinate("m", "position")
        N = algebraic("N", "spring force")

        def equations(self, x, ddx):
            return self.m * ddx.y - x.N, x.N + self.k * x.y

    system = linear_system(Lagged)
    assert system.explicit.orders == (2, 0)
    m, k = system.traced.parameters.values()
    assert system.polynomial.expressions == (k, 0, m)


def test_a_group_is_one_thing_to_polynomials_and_its_content_to_everything_else():
    import sympy as sp

    from ucrit.core.derivation.rings import function_symbols
    from ucrit.core.formulas import typeset
    from ucrit.core.formulas.functions import grouped

    a, b = sp.symbols("a b", positive=True)
    group = grouped(a / b + 1)
    assert len(function_symbols([3 * group**2 + a], {})[0]) == 1
    assert next(iter(function_symbols([group], {})[0].values())).is_positive
    assert sp.diff(group**2, a).subs({a: 2, b: 4}) == 2 * sp.Rational(3, 2) / 4
    assert float(group.subs({a: 2, b: 4})) == 1.5
    assert str(2 * group) == "2*(a/b + 1)"
    assert "Group" not in sp.latex(group) + sp.mathml(group, printer="presentation") + typeset.text(group)
    for module in ("numpy", "mpmath", "math"):
        assert sp.lambdify([a, b], 2 * group, module)(2, 4) == 3
