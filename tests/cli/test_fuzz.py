"""Whatever a file holds and whatever is typed: an answer or one sentence, never a traceback."""

from __future__ import annotations

import os
import string
import tempfile
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from ucrit.catalogue import VEHICLES
from ucrit.cli.app import cli

Run = Callable[..., Result]
SOURCES = [path.read_text(encoding="utf-8") for path in sorted(VEHICLES.glob("*.toml"))]
SMALL = [(VEHICLES / f"{name}.toml").read_text(encoding="utf-8") for name in ("caravan", "bmw-320i")]

TOML_VALUES = st.recursive(
    st.one_of(
        st.integers(-(10**400), 10**400).map(str),
        st.floats().map(repr),
        st.booleans().map(lambda b: str(b).lower()),
        st.text(string.printable, max_size=12).map(lambda t: "'" + t + "'"),
        st.sampled_from(['"3 kg"', '"9 9**9**9"', '"1e999 kg"', '"\\u001b[31m"', "1979-05-27", "07:32:00", "0x1F"]),
    ),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3).map(lambda v: "[" + ", ".join(v) + "]"),
        st.dictionaries(st.sampled_from("abc"), inner, max_size=2).map(
            lambda d: "{" + ", ".join(f"{k} = {v}" for k, v in d.items()) + "}"
        ),
    ),
    max_leaves=4,
)
KEYS = st.sampled_from(
    ["model", "name", "source", "note", "parameters", "m", "a", "b", "C", "U", "x.y", "[parameters]"]
)


def survives(content: bytes) -> None:
    """Analyze a file with some content: status 0, or 2 with one sentence."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "fuzzed.toml"
        path.write_bytes(content)
        result = CliRunner().invoke(cli, ["analyze", str(path)], catch_exceptions=False)
        assert os.listdir(folder) == ["fuzzed.toml"]
    assert result.exit_code in (0, 2)
    if result.exit_code == 2:
        assert result.stdout == ""
        assert len(result.stderr.splitlines()) == 1
        assert result.stderr.startswith("ucrit: ")
    else:
        assert result.stderr == ""


@given(st.binary(max_size=80))
@settings(max_examples=60)
def test_any_bytes(content: bytes) -> None:
    survives(content)


@given(st.lists(st.tuples(KEYS, TOML_VALUES), max_size=6))
@settings(max_examples=120, suppress_health_check=[HealthCheck.too_slow])
def test_lines_like_toml(lines: list[tuple[str, str]]) -> None:
    survives("\n".join(f"{key} = {value}" for key, value in lines).encode("utf-8", "surrogatepass"))


@given(st.sampled_from(SMALL), st.integers(0, 12), TOML_VALUES)
@settings(max_examples=120, suppress_health_check=[HealthCheck.too_slow])
def test_a_value_replaced(text: str, which: int, value: str) -> None:
    lines = text.splitlines()
    assigned = [i for i, line in enumerate(lines) if " = " in line]
    at = assigned[which % len(assigned)]
    lines[at] = lines[at].partition(" = ")[0] + " = " + value
    survives("\n".join(lines).encode())


@given(st.sampled_from(SMALL), st.data())
@settings(max_examples=80, suppress_health_check=[HealthCheck.too_slow])
def test_a_piece_cut_or_put_in(text: str, data: st.DataObject) -> None:
    start = data.draw(st.integers(0, len(text)))
    end = data.draw(st.integers(start, min(start + 30, len(text))))
    piece = data.draw(st.text(string.printable, max_size=5))
    survives((text[:start] + piece + text[end:]).encode())


@given(st.floats(-4, 4), st.sampled_from(["m", "I_c", "a", "b", "C", "k", "c", "U"]))
@settings(max_examples=40, suppress_health_check=[HealthCheck.too_slow])
def test_any_size_of_a_parameter(exponent: float, name: str) -> None:
    result = CliRunner().invoke(
        cli, ["analyze", "caravan", "--set", f"{name}={10**exponent!r}"], catch_exceptions=False
    )
    assert result.exit_code == 0
    assert result.stdout


@given(st.lists(st.text(max_size=12), max_size=4))
@settings(max_examples=100)
def test_any_words(words: list[str]) -> None:
    arguments = ["analyze", "caravan", *(f"--set={word}" for word in words), "--upto", "1 furlong"]
    result = CliRunner().invoke(cli, arguments, catch_exceptions=False)
    assert result.exit_code == 2
    assert len(result.stderr.splitlines()) == 1


@pytest.mark.parametrize("digits", [400, 5000])
def test_numbers_too_large_for_a_float(digits: int) -> None:
    survives(SMALL[0].replace("m = 1200", f"m = {'9' * digits}").encode())


def test_malformed_toml_names_the_line(run: Run, tmp_path: Path) -> None:
    (tmp_path / "bad.toml").write_text('model = "trailer"\n\n[parameters]\nm = 1\na == 2\n')
    result = run("analyze", tmp_path / "bad.toml")
    assert result.exit_code == 2
    assert "bad.toml: not valid TOML" in result.stderr
    assert "line 5" in result.stderr


def test_deeply_nested_toml(run: Run, tmp_path: Path) -> None:
    (tmp_path / "deep.toml").write_text("a = " + "[" * 100_000)
    result = run("analyze", tmp_path / "deep.toml")
    assert result.exit_code == 2
    assert "nested too deeply" in result.stderr or "not valid TOML" in result.stderr


@pytest.mark.parametrize("command", ["analyze", "show", "new", "check"])
def test_folders_missing_files_and_binary_files(command: str, run: Run, tmp_path: Path) -> None:
    (tmp_path / "image.toml").write_bytes(bytes(range(256)))
    for path, word in (
        (tmp_path, "folder"),
        (tmp_path / "none.toml", "no file"),
        (tmp_path / "image.toml", "text"),
    ):
        result = run(command, path)
        assert result.exit_code == 2
        assert str(path) in result.stderr
        assert word in result.stderr
        assert len(result.stderr.splitlines()) == 1
