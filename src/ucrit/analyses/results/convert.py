"""Results as tables with units, in the formats that users take away.

Complex numbers break netCDF and JSON, so eigenvalues leave as real and imaginary parts. pandas, xarray,
SciPy and python-control are imported when asked for, not before.
"""

from __future__ import annotations

import importlib
import json
import math
import os
import re
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import MissingExtraError, UcritError
from ...core.numeric.compiled import labels, state_space
from ...core.record import Record
from .matlab import matlab_names

Array = npt.NDArray[Any]
PathLike = str | os.PathLike[str]

SCHEMA = 1
"""Version of the layout that `Tabular.to_json` writes."""


@dataclass(frozen=True)
class Series(Record):
    """One array of a result: name, names of its dimensions, values, unit (empty for texts and flags)."""

    name: str
    dims: tuple[str, ...]
    values: Array
    unit: str = ""


@dataclass(frozen=True)
class Table(Record):
    """A result as named arrays; ``rows`` are the dimensions that become rows of a flat table.

    ``beside`` are arrays with a dimension of their own, which a flat table leaves out.
    """

    title: str
    vehicle: Model
    coords: tuple[Series, ...]
    data: tuple[Series, ...]
    rows: tuple[str, ...]
    beside: tuple[Series, ...] = ()

    def about(self) -> dict[str, str]:
        """Return what it is: title, model, name of the vehicle."""
        return {"title": self.title, "model": type(self.vehicle).model_id(), "vehicle": self.vehicle.info.name}

    def parameters(self) -> dict[str, dict[str, Any]]:
        """Return unit and value of each parameter of the vehicle as plain data."""
        return {
            name: {"unit": unit_of(self.vehicle, name), "value": _plain(np.asarray(value))}
            for name, value in self.vehicle.values.items()
        }

    def columns(self) -> Iterator[tuple[str, str, Array]]:
        """Yield name, unit and values of each column of the flat table; dimensions not in rows spread out."""
        coords = {series.name: series for series in self.coords}
        shape = tuple(coords[name].values.size for name in self.rows)
        for axis, name in enumerate(self.rows):
            index = [1] * len(shape)
            index[axis] = -1
            values = np.broadcast_to(coords[name].values.reshape(index), shape)
            yield name, coords[name].unit, values.ravel()
        for series in self.data:
            rows = [name for name in self.rows if name in series.dims]
            spread = [name for name in series.dims if name not in self.rows]
            values = series.values.transpose([series.dims.index(name) for name in (*rows, *spread)])
            full = [coords[name].values.size if name in rows else 1 for name in self.rows]
            values = values.reshape((*full, *values.shape[len(rows) :]))
            for place in np.ndindex(*values.shape[len(shape) :]):
                at = [str(coords[name].values[i]) for name, i in zip(spread, place, strict=True)]
                column = np.broadcast_to(values[(*[slice(None)] * len(shape), *place)], shape)
                yield series.name + (f"[{', '.join(at)}]" if at else ""), series.unit, column.ravel()


def complex_series(name: str, dims: tuple[str, ...], values: Array, unit: str) -> tuple[Series, Series]:
    """Return the real and the imaginary part of a complex array as two series."""
    return Series(f"{name}_real", dims, values.real, unit), Series(f"{name}_imag", dims, values.imag, unit)


def unit_of(vehicle: Model, name: str) -> str:
    """Return the unit of a parameter, ``"1"`` for a dimension that counts."""
    declared = type(vehicle).declaration.parameters.get(name)
    return declared.unit if declared else "1"


