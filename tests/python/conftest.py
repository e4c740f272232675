import os
import subprocess
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parents[2]


@pytest.fixture
def swinging():
    """A cloth that swings on two corners, as a dictionary."""
    return {
        "cloth": {"mesh": {"grid": [6, 6]}, "stiffness": 50, "pins": ["corner:x-y-", "corner:x+y-"]},
        "time": {"step": 0.02, "duration": 0.4},
        "integrator": {"method": "liu13"},
        "effects": {"gravity": {}},
    }


@pytest.fixture
def program():
    """Runs the drape that was built; returns what it ended as."""
    return lambda *arguments: subprocess.run(
        [os.environ["DRAPE_EXECUTABLE"], *map(str, arguments)], capture_output=True, text=True
    )
