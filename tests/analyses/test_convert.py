"""Results leave with names, units and every digit, in whole files."""

import csv
import json
import subprocess
import sys

import numpy as np
import pytest
import xarray
from scipy.io import loadmat
from scipy.signal import StateSpace

import control
from ucrit import UcritError, critical, load, modes
from ucrit.analyses.regions.stability_map import stability_map
from ucrit.analyses.regions.sweep import sweep
from ucrit.analyses.results.convert import to_control, to_scipy
from ucrit.analyses.stability.locus import locus
from ucrit.analyses.stability.sensitivity import sensitivity
from ucrit.core.errors import MissingExtraError
from ucrit.core.numeric.compiled import state_space

RESULTS = {
    "sweep": lambda v: sweep(v, U=[10, 20, 40], c=[0, 4000]),
    "locus": lambda v: locus(v, points=20),
    "modes": modes,
    "modes of arrays": lambda v: modes(v.with_(U=[10, 20, 40])),
    "critical": critical,
    "map": lambda v: stability_map(v, U=[10, 20, 40], c=[0, 4000]),
    "sensitivity": sensitivity,
}


@pytest.fixture(params=RESULTS, scope="module")
def result(request):
    return RESULTS[request.param](load("caravan"))


def test_xarray_holds_every_array_with_its_unit(result):
    data, table = result.to_xarray(), result.table()
    assert data.attrs["model"] == "trailer"
    for series in (*table.coords, *table.data):
        assert data[series.name].dims == series.dims
        np.testing.assert_array_equal(data[series.name].values, series.values)
        assert data[series.name].attrs.get("units", "") == series.unit
        assert series.values.dtype.kind != "c"


def test_xarray_finds_values_by_name():
    data = RESULTS["sweep"](load("caravan")).to_xarray()
    assert not bool(data.stable.sel(U=40, c=4000))
    found = modes(load("caravan"))
    picked = modes(load("caravan")).to_xarray().sel(mode="yaw oscillation")
    assert float(picked.eigenvalue_real) == next(m for m in found if m.name == "yaw oscillation").eigenvalue.real
    assert float(picked.participation.sum()) == pytest.approx(1)
    curve = locus(load("caravan"), points=20).to_xarray()
    assert curve.eigenvalue_imag.sel(mode="sway").dims == ("U",)
    assert curve.U.attrs["units"] == "m/s"


def test_json_can_be_read_back_exactly(result):
    content = json.loads(result.to_json(), parse_constant=lambda name: pytest.fail(name))
    assert (content["schema"], content["model"]) == (1, "trailer")
    assert content["parameters"]["m"] == {"unit": "kg", "value": 1200.0}
    for series in result.table().data:
        entry = content["variables"][series.name]
        assert (tuple(entry["dims"]), entry["unit"]) == (series.dims, series.unit)
        if series.values.dtype.kind == "f":
            np.testing.assert_array_equal(np.array(entry["values"], dtype=float), series.values)
        else:
            assert entry["values"] == series.values.tolist()


def test_csv_and_data_frame_agree(result, tmp_path):
    path = tmp_path / "result.csv"
    result.to_csv(path)
    with path.open(newline="") as file:
        header, *rows = csv.reader(file)
    frame = result.to_dataframe()
    units = frame.attrs["units"]
    assert header == [f"{name} [{units[name]}]" if name in units else name for name in frame.columns]
    assert len(rows) == len(frame)
    for column, name in zip(zip(*rows, strict=True), frame.columns, strict=True):
        if frame[name].dtype.kind == "f":
            np.testing.assert_array_equal(np.array(column, dtype=float), frame[name])
        else:
            assert list(column) == [str(x) for x in frame[name]]


def test_rows_of_a_flat_table_are_the_combinations():
    found = sweep(load("caravan"), c=[0, 4000], U=[10, 20, 40])
    frame = found.to_dataframe()
    assert list(zip(frame["c"], frame["U"], strict=True)) == [(c, U) for c in (0, 4000) for U in (10, 20, 40)]
    assert frame.attrs["units"]["growth"] == "1/s"
    np.testing.assert_array_equal(frame["growth"], found.growth.ravel())
    np.testing.assert_array_equal(frame["eigenvalue_imag[3]"], found.eigenvalues[..., 2].imag.ravel())


def test_mat_files(result, tmp_path):
    path = tmp_path / "result.mat"
    result.to_mat(path)
    content = loadmat(path, squeeze_me=True)
    for series in result.table().data:
        if series.values.dtype.kind == "f":
            np.testing.assert_array_equal(content[series.name], series.values.squeeze())
            assert content["units"][series.name].item() == series.unit


