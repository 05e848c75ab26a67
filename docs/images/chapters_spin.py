"""Spinning satellites, for chapter 2."""

from pictures import curve, figure_with_axes, picture

from ucrit import load, simulate
from ucrit.plots import style


@picture("chapter-02-spin")
def spin_about_two_axes():
    figure, (tumble, sink) = figure_with_axes(3.1, 2)
    middle = simulate(load("satellite-middle-axis"), 10, {"q": 0.01})
    damped = load("satellite-largest-axis-damped").with_(I_xx=10, I_yy=14, I_zz=30, J=6, c=20)
    turned = simulate(damped, 30, {"q": 0.05}, times=[0.02 * i for i in range(1501)])
    for axes, found, title in (
        (tumble, middle, "middle axis, rigid"),
        (sink, turned, "smallest axis, with a damper"),
    ):
        for number, (name, text) in enumerate((("p", "roll"), ("q", "pitch"), ("r", "yaw"))):
            curve(axes, found.times, found[name], number, text)
        axes.axhline(0, color=style.MUTED, linewidth=0.8, zorder=1)
        axes.set_ylim(-7.2, 7.2)
        axes.set_title(title, fontsize="medium")
        axes.set_xlabel("time [s]")
    tumble.set_ylabel("rate [rad/s]")
    sink.legend(frameon=False, loc="lower right", ncols=3, handlelength=2.4)
    return figure
