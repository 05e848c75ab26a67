import pickle

import numpy as np
import pytest

from ucrit.core import Model, ModelError, UcritError, coordinate, param, speed, state


class Slider(Model):
    """A mass on a spring, pulled along (a source)."""

    m: float = param("kg", "mass", above=0)
    k: float = param("N/m", "stiffness", at_least=0, default=100.0)
    phi: float = param("rad", "slope", above=-1, below=1, default=0.0)
    U: float = speed("speed", reverse=True)

    x = coordinate("m", "displacement")

    def equations(self, x, ddx):
        return self.m * ddx.x + self.k * x.x


def test_parameters_are_read_in_order_with_defaults():
    slider = Slider(m=2, U="36 km/h")
    assert dict(slider.values) == {"m": 2.0, "k": 100.0, "phi": 0.0, "U": 10.0}
    assert list(Slider.declaration.parameters) == ["m", "k", "phi", "U"]


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"m": -5, "U": 1}, "Slider: mass m must be above 0 kg, got -5 kg"),
        ({"m": 0, "U": 1}, "Slider: mass m must be above 0 kg, got 0 kg"),
        ({"m": 1, "k": -1, "U": 1}, "Slider: stiffness k must be at least 0 N/m, got -1 N/m"),
        ({"m": 1, "phi": 1, "U": 1}, "Slider: slope phi must be above -1 rad and below 1 rad, got 1 rad"),
        ({"m": float("nan"), "U": 1}, "Slider: mass m must be finite, got nan"),
        ({"m": float("inf"), "U": 1}, "Slider: mass m must be finite, got inf"),
        ({"U": 1}, "Slider: mass m is missing; it must be above 0 kg"),
        ({"m": 1, "U": 0}, "Slider: speed U must be other than 0 m/s, got 0 m/s"),
        ({"m": 1, "U": 1, "mm": 2}, "Slider: there is no parameter 'mm'; did you mean 'm'?"),
        ({"m": [1, -2], "U": 1}, "Slider: mass m must be above 0 kg, got -2 kg"),
        ({"m": [], "U": 1}, "Slider: mass m must be a number or a one-dimensional array, got shape (0,)"),
        (
            {"m": [[1]], "U": 1},
            "Slider: mass m must be a number or a one-dimensional array, got shape (1, 1)",
        ),
        ({"m": "5 m", "U": 1}, "Slider: mass m is measured in kg, got '5 m'"),
        ({"m": None, "U": 1}, "Slider: mass m is missing; it must be above 0 kg"),
        ({"m": True, "U": 1}, "Slider: mass m must be a number or a text with a unit, got True"),
        ({"m": {"a": 1}, "U": 1}, "Slider: mass m must be a number or an array of numbers, got {'a': 1}"),
    ],
)
def test_impossible_values_are_refused_in_one_sentence(values, sentence):
    with pytest.raises(UcritError) as caught:
        Slider(**values)
    assert str(caught.value) == sentence


def test_vehicles_do_not_change():
    slider = Slider(m=1, U=1)
    with pytest.raises(AttributeError, match="with_"):
        slider.m = 2
    array = Slider(m=[1.0, 2.0], U=1)
    with pytest.raises(ValueError, match="read-only"):
        array.m[0] = 5
    with pytest.raises(TypeError):
        slider.values["m"] = 5


def test_copies_keep_what_is_not_changed():
    slider = Slider(m=1, U=1).with_info(name="a", source="b")
    copy = slider.with_(m="2 t")
    assert (copy.m, copy.k, copy.info.name) == (2000.0, 100.0, "a")
    assert slider.m == 1
    with pytest.raises(UcritError, match="did you mean 'm'"):
        slider.with_(M=1)


def test_array_parameters_span_named_dimensions_in_declared_order():
    slider = Slider(U=[1, 2, 3, 4], m=[1, 2, 3])
    assert {name: d.size for name, d in slider.dims.items()} == {"m": 3, "U": 4}
    m, k, _, U = slider.arguments()
    assert m.shape == (3, 1)
    assert U.shape == (1, 4)
    assert k == 100.0


def test_arrays_along_one_dimension_vary_together():
    slider = Slider(m=1, U=1).along("sample", m=[1, 2, 3], k=[4, 5, 6])
    assert list(slider.dims) == ["sample"]
    assert slider.arguments()[1].shape == (3,)
    with pytest.raises(UcritError, match="one length"):
        slider.along("sample", m=[1, 2], k=[1, 2, 3])
    with pytest.raises(UcritError, match="arrays"):
        slider.along("sample", m=1.0)


def test_vehicles_compare_hash_pickle_and_print():
    slider = Slider(m=[1, 2], U=3)
    assert pickle.loads(pickle.dumps(slider)) == slider
    assert hash(slider) == hash(Slider(m=[1, 2], U=3))
    assert slider != Slider(m=[1, 3], U=3)
    assert repr(slider) == "Slider(m=[1 ... 2, 2 values], k=100, phi=0, U=3)"
    assert ">stiffness</td>" in slider._repr_html_()


def test_a_subclass_may_fix_or_remove_a_parameter():
    class Fixed(Slider):
        """Fixed (a source)."""

        k = 50.0

    assert "k" not in Fixed.declaration.parameters
    assert Fixed(m=1, U=1).k == 50.0
    with pytest.raises(UcritError, match="no parameter 'k'"):
        Fixed(m=1, k=3, U=1)


def test_signature_lists_the_parameters():
    import inspect

    assert str(inspect.signature(Slider)) == "(*, m: float, k: float = 100.0, phi: float = 0.0, U: float)"


def declare(**body):
    return type("Wrong", (Model,), body)


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ({"values": param("m", "a length")}, "that name is taken"),
        ({"_m": param("m", "a length")}, "that name is taken"),
        ({"U": speed(), "W": speed()}, "only one parameter can be the speed"),
        ({"x": state("m", "x")}, "state the motion by one of"),
        (
            {"x": state("m", "x"), "equations": lambda self, x, ddxx: 0},
            "no argument 'ddxx'; did you mean 'ddx'?",
        ),
    ],
)
def test_wrong_declarations_are_refused(body, message):
    with pytest.raises(ModelError, match=message.replace("?", r"\?")):
        declare(**body)


def test_bounds_that_exclude_everything_are_refused():
    with pytest.raises(ModelError, match="no number is above 2 m and below 1 m"):
        param("m", "length", above=2, below=1)


def test_values_are_float_arrays_of_their_own():
    source = np.array([1, 2])
    slider = Slider(m=source, U=1)
    source[0] = 99
    assert slider.m.tolist() == [1.0, 2.0]
