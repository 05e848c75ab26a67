"""Every public function, each of its arguments, values of the wrong kind: a sentence, nothing else.

The functions are called with arguments that are right but for one; what is right needs not be known, because a wrong
argument is refused before anything is computed.
"""

import copy
import inspect
import math
import pickle
import warnings
from pathlib import Path

import numpy as np
import pint
import pytest

import ucrit
from ucrit import UcritError, load
from ucrit.core.asked import _kinds

FUNCTIONS = {name: getattr(ucrit, name) for name in ucrit._PUBLIC if inspect.isfunction(getattr(ucrit, name))}


CARAVAN = load("caravan")


class Odd:
    """Nothing that any function takes."""


WRONG = (None, "x", -1, True, math.nan, 10**400, 1j, b"x", [], ["a", 1], [math.nan], {1: 2}, Odd(), int, np.array([]))


def arguments():
    """Every argument whose kind is declared, with the kinds of each."""
    for name, function in FUNCTIONS.items():
        for argument in inspect.signature(function).parameters.values():
            kinds = _kinds(str(argument.annotation))
            if kinds is not None:
                yield pytest.param(name, argument, kinds, id=f"{name}-{argument.name}")


def called(name, argument, value):
    """Call a function with one wrong argument, which is read before the others that it needs."""
    declared = inspect.signature(FUNCTIONS[name]).parameters.values()
    first = [p for p in declared if p.kind in (p.POSITIONAL_ONLY, p.VAR_POSITIONAL)]
    if argument in first:
        return FUNCTIONS[name](*(value if p.name == argument.name else right(p) for p in first))
    named = {p.name for p in declared if p.kind in (p.POSITIONAL_OR_KEYWORD, p.KEYWORD_ONLY) and p.default is p.empty}
    return FUNCTIONS[name](
        *map(right, first), **{word(argument): value}, **dict.fromkeys(named - {argument.name}, CARAVAN)
    )


def right(argument):
    """A right value of an argument that has no name."""
    return CARAVAN if "Model" in str(argument.annotation) else "x"


def word(argument):
    """What the message calls an argument: itself, or a parameter among ``**ranges``."""
    return "m" if argument.kind is argument.VAR_KEYWORD else argument.name


@pytest.mark.parametrize(("name", "argument", "kinds"), list(arguments()))
def test_a_value_of_the_wrong_kind_is_refused_in_a_sentence(name, argument, kinds):
    wrong = [v for v in WRONG if v is not argument.default and not any(kind.fits(v) for kind in kinds)]
    assert wrong, "nothing is wrong for it"
    for value in wrong:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with pytest.raises(UcritError) as caught:
                called(name, argument, value)
        sentence = str(caught.value)
        assert sentence.startswith(f"{FUNCTIONS[name].__qualname__}: {word(argument)} must be ")
        assert "\n" not in sentence
        assert len(sentence) < 250


def test_most_arguments_declare_a_kind():
    everything = [p for f in FUNCTIONS.values() for p in inspect.signature(f).parameters.values()]
    assert len(list(arguments())) > 0.85 * len(everything)


def test_a_misspelt_argument_gets_a_near_match():
    tried = 0
    for function in FUNCTIONS.values():
        declared = inspect.signature(function).parameters.values()
        named = [p.name for p in declared if p.kind is p.KEYWORD_ONLY]
        if named and not any(p.kind is p.VAR_KEYWORD for p in declared):
            told = rf"{function.__qualname__}\(\) has no argument '{named[0]}x'; did you mean '{named[0]}'"
            with pytest.raises(TypeError, match=told):
                function(**{f"{named[0]}x": 1})
            tried += 1
    assert tried > 20


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_can_be_sent_to_other_processes(name):
    assert pickle.loads(pickle.dumps(FUNCTIONS[name])) is FUNCTIONS[name]


def test_a_name_in_place_of_a_vehicle_is_told_how_to_load_it():
    with pytest.raises(UcritError, match=r"modes: vehicle must be a vehicle, .* got 'caravan'; load\('caravan'\)"):
        ucrit.modes("caravan")


def test_numbers_of_other_kinds_are_numbers():
    caravan, unit = load("caravan"), pint.UnitRegistry()
    for mass in (np.int64(1100), np.float32(1100), np.array(1100.0), unit.Quantity(1.1, "t"), "1.1 t"):
        assert caravan.with_(m=mass) == caravan.with_(m=1100)
    many = unit.Quantity(np.array([1.0, 1.1]), "t")
    np.testing.assert_allclose(caravan.with_(m=many).values["m"], [1000, 1100])
    with pytest.raises(UcritError, match="mass m is measured in kg, got '3 meter'"):
        caravan.with_(m=unit.Quantity(3, "m"))
    assert ucrit.critical(caravan, "U", "36 km/h", np.array(40.0)) == ucrit.critical(caravan, "U", 10, 40)
    assert ucrit.remedies(caravan, "90 km/h")[0] == ucrit.remedies(caravan, 25)[0]


