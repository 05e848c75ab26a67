"""What one stumbles over with a first model of one's own is told in a sentence that says what to do."""

import pytest

MODEL = '''from ucrit import Model, param, state
{imports}


class Sled(Model):
    """Sled that is pushed."""

    m = param("kg", "mass", above=0)
    k = param("kg/s", "damping", above=0)
    V = state("m/s", "velocity")

    def equations(self, x, dx, u):
        {body}
'''


@pytest.mark.parametrize("command", ["analyze", "sweep"])
@pytest.mark.parametrize("name", ["sled.py", "sled.py:Sled"])
def test_a_models_file_is_no_vehicle(run, command, name):
    done = run(command, name, *(["m=1:2"] if command == "sweep" else []))
    assert done.exit_code == 2
    assert f"'{name}' is a model, not a vehicle; 'ucrit new {name} > mine.toml' gives a file" in done.stderr


@pytest.mark.parametrize(
    ("imports", "body", "words"),
    [
        ("import math", "return self.m * dx.V + math.sin(x.V)", "from ucrit.core, not from math or numpy"),
        ("", "return self.m * dx.V + (self.k * x.V if x.V > 0 else 0)", "where(condition, one, other) from ucrit.core"),
    ],
)
def test_symbols_are_no_numbers(run, tmp_path, imports, body, words):
    path = tmp_path / "sled.py"
    path.write_text(MODEL.format(imports=imports, body=body))
    done = run("show", str(path))
    assert done.exit_code == 2
    assert words in done.stderr
    assert "Traceback" not in done.stderr
