"""Drawings show the numbers of the results they draw."""

import math
import subprocess
import sys

import matplotlib
import numpy as np
import pytest
from drawn import find, legend_texts, texts

from ucrit import analyze, critical, load, locus, modes, moment_line, plot, plots, remedies, stability_map, sweep
from ucrit.core import UcritError
from ucrit.plots import style


@pytest.fixture(scope="module")
def caravan():
    return load("caravan")


@pytest.fixture(scope="module")
def path(caravan):
    return locus(caravan, points=120)


@pytest.fixture(scope="module")
def speeds(caravan):
    return critical(caravan)


@pytest.fixture(scope="module")
def over(caravan):
    return stability_map(caravan, U=np.linspace(1, 40, 80), a=np.linspace(2, 5, 60))


class TestRootLocus:
    def test_design_point_is_the_eigenvalues(self, caravan, path, speeds):
        (design,) = find(plots.plot_locus(path, critical=speeds), "design")
        drawn = sorted(zip(*design.get_data(), strict=True))
        expected = sorted((m.eigenvalue.real, m.eigenvalue.imag) for m in modes(caravan))
        assert np.allclose(drawn, expected, rtol=1e-9)

    def test_critical_point_is_ringed_on_the_axis_at_its_frequency(self, path, speeds):
        figure = plots.plot_locus(path, critical=speeds)
        (ring,) = find(figure, "critical")
        x, y = ring.get_data()
        assert x[0] == 0
        assert y[0] == pytest.approx(2 * math.pi * speeds[0].frequency_hz)
        assert "23.24\N{NO-BREAK SPACE}m/s\nflutter" in texts(figure)

    def test_paths_are_the_tracked_branches(self, path):
        lines = find(plots.plot_locus(path), "branch-0")
        (upper,) = [line for line in lines if np.isfinite(line.get_xdata()).all()]
        assert np.array_equal(upper.get_xdata(), path.branches[:, 0].real)
        assert np.array_equal(upper.get_ydata(), path.branches[:, 0].imag)

    def test_lower_half_plane_is_left_out(self, path):
        figure = plots.plot_locus(path)
        for line in [*find(figure, "branch-0"), *find(figure, "branch-1")]:
            assert np.nanmin(line.get_ydata()) >= 0

    def test_unstable_half_plane_is_shaded_from_zero(self, path):
        axes = plots.plot_locus(path).get_axes()[0]
        shades = [p for p in axes.patches if matplotlib.colors.to_hex(p.get_facecolor()) == style.UNSTABLE]
        assert [p.get_x() for p in shades] == [0]
        assert shades[0].get_width() == pytest.approx(axes.get_xlim()[1])

    def test_legend_names_modes_and_speed(self, path, speeds):
        named = legend_texts(plots.plot_locus(path, critical=speeds))
        assert named[:2] == ["sway", "yaw oscillation"]
        assert "$U$ = 27.78\N{NO-BREAK SPACE}m/s" in named
        assert "critical" in named
        assert "critical" not in legend_texts(plots.plot_locus(path))

    def test_far_roots_do_not_squeeze_the_others(self):
        truck = load("coach-truck-rigid")
        axes = plots.plot_locus(locus(truck, points=60)).get_axes()[0]
        deciding = max(m.eigenvalue.real for m in modes(truck))
        fastest = min(m.eigenvalue.real for m in modes(truck))
        assert axes.get_xlim()[0] < deciding
        assert axes.get_xlim()[0] > 5 * fastest

    def test_labels_do_not_overlap(self, path, speeds):
        figure = plots.plot_locus(path, critical=speeds)
        figure.canvas.draw()
        boxes = [t.get_window_extent() for t in figure.get_axes()[0].texts if t.get_text()]
        pairs = [(a, b) for i, a in enumerate(boxes) for b in boxes[:i]]
        assert len(boxes) > 5
        assert not [1 for a, b in pairs if a.overlaps(b)]


