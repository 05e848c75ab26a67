"""Run a page: files it shows are written, commands it shows are called, output it shows is compared."""

import doctest
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def run_page(page, folder, cache):
    """Run the blocks of a page in a folder; raise `AssertionError` where it shows something else."""
    for kind, text in BLOCK.findall(page.read_text(encoding="utf-8")):
        named = re.match(r"# file: (\S+)\n", text)
        if named:
            (folder / named[1]).write_text(text, encoding="utf-8")
        elif kind == "console":
            run_console(text, folder, cache)
        elif kind == "pycon":
            run_session(page, text, folder)


def run_console(text, folder, cache):
    """Call the commands of a block and compare what they print."""
    for part in re.split(r"^(?=\$ )", text, flags=re.MULTILINE)[1:]:
        command, _, shown = part[2:].partition("\n")
        printed = call(command, folder, cache)
        same = not shown or filled(shown, printed)
        assert same, f"$ {command}\nprints\n{printed}\nbut the page shows\n{shown}"


def call(command, folder, cache):
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
        target.write_text(done.stdout, encoding="utf-8")
        return done.stderr
    return done.stdout + done.stderr


def filled(shown, printed):
    """Match printed lines with shown ones, '...' on a line of its own standing for any number of lines."""
    checker = doctest.OutputChecker()
    strip = "\n".join(line.rstrip() for line in printed.splitlines()) + "\n"
    return checker.check_output(shown, strip, doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)


def run_session(page, text, folder):
    """Run a Python session and compare what it prints."""
    here = Path.cwd()
    os.chdir(folder)
    told = []
    try:
        test = doctest.DocTestParser().get_doctest(text, {}, page.name, str(page), 0)
        runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
        runner.run(test, out=told.append)
    finally:
        os.chdir(here)
    assert not runner.failures, "".join(told)