class Tabular(Record):
    """What results share: a table, and its conversions."""

    def table(self) -> Table:
        """Return the result as named arrays with units."""
        raise NotImplementedError

    def _repr_html_(self) -> str:
        from . import notebook

        return notebook.tabular(self)

    def to_dataframe(self) -> Any:
        """Return a flat `pandas.DataFrame`; units are in ``.attrs["units"]``.

        Raises `MissingExtraError` where pandas is not installed.
        """
        pandas = needed("pandas", "data", "a data frame")
        columns = list(self.table().columns())
        frame = pandas.DataFrame({name: values for name, _, values in columns})
        frame.attrs |= self.table().about()
        frame.attrs["units"] = {name: unit for name, unit, _ in columns if unit}
        return frame

    def to_xarray(self) -> Any:
        """Return an `xarray.Dataset` with named dimensions; units are attributes of its variables.

        The attribute ``parameters`` holds the vehicle's parameters as JSON, in the layout of `to_json`.

        Raises `MissingExtraError` where xarray is not installed.
        """
        xarray = needed("xarray", "data", "a labelled array")
        table = self.table()

        def variables(group: Sequence[Series]) -> dict[str, Any]:
            return {s.name: (s.dims, s.values, {"units": s.unit} if s.unit else {}) for s in group}

        attrs = {**table.about(), "parameters": json.dumps(table.parameters())}
        return xarray.Dataset(variables((*table.data, *table.beside)), variables(table.coords), attrs)

    def to_csv(self, path: PathLike) -> None:
        """Write a flat table, each column headed ``name [unit]``; the file appears whole or not at all."""
        import csv
        import io

        columns = list(self.table().columns())
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow([f"{name} [{unit}]" if unit else name for name, unit, _ in columns])
        writer.writerows(zip(*(values.tolist() for _, _, values in columns), strict=True))
        write_whole(path, text.getvalue().encode())

    def to_netcdf(self, path: PathLike) -> None:
        """Write a netCDF file of version 3, whole or not at all.

        Raises `MissingExtraError` where xarray is not installed.
        """
        write_whole(path, bytes(self.to_xarray().to_netcdf(engine="scipy")))

    def findings(self) -> dict[str, Any]:
        """Return what the result tells beside its table, as plain data: sentences, single numbers."""
        return {}

    def to_dict(self) -> dict[str, Any]:
        """Return the result as plain data, as `to_json` writes it; nan and infinity become ``None``."""
        table = self.table()
        vehicle = table.vehicle
        return {
            "schema": SCHEMA,
            "result": table.title,
            "model": type(vehicle).model_id(),
            "vehicle": vehicle.info.name,
            "parameters": table.parameters(),
            "findings": finite(self.findings()),
            "coordinates": {s.name: _entry(s) for s in table.coords},
            "variables": {s.name: _entry(s) for s in (*table.data, *table.beside)},
        }

    def to_json(self, path: PathLike | None = None) -> str:
        """Return the result as JSON text, and write it if a path is given; nan and infinity become null."""
        text = json.dumps(self.to_dict(), allow_nan=False)
        if path is not None:
            write_whole(path, text.encode())
        return text

    def to_mat(self, path: PathLike) -> None:
        """Write a MATLAB file (version 5): one variable for each array, structs ``units``, ``names``, ``parameters``.

        MATLAB's names are letters, digits and underscores: ``theta'`` becomes ``theta_dot``, any other character an
        underscore. The struct ``names`` has the names as they are elsewhere.
        """
        import io

        from scipy.io import savemat

        table = self.table()
        series = (*table.coords, *table.data, *table.beside)
        called = matlab_names([s.name for s in series])
        cells = {s.name: s.values.astype(object) if s.values.dtype.kind == "U" else s.values for s in series}
        arrays: dict[str, Any] = {called[name]: values for name, values in cells.items()}
        arrays["units"] = {called[s.name]: s.unit for s in series if s.unit}
        arrays["names"] = {new: name for name, new in called.items()}
        arrays["parameters"] = dict(table.vehicle.values)
        buffer = io.BytesIO()
        savemat(buffer, arrays, long_field_names=True, oned_as="column")
        write_whole(path, buffer.getvalue())


def _entry(series: Series) -> dict[str, Any]:
    return {"dims": list(series.dims), "unit": series.unit, "values": _plain(series.values)}