@pytest.mark.parametrize(
    ("text", "meant"),
    [("80 kmh", "did you mean 'km/h'"), ("80,5 km/h", "the decimal sign is a point"), ("80 KM/H", "'km/h'")],
)
def test_units_and_numbers_that_are_mistyped(text, meant):
    with pytest.raises(UcritError, match=meant):
        ucrit.analyze("caravan", upto=text)


RESULTS = {
    "analyze": lambda v: ucrit.analyze(v),
    "modes": lambda v: ucrit.modes(v.with_(U=[10, 20])),
    "locus": lambda v: ucrit.locus(v, points=40),
    "sweep": lambda v: ucrit.sweep(v, U=[10, 20], c=[0, 4000]),
    "map": lambda v: ucrit.stability_map(v, U=[10, 20], c=[0, 4000]),
    "simulate": lambda v: ucrit.simulate(v, 1, {"theta": 0.01}),
    "uncertainty": lambda v: ucrit.uncertainty(v, samples=8),
    "certify": lambda v: ucrit.certify(v, U=(5, 30)),
    "critical": lambda v: ucrit.critical(v),
    "step": lambda v: ucrit.step_response(load("understeering-car"), "delta_f"),
    "bonds": lambda v: ucrit.bonds("oscillator"),
    "limit": lambda v: ucrit.limit(v, k=math.inf),
    "trim": lambda v: ucrit.trim(load("navion-from-geometry")),
    "handling": lambda v: ucrit.handling_diagram(load("spinning-car")),
    "family": lambda v: ucrit.steady_family(load("spinning-car"), "a_y", 2, free="delta_f"),
    "tire": lambda v: ucrit.tire_curves(ucrit.tire("brush", C=80_000, mu=0.9)),
    "cycles": lambda v: _cycles(),
    "branch": lambda v: _cycles().branches[0],
    "cycle": lambda v: _cycles().at(21)[0],
    "boundary": lambda v: ucrit.boundary(v, c=(0, 4000), U=(5, 30)),
    "percussion": lambda v: ucrit.percussion(load("understeering-car"), "delta_f"),
    "steady turn": lambda v: ucrit.steady_turn(load("understeering-car")),
    "transfer": lambda v: ucrit.transfer(load("understeering-car"), "delta_f", "r"),
    "frequency": lambda v: ucrit.frequency_response(load("understeering-car"), "delta_f"),
}
"""Some do without the vehicle: they are the same for another."""


def _cycles():
    return ucrit.limit_cycles(load("nose-gear", {"k": -10}), upper=22)


OF_THE_CARAVAN = (
    *("analyze", "modes", "locus", "sweep", "map", "simulate", "uncertainty", "certify", "critical", "boundary"),
)


@pytest.mark.parametrize("name", RESULTS)
def test_results_can_be_kept_compared_and_read(name):
    caravan = load("caravan")
    result = RESULTS[name](caravan)
    for same in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result), RESULTS[name](caravan)):
        assert same == result
        assert hash(same) == hash(result)
        assert repr(same) == repr(result)
        if hasattr(result, "table"):
            assert same.table() == result.table()
    assert result != 3
    assert len(repr(result)) < 1500
    other = RESULTS[name](caravan.with_(m=1100))
    assert (other == result) == (name not in OF_THE_CARAVAN)


def test_paths_that_are_no_file(tmp_path: Path):
    found = ucrit.sweep(load("caravan"), U=[10, 20])
    with pytest.raises(UcritError, match="cannot be written: it is a folder"):
        found.to_csv(tmp_path)
    found.to_csv("/dev/null")
    assert Path("/dev/null").is_char_device()


CLASSES = {
    name: getattr(ucrit, name)
    for name in ucrit._PUBLIC
    if inspect.isclass(getattr(ucrit, name)) and "__dataclass_fields__" in vars(getattr(ucrit, name))
}


@pytest.mark.parametrize("name", CLASSES)
def test_a_misspelt_argument_of_a_class_gets_a_near_match(name):
    cls = CLASSES[name]
    first = next(iter(inspect.signature(cls).parameters))
    with pytest.raises(TypeError, match=rf"{name}\(\) has no argument '{first}x'; (did you mean|allowed:)"):
        cls(**{f"{first}x": 1})
    with pytest.raises(TypeError, match=rf"{name}\(\) lacks the argument"):
        cls()
    assert pickle.loads(pickle.dumps(cls)) is cls
