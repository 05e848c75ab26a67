"""Powers of bonds along a motion, and whether each element does what it states."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from ...bondgraph.graph import Bond
from ...bondgraph.model import BondGraphModel, graph_of, states_bond_graph
from ...core.contract.methods import Names
from ...core.contract.model import Model
from ...core.errors import UcritError
from ..results.convert import Series, Table, Tabular
from .simulation import Simulation

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class PowerFlow(Tabular):
    """Powers along a simulated motion.

    Attributes
    ----------
    vehicle
        The vehicle that was simulated.
    times
        [s], shape (T,).
    powers
        Power along each bond [W], positive from tail to head, shape (T, bonds).
    energy
        Held by all stores [J], shape (T,); nan where a law cannot be integrated or reads other elements.
    supplied, dissipated
        Given by all sources, taken by all resistances [W], shape (T,).
    bonds
        Those of the graph, in the order of their numbers.
    faults
        For each element, by ``str(element)``: how far what it states is from holding, as a share of the largest value
        about; for junctions, transformers and gyrators also the power that does not pass through.
    """

    vehicle: Model
    times: Array
    powers: Array
    energy: Array
    supplied: Array
    dissipated: Array
    bonds: tuple[Bond, ...] = ()
    faults: dict[str, float] = field(default_factory=dict)

    def table(self) -> Table:
        """Return the powers of the bonds, the energy, and what is supplied and dissipated, over time."""
        coords = (
            Series("time", ("time",), self.times, "s"),
            Series("bond", ("bond",), 1 + np.arange(self.powers.shape[1])),
        )
        data = (
            Series("energy", ("time",), self.energy, "J"),
            Series("supplied", ("time",), self.supplied, "W"),
            Series("dissipated", ("time",), self.dissipated, "W"),
            Series("power", ("time", "bond"), self.powers, "W"),
        )
        return Table("power", self.vehicle, coords, data, ("time",))

    @property
    def imbalance(self) -> float:
        """Largest difference of the energy from what has come in, as a share of the energy that was about.

        The integral over time is Simpson's on the given times, and its error is part of this.
        """
        from scipy.integrate import cumulative_simpson

        net = self.supplied - self.dissipated
        gained = cumulative_simpson(net, x=self.times, initial=0.0)
        passed = np.trapezoid(np.abs(self.supplied) + np.abs(self.dissipated), self.times)
        about = np.ptp(self.energy) + passed + 1e-3 * np.max(np.abs(self.energy))  # some, where nothing changes
        return float(np.max(np.abs(self.energy - self.energy[0] - gained)) / (about or 1.0))


def power_flow(simulation: Simulation) -> PowerFlow:
    """Return the power of every bond, and the energy, along a simulated motion.

    The motion is the model's own: where it is stated by forces or energies, the powers tell whether its bond graph
    agrees.

    Parameters
    ----------
    simulation
        What `ucrit.simulate` returned for one vehicle whose model states a bond graph.

    Raises
    ------
    UcritError
        If the model states no bond graph, or the simulation has further dimensions.

    Examples
    --------
    >>> from ucrit import load, power_flow, simulate
    >>> flow = power_flow(simulate(load("caravan"), 2, {"theta": "3 deg"}))
    >>> print(flow.bonds[18], f"{flow.powers[0, 18]:.2f} W")
    19: axle -> tire 6850.76 W
    >>> flow.imbalance < 1e-6
    True
    """
    model = type(simulation.vehicle)
    if not states_bond_graph(model):
        raise UcritError(f"{model.model_id()} states no bond graph: a method 'bond_graph(self, u)' would")
    if simulation.values.ndim != 2:
        raise UcritError("powers are told of one motion, and the simulation has several")
    bonds, names, function = _function(model)
    values = function(simulation.values.T, simulation.input_values.T, simulation.vehicle.arguments())
    table = np.array([np.broadcast_to(v, simulation.times.shape) for v in values], dtype=np.float64)
    powers, (energy, supplied, dissipated), rest = np.split(table, np.cumsum([len(bonds), 3]))
    faults = _faults(names, rest[::2], rest[1::2])
    return PowerFlow(simulation.vehicle, simulation.times, powers.T, energy, supplied, dissipated, bonds, faults)


def _faults(names: list[str], left: Array, right: Array) -> dict[str, float]:
    """Return the largest difference of both sides of each element's statements; noise of zeros counts as nothing."""
    sizes = np.maximum(np.abs(left), np.abs(right)).max(axis=1, initial=0.0)
    least = 1e-9 * sizes.max(initial=0.0) or 1.0
    shares = np.abs(left - right).max(axis=1, initial=0.0) / np.maximum(sizes, least)
    found: dict[str, float] = {}
    for name, share in zip(names, shares, strict=True):
        found[name] = max(found.get(name, 0.0), float(share))
    return found


def _made(model: type[Model]) -> tuple[tuple[Bond, ...], list[str], Any]:
    """Return the bonds, the element of each statement, and a function of states, inputs and parameters.

    It gives powers of bonds; energy, supplied and dissipated power; then both sides of every statement.
    """
    import sympy as sp

    from ...bondgraph.equations import state_equations
    from ...bondgraph.further import graph_states
    from ...bondgraph.power import power_balance
    from ...bondgraph.statements import statements
    from ...core.derivation.trace import trace
    from ...core.formulas.codegen import build, generate

    traced = trace(model, None)
    found = state_equations(graph_of(model, None), traced.u)
    power, stated = power_balance(found), list(statements(found))
    names = list(model.declaration.variables)
    groups = (
        Names(group, {n: chain[k] for n, chain in zip(names, traced.q, strict=False) if k < len(chain)})
        for k, group in enumerate(("x", "dx", "ddx"))
    )
    if issubclass(model, BondGraphModel):
        x = next(groups)
        states = {symbol: getattr(x, name) for symbol, name in zip(found.symbols, found.states, strict=True)}
    else:
        states = graph_states(model.model_id(), found.graph, *groups)
    energy = sp.nan if power.energy is None else power.energy
    wanted = [*power.bonds, energy, power.supplied, power.dissipated]
    wanted += [sp.sympify(side) for _, *sides in stated for side in sides]
    inside = [sp.sympify(x).xreplace(states) for x in wanted]
    arguments = [list(traced.states), list(traced.u), list(traced.parameters.values())]
    function = build(generate("powers", arguments, inside), "powers")
    return found.graph.bonds, [str(element) for element, *_ in stated], function


_function: Any = cache(_made)
