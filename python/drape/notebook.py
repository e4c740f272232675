"""Pictures, films, recorded motions, checks and sweeps, as a notebook shows them."""

import csv
import json
import os
import shutil
import struct
import subprocess
import tempfile
import zlib
from pathlib import Path

import numpy as np

from . import _drape
from ._drape import DivergedError, Error, OutputError, Simulation, UsageError, data_folder, render


def _chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _rows(picture):
    """A picture's rows as PNG has them, compressed, each the difference to the one above it."""
    rows = np.asarray(picture, np.uint8).reshape(picture.shape[0], -1)
    up = rows.copy()
    up[1:] -= rows[:-1]
    return zlib.compress(np.hstack([np.full((len(rows), 1), 2, np.uint8), up]).tobytes(), 6)


def _png(pictures, delay=(1, 25)):
    """A PNG of one picture, or of several an animated one."""
    height, width, _ = pictures[0].shape
    parts = [b"\x89PNG\r\n\x1a\n", _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))]
    if len(pictures) > 1:
        parts.append(_chunk(b"acTL", struct.pack(">II", len(pictures), 0)))
    number = 0
    for index, picture in enumerate(pictures):
        if len(pictures) > 1:
            parts.append(_chunk(b"fcTL", struct.pack(">IIIIIHHBB", number, width, height, 0, 0, *delay, 0, 0)))
            number += 1
        if index == 0:
            parts.append(_chunk(b"IDAT", _rows(picture)))
        else:
            parts.append(_chunk(b"fdAT", struct.pack(">I", number) + _rows(picture)))
            number += 1
    parts.append(_chunk(b"IEND", b""))
    return b"".join(parts)


def picture_of(simulation):
    """A PNG of the cloth as it is now, as a notebook shows a simulation."""
    return _png([render(simulation)])


class Film(bytes):
    """The bytes of an animated PNG, which a notebook plays."""

    def _repr_png_(self):
        return bytes(self)

    def save(self, file):
        """Writes the film to a file, film.png."""
        Path(file).write_bytes(self)


def film(simulation, seconds=None, *, fps=25.0, speed=1.0, **camera):
    """Steps the simulation on and films it: a Film, which a notebook plays.

    seconds are those of the scene, by default up to its end; speed is seconds of the scene per second of the film.
    camera is what render() takes: size, position, target, azimuth, elevation, field_of_view, color_by, color_limit. With
    color_by it needs color_limit, so that all frames have one scale. A frame shows the step that is nearest to its time.
    """
    if camera.get("color_by") is not None and camera.get("color_limit") is None:
        raise UsageError("film: color_by needs color_limit, so that all frames have one scale")
    if not (fps > 0 and speed > 0):
        raise UsageError("film: fps and speed must be above 0")
    if seconds is None:
        seconds = max(simulation.duration - simulation.time, 0)
    if not 0 <= seconds < 3600:
        raise UsageError(f"film: expected from 0 to 3600 seconds, found {seconds:g}")
    first = simulation.steps_taken
    pictures = []
    for frame in range(int(seconds * fps / speed + 1e-9) + 1):
        steps = first + round(frame * speed / fps / simulation.step_size) - simulation.steps_taken
        if steps > 0:
            simulation.step(steps)
        pictures.append(render(simulation, **camera))
    return Film(_png(pictures, (1000, round(1000 * fps))))


def _program():
    """The drape of the command line that belongs to this module."""
    named = os.environ.get("DRAPE_EXECUTABLE")
    if named:
        return named
    module = Path(_drape.__file__).resolve()
    for folder in module.parents:
        for file in (folder / "drape", folder / "bin" / "drape"):
            if file.is_file() and os.access(file, os.X_OK):
                return str(file)
    found = shutil.which("drape")
    if found is None:
        raise UsageError("the program drape is not found: neither beside this module nor on the PATH")
    return found


_KINDS = {2: UsageError, 3: DivergedError, 4: OutputError}


def _run(arguments, good=(0,)):
    done = subprocess.run([_program(), *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode not in good:
        said = [line.removeprefix("drape: ") for line in done.stderr.strip().splitlines()]
        raise _KINDS.get(done.returncode, Error)("\n".join(said))
    return done


def _text(value):
    """A value as --set takes it."""
    return json.dumps(value) if not isinstance(value, str) else value


def _overrides(values):
    return [word for key, value in values.items() for word in ("--set", f"{key}={_text(value)}")]


class Motion:
    """A recorded motion: times [s], positions by moment (m×n×3) [m], and triangles.

    len() is the number of moments; motion[k] is the positions of one.
    """

    def __init__(self, name, arrays):
        self.name = name
        self.times = arrays["times"]
        self.positions = arrays["positions"]
        self.triangles = arrays["faces"]

    def __len__(self):
        return len(self.times)

    def __getitem__(self, moment):
        return self.positions[moment]

    def __repr__(self):
        return f"<drape.Motion of {self.name}, {len(self)} moments, {self.positions.shape[1]} vertices>"


def load(file):
    """Reads a motion that drape simulate has recorded, motion.drape: a Motion with every step."""
    if Path(file).suffix != ".drape":
        raise UsageError(f"{file}: expected a motion, such as motion.drape")
    with tempfile.TemporaryDirectory() as folder:
        arrays = Path(folder) / "motion.npz"
        _run(["render", file, "-o", arrays, "--every", 1])
        with np.load(arrays) as found:
            return Motion(Path(file).stem, {name: found[name] for name in ("times", "positions", "faces")})


class Check:
    """What a check found: ok, text, and the path of its page."""

    def __init__(self, ok, text, page):
        self.ok, self.text, self.page = ok, text, page

    def __bool__(self):
        return self.ok

    def __repr__(self):
        return self.text


def check(*scenes, report="out/check", update="none", set={}):
    """Compares scenes with their golden frames and motion, as drape check: a Check, which is true if nothing changed."""
    arguments = ["check", *scenes, "--report", report, "--update", update, *_overrides(set)]
    done = _run(arguments, good=(0, 1))
    return Check(done.returncode == 0, done.stdout.strip(), str(Path(report) / "report.html"))


class Sweep(list):
    """The rows of a sweep's table, a dictionary each; folder has its page, report.html."""

    def __init__(self, rows, folder):
        super().__init__(rows)
        self.folder = folder


def sweep(*scenes, vary, set={}, folder="out/sweep", jobs=1):
    """Runs scenes with each combination of values, as drape sweep: a Sweep of what came out.

    vary is a dictionary: {"cloth.stiffness": [10, 40, 80]}, or with a range as --vary takes it, "10..80/8".
    """
    varied = []
    for key, values in vary.items():
        text = values if isinstance(values, str) else ",".join(map(_text, values))
        varied += ["--vary", f"{key}={text}"]
    _run(["sweep", *scenes, *varied, *_overrides(set), "-o", folder, "--jobs", jobs])
    with open(Path(folder) / "runs.csv", newline="", encoding="utf-8") as table:
        return Sweep(csv.DictReader(table), str(folder))


Simulation._repr_png_ = picture_of
