"""The built pages: no warning, nothing from elsewhere, no dead link, everything that is declared is in them."""

import os
import re
import runpy
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

import matplotlib as mpl
import pytest

import ucrit
from ucrit.catalogue import controller_names, find_model, model_names, tire_names, vehicle_names
from ucrit.cli.app import COMMANDS

ROOT = Path(__file__).parent.parent
PAGES = [path.stem for path in sorted((ROOT / "docs").glob("*.md"))]
EXAMPLES = sorted((ROOT / "examples").glob("plot_*.py"))


class Read(HTMLParser):
    """Collects links, resources, the names of places, and the text of a page."""

    def __init__(self, path):
        super().__init__()
        self.links, self.resources, self.places, self.words = [], [], set(), []
        self.feed(path.read_text(encoding="utf-8"))
        self.text = " ".join("".join(self.words).split())

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.places |= {found[key] for key in ("id", "name") if found.get(key)}
        if tag == "a" and found.get("href"):
            self.links.append(found["href"])
        elif found.get("src") or (tag == "link" and found.get("href")):
            self.resources.append(found.get("src") or found["href"])

    def handle_data(self, data):
        self.words.append(data)


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    build = [sys.executable, ROOT / "docs" / "site" / "build.py", folder, "--without-running"]
    environment = {**os.environ, "PYTHONPATH": str(Path(ucrit.__file__).parent.parent)}
    done = subprocess.run(build, capture_output=True, text=True, env=environment)
    pages = {str(path.relative_to(folder / "html")): Read(path) for path in (folder / "html").rglob("*.html")}
    return pages, folder, done


def test_the_pages_are_built_without_a_warning(site):
    *_, done = site
    assert done.returncode == 0, done.stdout + done.stderr
    assert not done.stderr


def test_every_page_is_in_the_menu(site):
    pages, *_ = site
    linked = set(pages["index.html"].links)
    for name in PAGES:
        assert f"{name}.html" in pages
        assert name == "index" or f"{name}.html" in linked


def test_nothing_is_fetched_from_elsewhere(site):
    pages, folder, _ = site
    for name, page in pages.items():
        away = [r for r in page.resources if re.match(r"(https?:)?//", r)]
        assert not away, f"{name} fetches {away}"
    for style in (folder / "html").rglob("*.css"):
        text = style.read_text(encoding="utf-8")
        assert not re.search(r"@import|url\(\s*[\"']?(https?:)?//|@font-face", text), style.name


def test_every_link_leads_somewhere(site):
    pages, folder, _ = site
    for name, page in pages.items():
        for link in {*page.links, *page.resources}:
            if re.match(r"https?:|mailto:|data:", link):
                continue
            path, _, place = unquote(link).partition("#")
            path = path.partition("?")[0]
            target = ((folder / "html" / name).parent / path).resolve() if path else folder / "html" / name
            assert target.is_file(), f"{name} links to {link}"
            there = str(target.relative_to((folder / "html").resolve()))
            assert not place or there not in pages or place in pages[there].places, f"{name} links to {link}"


@pytest.mark.parametrize("name", model_names())
def test_a_models_page_has_what_is_declared_and_published(site, name):
    text = site[0][f"reference/models/{name}.html"].text
    described = ucrit.show(name)
    for quantity in (*described.parameters, *described.variables, *described.inputs, *described.outputs):
        assert quantity.meaning in text
    assert all(" ".join(source.split()) in text for source in described.sources)
    assert " digits" in text or "numbers" not in {c.of.split()[1] for c in ucrit.cite(find_model(name))}


def test_vehicles_laws_commands_and_names_are_all_in_the_reference(site):
    pages, *_ = site
    vehicles = pages["reference/vehicles.html"].text
    for name in vehicle_names():
        info = ucrit.load(name).info
        assert name in vehicles
        assert " ".join(info.source.replace("`", "").split()) in vehicles
    laws = pages["reference/laws.html"].text
    assert all(name in laws for name in (*controller_names(), *tire_names(), "brush", "linear"))
    commands = pages["reference/commands.html"].text
    assert all(f"Usage: ucrit {name} " in commands for name in COMMANDS)
    for name in ucrit._PUBLIC:
        page = pages[f"reference/python/{name.lower()}.html"]
        assert f"ucrit.{getattr(ucrit, name).__name__}" in page.places or f"ucrit.{name}" in page.places


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda p: p.stem)
def test_an_example_runs(path):
    assert path.read_text(encoding="utf-8").startswith('"""\n')
    with mpl.rc_context():
        names = runpy.run_path(str(path))
    assert any(type(value).__name__ == "Figure" for value in names.values()), "it draws nothing"
