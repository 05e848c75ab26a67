"""What goes wrong becomes one sentence on stderr and an exit status.

0 done; 1 a check failed; 2 wrong input; 3 not stable, where that was asked; 130 interrupted. Exceptions that
are not the user's are bugs and show themselves in full.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Iterable
from types import TracebackType
from typing import Any

import click

WRONG_INPUT = 2
INTERRUPTED = 130


def exit_status(run: Callable[[], Any]) -> int:
    """Run a command and return the status to leave with."""
    try:
        result = run()
        sys.stdout.flush()
    except click.ClickException as error:
        return tell(usage_sentence(error))
    except (click.Abort, KeyboardInterrupt):
        return INTERRUPTED
    except BrokenPipeError:
        return _quiet_end()
    except OSError as error:  # a full disk behind stdout, a file that vanished
        _quiet_end()
        what = f"'{error.filename}': " if error.filename else ""
        return tell(f"the result cannot be written or read: {what}{error.strerror or error}")
    except MemoryError:
        return tell("this takes more memory than there is; take fewer points, or write them to a .zarr store")
    except Exception as error:
        sentence = _sentence(error)
        if sentence is None:
            raise
        return tell(sentence)
    return result if isinstance(result, int) else 0


def tell(sentence: str) -> int:
    """Print one line on stderr and return the status for wrong input."""
    click.echo(f"ucrit: {' '.join(sentence.split())}", err=True)
    return WRONG_INPUT


def usage_sentence(error: click.ClickException) -> str:
    """Return what is wrong with the command line, with a near match for a misspelt option."""
    context = getattr(error, "ctx", None)
    hint = f"; see '{context.command_path} --help'" if context else ""
    if isinstance(error, click.NoSuchOption) and context:
        known = _options(context.command.params)
        name = _nearest(error.option_name, known)
        return f"there is no option '{error.option_name}'" + (f"; did you mean '{name}'?" if name else hint)
    text = " ".join(error.format_message().split()).rstrip(".")
    text = text[:1].lower() + text[1:]
    return text if "; did you mean" in text or "; allowed:" in text else text + hint


def _options(params: Iterable[click.Parameter]) -> list[str]:
    return [name for p in params if isinstance(p, click.Option) for name in (*p.opts, *p.secondary_opts)] + ["--help"]


def _nearest(name: str, known: list[str]) -> str | None:
    from difflib import get_close_matches

    return next(iter(get_close_matches(name, [k for k in known if k.startswith("--")], n=1, cutoff=0.5)), None)


def _quiet_end() -> int:
    """End like other tools when the reader of a pipe is gone; what is left in the buffer goes nowhere."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 0


def _sentence(error: Exception) -> str | None:
    """Return the sentence of an error that is the user's to mend, ``None`` for a bug."""
    errors = sys.modules.get("ucrit.core.errors")
    if errors and isinstance(error, errors.UcritError):
        return str(error)
    place = _in_user_file(error.__traceback__)
    return place and f"{place}: {type(error).__name__}: {error}{_hint(error)}"


def _hint(error: Exception) -> str:
    """Say what to do about errors that symbols raise, with which a model's equations are run once."""
    told = str(error)
    if isinstance(error, TypeError) and ("to float" in told or "ufunc" in told):
        return "; equations are run with symbols: take sin, cos, sqrt ... from ucrit.core, not from math or numpy"
    if isinstance(error, TypeError) and "truth value" in told:
        return "; equations are run with symbols: take where(condition, one, other) from ucrit.core instead of 'if'"
    return ""


def _in_user_file(trace: TracebackType | None) -> str | None:
    """Return file and line where a user's model file raised; it is run, but is no imported module."""
    found = None
    while trace is not None:
        code, own = trace.tb_frame.f_code, trace.tb_frame.f_globals
        module = sys.modules.get(own.get("__name__", ""))
        if (module is None or vars(module) is not own) and re.search(r"\.py$", code.co_filename):
            found = f"'{code.co_filename}' cannot be used, line {trace.tb_lineno}"
        trace = trace.tb_next
    return found
