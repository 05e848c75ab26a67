"""The documentation is run: files it shows are written, commands it shows are called, output it shows is compared."""

import doctest
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def run(command, folder, cache):
    """Run a ucrit command of a page as its reader would, with 80 columns."""
    words = shlex.split(command)
    assert words[0] == "ucrit", f"a page can only show ucrit commands, not {command}"
    env = {**os.environ, "COLUMNS": "80", "UCRIT_CACHE": str(cache), "NO_COLOR": "1"}
    path = Path(sys.executable).parent / "ucrit"
    target = None
    if ">" in words:
        target = folder / words[words.index(">") + 1]
        words = words[: words.index(">")]
    done = subprocess.run([path, *words[1:]], cwd=folder, env=env, capture_output=True, text=True)
    if target:
        target.write_text(done.stdout)
        return done.stderr
    return done.stdout + done.stderr


def fill(shown, printed):
    """Match printed lines with shown ones, '...' on a line of its own standing for any number of lines."""
    checker = doctest.OutputChecker()
    strip = "\n".join(line.rstrip() for line in printed.splitlines()) + "\n"
    return checker.check_output(shown, strip, doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)


@pytest.mark.parametrize("page", PAGES, ids=lambda p: str(p.relative_to(ROOT)))
def test_page(page, tmp_path):
    blocks = BLOCK.findall(page.read_text())
    for kind, text in blocks:
        named = re.match(r"# file: (\S+)\n", text)
        if named:
            (tmp_path / named[1]).write_text(text)
        elif kind == "console":
            for part in re.split(r"^(?=\$ )", text, flags=re.MULTILINE)[1:]:
                command, _, shown = part[2:].partition("\n")
                printed = run(command, tmp_path, tmp_path / "cache")
                assert not shown or fill(shown, printed), f"$ {command}\nprints\n{printed}\nbut the page shows\n{shown}"
        elif kind == "pycon":
            run_session(page, text, tmp_path)


def run_session(page, text, folder):
    here = Path.cwd()
    os.chdir(folder)
    try:
        test = doctest.DocTestParser().get_doctest(text, {}, page.name, str(page), 0)
        runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
        runner.run(test)
        assert not runner.failures
    finally:
        os.chdir(here)


@pytest.mark.parametrize("page", PAGES, ids=lambda p: str(p.relative_to(ROOT)))
def test_links_of_a_page_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)#]+)\)|src=\"([^\"]+)\"", page.read_text()):
        path = target[0] or target[1]
        if not path.startswith("http"):
            assert (page.parent / path).exists(), f"{page.name} links to {path}"