class TestDamping:
    def test_lines_at_the_critical_and_the_present_speed(self, path, speeds):
        figure = plots.plot_damping(path, critical=speeds)
        for axes in figure.get_axes():
            upright = [line.get_xdata()[0] for line in axes.lines if list(line.get_ydata()) == [0, 1]]
            assert sorted(upright) == pytest.approx([speeds[0].value, 100 / 3.6])
        assert "23.24\N{NO-BREAK SPACE}m/s\nflutter" in texts(figure)

    def test_damping_ratio_and_frequency_at_the_present_speed(self, caravan, path):
        figure = plots.plot_damping(path)
        least = modes(caravan).list()[0]
        for gid, expected in (("rate-0", least.damping_ratio), ("frequency-0", least.frequency_hz)):
            x, y = find(figure, gid)[0].get_data()
            assert np.interp(100 / 3.6, x, y) == pytest.approx(expected, rel=1e-6)

    def test_stable_ranges_are_shaded(self, path, speeds):
        for axes in plots.plot_damping(path, critical=speeds).get_axes():
            (span,) = [p for p in axes.patches if p.get_gid() == "stable"]
            assert span.get_x() == pytest.approx(path.values[0])
            assert span.get_x() + span.get_width() == pytest.approx(speeds[0].value)

    def test_nothing_is_called_stable_where_nothing_is(self):
        vehicle = load("supermarket-cart-pushed-backward")
        figure = plots.plot_damping(locus(vehicle, points=40), critical=critical(vehicle))
        assert not find(figure, "stable")
        assert "stable" not in legend_texts(figure)

    def test_growth_rate_where_a_motion_runs_away(self):
        vehicle = load("oversteering-car")
        (axes,) = plots.plot_damping(locus(vehicle, points=40)).get_axes()
        assert axes.get_ylabel() == "growth rate [1/s]"

    def test_units_on_every_axis(self, path):
        upper, lower = plots.plot_damping(path).get_axes()
        assert upper.get_ylabel() == "damping ratio [1]"
        assert lower.get_ylabel() == "frequency [Hz]"
        assert lower.get_xlabel() == "speed of the towing vehicle $U$ [m/s]"


class TestMap:
    def test_boundary_passes_through_the_critical_speed(self, caravan, over, speeds):
        axes = plots.plot_map(over, vehicle=caravan).get_axes()[0]
        (line,) = [c for c in axes.collections if c.get_facecolor().size == 0]
        points = np.concatenate([p.vertices for p in line.get_paths()])
        near = points[np.abs(points[:, 1] - caravan.values["a"]) < 0.05]
        assert np.abs(near[:, 0] - speeds[0].value).min() < 0.5

    def test_shades_are_the_verdicts(self, caravan, over):
        axes = plots.plot_map(over, vehicle=caravan).get_axes()[0]
        (shades,) = [c for c in axes.collections if c.get_facecolor().size]
        colours = [matplotlib.colors.to_hex(c) for c in shades.get_facecolor()]
        stable = shades.get_paths()[colours.index(style.STABLE)]
        assert stable.contains_point((10, 4.5))
        assert not stable.contains_point((35, 3.0))
        assert over.stable[18, 49]
        assert not over.stable[70, 20]

    def test_design_point(self, caravan, over):
        (point,) = find(plots.plot_map(over, vehicle=caravan), "design")
        assert [float(v[0]) for v in point.get_data()] == pytest.approx([100 / 3.6, 3.7])
        assert not find(plots.plot_map(over), "design")

    def test_vehicle_outside_the_map_is_not_drawn(self, caravan, over):
        assert not find(plots.plot_map(over, vehicle=caravan.with_(a=7)), "design")

    def test_regions_are_named_and_a_uniform_map_has_one_name(self, caravan, over):
        assert {"stable", "unstable"} <= set(texts(plots.plot_map(over)))
        calm = stability_map(caravan, U=[1.0, 2, 3], a=[4.0, 4.5, 5])
        assert texts(plots.plot_map(calm)) == ["stable"]

    def test_equal_ratios_get_a_logarithmic_axis(self, caravan):
        result = stability_map(caravan, k=np.geomspace(1e3, 1e6, 20), a=np.linspace(2, 5, 20))
        axes = plots.plot_map(result).get_axes()[0]
        assert (axes.get_xscale(), axes.get_yscale()) == ("log", "linear")

    def test_axes_have_units(self, over):
        axes = plots.plot_map(over).get_axes()[0]
        assert axes.get_xlabel() == "speed of the towing vehicle $U$ [m/s]"
        assert axes.get_ylabel() == "hitch to centre of mass $a$ [m]"

    def test_one_dimension_is_refused(self, caravan):
        with pytest.raises(UcritError, match=r"over two parameters, this one spans U"):
            plots.plot_map(stability_map(caravan, U=[10.0, 20]))

    def test_a_single_value_is_refused(self, caravan):
        with pytest.raises(UcritError, match=r"a map is drawn over ranges, but U is 10 all over it"):
            plots.plot_map(stability_map(caravan, U=[10.0, 10], c=[0, 4000]))

    def test_values_in_any_order_give_one_picture(self, caravan):
        """Also of more values than a picture has columns, and with lines of equal damping."""
        U, c = np.linspace(5, 40, 1500), np.array([0.0, 2000, 4000, 8000])
        grids = (U, c), (U[::-1], c[[2, 0, 3, 1]])
        drawn = [plots.plot_map(stability_map(caravan, U=u, c=k, margins=True)).get_axes()[0] for u, k in grids]
        paths = [[path.vertices for line in axes.collections for path in line.get_paths()] for axes in drawn]
        assert len(paths[0]) == len(paths[1])
        for one, other in zip(*paths, strict=True):
            np.testing.assert_allclose(one, other)
        assert "$\\zeta$ = 0.1" in [text.get_text() for text in drawn[0].texts]


