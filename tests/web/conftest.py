"""A real server on a free port, a way to ask it, and a real headless Chromium."""

from __future__ import annotations

import http.client
import importlib.util
import json
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import pytest
import uvicorn

from ucrit.web.routes import application
from ucrit.web.serve import listen

TOOL = Path(__file__).parents[2] / "tools" / "browser.py"


class Answer(NamedTuple):
    """What came back."""

    status: int
    headers: dict[str, str]
    content: bytes

    def json(self) -> Any:
        """Return the content as plain data."""
        return json.loads(self.content)


@pytest.fixture(scope="session")
def port() -> Iterator[int]:
    """Port of a server that runs in a thread."""
    listening = listen("127.0.0.1", 0)
    config = uvicorn.Config(application(), log_level="error", access_log=False, server_header=False)
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]}, daemon=True)
    thread.start()
    yield listening.getsockname()[1]
    server.should_exit = True
    thread.join(10)
    listening.close()


@pytest.fixture(scope="session")
def ask(port: int) -> Callable[..., Answer]:
    """Ask the server; a body that is not bytes is sent as JSON."""

    def call(path: str, body: Any = None, method: str | None = None, **headers: str) -> Answer:
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
        sent = {"Content-Type": "application/json", **{k.replace("_", "-"): v for k, v in headers.items()}}
        content = body if isinstance(body, bytes | None) else json.dumps(body).encode()
        connection.request(method or ("GET" if body is None else "POST"), path, content, sent)
        response = connection.getresponse()
        answer = Answer(response.status, {k.lower(): v for k, v in response.getheaders()}, response.read())
        connection.close()
        return answer

    return call


def chromium() -> str | None:
    """Return the path of a Chromium, as the tool that installs it finds it."""
    spec = importlib.util.spec_from_file_location("browser_tool", TOOL)
    assert spec is not None
    assert spec.loader is not None
    tool = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tool)
    found: str | None = tool.find()
    return found


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """A headless Chromium that can reach no name and no address but this machine's."""
    path = chromium()
    if path is None:
        pytest.skip("no Chromium was found, and python3 tools/browser.py could not install one")
    sync = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
    flags = ["--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1", "--no-sandbox"]
    with sync.sync_playwright() as playwright:
        found = playwright.chromium.launch(executable_path=path, args=flags)
        yield found
        found.close()


class Page:
    """A page that remembers what went wrong and what it asked for."""

    def __init__(self, browser: Any, port: int, **options: Any) -> None:
        self.home = f"http://127.0.0.1:{port}/"
        self.context = browser.new_context(viewport={"width": 1300, "height": 900}, reduced_motion="reduce", **options)
        self.page = self.context.new_page()
        self.wrong: list[str] = []
        self.asked: list[str] = []
        self.page.on("console", lambda m: self.wrong.append(m.text) if m.type in ("error", "warning") else None)
        self.page.on("pageerror", lambda e: self.wrong.append(str(e)))
        self.page.on("request", lambda r: self.asked.append(r.url))

    def mark(self) -> str:
        """Return how often the page has come to rest."""
        return self.page.evaluate("document.documentElement.dataset.settled || '0'")

    def settle(self, before: str) -> None:
        """Wait until the page comes to rest after a moment that `mark` noted."""
        self.page.wait_for_selector(f"html[data-settled]:not([data-settled='{before}'])", state="attached")

    def visit(self, fragment: str) -> None:
        """Open the page with a link."""
        if not self.page.url.startswith(self.home):
            self.page.goto(self.home + fragment)
            self.settle("0")
            return
        before = self.mark()
        self.page.evaluate("fragment => { location.hash = fragment; }", fragment)
        self.settle(before)

    def change(self, act: Callable[[], Any]) -> None:
        """Do something and wait until the page has come to rest again."""
        before = self.mark()
        act()
        self.settle(before)

    def text(self, selector: str) -> str:
        """Return the text of an element."""
        return self.page.locator(selector).inner_text()


@pytest.fixture
def open_page(browser: Any, port: int) -> Iterator[Callable[..., Page]]:
    """Open pages that are closed at the end, with nothing said on their consoles and nobody asked elsewhere."""
    pages: list[Page] = []

    def make(fragment: str = "#v=caravan", **options: Any) -> Page:
        pages.append(Page(browser, port, **options))
        pages[-1].visit(fragment)
        return pages[-1]

    yield make
    for page in pages:
        page.context.close()
        assert page.wrong == []
        assert all(url.startswith((page.home, "blob:", "data:")) for url in page.asked)
