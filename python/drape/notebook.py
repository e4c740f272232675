"""Pictures, films, recorded motions, checks and sweeps, as a notebook shows them."""

import csv
import math
import os
import re
import shutil
import struct
import subprocess
import tempfile
import warnings
import zlib
from fractions import Fraction
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


_MOST_FRAMES = 10_000_000  # as of a scene's film


def _delay(fps):
    """Duration of a frame [s]: numerator and denominator, of 16 bits each."""
    most = 65535
    part = max(Fraction(min(fps, 1 / fps)).limit_denominator(most), Fraction(1, most))
    return (part.numerator, part.denominator) if fps >= 1 else (part.denominator, part.numerator)


def film(simulation, seconds=None, *, fps=25.0, speed=1.0, **camera):
    """Steps the simulation on and films it: a Film, which a notebook plays.

    seconds are those of the scene, by default up to its end; speed is seconds of the scene per second of the film.
    camera is what render() takes: size, position, target, azimuth, elevation, field_of_view, color_by, color_limit. With
    color_by it needs color_limit, so that all frames have one scale. A frame shows the step that is nearest to its time.
    """
    if camera.get("color_by") is not None and camera.get("color_limit") is None:
        raise UsageError("film: color_by needs color_limit, so that all frames have one scale")
    for name, value in (("fps", fps), ("speed", speed)):
        if not 0 < value < math.inf:
            raise UsageError(f"film: {name}: expected a finite number above 0, found {value:g}")
    delay = _delay(float(fps))
    if seconds is None:
        seconds = max(simulation.duration - simulation.time, 0)
    if not 0 <= seconds < 3600:
        raise UsageError(f"film: expected from 0 to 3600 seconds, found {seconds:g}")
    frames = float(seconds) * float(fps) / float(speed)
    if not frames < _MOST_FRAMES:
        raise UsageError(f"film: the film would have {frames:.4g} frames; the limit is {_MOST_FRAMES:g}")
    first = simulation.steps_taken
    pictures = []
    for frame in range(int(frames + 1e-9) + 1):
        steps = first + round(frame * speed / fps / simulation.step_size) - simulation.steps_taken
        if steps > 0:
            simulation.step(steps)
        pictures.append(render(simulation, **camera))
    return Film(_png(pictures, delay))


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


def _run(arguments, good=lambda code: code == 0):
    done = subprocess.run([_program(), *map(str, arguments)], capture_output=True, text=True, check=False)
    if not good(done.returncode):
        said = [line.removeprefix("drape: ") for line in done.stderr.strip().splitlines()]
        raise _KINDS.get(done.returncode, Error)("\n".join(said))
    return done


def _quoted(text):
    """A string as TOML writes it, without quotes inside, so that --vary splits it nowhere."""
    return '"' + "".join(f"\\u{ord(c):04x}" if c < " " or c in '"\\\x7f' else c for c in text) + '"'


def _toml(value):
    """A value as TOML writes it."""
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)) and not hasattr(value, "tolist"):
        return repr(value)
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_quoted(name)} = {_toml(item)}" for name, item in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_toml, value)) + "]"
    if hasattr(value, "tolist"):  # numpy's values
        return _toml(value.tolist())
    if hasattr(value, "__fspath__"):
        return _toml(os.fspath(value))
    raise TypeError(f"expected a number, a string, a list or a dictionary, found {value!r}")


def _override(value):
    """A value as --set and --vary take it: a word without quotes, if it is clear, as tables show it."""
    bare = isinstance(value, str) and re.fullmatch("[A-Za-z][A-Za-z0-9_-]*", value)
    return str(value) if bare and value not in ("true", "false", "inf", "nan") else _toml(value)


def _overrides(values):
    return [word for key, value in values.items() for word in ("--set", f"{key}={_override(value)}")]


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
    """Reads a motion that drape simulate has recorded, motion.drape: a Motion with every step.

    Warns if it stores fewer states: positions between them are interpolated.
    """
    if Path(file).suffix != ".drape":
        raise UsageError(f"{file}: expected a motion, such as motion.drape")
    with tempfile.TemporaryDirectory() as folder:
        arrays = Path(folder) / "motion.npz"
        said = _run(["render", file, "-o", arrays, "--every", 1]).stderr
        for line in said.splitlines():
            if line.endswith(" interpolated"):
                warnings.warn(line.removeprefix("drape: "), stacklevel=2)
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
    done = _run(arguments, good=lambda code: code in (0, 1))
    return Check(done.returncode == 0, done.stdout.strip(), str(Path(report) / "report.html"))


class Sweep(list):
    """The rows of a sweep's table, a dictionary each; folder has its page, report.html."""

    def __init__(self, rows, folder):
        super().__init__(rows)
        self.folder = folder


def _version(file):
    """Differs after a file is written anew."""
    return (file.stat().st_ino, file.stat().st_mtime_ns) if file.exists() else None


def sweep(*scenes, vary, set={}, folder="out/sweep", jobs=1):
    """Runs scenes with each combination of values, as drape sweep: a Sweep of what came out.

    vary is a dictionary: {"cloth.stiffness": [10, 40, 80]}, or with a range as --vary takes it, "10..80/8".
    A run that diverges or is refused has its row too, with its outcome and reason.
    """
    varied = []
    for key, values in vary.items():
        text = values if isinstance(values, str) else ",".join(map(_override, values))
        varied += ["--vary", f"{key}={text}"]
    runs = Path(folder) / "runs.csv"
    before = _version(runs)
    arguments = ["sweep", *scenes, *varied, *_overrides(set), "-o", folder, "--jobs", jobs]
    _run(arguments, good=lambda code: code == 0 or (code in _KINDS and _version(runs) != before))
    with open(runs, newline="", encoding="utf-8") as table:
        return Sweep(csv.DictReader(table), str(folder))


Simulation._repr_png_ = picture_of
