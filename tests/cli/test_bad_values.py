"""Every parameter of every model with values it cannot have: one sentence, status 2, nothing written."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

from ucrit.catalogue import find_model

from .values import EVERY, bad_values, sample, toml

Run = Callable[..., Result]


def refused(result: Result, folder: Path, *parts: str) -> None:
    """Assert that a command ended with one sentence that holds ``parts``, and left nothing behind."""
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    lines = result.stderr.splitlines()
    assert len(lines) == 1, lines
    assert lines[0].startswith("ucrit: ")
    assert "Traceback" not in lines[0]
    for part in parts:
        assert part in lines[0], (part, lines[0])
    assert not (folder / "out.html").exists()


def write(path: Path, name: str, values: dict[str, Any]) -> Path:
    rows = "\n".join(f"{key} = {toml(value)}" for key, value in values.items())
    path.write_text(f'model = "{name}"\n[parameters]\n{rows}\n')
    return path


@pytest.mark.parametrize(("name", "key"), EVERY, ids=[".".join(pair) for pair in EVERY])
def test_bad_value_in_a_file(name: str, key: str, run: Run, tmp_path: Path) -> None:
    model = find_model(name)
    parameter = model.declaration.parameters[key]
    for value in bad_values(parameter):
        path = write(tmp_path / "bad.toml", name, {**sample(model), key: value})
        result = run("analyze", path, "--report", tmp_path / "out.html")
        shown = str(value) if not isinstance(value, float) else f"{value:g}"
        named = "there is no entry" if isinstance(value, dict) else shown.split()[-1] if shown else "''"
        refused(result, tmp_path, f"{parameter.meaning} {key}", named)
        if isinstance(value, float) and abs(value) < 1e9:
            refused(result, tmp_path, parameter.allowed)


@pytest.mark.parametrize(("name", "key"), EVERY, ids=[".".join(pair) for pair in EVERY])
def test_bad_value_set_on_the_command_line(
    name: str, key: str, run: Run, tmp_path: Path, vehicle_file: Callable[[str], Path]
) -> None:
    parameter = find_model(name).declaration.parameters[key]
    texts = [f"{v:g}" if isinstance(v, float) else v for v in bad_values(parameter) if isinstance(v, float | str)]
    for text in texts:
        result = run("analyze", vehicle_file(name), "--set", f"{key}={text}", "--report", tmp_path / "out.html")
        refused(result, tmp_path, key, (text or f"'{key}='").split()[-1])


@pytest.mark.parametrize(("name", "key"), EVERY, ids=[".".join(pair) for pair in EVERY])
def test_missing_and_misspelt_parameters(name: str, key: str, run: Run, tmp_path: Path) -> None:
    model = find_model(name)
    parameter = model.declaration.parameters[key]
    misspelt = key + "_" if len(key) > 1 else key * 3
    values = sample(model)
    if parameter.default is None:
        path = write(tmp_path / "bad.toml", name, {k: v for k, v in values.items() if k != key})
        refused(run("analyze", path), tmp_path, f"{parameter.meaning} {key} is missing", parameter.allowed)
    path = write(tmp_path / "bad.toml", name, {**values, misspelt: 1.0})
    refused(run("analyze", path), tmp_path, f"no parameter '{misspelt}'", "did you mean" if len(key) > 1 else "")
    good = write(tmp_path / "good.toml", name, values)
    refused(run("analyze", good, "--set", f"{misspelt}=1"), tmp_path, f"no parameter '{misspelt}'")


@pytest.mark.parametrize(("name", "key"), EVERY[::5], ids=[".".join(pair) for pair in EVERY[::5]])
def test_empty_and_reversed_ranges(
    name: str, key: str, run: Run, tmp_path: Path, vehicle_file: Callable[[str], Path]
) -> None:
    for text in ("5:1", "3:3", "3", "", "1:2:0", "a:b", "1:2:3:4:5", "1:nan", "1:2:1e99"):
        result = run("sweep", vehicle_file(name), f"{key}={text}", "-o", tmp_path / "out.csv")
        refused(result, tmp_path, key, text.rpartition(":")[2])
        assert not (tmp_path / "out.csv").exists()
