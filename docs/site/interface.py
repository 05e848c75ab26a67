"""Reference pages of the Python interface: every public name, with the classes of results beside the functions."""

import dataclasses
import importlib
import inspect
import pkgutil

import ucrit

GROUPS = {
    "analyses": "Analyses",
    "core": "Writing models",
    "catalogue": "Catalogue",
    "checks": "Checks",
    "plots": "Drawings",
    "report": "Report",
    "numerics": "Numerics",
    "web": "The explorer",
}


def pages():
    """Return all pages by their path."""
    public = {name: getattr(ucrit, name) for name in sorted(ucrit._PUBLIC, key=str.lower)}
    classes = results()
    found, lines, shown = {}, [], set()
    for group, title in GROUPS.items():
        names = [name for name in public if place(name).split(".")[0] == group]
        lines += [title, "-" * len(title), "", ".. list-table::", "   :widths: 25 75", ""]
        for name in names:
            lines += [f"   * - :doc:`{name} <{name.lower()}>`", f"     - {first_line(public[name])}"]
            beside = [c for c in classes.get(f"ucrit.{place(name)}", ()) if c not in shown and c is not public[name]]
            shown.update(beside)
            found[f"python/{name.lower()}.rst"] = page(name, public[name], beside)
        lines.append("")
    rest = [c for group in classes.values() for c in group if c not in shown and c not in public.values()]
    found["python/results.rst"] = heading("Other results") + "".join(map(autoclass, rest))
    toc = [".. toctree::", "   :hidden:", "", *(f"   {path[7:-4]}" for path in found), ""]
    top = (
        heading("Python")
        + "Every public name, importable from ``ucrit``. :doc:`Other results <results>` are what these return.\n\n"
    )
    return {**found, "python/index.rst": top + "\n".join([*lines, *toc])}


def place(name):
    """Return the module of a public name, below ucrit."""
    where = ucrit._PUBLIC[name]
    return where if isinstance(where, str) else where[0]


def results():
    """Return the public classes of the analyses by module."""
    found = {}
    for info in pkgutil.walk_packages(importlib.import_module("ucrit.analyses").__path__, "ucrit.analyses."):
        module = importlib.import_module(info.name)
        own = [
            value
            for name, value in vars(module).items()
            if inspect.isclass(value) and value.__module__ == info.name and not name.startswith("_")
        ]
        kept = [c for c in own if dataclasses.is_dataclass(c) or issubclass(c, tuple)]
        found[info.name] = [c for c in kept if hasattr(c, "_repr_html_") or hasattr(c, "table")]
    return found


def page(name, value, beside):
    """Return the page of one public name."""
    kind = "autoclass" if inspect.isclass(value) else "autofunction"
    members = "   :members:\n" if inspect.isclass(value) else ""
    return heading(name) + f".. {kind}:: ucrit.{name}\n{members}\n" + "".join(map(autoclass, beside))


def autoclass(cls):
    """Return the directive that documents a class."""
    return f".. autoclass:: {cls.__module__}.{cls.__qualname__}()\n   :members:\n\n"


def heading(text):
    """Return the title of a page."""
    return f"{text}\n{'=' * len(text)}\n\n"


def first_line(value):
    """Return the first sentence of a description, roles left as they are."""
    return (inspect.getdoc(value) or "").split("\n\n")[0].replace("\n", " ")
