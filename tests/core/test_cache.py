import os
import subprocess
import sys

import pytest

from ucrit.core import Model, param, state
from ucrit.core.numeric import cache as cache_module
from ucrit.core.numeric.cache import cached, fingerprint


def make(factor, helper):
    class Made(Model):
        """Made (a source)."""

        T: float = param("s", "time", above=0)
        x = state("m", "position")

        def equations(self, x, dx):
            return self.T * dx.x + factor * helper(x.x)

    return Made


def test_fingerprint_follows_the_code_that_the_equations_reach():
    same = fingerprint(make(2, lambda v: v))
    assert same == fingerprint(make(2, lambda v: v))
    assert same != fingerprint(make(3, lambda v: v))
    assert same != fingerprint(make(2, lambda v: -v))


def test_second_look_comes_from_disk(tmp_path, monkeypatch):
    monkeypatch.setenv("UCRIT_CACHE", str(tmp_path))
    model, calls = make(5, lambda v: v), []

    def compute():
        calls.append(1)
        return {"a": [1, 2]}

    assert cached(model, "piece", compute) == {"a": [1, 2]}
    cache_module._memory.clear()
    assert cached(model, "piece", compute) == {"a": [1, 2]}
    assert len(calls) == 1
    (file,) = tmp_path.glob("*.json")
    file.write_text("{ half a fi")
    cache_module._memory.clear()
    assert cached(model, "piece", compute) == {"a": [1, 2]}
    assert len(calls) == 2
    assert not list(tmp_path.glob("*.tmp"))


@pytest.mark.parametrize("folder", ["off", "/proc/nowhere"])
def test_no_cache_costs_time_only(monkeypatch, folder):
    monkeypatch.setenv("UCRIT_CACHE", folder)
    assert cached(make(7, lambda v: v), f"piece-{folder}", lambda: 3) == 3


def test_numeric_work_does_not_import_sympy_the_second_time(tmp_path):
    code = (
        "import sys; from ucrit import analyze; a = analyze('caravan'); assert not a.stable;"
        "print(sorted({'sympy', 'scipy', 'matplotlib', 'pint', 'mpmath', 'xarray'} & set(sys.modules)))"
    )
    env = {**os.environ, "UCRIT_CACHE": str(tmp_path)}
    runs = [
        subprocess.run([sys.executable, "-c", code], env=env, capture_output=True, text=True, check=True).stdout
        for _ in range(2)
    ]
    assert "sympy" in runs[0]
    assert runs[1].strip() == "[]"


def test_fingerprint_follows_all_code_that_derives():
    names = {name for name, _, _ in cache_module._package_stamps()}
    assert {"core/derivation/derive.py", "analyses/stability/conditions.py", "analyses/linear/formulas.py"} <= names
