"""Real processes: pipes, colours, width, encodings, start-up time, completion."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from ucrit.catalogue import vehicle_names

START = "from ucrit.cli import main; main()"


def process(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    env = {**os.environ, "COLUMNS": "80", "PYTHONIOENCODING": "utf-8", **environment}
    command = [sys.executable, "-c", START, *arguments]
    return subprocess.run(command, capture_output=True, text=True, encoding="utf-8", env=env, timeout=120)


@pytest.mark.parametrize(
    "arguments",
    [
        ("analyze", "caravan"),
        ("analyze", "oversteering-car"),
        ("list",),
        ("show", "caravan"),
        ("show", "car"),
    ],
)
def test_piped_output_is_plain_and_fits_80_columns(arguments: tuple[str, ...]) -> None:
    done = process(*arguments)
    assert done.returncode == 0
    assert "\x1b" not in done.stdout
    for line in done.stdout.splitlines():
        assert len(line) <= 80, line
        assert line == line.rstrip()


def test_colours_only_where_wanted() -> None:
    assert "\x1b[" in process("analyze", "caravan", FORCE_COLOR="1", TERM="xterm").stdout
    coloured = "\x1b[1;31m"
    assert coloured in process("analyze", "caravan", FORCE_COLOR="1", TERM="xterm").stdout
    assert coloured not in process("analyze", "caravan", FORCE_COLOR="1", TERM="xterm", NO_COLOR="1").stdout


def test_encodings_without_the_signs() -> None:
    text = process("analyze", "caravan", PYTHONIOENCODING="ascii").stdout
    assert "+- 4.741j" in text
    assert text.isascii()


def test_control_characters_of_a_file_do_not_reach_the_terminal(tmp_path: Path) -> None:
    path = tmp_path / "sly.toml"
    path.write_text('model = "trailer-kinematic"\nname = "\\u001b[31mred"\n[parameters]\na = 1\nb = 1\nU = 1\n')
    assert "\x1b" not in process("analyze", str(path)).stdout
    path.write_text('model = "\\u001b[31mred"\n[parameters]\n')
    done = process("analyze", str(path))
    assert done.returncode == 2
    assert "\x1b" not in done.stderr


@pytest.mark.skipif(sys.platform == "win32", reason="pipes of a POSIX shell")
def test_a_closed_pipe_is_no_error() -> None:
    for command in ("analyze caravan", "sweep caravan m=1000:1500:20000"):
        line = f'"{sys.executable}" -c "{START}" {command} | head -c 5'
        done = subprocess.run(line, shell=True, capture_output=True, text=True, timeout=120)
        assert len(done.stdout) == 5
        assert done.stderr == ""


def test_errors_are_one_line_without_traceback() -> None:
    done = process("analyze", "carvan")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "ucrit: there is no vehicle 'carvan'; did you mean 'caravan'?\n"


def complete(words: str, at: int) -> list[str]:
    done = process(_UCRIT_COMPLETE="bash_complete", COMP_WORDS=words, COMP_CWORD=str(at))
    return [line.partition(",")[2] for line in done.stdout.split()]


def test_tab_completion(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").touch()
    assert {"analyze", "show"} <= set(complete("ucrit ", 1))
    assert {name for name in vehicle_names() if name.startswith("car")} <= set(complete("ucrit analyze car", 2))
    assert complete("ucrit analyze caravan --set I", 4) == ["I_c="]
    assert "a=" in complete("ucrit sweep caravan ", 3)
    assert complete(f"ucrit analyze {tmp_path}/mi", 2) == [f"{tmp_path}/mine.toml"]
    assert "trailer" in complete("ucrit show trail", 2)


def imported(*arguments: str) -> set[str]:
    argv = f"import sys; sys.argv[1:] = {list(arguments)!r}"
    code = f"{argv}\ntry:\n    {START}\nfinally:\n    print(*sys.modules, file=sys.stderr)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120)
    return set(done.stderr.split())


def test_help_imports_nothing_heavy() -> None:
    for arguments in (("--help",), ("analyze", "--help"), ("--version",), ("completion", "bash")):
        assert not imported(*arguments) & {
            "numpy",
            "sympy",
            "rich",
            "pint",
            "matplotlib",
            "ucrit.core",
            "ucrit.catalogue",
        }


def test_second_start_needs_no_sympy() -> None:
    for arguments in (("analyze", "caravan"), ("show", "trailer"), ("list",)):
        process(*arguments)
        assert not imported(*arguments) & {"sympy", "pint", "matplotlib", "scipy", "pandas"}


def seconds(*command: str) -> float:
    """Time a process as users have it, with compiled files, which NumPy's installation brings along anyway."""
    env = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    start = time.perf_counter()
    subprocess.run([sys.executable, *command], check=True, capture_output=True, env=env)
    return time.perf_counter() - start


@pytest.mark.parametrize(("arguments", "limit"), [(("--help",), 1.5), (("analyze", "caravan"), 4.0)])
def test_start_up_time(arguments: tuple[str, ...], limit: float) -> None:
    process(*arguments)
    pairs = [(seconds("-c", "import numpy"), seconds("-c", START, *arguments)) for _ in range(5)]
    assert min(own for _, own in pairs) <= limit * min(numpy for numpy, _ in pairs)


def test_too_little_memory_is_one_sentence(capsys: pytest.CaptureFixture[str]) -> None:
    from ucrit.cli.errors import exit_status

    def greedy() -> None:
        raise MemoryError

    assert exit_status(greedy) == 2
    assert capsys.readouterr().err.startswith("ucrit: this takes more memory than there is; take fewer points")