class TestDispatch:
    def test_each_result_gets_its_drawing(self, caravan):
        assert len(plot(analyze(caravan)).subfigs) == 2
        assert len(plot(locus(caravan, points=30)).subfigs) == 2
        assert "sway, 0.755 Hz" in texts(plot(modes(caravan)))
        assert find(plot(remedies(caravan)), "bar-a")
        assert "stable" in texts(plot(stability_map(caravan, U=[10.0, 20, 30], a=[2.0, 3, 4])))

    def test_lines_of_moment_against_lift_with_their_trim(self):
        plane = load("navion-from-geometry")
        lines = moment_line(plane, "delta_e", np.deg2rad([-6, -4]))
        figure = plot(lines)
        for row in range(2):
            (drawn,) = find(figure, f"line-{row}")
            assert drawn.get_ydata() == pytest.approx(lines.moment[row])
        (dots,) = find(figure, "trimmed")
        assert dots.get_xdata() == pytest.approx(lines.trimmed)
        named = [t.get_text() for t in figure.axes[0].get_legend().get_texts()]
        assert named == ["\N{MINUS SIGN}6 degrees", "\N{MINUS SIGN}4 degrees"]
        assert "[N m]" in plot(moment_line(load("model-glider"))).axes[0].get_ylabel().replace("·", " ")

    def test_a_vehicle_without_speed_shows_its_modes(self):
        assert "hunting, 1.67 Hz" in texts(plot(analyze("wheelset-1-in-20")))

    def test_other_things_are_refused(self, caravan):
        with pytest.raises(UcritError, match="no drawing for Sweep"):
            plot(sweep(caravan, U=[10.0, 20]))
        with pytest.raises(UcritError, match="no drawing for tuple"):
            plot(())

    def test_draws_into_a_given_figure(self, caravan):
        figure = style.new_figure(9, 4)
        assert plot(analyze(caravan), figure=figure) is figure

    def test_a_figure_in_use_is_refused_for_two_drawings(self, caravan):
        used = style.new_figure()
        used.subplots()
        with pytest.raises(UcritError, match="empty figure"):
            plot(analyze(caravan), figure=used)


class TestHousekeeping:
    def test_a_users_settings_neither_matter_nor_change(self, path):
        with matplotlib.rc_context({"axes.facecolor": "black", "font.size": 30, "axes.grid": True}):
            before = dict(matplotlib.rcParams)
            axes = plots.plot_locus(path).get_axes()[0]
            assert dict(matplotlib.rcParams) == before
        assert axes.xaxis.label.get_fontsize() == 9

    def test_importing_draws_nothing_and_loads_no_library(self):
        code = (
            "import sys, ucrit.plots, ucrit.report; "
            "print([m for m in ('matplotlib', 'jinja2', 'sympy') if m in sys.modules])"
        )
        run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        assert run.stdout.strip() == "[]"

    def test_no_window_library_is_loaded(self):
        code = (
            "import sys; from ucrit import analyze, plot; plot(analyze('caravan')); "
            "print('matplotlib.pyplot' in sys.modules)"
        )
        run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        assert run.stdout.strip() == "False"

    def test_dollar_signs_in_names_are_no_mathematics(self):
        assert plots.labels.plain("costs 5 $ and $") == r"costs 5 \$ and \$"
