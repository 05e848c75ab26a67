"""Reference pages of models and vehicles, from their declarations and the published data they are checked against."""

import math
from functools import cache
from html import escape
from itertools import groupby

import markup
import numpy as np

import ucrit
from ucrit.catalogue import PUBLISHED, VEHICLES, find_model, model_names, vehicle_names
from ucrit.checks.eigenvalues import NEAR
from ucrit.checks.published import read_published
from ucrit.core.numeric.compiled import state_space
from ucrit.plots.labels import unit_text
from ucrit.report import formulas
from ucrit.report.derivation import steps

WHAT = {
    "polynomial": "characteristic polynomial",
    "matrices": "linear equations",
    "state_matrix": "state matrix",
    "transfer": "transfer function",
    "motion": "non-linear equations, derived again",
    "critical": "critical value",
    "criterion": "criterion",
    "numbers": "eigenvalues",
}


def pages():
    """Return all pages by their path."""
    vehicles = {name: ucrit.load(name) for name in vehicle_names()}
    of = {name: [v for v in vehicles if base(vehicles[v]) == name] for name in model_names()}
    found = {f"models/{name}.md": page(name, {v: vehicles[v] for v in of[name]}) for name in model_names()}
    return {"models/index.md": index(of), "vehicles.md": all_vehicles(of, vehicles), **found}


def base(vehicle):
    """Return the name of the model that a vehicle's file names."""
    return type(vehicle).ingredients()["model"]


@cache
def base_of(name):
    """Return the name of the model that a shipped vehicle's file names."""
    return base(ucrit.load(name))


def index(of):
    """Return the list of all models."""
    rows = []
    for name in of:
        model = find_model(name)
        order = ucrit.show(name).polynomial
        entries = published(name)
        double = ", ".join(dict.fromkeys(WHAT[e[0]] for e in entries)) or "none"
        rows.append(
            (markup.link(name, f"<code>{name}</code>"), markup.text(model.title()), str(len(order) - 1), double)
        )
    names = "\n".join(of)
    return (
        "# Models\n\nAll that stands on these pages is made from the models' own files: parameters, equations, what is "
        "derived from them, and the published equations and numbers with which `ucrit check` compares them.\n\n"
        + markup.table(("model", "what it is", "order", "double entry"), rows)
        + f"\n```{{toctree}}\n:hidden:\n\n{names}\n```\n"
    )


def page(name, vehicles):
    """Return the page of one model."""
    described = ucrit.show(name)
    parts = [f"# {name}\n", plain(described.title), plain(described.notes), parameters(described)]
    for title, quantities in (
        ("Variables", described.variables),
        ("Inputs", described.inputs),
        ("Outputs", described.outputs),
    ):
        if quantities:
            rows = [(*markup.symbol(q.name), markup.text(q.meaning), markup.unit(q.unit)) for q in quantities]
            parts.append(f"## {title}\n\n" + markup.table(("symbol", "name", "meaning", "unit"), rows))
    if slots := find_model(name).declaration.slots:
        rows = [
            (f"<code>{k}</code>", markup.text(s.meaning), f"<code>{s.law.part_id()}</code>") for k, s in slots.items()
        ]
        parts.append("## Parts\n\n" + markup.table(("slot", "what it is", "law, unless a file names another"), rows))
    parts += [criteria(described), derivation(described), double_entry(name), of_model(name, vehicles)]
    return "\n".join(part for part in parts if part)


def plain(words):
    """Return text as paragraphs in which Markdown finds nothing."""
    return "".join(markup.block(f"<p>{markup.text(part)}</p>") + "\n" for part in words.split("\n\n") if part.strip())


def parameters(described):
    """Return the table of parameters."""
    rows = [
        (
            *markup.symbol(p.name),
            markup.text(p.meaning),
            markup.unit(p.unit),
            escape(p.allowed.replace(p.unit, unit_text(p.unit)) if p.unit != "1" else p.allowed),
            "" if p.default is None else f"{p.default:.6g}",
        )
        for p in described.parameters
    ]
    return "## Parameters\n\n" + markup.table(("symbol", "name", "meaning", "unit", "allowed", "default"), rows)


