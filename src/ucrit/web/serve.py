"""Starting the explorer: a socket on the loopback address, the address in words, a browser window."""

from __future__ import annotations

import errno
import os
import socket
import sys
from collections.abc import Callable
from typing import Any
from urllib.parse import urlencode

from ..core.contract.model import Model
from ..core.errors import MissingExtraError, UcritError

PORT = 8642
HOST = "127.0.0.1"


def app(
    vehicle: Model | str | os.PathLike[str] | None = None,
    *,
    host: str = HOST,
    port: int = PORT,
    browser: bool = True,
    tell: Callable[[str], Any] = print,
) -> None:
    """Serve the explorer, a page in the browser, until interrupted.

    Parameters
    ----------
    vehicle
        What the page shows first: a vehicle, the name of one that is shipped, or a vehicle file of shipped models.
    host
        Name or address to serve at. Other machines reach any other than the loopback's; there is no password.
    port
        Port of that address; 0 for any that is free.
    browser
        Whether a browser window is opened.
    tell
        Called with the lines that say where the page is.

    Raises
    ------
    UcritError
        If the address cannot be served, or the vehicle cannot be shown.
    MissingExtraError
        If Starlette and uvicorn are not installed.

    Examples
    --------
    >>> import ucrit
    >>> ucrit.app("caravan")  # doctest: +SKIP
    """
    try:
        import uvicorn

        from .routes import application
    except ImportError as error:
        raise MissingExtraError(
            f"the explorer needs the package '{error.name}'; install it with: pip install 'ucrit[app]'"
        ) from None
    from .guard import is_loopback

    place = _fragment(vehicle)
    listening = listen(host, port)
    address = _address(host, listening.getsockname()[1]) + place
    if not is_loopback(host):
        tell(f"Warning: every machine that reaches {host} can use this page; there is no password.")
    tell(f"The explorer is at {address}")
    tell("Stop it with Ctrl-C.")
    sys.stdout.flush()
    if browser:
        import webbrowser

        webbrowser.open(address)  # the socket listens already: a browser that is faster than the server waits
    config = uvicorn.Config(application(host), log_level="warning", access_log=False, server_header=False)
    try:
        uvicorn.Server(config).run(sockets=[listening])
    except KeyboardInterrupt:
        pass
    finally:
        listening.close()


def _fragment(vehicle: Model | str | os.PathLike[str] | None) -> str:
    """Return the part of the address that tells the page what to show; it never goes over the line."""
    from ..catalogue import load, read_vehicle, vehicle_names
    from ..core.contract.files import write_vehicle

    if vehicle is None:
        return ""
    if isinstance(vehicle, str) and vehicle in vehicle_names():
        return "#" + urlencode({"v": vehicle})
    subject = vehicle if isinstance(vehicle, Model) else load(vehicle)
    text = write_vehicle(subject)
    try:
        same = read_vehicle(text, "the vehicle")
    except UcritError:
        same = None
    if type(same) is not type(subject):
        model = type(subject).model_id()
        raise UcritError(
            f"the explorer shows models, laws and tires of the catalogue, and bond graphs; '{model}' is made of others"
        )
    return "#" + urlencode({"toml": text})


def listen(host: str, port: int) -> socket.socket:
    """Return a socket that listens, with Nagle's algorithm off; raise `UcritError` where it cannot."""
    if isinstance(port, bool) or not isinstance(port, int) or not 0 <= port < 2**16:
        raise UcritError(f"a port is a whole number from 0 to 65535, got {port!r}")
    try:
        family, kind, protocol, _, place = socket.getaddrinfo(
            host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )[0]
    except (OSError, UnicodeError):
        raise UcritError(f"there is no address of the name '{host}' on this machine") from None
    # asyncio switches Nagle's algorithm off where the protocol is named; with it each answer takes 40 ms longer.
    listening = socket.socket(family, kind, protocol or socket.IPPROTO_TCP)
    if os.name != "nt":  # elsewhere it would let two servers share a port
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listening.bind(place)
        listening.listen(128)
    except OSError as error:
        listening.close()
        if error.errno == errno.EADDRINUSE:
            raise UcritError(f"port {port} of {host} is taken; take another, or 0 for any that is free") from None
        raise UcritError(f"port {port} of {host} cannot be served: {error.strerror or error}") from None
    return listening


def _address(host: str, port: int) -> str:
    shown = {"0.0.0.0": socket.gethostname(), "::": socket.gethostname()}.get(host, host)
    return f"http://{f'[{shown}]' if ':' in shown else shown}:{port}/"
