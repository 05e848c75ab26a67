"""The command group. Nothing here imports NumPy, rich or a model: a command does, when it runs."""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Sequence
from functools import partial
from typing import Any

import click

from .errors import exit_status

COMMANDS = {
    "analyze": "analyze",
    "compare": "compare",
    "list": "listing",
    "show": "show",
    "new": "new",
    "simulate": "simulate",
    "sweep": "sweep",
    "map": "map",
    "cycles": "cycles",
    "handling": "handling",
    "boundary": "boundary",
    "margins": "margins",
    "uncertainty": "uncertainty",
    "certify": "certify",
    "routh": "routh",
    "bonds": "bonds",
    "tire": "tire",
    "check": "check",
    "cite": "cite",
    "app": "app",
    "completion": "completion",
}
"""Commands in the order of the help, and the modules that hold them."""

HELP = {"help_option_names": ["-h", "--help"], "max_content_width": 100}


class Cli(click.Group):
    """A group whose commands are imported when used, and whose errors are one sentence on stderr."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of the commands."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import a command."""
        if cmd_name not in COMMANDS:
            return None
        module = importlib.import_module(f"ucrit.cli.commands.{COMMANDS[cmd_name]}")
        command: click.Command = module.command
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find a command; a misspelt one gets a near match."""
        if args and not args[0].startswith("-") and args[0] not in COMMANDS:
            from ..core.errors import near_match

            raise click.UsageError(f"there is no command '{args[0]}'{near_match(args[0], COMMANDS)}", ctx)
        return super().resolve_command(ctx, args)

    def main(
        self,
        args: Sequence[str] | None = None,
        prog_name: str | None = None,
        complete_var: str | None = None,
        standalone_mode: bool = True,
        **extra: Any,
    ) -> Any:
        """Run a command and leave with its status; see `ucrit.cli.errors` for the statuses."""
        run = partial(super().main, args, prog_name, complete_var, standalone_mode=False, **extra)
        if not standalone_mode:
            return run()
        if sys.stdout is None or sys.stderr is None:  # closed by who started us
            nowhere = open(os.devnull, "w")  # noqa: SIM115 - open until the end
            sys.stdout, sys.stderr = sys.stdout or nowhere, sys.stderr or nowhere
        for stream in (sys.stdout, sys.stderr):
            if hasattr(stream, "reconfigure"):  # what the terminal cannot print shall not stop the rest
                stream.reconfigure(errors="replace")
        sys.exit(exit_status(run))


def _version(ctx: click.Context, _: click.Parameter, wanted: bool) -> None:
    if wanted and not ctx.resilient_parsing:
        from .. import __version__

        click.echo(f"ucrit {__version__}")
        ctx.exit()


@click.group(cls=Cli, invoke_without_command=True, context_settings=HELP)
@click.option(
    "--version", is_flag=True, is_eager=True, expose_value=False, callback=_version, help="Print the version."
)
@click.pass_context
def cli(ctx: click.Context) -> None:
    """Is the vehicle stable, up to what speed, how does it fail, and what should be changed?

    \b
    Start with:
      ucrit list                                what there is
      ucrit analyze caravan --upto "130 km/h"   judge one of the vehicles
      ucrit new trailer > mine.toml             a vehicle file to fill in
      ucrit analyze mine.toml                   judge your own
      ucrit app caravan                         move its parameters in the browser

    \b
    Units:  a number is in SI units (m, kg, s, N, rad); anything else carries its
            unit: "110 km/h", "2 t", "3 deg", "12 kN/deg", "45 lbf/in".
    Files:  vehicles are .toml files, models .py files, both wherever you like.
            Formulas once derived are kept in the user's cache folder; set
            UCRIT_CACHE to another folder, or to "off".
    Colour: only on a terminal; set NO_COLOR=1 for none.

    \b
    Exit status:
      0  done, whatever the verdict      2  wrong input: one sentence on stderr
      1  a check failed (ucrit check)    3  not stable (analyze --fail-if-unstable)
    """
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())