def derivation(described):
    """Return the steps from the equations of motion to the characteristic polynomial."""
    parts = ["## Equations\n"]
    for step in steps(described):
        parts.append(markup.block(f"<p>{step.text}</p>"))
        parts += [markup.block(str(formula), "formula") for formula in step.formulas]
        if step.note and step.note != described.notes:
            parts.append(markup.block(f"<p>{markup.text(step.note.removesuffix(described.notes))}</p>"))
    return "\n".join(parts)


def criteria(described):
    """Return the conditions for stability."""
    if described.criteria is None:
        return f"## Criteria\n\n{plain(described.why_no_criteria)}"
    parts = [
        "## Criteria\n",
        plain(str(described.criteria).splitlines()[0] + (":" if described.criteria.conditions else ".")),
    ]
    for condition in described.criteria:
        if formulas.too_long(condition.expression):
            parts.append(plain(f"{condition.name}: too long to print; `ucrit.criteria` returns it."))
        else:
            parts.append(markup.block(str(formulas.formula(condition.mathml, "> 0")), "formula"))
    return "\n".join(parts)


def published(name):
    """Return table, source, note and outcome of all published entries about a model."""
    path = PUBLISHED / f"{name.replace('-', '_')}.toml"
    if not path.is_file():
        return []
    return [
        (kind, entry.source, entry.content.get("note", ""), digits(name, entry) if kind == "numbers" else "agrees")
        for kind, entries in read_published(path).items()
        for entry in entries
    ]


def digits(name, entry):
    """Say to how many digits published eigenvalues come out; what may be missing is in the check."""
    values = dict(entry.content.get("parameters", {}))
    if "vehicle" in entry.content:
        values = {**ucrit.load(entry.content["vehicle"]).values, **values}
    got = np.linalg.eigvals(state_space(find_model(name)(**values)).A)
    wrong = 0.0
    for pair in entry.content["eigenvalues"]:
        value = complex(*pair)
        nearest = got[np.argmin(np.abs(got - value))]
        wrong = max(wrong, abs(nearest - value) / max(abs(value), NEAR * np.abs(got).max()))
    allowed = math.floor(-math.log10(entry.content["tolerance"]))
    count = len(entry.content["eigenvalues"])
    agree = min(15, math.floor(-math.log10(wrong))) if wrong else 15
    return f"{count} eigenvalues to {agree} digits ({allowed} asked for)"


def double_entry(name):
    """Return the table of what is published and comes out."""
    entries = published(name)
    if not entries:
        return "## Double entry\n\nNothing published is on file for this model.\n"
    rows = [(WHAT[kind], markup.text(source), markup.text(note), outcome) for kind, source, note, outcome in entries]
    return (
        f"## Double entry\n\nEntered a second time from the literature and compared by `ucrit check {name}`.\n\n"
        + markup.table(("what", "who says so", "remark", "comes out"), rows)
    )


def of_model(name, vehicles):
    """Return the vehicles of a model with their sources and numbers."""
    if not vehicles:
        return f"## Vehicles\n\nNone is shipped; `ucrit new {name}` prints a file to fill in.\n"
    parts = ["## Vehicles\n"]
    for key, vehicle in vehicles.items():
        info = vehicle.info
        parts.append(f"### {key}\n")
        parts.append(plain(f"{info.name}. {ucrit.analyze(vehicle).sentence}."))
        parts += [plain(f"Source: {info.source}"), plain(f"Note: {info.note}") if info.note else ""]
        content = escape((VEHICLES / f"{key}.toml").read_text(encoding="utf-8")).replace("\n", "&#10;")
        parts.append(f"<details><summary>The file</summary><pre>{content}</pre></details>\n")
    return "\n".join(parts)


def all_vehicles(of, vehicles):
    """Return the list of all vehicles, by model."""
    parts = ["# Vehicles\n", "Every vehicle that is shipped, and where its numbers come from.\n"]
    for model, names in groupby(((m, n) for m, ns in of.items() for n in ns), key=lambda pair: pair[0]):
        rows = [
            (
                f'<a href="models/{model}.html#{name}"><code>{name}</code></a>',
                escape(vehicles[name].info.name),
                markup.text(vehicles[name].info.source),
            )
            for _, name in names
        ]
        parts.append(f"## {model}\n\n" + markup.table(("vehicle", "what it is", "source"), rows))
    return "\n".join(parts)
