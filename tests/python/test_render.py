import struct
import zlib

import numpy as np
import pytest

import drape
from conftest import SOURCE


def read_png(data):
    """The pixels of a PNG of 8-bit RGB, after the specification's section 9."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(data):
        (length,), kind = struct.unpack(">I", data[at : at + 4]), data[at + 4 : at + 8]
        body = data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", body[:10])
            assert (depth, color) == (8, 2)
        if kind == b"IDAT":
            packed += body
        at += 12 + length
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + 3 * width)
    above = np.zeros(3 * width, int)
    picture = np.zeros((height, 3 * width), np.uint8)
    for y, (kind, row) in enumerate(zip(rows[:, 0], rows[:, 1:].astype(int))):
        now = row.copy()
        for i in range(3 * width):
            left, corner = (now[i - 3], above[i - 3]) if i >= 3 else (0, 0)
            up = above[i]
            guess = left + up - corner
            paeth = min((left, up, corner), key=lambda candidate: abs(guess - candidate))
            now[i] = (row[i] + (0, left, up, (left + up) // 2, paeth)[kind]) % 256
        picture[y] = above = now
    return picture.reshape(height, width, 3)


def test_the_picture_is_that_of_the_command_line(tmp_path, program):
    scene = SOURCE / "scenes/homework/4.toml"
    set = {
        "video.size": [96, 80],
        "time.duration": 0.4,
        "camera.position": [0, -6, 1],
        "camera.target": [0, 0, -0.5],
    }
    simulation = drape.Simulation(scene, set=set)
    simulation.step(simulation.step_count)
    options = [word for key, value in set.items() for word in ("--set", f"{key}={value}")]
    done = program("render", "--quiet", scene, *options, "-o", tmp_path / "last.png")
    assert done.returncode == 0, done.stderr
    assert np.array_equal(drape.render(simulation), read_png((tmp_path / "last.png").read_bytes()))


def test_all_of_the_cloth_is_in_view(swinging):
    swinging["look"] = {"background": "#0000ff", "color": "#ff0000", "shadows": False}
    simulation = drape.Simulation(swinging)
    for elevation in (20, 80):
        picture = drape.render(simulation, size=(64, 48), azimuth=30, elevation=elevation)
        assert picture.shape == (48, 64, 3) and picture.dtype == np.uint8
        border = np.concatenate([picture[0], picture[-1], picture[:, 0], picture[:, -1]])
        assert (border == [0, 0, 255]).all(), "something reaches the border"
        assert (picture[:, :, 0] > 60).any(), "nothing is in the picture"


def test_wrong_sizes_are_refused(swinging):
    with pytest.raises(drape.UsageError, match="size: expected from 1 to 16384 pixels"):
        drape.render(drape.Simulation(swinging), size=(0, 10))
