"""Reference pages of commands, force laws and controllers."""

import os

import markup

from ucrit.analyses.about.cite import cite
from ucrit.catalogue import controller_names, find_controller, find_part, part_names, tire_file, tire_names
from ucrit.cli.app import COMMANDS, cli
from ucrit.parts.tires import Tire


def pages():
    """Return all pages by their path."""
    return {"commands.md": commands(), "laws.md": laws()}


def commands():
    """Return the help of every command, as it prints it."""
    import click

    os.environ["COLUMNS"] = "88"
    parts = ["# Commands\n", "What `ucrit --help` and `ucrit COMMAND --help` print.\n"]
    context = click.Context(cli, info_name="ucrit", terminal_width=88, max_content_width=88)
    parts.append(fenced(cli.get_help(context)))
    for name in COMMANDS:
        command = cli.get_command(context, name)
        inner = click.Context(command, info_name=name, parent=context, terminal_width=88, max_content_width=88)
        parts += [f"## ucrit {name}\n", fenced(command.get_help(inner))]
    return "\n".join(parts)


def fenced(text):
    """Return text as a block of code."""
    return f"````text\n{text}\n````\n"


def laws():
    """Return the tables of tire laws, tires and controllers."""
    parts = [
        "# Tires and controllers\n",
        "## Tire laws\n",
        "A file puts a law into a slot of a model; see [tires](../chapter-04.md).\n",
    ]
    for name in part_names(Tire):
        parts += declared(find_part(name, Tire), name)
    parts.append("## Tires as property files\n")
    parts.append(markup.table(("tire", "source"), [(f"<code>{name}</code>", sources(name)) for name in tire_names()]))
    parts += ["", "## Controllers\n"]
    for name in controller_names():
        law = find_controller(name)
        parts += declared(law, name, law.declaration.parameters)
        drives = ", ".join(f"`{one}`" for one in law.drives)
        inputs = "; ".join(f"`{q.name}` [{q.unit}], {q.meaning}" for q in law.declaration.inputs.values())
        parts.append(f"It drives {drives}." + (f" Inputs: {inputs}." if inputs else "") + "\n")
    assert all(tire_file(name) for name in tire_names())
    return "\n".join(parts)


def sources(name):
    """Return the sources of a law or tire, in a line each."""
    return "<br>".join(dict.fromkeys(markup.text(c.source) for c in cite(name)))


def declared(law, name, parameters=None):
    """Return title, parameters and sources of a law."""
    rows = [
        (*markup.symbol(p.name), markup.text(p.meaning), markup.unit(p.unit), p.allowed)
        for p in (law.parameters if parameters is None else parameters).values()
    ]
    return [
        f"### {name}\n",
        markup.block(f"<p>{markup.text(law.title())}</p>"),
        markup.table(("symbol", "name", "meaning", "unit", "allowed"), rows) if rows else "",
        markup.block(f"<p>Source: {sources(name)}</p>"),
    ]
