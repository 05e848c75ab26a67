"""Pieces of pages: HTML in Markdown, on lines of its own so that nothing in it is read as Markdown."""

from html import escape

from ucrit.plots.labels import unit_text
from ucrit.report import formulas


def block(html, kind="wide"):
    """Return HTML as a block that Markdown leaves alone."""
    return f'<div class="{kind}">' + " ".join(html.split("\n")) + "</div>\n"


def table(head, rows):
    """Return a table; cells are HTML."""
    top = "".join(f'<th scope="col">{name}</th>' for name in head)
    body = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    return block(f"<table><thead><tr>{top}</tr></thead><tbody>{body}</tbody></table>")


def symbol(name):
    """Return a declared name as a formula, and as it is typed."""
    return f"{formulas.symbol(name)}", f"<code>{escape(name)}</code>"


def unit(text):
    """Return a unit with raised powers."""
    return escape(unit_text(text)) or "1"


def text(words):
    """Return text as HTML, code in backticks as code."""
    parts = escape(words).replace("``", "`").split("`")
    return "".join(f"<code>{part}</code>" if i % 2 else part for i, part in enumerate(parts))


def link(path, words):
    """Return a link between built pages; Sphinx does not look into HTML, a test does."""
    return f'<a href="{path}.html">{words}</a>'
