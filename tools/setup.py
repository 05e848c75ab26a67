"""Make a virtual environment with ucrit, its locked dependencies and its tests' tools.

Run as ``python3 tools/setup.py .venv``.

Debian's Python comes without ensurepip, so pip is started from the wheel beside this file.
"""

import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def main(folder: str) -> None:
    """Create the environment in ``folder``, from scratch."""
    if sys.version_info < (3, 11):  # noqa: UP036 - this file is run by whatever Python there is
        sys.exit(f"ucrit needs Python 3.11 or newer, not {sys.version.split()[0]}: make PYTHON=python3.12 ...")
    venv.EnvBuilder(clear=True, symlinks=True).create(folder)
    python = Path(folder).absolute() / "bin" / "python"
    (wheel,) = (ROOT / "tools").glob("pip-*.whl")
    pip = [python, wheel / "pip", "--disable-pip-version-check", "install", "--quiet"]
    for what in (["-r", "requirements.lock"], ["--no-deps", "--editable", "."]):
        subprocess.run([*pip, *what], cwd=ROOT, check=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
