"""Responses to one input: gain and phase over frequency (H. W. Bode's diagram), and outputs over time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import UcritError
from . import labels, style

if TYPE_CHECKING:
    from ..analyses.linear.response_results import FrequencyResponse, TimeResponse


def plot_frequency_response(result: FrequencyResponse, *, figure: Any = None) -> Any:
    """Draw gain and phase of each output over the frequency.

    Parameters
    ----------
    result
        `ucrit.frequency_response` of one vehicle.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    UcritError
        If a parameter of the vehicle is an array.
    """
    _refuse_arrays(result)
    with style.settings():
        fig = figure or style.new_figure(height=4.6)
        gain, phase = fig.subplots(2, 1, sharex=True, gridspec_kw={"height_ratios": [1.4, 1]})
        for k, name in enumerate(result.outputs):
            look = {"color": style.colour(k), "linestyle": style.dash(k), "linewidth": 1.7}
            size = result.gain(name)
            gain.plot(result.frequencies, np.where(size > 0, size, np.nan), gid=f"gain {name}", label=name, **look)
            phase.plot(result.frequencies, result.phase_deg(name), gid=f"phase {name}", **look)
        gain.set(xscale="log", yscale="log", ylabel="gain [SI units]")
        phase.set(xlabel="frequency [Hz]", ylabel="phase [degrees]")
        style.plain_numbers(gain.yaxis)
        gain.set_title(f"response to {result.input}", fontsize=9, loc="left", color=style.INK)
        gain.legend(fontsize=8, frameon=False)
        for panel in (gain, phase):
            panel.set_xlim(result.frequencies.min(), result.frequencies.max())
            style.tidy(panel)
        fig.align_ylabels()
    return fig


def plot_time_response(result: TimeResponse, *, figure: Any = None) -> Any:
    """Draw each output over time, with the value that it tends to.

    Parameters
    ----------
    result
        `ucrit.step_response` or `ucrit.impulse_response` of one vehicle.
    figure
        Figure to draw into; a new one by default.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    UcritError
        If a parameter of the vehicle is an array.
    """
    _refuse_arrays(result)
    with style.settings():
        fig = figure or style.new_figure(height=1 + 1.3 * len(result.outputs))
        panels = fig.subplots(len(result.outputs), 1, sharex=True, squeeze=False)[:, 0]
        for k, (panel, name, unit) in enumerate(zip(panels, result.outputs, result.units, strict=True)):
            panel.plot(result.times, result[name], color=style.colour(0), linewidth=1.9, gid=name)
            if np.isfinite(result.final[k]):
                panel.axhline(result.final[k], color=style.MUTED, linewidth=0.9, linestyle=":", gid=f"final {name}")
            panel.set_ylabel(labels.axis_label("", name, unit).strip())
            panel.set_xlim(result.times[0], result.times[-1])
            style.tidy(panel)
        panels[-1].set_xlabel("time [s]")
        panels[0].set_title(f"{result.kind} response to {result.input}", fontsize=9, loc="left", color=style.INK)
        fig.align_ylabels()
    return fig


def _refuse_arrays(result: FrequencyResponse | TimeResponse) -> None:
    if result.vehicle.dims:
        raise UcritError(
            f"responses are drawn of one vehicle: give one value each for {', '.join(result.vehicle.dims)}"
        )
