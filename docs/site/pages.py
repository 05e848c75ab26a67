"""What Sphinx is taught: formulas without scripts, and names that share one description in a docstring."""

import re

from sphinx.errors import ExtensionError


def refused(self, node):
    """Refuse LaTeX, which only a script would draw: pages hold MathML, which browsers draw themselves."""
    raise ExtensionError(f"write formulas as text or MathML, not as LaTeX: {node.astext()}")


def split_names(app, what, name, obj, options, lines):
    """Give each of the names in ``a, b`` under Attributes the description that follows."""
    inside, at = False, 0
    while at < len(lines):
        if at + 1 < len(lines) and re.fullmatch(r"-{3,}", lines[at + 1]):
            inside = lines[at] == "Attributes"
        elif inside and re.fullmatch(r"\w+(, \w+)+", lines[at]):
            end = next((i for i in range(at + 1, len(lines)) if lines[i][:1].strip()), len(lines))
            described = lines[at + 1 : end]
            names = lines[at].split(", ")
            lines[at:end] = [line for one in names for line in (one, *described)]
            at += len(names) * (1 + len(described)) - 1
        at += 1


def setup(app):
    """Register the extension."""
    app.add_html_math_renderer("mathml", (refused, None), (refused, None))
    app.config.html_math_renderer = "mathml"
    app.connect("autodoc-process-docstring", split_names, priority=400)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
