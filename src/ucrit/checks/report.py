"""What came out of checking a model: one line per check."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from ..core.errors import ModelError
from ..core.html import Rich

MARKS = {True: "pass", False: "FAIL", None: "  - "}


class FailedCheckError(ModelError):
    """What a check raises when the model is wrong; its text says what and where."""


class NotApplicableError(Exception):
    """What a check raises when there is nothing to check; its text says why."""


@dataclass(frozen=True)
class Check:
    """Outcome of one check: ``passed`` is ``None`` where the check did not apply, and ``detail`` says why."""

    name: str
    passed: bool | None
    detail: str

    def __str__(self) -> str:
        return f"{MARKS[self.passed]}  {self.name}: {self.detail}"


@dataclass(frozen=True)
class Report(Rich):
    """Outcome of all checks of one model, in the order they ran.

    Examples
    --------
    >>> report = Report("cart", (Check("mirror symmetry", False, "x changes with the side"),))
    >>> print(report)
    cart: 1 of 1 checks failed
    FAIL  mirror symmetry: x changes with the side
    >>> report.ok
    False
    """

    model: str
    checks: tuple[Check, ...]

    @property
    def ok(self) -> bool:
        """True if no check failed."""
        return not self.failed

    @property
    def failed(self) -> tuple[Check, ...]:
        """The checks that failed."""
        return tuple(check for check in self.checks if check.passed is False)

    def raise_if_failed(self) -> None:
        """Raise `ModelError` naming every failed check."""
        if self.failed:
            reasons = "; ".join(f"{check.name}: {check.detail}" for check in self.failed)
            raise ModelError(f"{self.model}: {self._summary}: {reasons}")

    @property
    def _summary(self) -> str:
        applied = sum(check.passed is not None for check in self.checks)
        return f"{len(self.failed)} of {applied} checks failed" if self.failed else f"{applied} checks passed"

    def to_dict(self) -> dict[str, Any]:
        """Return the outcome as plain data."""
        return {"model": self.model, "ok": self.ok, "checks": [asdict(check) for check in self.checks]}

    def __str__(self) -> str:
        return "\n".join([f"{self.model}: {self._summary}", *map(str, self.checks)])
