"""Mass-spring cloth: simulated, and drawn offscreen.

    import drape

    simulation = drape.Simulation("scene.toml", set={"cloth.stiffness": 300})
    simulation.step(100)
    lowest = simulation.positions[:, 2].min()
    picture = drape.render(simulation)

Lengths are in metres, masses in kilograms, times in seconds, angles in degrees.
"""

from ._drape import (
    DivergedError,
    Energies,
    Error,
    OutputError,
    Simulation,
    State,
    StepReport,
    UsageError,
    __version__,
    data_folder,
    instruction_set,
    instruction_sets,
    limit_instruction_set,
    render,
    use_data_folder,
)
from .notebook import Check, Film, Motion, Sweep, check, film, load, sweep

__all__ = [
    "Check",
    "DivergedError",
    "Energies",
    "Error",
    "Film",
    "Motion",
    "OutputError",
    "Simulation",
    "State",
    "StepReport",
    "Sweep",
    "UsageError",
    "check",
    "data_folder",
    "film",
    "instruction_set",
    "instruction_sets",
    "limit_instruction_set",
    "load",
    "render",
    "sweep",
    "use_data_folder",
]
