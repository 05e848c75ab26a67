"""Do the checks find errors? Seed single errors into every model's equations and count those that are caught.

Run ``python -m benchmarks.mutants [model ...]``; exit status 1 where fewer than 99 % are caught.

An error is one change of one place: a sign, an operator, a dropped term, factor or square, a swapped name,
another function, another constant. Drawings are left alone, errors that change no motion and no output left out.
"""

from __future__ import annotations

import difflib
import os
import signal
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module
from multiprocessing import Pool
from pathlib import Path
from types import ModuleType

os.environ["UCRIT_CACHE"] = "off"

from rich.console import Console
from rich.progress import track
from rich.table import Column, Table

from benchmarks.seeding import seeded
from ucrit.catalogue import HERE, find_model, model_names, models_in
from ucrit.checks.derivations import accelerations
from ucrit.checks.states import differs, random_states
from ucrit.checks.subject import Subject
from ucrit.checks.suite import run
from ucrit.core.contract.model import Model
from ucrit.core.derivation.trace import trace
from ucrit.core.numeric.motion import motion

REQUIRED = 0.99
SECONDS = 30
"""An error that makes the equations grow until checks take longer than this is noticed, too."""
SHAPES = "parts.shapes"
"""Where drawings come from, which move nothing."""
DECLARED = ("parameters", "variables", "inputs", "outputs")
SLOW = "too slow"
EQUIVALENT = "equivalent"
SURVIVED = "survived"


@dataclass(frozen=True)
class Mutant:
    """A source file with one error, and the models that must notice."""

    file: str
    what: str
    original: str
    text: str
    models: tuple[str, ...]

    @property
    def diff(self) -> str:
        """The changed lines."""
        lines = difflib.unified_diff(self.original.splitlines(), self.text.splitlines(), n=0, lineterm="")
        return "\n".join(line for line in lines if not line.startswith(("---", "+++", "@@")))


def mutants(wanted: list[str]) -> list[Mutant]:
    """Return all mutants of the wanted models, and of the parts they import."""
    found: list[Mutant] = []
    parts: dict[str, dict[str, list[str]]] = {}
    for name in wanted:
        path = HERE / "models" / f"{name.replace('-', '_')}.py"
        found += [Mutant(f"models/{path.name}", *m, (name,)) for m in seeded(path.read_text(), find_model(name))]
        for part, functions in imported_parts(path):
            users = parts.setdefault(part, {})
            for function in functions:
                users.setdefault(function, []).append(name)
    for part, functions in parts.items():
        file = f"{part.replace('.', '/')}.py"
        text = (HERE / "parts" / file).read_text()
        for function, users in functions.items():
            found += [Mutant(f"parts/{file}", *m, tuple(users)) for m in seeded(text, None, function)]
    return found


def imported_parts(path: Path) -> Iterator[tuple[str, list[str]]]:
    """Return the modules of force laws that a model file imports, each with a name it takes from there."""
    import ast

    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("parts.") and node.module != SHAPES:
            module = import_module(f"ucrit.{node.module}")
            for alias in node.names:
                yield getattr(module, alias.name).__module__.removeprefix("ucrit.parts."), [alias.name]


def outcome(mutant: Mutant) -> tuple[Mutant, str]:
    """Return what became of a mutant, tried in a process of its own that a clock can end."""
    reader, writer = os.pipe()
    child = os.fork()
    if not child:
        os.close(reader)
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.alarm(SECONDS * len(mutant.models))
        try:
            os.write(writer, checked(mutant).encode())
        finally:
            os._exit(0)
    os.close(writer)
    with os.fdopen(reader) as answer:
        found = answer.read()
    _, status = os.waitpid(child, 0)
    if not found and not os.WIFSIGNALED(status):
        raise RuntimeError(f"{mutant.file}: {mutant.what}: the checks stopped without a result\n{mutant.diff}")
    return mutant, found or SLOW


