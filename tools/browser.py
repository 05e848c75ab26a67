"""Find a Chromium for the browser tests, or try to install Debian's: ``python3 tools/browser.py``.

Quiet and never fatal: where there is none in the end, the browser tests are skipped and say so.
"""

import os
import shutil
import subprocess

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
APT = ("apt-get", "-o", "DPkg::Lock::Timeout=60", "-qq")


def find() -> str | None:
    """Return the path of a Chromium or Chrome, the one in ``CHROMIUM`` first."""
    named = os.environ.get("CHROMIUM")
    return named or next((path for path in map(shutil.which, NAMES) if path), None)


def install() -> None:
    """Try to install one, as root on a Debian or as a user who may become root without a password."""
    if find() or not shutil.which("apt-get"):
        return
    root = () if os.geteuid() == 0 else ("sudo", "-n") if shutil.which("sudo") else None
    if root is None:
        return
    quiet = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "check": False}
    env = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    for step in (("update",), ("install", "-y", "--no-install-recommends", "chromium")):
        try:
            subprocess.run([*root, *APT, *step], timeout=300, env=env, **quiet)
        except (OSError, subprocess.TimeoutExpired):
            return


if __name__ == "__main__":
    install()
    print(f"browser tests use {find()}" if find() else "no Chromium: browser tests will be skipped")
