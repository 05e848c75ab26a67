"""Build the pages in docs, the gallery and the reference: ``python docs/site/build.py [folder]``, ``make docs``.

The pages are run, as far as they or the package changed since. They are copied to a folder of their own, links between
them adjusted, and the reference is written beside them from the declarations of models, vehicles, laws and commands.
Sphinx does the rest; its warnings are errors.
"""

import argparse
import hashlib
import inspect
import re
import shutil
import sys
import tempfile
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "docs" / "images"))

import commands  # noqa: E402
import interface  # noqa: E402
from draw import PICTURES, check, command  # noqa: E402
from execute import run_page  # noqa: E402
from pictures import COMPARED  # noqa: E402

import models  # noqa: E402
from ucrit.catalogue import model_names, vehicle_names  # noqa: E402

DOCS = ROOT / "docs"
LINK = re.compile(r"(\]\()([^)\s]+)((?: \"[^\"]*\")?\))")
PICTURE = re.compile(r"^!\[.*\]\(images/([\w-]+)\.png .*\)$", re.MULTILINE)
LINKED = re.compile(r"\]\(([\w-]+)\.md\)")
NAME = re.compile(r"(?<![\[`])`([a-z0-9-]+)`(?![`\]])")
LANGUAGE = re.compile(r"^(`{3,})(\w+)$", re.MULTILINE)
REFERENCE = [
    "reference/models/index",
    "reference/vehicles",
    "reference/laws",
    "reference/commands",
    "reference/python/index",
    "changelog",
]


def write(path, text):
    """Write a page if it is not there as it is: what has not changed is not read again."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not (path.is_file() and path.read_text(encoding="utf-8") == text):
        path.write_text(text, encoding="utf-8")


def moved(target):
    """Return where a link leads in the built pages."""
    if target.startswith(("http", "#")):
        return target
    path, sharp, anchor = target.partition("#")
    name = path.removeprefix("../").removeprefix("docs/")
    return {"README.md": "readme.md", "CHANGELOG.md": "changelog.md"}.get(name, name) + sharp + anchor


def coloured(language):
    """Return the name of a language, ``text`` for one that is not known."""
    from pygments.lexers import get_lexer_by_name
    from pygments.util import ClassNotFound

    try:
        get_lexer_by_name(language)
    except ClassNotFound:
        return "text"
    return language


def linked(match):
    """Return the name of a model or a vehicle as a link to the reference."""
    name = match[1]
    if name in vehicle_names():
        return f"[`{name}`](reference/models/{models.base_of(name)}.md#{name})"
    return f"[`{name}`](reference/models/{name}.md)" if name in model_names() else match[0]


def explained(match):
    """Return a picture with what draws it below, folded up."""
    if match[1] not in PICTURES:
        return match[0]
    code = textwrap.dedent(inspect.getsource(PICTURES[match[1]])).rstrip()
    told = f"<summary>How this is drawn</summary>\n\n`{command(match[1])}`\n\n```python\n{code}\n```"
    return f'{match[0]}\n\n<details class="drawn">{told}\n\n</details>'


def page(path):
    """Return a page's text with its links adjusted, links to the reference, and no language that cannot be coloured."""
    text = LANGUAGE.sub(lambda match: match[1] + coloured(match[2]), path.read_text(encoding="utf-8"))
    text = LINK.sub(lambda match: match[1] + moved(match[2]) + match[3], text)
    text = PICTURE.sub(explained, text)
    parts = re.split(r"(^```.*?^```$)", text, flags=re.MULTILINE | re.DOTALL)
    return "".join(part if part.startswith("```") else NAME.sub(linked, part) for part in parts)


def execute(pages, folder):
    """Run the pages, and draw the slow pictures, that are not known to be right; return what is wrong, by name."""
    package = hashlib.sha256()
    for path in sorted((*(ROOT / "src").rglob("*"), *(DOCS / "images").glob("*.py"))):
        if path.is_file() and path.suffix not in (".pyc",):
            package.update(path.read_bytes())
    wrong = {}
    slow = [name for name, when in COMPARED.items() if when == "build"]
    for name, path in {**pages, **{name: DOCS / "images" / f"{name}.png" for name in slow}}.items():
        stamp = folder / "run" / name
        state = hashlib.sha256(path.read_bytes() + package.digest()).hexdigest()
        if stamp.is_file() and stamp.read_text(encoding="utf-8") == state:
            continue
        with tempfile.TemporaryDirectory() as place:
            try:
                told = check(name) if name in slow else run_page(path, Path(place), folder / "cache")
            except AssertionError as error:
                told = str(error)
        if told:
            wrong[name] = told
        else:
            write(stamp, state)
    return wrong


def titled(name):
    """Return a page as the menu has it: by its own title, or by one that tells more."""
    return "Read me first <readme>" if name == "readme" else name


def index():
    """Return the first page, and the menu: the pages under each of its headings, in their order."""
    text = page(DOCS / "index.md")
    first, *parts = re.split(r"^## ", text, flags=re.MULTILINE)
    menus = {"": first, **dict(part.split("\n", 1) for part in parts)}
    menus = {title.replace("*", ""): dict.fromkeys(map(titled, LINKED.findall(part))) for title, part in menus.items()}
    menus |= {"Examples": ["gallery/index"], "Reference": REFERENCE}
    lists = [
        "```{toctree}\n:hidden:\n" + f":caption: {title}\n" * bool(title) + "\n" + "\n".join(found) + "\n```"
        for title, found in menus.items()
    ]
    return text + "\n" + "\n\n".join(lists) + "\n"


def sources():
    """Return all pages that are written by hand, by their names in the site."""
    pages = {path.stem: path for path in sorted(DOCS.glob("*.md"))}
    return pages | {"readme": ROOT / "README.md", "changelog": ROOT / "CHANGELOG.md"}


def stage(folder):
    """Write everything that Sphinx reads."""
    pages = sources()
    wanted = {folder / "index.md": index()}
    wanted |= {folder / f"{name}.md": page(path) for name, path in pages.items() if name != "index"}
    for part in (models, commands, interface):
        wanted |= {folder / "reference" / name: text for name, text in part.pages().items()}
    for old in (*folder.glob("*.md"), *folder.glob("reference/**/*.*")):
        if old not in wanted and old.is_file():
            old.unlink()
    for path, text in wanted.items():
        write(path, text)
    shutil.copytree(
        DOCS / "images", folder / "images", dirs_exist_ok=True, ignore=shutil.ignore_patterns("*.py", "__*")
    )


def main(arguments=None):
    """Write the sources and build the pages; return Sphinx's exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", nargs="?", default=str(ROOT / "build" / "docs"), help="where to (build/docs)")
    parser.add_argument("--without-running", action="store_true", help="run neither the pages nor the examples")
    chosen = parser.parse_args(arguments)
    folder = Path(chosen.folder).resolve()
    if not chosen.without_running and (wrong := execute(sources(), folder)):
        sys.exit("\n\n".join(f"{name} shows what is not so:\n{text}" for name, text in wrong.items()))
    stage(folder / "source")
    from sphinx.cmd.build import main as sphinx

    options = ["-D", "plot_gallery=0"] if chosen.without_running else []
    here = str(Path(__file__).parent)
    places = [str(folder / "source"), str(folder / "html")]
    return sphinx(["-W", "--keep-going", "-q", "-c", here, "-d", str(folder / "doctrees"), *options, *places])


if __name__ == "__main__":
    sys.exit(main())
