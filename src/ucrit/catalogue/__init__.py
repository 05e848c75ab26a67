"""The catalogue: models, laws, controllers and vehicles that are shipped, found by looking into their folders."""

from .controllers import controlled, controller_names, find_controller
from .laws import find_part, part_names, tire, tire_file, tire_names, tire_switches
from .models import find_model, graph_model, model_from_file, model_names, models_in, models_in_file
from .places import BONDS, HERE, PUBLISHED, TIRES, VEHICLES
from .vehicles import load, read_vehicle, vehicle_names

__all__ = [
    "BONDS",
    "HERE",
    "PUBLISHED",
    "TIRES",
    "VEHICLES",
    "controlled",
    "controller_names",
    "find_controller",
    "find_model",
    "find_part",
    "graph_model",
    "load",
    "model_from_file",
    "model_names",
    "models_in",
    "models_in_file",
    "part_names",
    "read_vehicle",
    "tire",
    "tire_file",
    "tire_names",
    "tire_switches",
    "vehicle_names",
]
