"""The documentation is run, and its links lead somewhere."""

import re
import sys
from itertools import pairwise
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
sys.path[:0] = [str(ROOT / "docs" / "site"), str(ROOT / "docs" / "images")]

import draw  # noqa: E402
import pictures  # noqa: E402
from execute import run_page  # noqa: E402

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]


@pytest.mark.parametrize("page", PAGES, ids=lambda p: str(p.relative_to(ROOT)))
def test_page(page, tmp_path):
    run_page(page, tmp_path, tmp_path / "cache")


@pytest.mark.parametrize("page", PAGES, ids=lambda p: str(p.relative_to(ROOT)))
def test_links_of_a_page_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)#\s]+)(?: \"[^\"]*\")?\)|src=\"([^\"]+)\"", page.read_text()):
        path = target[0] or target[1]
        if not path.startswith("http"):
            assert (page.parent / path).exists(), f"{page.name} links to {path}"


@pytest.mark.parametrize("page", PAGES, ids=lambda p: str(p.relative_to(ROOT)))
def test_no_line_is_taken_for_a_list_or_a_heading(page):
    prose = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    for before, line in pairwise(prose.splitlines()):
        assert not re.match(r"\+ |> |=+$", line), line
        inside = not before.strip() or re.match(r"[-*] |\d+\. | {2,}", before)
        assert inside or not re.match(r"[-*] |\d+\. ", line), line


def test_a_page_that_shows_something_else_fails(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("```pycon\n>>> 1 + 1\n3\n\n```\n")
    with pytest.raises(AssertionError, match="Expected:\n    3\nGot:\n    2"):
        run_page(page, tmp_path, tmp_path / "cache")
    page.write_text("```console\n$ ucrit --version\nno version\n```\n")
    with pytest.raises(AssertionError, match="but the page shows\nno version"):
        run_page(page, tmp_path, tmp_path / "cache")


@pytest.mark.parametrize("name", sorted(n for n, when in pictures.COMPARED.items() if when == "tests"))
def test_a_picture_shows_what_is_found_now(name):
    assert not draw.check(name)


def test_the_command_that_draws_a_picture_stands_beside_it():
    shown = set()
    for page in PAGES:
        for name, title in re.findall(r"!\[.*\]\(\S*/([\w-]+)\.png(.*)\)", page.read_text(encoding="utf-8")):
            shown.add(name)
            assert title == f' "{draw.command(name) if name in draw.PICTURES else "python docs/images/app.py"}"'
    assert shown == draw.PICTURES.keys() | {"app"} == {path.stem for path in (ROOT / "docs" / "images").glob("*.png")}


def test_a_picture_that_shows_something_else_is_stale(tmp_path, monkeypatch):
    def drawn(slope, word="time [s]"):
        figure, axes = pictures.figure_with_axes(2)
        pictures.curve(axes, [0, 1, 2], [0, slope, 2], 0, "a curve")
        axes.set_xlabel(word)
        return figure

    monkeypatch.setattr(pictures, "HERE", tmp_path)
    assert pictures.stale(drawn(1.0), "line")
    pictures.save(drawn(1.0), "line")
    assert not pictures.stale(drawn(1.001), "line")
    assert "curves" in pictures.stale(drawn(1.1), "line")
    assert "'time [s]' in the file, 'time [min]' now" in pictures.stale(drawn(1.0, "time [min]"), "line")
