"""Promises about the package itself: documented names, refused misspellings, no vehicle named twice."""

import importlib
import inspect
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest

import ucrit
from ucrit import UcritError

ROOT = Path(__file__).parent.parent
PUBLIC = sorted(ucrit._PUBLIC)
FUNCTIONS = [name for name in PUBLIC if inspect.isfunction(getattr(ucrit, name))]
PHYSICS = ("ucrit.models", "ucrit.parts")


def modules():
    for info in pkgutil.walk_packages(ucrit.__path__, "ucrit."):
        if not info.name.endswith("__main__"):
            yield importlib.import_module(info.name)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_argument_of_a_public_function_is_documented(name):
    function = getattr(ucrit, name)
    text = inspect.getdoc(function)
    assert re.match(r"[A-Z].*\.$", text.splitlines()[0])
    missing = [p for p in inspect.signature(function).parameters if not re.search(rf"\b{p}\b", text)]
    assert not missing, f"{name} does not explain {missing}"


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_misspelt_argument_is_refused(name):
    with pytest.raises((TypeError, UcritError)):
        getattr(ucrit, name)(ucrit.load("caravan"), no_such_argument=1)


def test_every_module_says_what_it_is_for():
    for module in modules():
        assert module.__doc__ or module.__name__.endswith("__init__"), f"{module.__name__} has no docstring"


def test_every_public_class_and_function_of_a_module_has_a_docstring():
    bare = [
        f"{module.__name__}.{name}"
        for module in modules()
        if not module.__name__.startswith(PHYSICS)
        for name, value in vars(module).items()
        if not name.startswith("_")
        and (inspect.isfunction(value) or inspect.isclass(value))
        and value.__module__ == module.__name__
        and not value.__doc__
    ]
    assert not bare


def test_importing_the_package_imports_nothing_heavy():
    heavy = {"numpy", "sympy", "scipy", "matplotlib", "rich", "click"}
    code = f"import sys, ucrit; print(sorted({heavy} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_no_model_knows_its_parameters_twice():
    """A parameter's unit and meaning stand in its declaration alone: a base class has it, or the model has."""
    for name in ucrit.catalogue.model_names():
        model = ucrit.find_model(name)
        for key, parameter in model.declaration.parameters.items():
            owners = [base for base in model.__mro__ if key in vars(base)]
            same = [base for base in owners[1:] if vars(base)[key] == vars(owners[0])[key]]
            assert not same, f"{name}: {key} ({parameter.meaning}) is declared again as it was"


def test_the_version_is_the_projects():
    text = (ROOT / "pyproject.toml").read_text()
    assert f'version = "{ucrit.__version__}"' in text
    assert ucrit.__version__ in (ROOT / "CHANGELOG.md").read_text()


def test_a_star_brings_all_public_names_but_hides_none_of_python():
    names: dict[str, object] = {}
    exec("from ucrit import *", names)
    assert {"load", "analyze", "Model"} <= names.keys()
    assert "list" not in names
