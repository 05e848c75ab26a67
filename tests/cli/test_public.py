"""The names of the package: all importable, the same for type checkers as at run time."""

from __future__ import annotations

import ast
from pathlib import Path

import ucrit


def typed_names() -> set[str]:
    tree = ast.parse(Path(ucrit.__file__).read_text(encoding="utf-8"))
    block = next(node for node in tree.body if isinstance(node, ast.If))
    return {
        alias.asname or alias.name for node in block.body if isinstance(node, ast.ImportFrom) for alias in node.names
    }


def test_type_checkers_see_the_names_that_exist() -> None:
    assert typed_names() == set(ucrit._PUBLIC)


def test_every_name_is_there() -> None:
    for name in ucrit._PUBLIC:
        assert getattr(ucrit, name) is not None
        assert name in dir(ucrit)


def test_commands_are_functions_of_the_same_name() -> None:
    from ucrit.cli.app import COMMANDS

    for name in COMMANDS:
        assert name == "completion" or callable(getattr(ucrit, name))


def test_listing_prints_and_refuses() -> None:
    listing = ucrit.list()
    assert "caravan" in listing
    assert "  trailer " in str(listing)
    assert ">caravan</th>" in listing._repr_html_()
