"""Growth rate and frequency of sampled motions, by a linear recurrence through their samples.

Source: F. B. Hildebrand, Introduction to Numerical Analysis (1974), section 9.4 (the exponential approximation of
Prony), here by least squares over several quantities that share their exponents.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]


def fit_exponents(samples: Array, step: float, order: int) -> tuple[Array, float]:
    """Fit ``sum_k c_k exp(s_k t)`` to samples at equal steps; all quantities share the exponents.

    Parameters
    ----------
    samples
        Shape (times, quantities), in units that make the quantities comparable.
    step
        Time between samples [s].
    order
        Number of exponents, 1 or 2.

    Returns
    -------
    exponents
        [1/s], shape (order,), complex, that with the larger imaginary, then real part first.
    misfit
        What the recurrence leaves, as a share of the samples: 0 for an exact fit.

    Examples
    --------
    >>> t = 0.1 * np.arange(20)
    >>> s, misfit = fit_exponents(np.exp(-0.5 * t)[:, None] * np.cos([3 * t]).T, 0.1, 2)
    >>> np.round(s, 6).tolist(), misfit < 1e-9
    ([(-0.5+3j), (-0.5-3j)], True)
    """
    rows = len(samples) - order
    windows = np.stack([samples[k : k + rows] for k in range(order + 1)])
    weight = np.sqrt((windows**2).sum(axis=(0, 2)))  # every time counts alike, however small the motion is there
    windows = windows / np.where(weight > 0, weight, 1)[:, None]
    columns = windows[:order].reshape(order, -1).T
    target = windows[order].ravel()
    factors, *_ = np.linalg.lstsq(columns, target, rcond=None)
    misfit = float(np.linalg.norm(columns @ factors - target) / max(np.linalg.norm(target), np.finfo(float).tiny))
    roots = np.roots([1, *-factors[::-1]]).astype(complex)
    if order == 1 or not len(roots):
        roots = np.array(factors, dtype=complex)
    with np.errstate(divide="ignore"):
        exponents = np.log(roots) / step
    return exponents[np.lexsort((-exponents.real, -exponents.imag))], misfit
