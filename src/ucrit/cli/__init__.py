"""The command line: `main` is what the command ``ucrit`` runs."""

from __future__ import annotations


def main() -> None:
    """Run the command line with the process's arguments."""
    from .app import cli

    cli.main(prog_name="ucrit")
