"""``ucrit completion``: the script that makes the tab key complete."""

from __future__ import annotations

import click


@click.command("completion", short_help="Print the script for tab completion.")
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
@click.pass_context
def command(ctx: click.Context, shell: str) -> None:
    """Print the script that lets the tab key complete commands, vehicles, models and parameters.

    \b
    Examples:
      eval "$(ucrit completion bash)"                              # in ~/.bashrc
      eval "$(ucrit completion zsh)"                               # in ~/.zshrc
      ucrit completion fish > ~/.config/fish/completions/ucrit.fish

    Exit status: 0 done; 2 wrong input.
    """
    from click.shell_completion import get_completion_class

    made = get_completion_class(shell)
    assert made is not None
    script = made(ctx.find_root().command, {}, "ucrit", "_UCRIT_COMPLETE")
    click.echo(script.source_template % script.source_vars())
