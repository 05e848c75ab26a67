"""``ucrit routh``: the same as in Python, through the command line."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from click.testing import Result

import ucrit

Run = Callable[..., Result]


@pytest.mark.parametrize("polynomial", ["s^4 + 2 s^3 + 3 s^2 + 4 s + 5", "s^3 + 4 s^2 + 5 s + K"])
def test_prints_what_python_prints(run: Run, polynomial: str) -> None:
    result = run("routh", polynomial)
    assert result.exit_code == 0
    assert result.stdout == f"{ucrit.routh(polynomial)}\n"
    assert result.stderr == ""


def test_array_as_in_a_textbook(run: Run) -> None:
    lines = run("routh", "s^4 + 2 s^3 + 3 s^2 + 4 s + 5").stdout.splitlines()
    assert [line.split() for line in lines[2:7]] == [
        ["s^4", "|", "1", "3", "5"],
        ["s^3", "|", "2", "4"],
        ["s^2", "|", "1", "5"],
        ["s^1", "|", "-6"],
        ["s^0", "|", "5"],
    ]
    assert "roots in the right half plane: 2" in lines[7]


def test_symbols_and_their_signs(run: Run) -> None:
    result = run("routh", "m s^2 + c s + k", "--positive", "m, c")
    assert result.stdout.endswith("with m, c positive\nstable if and only if\n    k > 0\n")


def test_another_variable(run: Run) -> None:
    assert "z^2 + 3 z + 2" in run("routh", "(z + 1)(z + 2)", "--variable", "z").stdout


def test_rows_and_notes_name_the_variable(run: Run) -> None:
    lines = run("routh", "z^4 + z^3 + 5 z^2 + 4 z + 4", "--variable", "z").stdout.splitlines()
    assert [line.split()[0] for line in lines[2:7]] == ["z^4", "z^3", "z^2", "z^1", "z^0"]
    assert lines[7] == "row z^1 vanished; replaced by the derivative of the auxiliary polynomial z^2 + 4"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["s +"], "cannot be read"),
        (["x + 1"], "holds no s"),
        (["s + k", "--positive", "q"], "there is no symbol 'q'"),
        ([], "missing argument"),
    ],
)
def test_wrong_input_is_one_sentence(run: Run, arguments: list[str], words: str) -> None:
    result = run("routh", *arguments)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert len(result.stderr.splitlines()) == 1
    assert words in result.stderr