def checked(mutant: Mutant) -> str:
    """Return the name of the first check that fails, or that the mutant is equivalent or survived."""
    differing = False
    for name in mutant.models:
        try:
            model = altered(mutant, name)
        except Exception as error:
            return f"class statement ({type(error).__name__})"
        for check in run(Subject.of(model, 0, None)):
            if check.passed is False:
                return check.name
        differing |= not same(find_model(name), model)
    return SURVIVED if differing else EQUIVALENT


def altered(mutant: Mutant, name: str) -> type[Model]:
    """Return the model made from the altered source, or from its own source with an altered part."""
    folder, _, file = mutant.file.partition("/")
    stem = name.replace("-", "_")
    if folder == "models":
        return models_in(executed(f"ucrit.models.{stem}", mutant.text))[0]
    part = f"ucrit.parts.{file.removesuffix('.py').replace('/', '.')}"
    kept, package = sys.modules[part], sys.modules[part.rpartition(".")[0]]
    passed_on = {n: value for n, value in vars(package).items() if vars(kept).get(n) is value}
    sys.modules[part] = executed(part, mutant.text)
    vars(package).update({n: vars(sys.modules[part])[n] for n in passed_on})
    try:
        return models_in(executed(f"ucrit.models.{stem}", (HERE / "models" / f"{stem}.py").read_text()))[0]
    finally:
        sys.modules[part] = kept
        vars(package).update(passed_on)


def executed(name: str, text: str) -> ModuleType:
    """Return a module made from a text, as if it were the file of that name."""
    module = ModuleType(name)
    module.__package__ = name.rpartition(".")[0]
    exec(compile(text, name, "exec"), module.__dict__)
    return module


def same(original: type[Model], mutant: type[Model]) -> bool:
    """Tell whether every derivation of two models gives the same motion and outputs at random states."""
    if any(getattr(original.declaration, kind) != getattr(mutant.declaration, kind) for kind in DECLARED):
        return False
    subject = Subject.of(original, 1, None)
    states = random_states(subject, "equivalence")
    one, other = (motion(model) for model in (original, mutant))
    at = (states.w, states.u, states.parameters)
    if differs(one.rhs(*at), other.rhs(*at), 1e-10) or differs(one.outputs(*at), other.outputs(*at), 1e-10):
        return False
    return all(
        not differs(*(accelerations(trace(model, None, how), states) for model in (original, mutant)), 1e-10)
        for how in subject.derivations
    )


def table(outcomes: list[tuple[Mutant, str]]) -> Table:
    """Return how many errors of each file were caught, and by which check first."""
    shown = Table(Column("file", no_wrap=True), "errors", "caught", "share", "caught first by")
    for file in sorted({mutant.file for mutant, _ in outcomes}):
        counts = Counter(result for mutant, result in outcomes if mutant.file == file and result != EQUIVALENT)
        total, caught = counts.total(), counts.total() - counts[SURVIVED]
        first = ", ".join(f"{check} {n}" for check, n in counts.most_common() if check != SURVIVED)
        shown.add_row(file, str(total), str(caught), f"{caught / max(total, 1):.1%}", first)
    return shown


def main() -> int:
    """Seed, check, print; return the exit status."""
    console, wanted = Console(), sys.argv[1:] or list(model_names())
    seeds = mutants(wanted)
    with Pool(min(2, os.cpu_count() or 1)) as pool:
        work = pool.imap_unordered(outcome, seeds, chunksize=4)
        outcomes = list(track(work, "checking seeded errors", total=len(seeds), console=console))
    console.print(table(outcomes))
    real = [(mutant, result) for mutant, result in outcomes if result != EQUIVALENT]
    survivors = [mutant for mutant, result in real if result == SURVIVED]
    for mutant in survivors:
        console.print(f"\nsurvived: {mutant.file}: {mutant.what}\n{mutant.diff}", markup=False)
    share = 1 - len(survivors) / max(len(real), 1)
    console.print(f"\n{len(real)} errors, {len(real) - len(survivors)} caught: {share:.1%}", end="; ")
    console.print(f"{len(outcomes) - len(real)} changes without effect left out")
    return 0 if share >= REQUIRED else 1


if __name__ == "__main__":
    sys.exit(main())
