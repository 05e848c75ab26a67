"""Formulas need no script: pages hold MathML, which browsers draw themselves; LaTeX among the pages is an error."""

from sphinx.errors import ExtensionError


def refused(self, node):
    """Refuse LaTeX, which only a script from elsewhere would draw."""
    raise ExtensionError(f"write formulas as text or MathML, not as LaTeX: {node.astext()}")


def setup(app):
    """Register the extension."""
    app.add_html_math_renderer("mathml", (refused, None), (refused, None))
    app.config.html_math_renderer = "mathml"
    return {"parallel_read_safe": True, "parallel_write_safe": True}