def _plain(values: Array) -> Any:
    """Nested lists that JSON can hold."""
    if values.dtype.kind == "f" and not np.isfinite(values).all():
        kept = values.astype(object)
        kept[~np.isfinite(values)] = None
        return kept.tolist()
    return values.tolist()


def finite(value: Any) -> Any:
    """Return plain data with ``None`` for numbers that are infinite or undefined, which JSON does not have."""
    if isinstance(value, dict):
        return {key: finite(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [finite(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def write_whole(path: PathLike, content: bytes) -> None:
    """Write a file so that it is never seen half written.

    Raises `UcritError` naming the file where that fails.
    """
    target = Path(path)
    temporary = None
    if not os.fspath(path) or target.is_dir():
        raise UcritError(f"'{os.fspath(path)}' cannot be written: it is {'a folder' if os.fspath(path) else 'no name'}")
    try:
        if target.exists() and not target.is_file():  # a device or a pipe takes what is written, and stays
            target.write_bytes(content)
            return
        with tempfile.NamedTemporaryFile("wb", dir=target.parent, delete=False, suffix=".tmp") as file:
            temporary = file.name
            file.write(content)
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, target)
    except OSError as error:
        if temporary is not None and os.path.exists(temporary):
            os.unlink(temporary)
        raise UcritError(f"'{target}' cannot be written: {error.strerror or error}") from None


def _umask() -> int:
    mask = os.umask(0o022)
    os.umask(mask)
    return mask


def needed(module: str, extra: str, what: str) -> Any:
    """Import a package that an extra installs, or tell which one."""
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name != module:
            raise
        raise MissingExtraError(f"{what} needs {module}: pip install 'ucrit[{extra}]'") from None


def _observed(vehicle: Model) -> tuple[Array, Array, Array, Array, list[str]]:
    """State equations of one vehicle whose outputs are all states, then the declared outputs."""
    if vehicle.dims:
        arrays = ", ".join(vehicle.dims)
        raise UcritError(f"a linear system is that of one vehicle: give one value each for {arrays}")
    A, B, C, D = state_space(vehicle)
    n, m = B.shape
    names = [*labels(vehicle), *type(vehicle).declaration.outputs]
    return A, B, np.vstack([np.eye(n), C]), np.vstack([np.zeros((n, m)), D]), names


def to_control(vehicle: Model) -> Any:
    """Return a vehicle as a `control.StateSpace` with named states, inputs and outputs (states, then declared outputs).

    Raises
    ------
    UcritError
        If a parameter is an array, or the vehicle has one state and no input, which python-control cannot hold.
    MissingExtraError
        If python-control is not installed.

    Examples
    --------
    >>> from ucrit import load
    >>> to_control(load("bmw-320i")).input_labels
    ['delta_f', 'delta_r']
    """
    A, B, C, D, outputs = _observed(vehicle)
    control = needed("control", "control", "a control system")
    names = {
        "states": list(labels(vehicle)),
        "inputs": list(type(vehicle).declaration.inputs),
        "outputs": outputs,
    }
    if B.shape == (1, 0):  # python-control turns a matrix of one row and no column into one of no rows
        raise UcritError(
            f"{type(vehicle).model_id()} has one state and no input, which python-control cannot hold; "
            "to_scipy gives it to SciPy"
        )
    name = re.sub(r"[^A-Za-z0-9_-]+", " ", vehicle.info.name or type(vehicle).model_id()).strip()
    return control.ss(A, B, C, D, name=name, **names)


def to_scipy(vehicle: Model) -> Any:
    """Return a vehicle as a `scipy.signal.StateSpace` whose outputs are the states, then the declared outputs.

    Raises `UcritError` if a parameter is an array.

    Examples
    --------
    >>> from ucrit import load
    >>> to_scipy(load("bmw-320i")).A.shape
    (2, 2)
    """
    from scipy.signal import StateSpace

    A, B, C, D, _ = _observed(vehicle)
    return StateSpace(A, B, C, D)
