"""Who may ask, and what the server gives away."""

from __future__ import annotations

import http.client
import os
import re
import signal
import socket
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from ucrit import UcritError, app, load
from ucrit.core.errors import MissingExtraError
from ucrit.web.guard import MAX_BODY, Guard, is_loopback

CARAVAN = {"vehicle": "caravan"}


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:80", "127.0.0.1.evil.example", "", "192.168.1.5", "localhost.evil"]
)
def test_other_names_are_turned_away(ask: Any, host: str) -> None:
    for path, body in (("/", None), ("/api/state", CARAVAN)):
        answer = ask(path, body, Host=host)
        assert answer.status == 421
        assert "does not answer to the name" in answer.json()["error"]


@pytest.mark.parametrize("host", ["localhost", "LOCALHOST:1", "127.0.0.1", "[::1]:8642", "127.0.0.2"])
def test_own_names_are_answered(ask: Any, host: str) -> None:
    assert ask("/", Host=host).status == 200


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "https://127.0.0.1", "http://127.0.0.1:1"])
def test_pages_from_elsewhere_are_turned_away(ask: Any, origin: str) -> None:
    answer = ask("/api/state", CARAVAN, Origin=origin)
    assert answer.status == 403
    assert "access-control-allow-origin" not in answer.headers


def test_the_own_page_is_answered(ask: Any, port: int) -> None:
    assert ask("/api/state", CARAVAN, Origin=f"http://127.0.0.1:{port}").status == 200


def test_a_form_elsewhere_cannot_post(ask: Any) -> None:
    for media in ("text/plain", "application/x-www-form-urlencoded", ""):
        assert ask("/api/state", CARAVAN, Content_Type=media).status == 415


def test_large_bodies_are_refused(ask: Any, port: int) -> None:
    assert ask("/api/state", b"x" * (MAX_BODY + 1)).status == 413
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=20)
    pieces = (b" " * 50_000 for _ in range(6))  # of unannounced length
    connection.request("POST", "/api/state", pieces, {"Content-Type": "application/json"}, encode_chunked=True)
    assert connection.getresponse().status in (400, 413)
    connection.close()
    assert ask("/api/state", b"{}", Content_Length="-1").status in (400, 413)


PATHS = [
    "/../pyproject.toml",
    "/..%2f..%2fpyproject.toml",
    "/%2e%2e/routes.py",
    "/routes.py",
    "/equations.html.jinja",
    "/assets/app.js",
    "//etc/passwd",
    "/etc/passwd",
    "/app.js%00",
    "/api/",
    "/api/../routes.py",
    "/.git/config",
]


@pytest.mark.parametrize("path", PATHS)
def test_nothing_on_the_disk_can_be_read(ask: Any, path: str) -> None:
    answer = ask(path)
    assert answer.status in (404, 405)
    assert set(answer.json()) == {"error"}


def test_what_the_page_is_made_of(ask: Any) -> None:
    page = ask("/")
    assert "default-src 'none'" in page.headers["content-security-policy"]
    assert page.headers["x-content-type-options"] == "nosniff"
    assert "server" not in page.headers
    for name in re.findall(r'(?:href|src)="([^"#]+)"', page.content.decode()):
        assert ask(f"/{name}").status == 200
    assert not re.search(rb"https?://", page.content)
    assert ask("/app.js").headers["content-type"].startswith("text/javascript")
    assert ask("/api/state").status in (404, 405)
    assert ask("/api/nothing", {}).status == 404


def test_no_asset_asks_another_machine() -> None:
    folder = Path(__file__).parents[2] / "src" / "ucrit" / "web" / "assets"
    for path in folder.iterdir():
        addresses = set(re.findall(r"https?://[^\s\"'`]+", path.read_text()))
        assert addresses <= {"http://www.w3.org/2000/svg"}, path.name


def test_an_open_address_answers_addresses_and_its_own_name_only() -> None:
    guard = Guard(lambda *_: None, "0.0.0.0")  # type: ignore[arg-type, return-value]
    for host, fine in (("192.168.1.5:8642", True), ("evil.example", False), ("localhost", True)):
        assert (guard.refusal({b"host": host}) is None) == fine
    assert Guard(lambda *_: None, "lab.example").refusal({b"host": "lab.example:80"}) is None  # type: ignore[arg-type, return-value]
    assert not is_loopback("lab.example")


# --- starting it


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    import uvicorn

    monkeypatch.setattr(uvicorn.Server, "run", lambda self, sockets: None)
    return []


def test_the_address_is_told(started: list[str]) -> None:
    app("caravan", port=0, browser=False, tell=started.append)
    assert re.fullmatch(r"The explorer is at http://127\.0\.0\.1:\d+/#v=caravan", started[0])


def test_other_machines_are_let_in_with_a_warning_only(started: list[str]) -> None:
    app(host="0.0.0.0", port=0, browser=False, tell=started.append)
    assert "Warning: every machine that reaches 0.0.0.0" in started[0]


def test_a_vehicle_of_ones_own_is_in_the_link(started: list[str]) -> None:
    app(load("caravan").with_(m=1300), port=0, browser=False, tell=started.append)
    assert "#toml=" in started[0]
    assert "1300.0" in started[0]


def test_a_model_of_ones_own_is_refused(started: list[str], tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text(
        "import ucrit\nclass Mine(ucrit.Model):\n    m: float = ucrit.param('kg', 'mass')\n"
        "    y = ucrit.coordinate('m', 'place')\n    def equations(self, ddx):\n        return self.m * ddx.y\n"
    )
    (tmp_path / "mine.toml").write_text('model = "mine.py"\n[parameters]\nm = 1\n')
    with pytest.raises(UcritError, match="'Mine' is made of others"):
        app(tmp_path / "mine.toml", port=0, browser=False, tell=started.append)


def test_a_port_that_is_taken(started: list[str]) -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        taken = other.getsockname()[1]
        with pytest.raises(UcritError, match=f"port {taken} of 127.0.0.1 is taken"):
            app(port=taken, browser=False)


@pytest.mark.parametrize(
    ("options", "sentence"), [({"port": 70000}, "from 0 to 65535"), ({"host": "no.such.name.invalid"}, "no address")]
)
def test_wrong_addresses(started: list[str], options: dict[str, Any], sentence: str) -> None:
    with pytest.raises(UcritError, match=sentence):
        app(browser=False, **options)


def test_without_the_extra_a_sentence_tells_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "uvicorn", None)
    with pytest.raises(MissingExtraError, match=r"pip install 'ucrit\[app\]'"):
        app(browser=False)


def test_the_command_serves_and_stops() -> None:
    command = [
        sys.executable,
        "-c",
        "from ucrit.cli import main; main()",
        "app",
        "caravan",
        "--port",
        "0",
        "--no-browser",
    ]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env={**os.environ})
    assert process.stdout is not None
    line = process.stdout.readline()
    port = int(re.search(r"127\.0\.0\.1:(\d+)/#v=caravan", line)[1])  # type: ignore[index]
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=20)
    connection.request("GET", "/")
    assert connection.getresponse().status == 200
    connection.close()
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=20)
    assert process.returncode == 0
    assert said == ""
