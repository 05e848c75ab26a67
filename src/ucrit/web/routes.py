"""The paths of the server: the page, its files, and one path for each thing that it asks."""

from __future__ import annotations

import json
import threading
import traceback
from collections import defaultdict
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import anyio
import numpy as np
from anyio import CapacityLimiter, to_thread
from starlette.applications import Starlette
from starlette.responses import Response
from starlette.routing import Route

from ..core.errors import UcritError
from . import answers, beyond
from .downloads import File, download
from .equations import equations
from .guard import MAX_BODY, Guard, TooLargeError
from .motions import motion
from .subject import read_json, read_subject

if TYPE_CHECKING:
    from starlette.requests import Request

    from ..core.contract.model import Model

ASSETS = Path(__file__).resolve().parent / "assets"
TYPES = {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".svg": "image/svg+xml",
}

QUICK: dict[str, Callable[[Model, Mapping[str, Any]], Any]] = {"state": answers.state, "map": answers.plane}
"""Asked while a slider moves."""

SLOW: dict[str, Callable[[Model, Mapping[str, Any]], Any]] = {
    "open": answers.opened,
    "remedies": answers.remedies,
    "sure": answers.sure,
    "motion": motion,
    "equations": equations,
    "handling": beyond.handling,
    "cycles": beyond.cycles,
    "download": download,
}
"""Asked once in a while; some derive formulas for seconds."""

TIME_LIMIT = 60.0
"""Seconds after which a visitor is told that it takes too long."""

BODY_TIME = 10.0
"""Seconds in which the body of a request must have arrived."""

_deriving: defaultdict[type[Model], threading.Lock] = defaultdict(threading.Lock)
_derived: set[tuple[str, type[Model]]] = set()


def application(host: str = "127.0.0.1") -> Guard:
    """Return the ASGI application that serves the page to a host name or address."""
    files = {path.name: path.read_bytes() for path in ASSETS.iterdir() if path.suffix in TYPES}
    quick, slow = CapacityLimiter(8), CapacityLimiter(4)

    async def asset(request: Request) -> Response:
        name = request.path_params.get("name", "index.html")
        if name not in files:
            return _json({"error": f"there is no page '/{name[:100]}'"}, 404)
        return Response(files[name], media_type=TYPES[Path(name).suffix])

    async def vehicles(request: Request) -> Response:
        return _json(await to_thread.run_sync(answers.catalogue, limiter=quick))

    async def ask(request: Request) -> Response:
        name = request.path_params["name"]
        lane, group = (quick, QUICK) if name in QUICK else (slow, SLOW)
        if name not in group:
            return _json({"error": f"there is nothing to ask at '/api/{name[:100]}'"}, 404)
        return await _answered(request, name, group[name], lane)

    routes = [
        Route("/", asset),
        Route("/{name}", asset),
        Route("/api/vehicles", vehicles),
        Route("/api/{name}", ask, methods=["POST"]),
    ]
    errors: Any = {404: _not_found, 405: _not_found}
    pages = Starlette(routes=routes, exception_handlers=errors)
    pages.router.redirect_slashes = False
    return Guard(pages, host)


async def _not_found(request: Request, error: Exception) -> Response:
    return _json({"error": "there is no such page"}, getattr(error, "status_code", 404))


async def _answered(
    request: Request, name: str, work: Callable[[Model, Mapping[str, Any]], Any], lane: CapacityLimiter
) -> Response:
    """Do the work in a thread of a lane; whatever goes wrong becomes one sentence."""
    if request.headers.get("content-type", "").partition(";")[0].strip().lower() != "application/json":
        return _json({"error": "a request must be of the type application/json"}, 415)
    try:
        with anyio.fail_after(BODY_TIME):
            content = await request.body()
        with anyio.fail_after(TIME_LIMIT):
            return await to_thread.run_sync(
                partial(_respond, name, work, content), limiter=lane, abandon_on_cancel=True
            )
    except TooLargeError:
        return _json({"error": f"a request may have {MAX_BODY // 1024} kB, not more"}, 413)
    except TimeoutError:
        sentence = "this takes longer than a page can wait; ask again in a minute: what was derived by then is kept"
        return _json({"error": sentence}, 503)
    except UcritError as error:
        return _json({"error": " ".join(str(error).split())}, 400)
    except Exception:
        traceback.print_exc()
        return _json({"error": "this cannot be computed: ucrit has a fault here, told where the server runs"}, 500)


def _respond(name: str, work: Callable[[Model, Mapping[str, Any]], Any], content: bytes) -> Response:
    """Read a request, work on it and make the response, all in the thread."""
    body = read_json(content)
    vehicle = read_subject(body)
    with np.errstate(all="ignore"):  # what comes of overflows is seen below, where it cannot be written as JSON
        try:
            found = _worked(name, work, vehicle, body)
            if not isinstance(found, File):
                return _json(found)
        except (ArithmeticError, np.linalg.LinAlgError, NotFiniteError):
            raise UcritError("these values lead to numbers too large or too small to compute with") from None
    disposition = {"content-disposition": f'attachment; filename="{found.name}"'}
    return Response(found.content, media_type=found.media, headers=disposition)


def _worked(name: str, work: Callable[[Model, Mapping[str, Any]], Any], vehicle: Model, body: Mapping[str, Any]) -> Any:
    """Do the work; of those who ask a model's formulas first, one derives them while the others wait."""
    key = (name, type(vehicle))
    if key in _derived:
        return work(vehicle, body)
    with _deriving[type(vehicle)]:
        found = work(vehicle, body)
        _derived.add(key)
        return found


class NotFiniteError(Exception):
    """An answer with an infinite or undefined number in it."""


def _json(content: Any, status: int = 200) -> Response:
    try:
        text = json.dumps(content, allow_nan=False, separators=(",", ":"), ensure_ascii=False)
    except ValueError:
        raise NotFiniteError from None
    return Response(text.encode(errors="replace"), status, media_type="application/json")
