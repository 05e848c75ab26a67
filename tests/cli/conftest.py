"""Shared by the tests of the command line: a runner, and a vehicle file of every model."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from ucrit.catalogue import find_model
from ucrit.cli.app import cli
from ucrit.core.contract.files import write_vehicle

from .values import sample


@pytest.fixture(scope="session", autouse=True)
def _plain_terminal() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("COLUMNS", "80")
        patch.delenv("FORCE_COLOR", raising=False)
        yield


@pytest.fixture(scope="session")
def run() -> Callable[..., Result]:
    """Run the command line in this process; exceptions that it lets through fail the test."""
    runner = CliRunner()

    def call(*arguments: Any) -> Result:
        return runner.invoke(cli, [str(a) for a in arguments], prog_name="ucrit", catch_exceptions=False)

    return call


@pytest.fixture(scope="session")
def vehicle_file(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Return a valid vehicle file of a model."""
    folder = tmp_path_factory.mktemp("vehicles")

    def path_of(name: str) -> Path:
        path = folder / f"{name}.toml"
        if not path.exists():
            model = find_model(name)
            path.write_text(write_vehicle(model(**sample(model)).with_info(name="sample", source="made up")))
        return path

    return path_of