def test_netcdf_can_hold_it(result, tmp_path):
    path = tmp_path / "result.nc"
    data = result.to_xarray()
    plain = data.drop_vars([name for name in data.variables if data[name].dtype.kind == "b"])
    plain.to_netcdf(path, engine="scipy")
    with xarray.open_dataset(path, engine="scipy") as back:
        for name in plain.data_vars:
            np.testing.assert_array_equal(back[name].values, plain[name].values)


def test_a_file_appears_whole_or_not_at_all(result, tmp_path, monkeypatch):
    path = tmp_path / "result.csv"
    path.write_text("before")
    monkeypatch.setattr("os.replace", lambda *_: (_ for _ in ()).throw(OSError(28, "No space left on device")))
    with pytest.raises(UcritError, match=r"result\.csv' cannot be written: No space left on device"):
        result.to_csv(path)
    assert path.read_text() == "before"
    assert [p.name for p in tmp_path.iterdir()] == ["result.csv"]


def test_a_missing_folder_is_named(result, tmp_path):
    with pytest.raises(UcritError, match=r"nowhere.*cannot be written"):
        result.to_json(tmp_path / "nowhere" / "result.json")
    result.to_json(tmp_path / "result.json")
    assert (tmp_path / "result.json").read_text() == result.to_json()


@pytest.mark.parametrize(
    ("module", "extra", "use"),
    [
        ("xarray", "data", lambda v: modes(v).to_xarray()),
        ("pandas", "data", lambda v: modes(v).to_dataframe()),
        ("control", "control", to_control),
    ],
)
def test_missing_packages_say_how_to_get_them(module, extra, use, monkeypatch):
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(MissingExtraError, match=rf"needs {module}: pip install 'ucrit\[{extra}\]'"):
        use(load("caravan"))


def test_results_without_a_value_are_null_in_json():
    cart = sensitivity(load("neutral-car"))
    assert critical(load("bmw-320i")).to_dataframe().empty
    assert "NaN" not in cart.to_json()
    rigid = modes(load("supermarket-cart"))
    assert json.loads(rigid.to_json())["variables"]["damping_ratio"]["values"].count(None) >= 1


def test_control_systems_have_names_and_the_same_poles():
    car = load("bmw-320i")
    system = to_control(car)
    assert isinstance(system, control.StateSpace)
    assert system.state_labels == ["V", "r"]
    assert system.input_labels == ["delta_f", "delta_r"]
    assert system.output_labels == ["V", "r", "a_y", "curvature", "beta", "alpha_f", "alpha_r"]
    A, B, C, D = state_space(car)
    np.testing.assert_array_equal(system.A, A)
    np.testing.assert_array_equal(system.B, B)
    np.testing.assert_array_equal(system.C, np.vstack([np.eye(2), C]))
    np.testing.assert_array_equal(system.D, np.vstack([np.zeros((2, 2)), D]))
    np.testing.assert_allclose(np.sort(system.poles()), np.sort(modes(car).eigenvalues))
    steady = control.dcgain(system["r", "delta_f"])
    scipy = to_scipy(car)
    assert isinstance(scipy, StateSpace)
    np.testing.assert_allclose((scipy.D - scipy.C @ np.linalg.solve(scipy.A, scipy.B))[1, 0], steady)


def test_vehicles_without_inputs_convert_too():
    caravan = load("caravan")
    assert to_control(caravan).ninputs == 0
    with pytest.raises(UcritError, match="trailer-kinematic has one state and no input"):
        to_control(load("caravan-kinematic"))
    assert to_scipy(caravan).B.shape == (4, 0)


@pytest.mark.parametrize("convert", [to_control, to_scipy])
def test_arrays_of_vehicles_are_no_linear_system(convert):
    with pytest.raises(UcritError, match="one value each for U"):
        convert(load("caravan").with_(U=[10, 20]))


def test_the_analyses_import_none_of_the_large_packages():
    code = (
        "import sys; from ucrit.analyses.regions import ranges, stability_map, sweep; "
        "from ucrit.analyses.stability import locus, sensitivity; "
        "print(*{name.partition('.')[0] for name in sys.modules})"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = set(done.stdout.split())
    assert "numpy" in loaded
    assert not loaded & {"scipy", "sympy", "pandas", "xarray", "control", "matplotlib", "pint"}
