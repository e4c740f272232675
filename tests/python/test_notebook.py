import struct
import zlib

import numpy as np
import pytest

import drape
from conftest import SOURCE


def chunks(png):
    """The chunks of a PNG, whose checksums are right."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, found = 8, []
    while at < len(png):
        (length,) = struct.unpack(">I", png[at : at + 4])
        kind, data = png[at + 4 : at + 8], png[at + 8 : at + 8 + length]
        assert struct.unpack(">I", png[at + 8 + length : at + 12 + length])[0] == zlib.crc32(kind + data)
        found.append((kind, data))
        at += 12 + length
    return found


def pixels(data, width, height):
    """What compressed rows of filter 2 show."""
    rows = np.frombuffer(zlib.decompress(data), np.uint8).reshape(height, 1 + 3 * width)
    assert (rows[:, 0] == 2).all()
    return np.cumsum(rows[:, 1:], axis=0, dtype=np.uint8).reshape(height, width, 3)


@pytest.fixture
def small(swinging):
    return {**swinging, "video": {"size": [48, 32]}}


def test_a_simulation_shows_itself(small):
    simulation = drape.Simulation(small)
    parts = dict(chunks(simulation._repr_png_()))
    assert (pixels(parts[b"IDAT"], 48, 32) == drape.render(simulation)).all()


def test_a_film_has_its_frames(small, tmp_path):
    simulation = drape.Simulation(small)
    film = drape.film(simulation, 0.2, fps=25, azimuth=-60)
    assert simulation.time == pytest.approx(0.2)
    parts = chunks(film._repr_png_())
    assert [kind for kind, _ in parts].count(b"fcTL") == 6
    assert struct.unpack(">II", dict(parts)[b"acTL"]) == (6, 0)
    last = [data for kind, data in parts if kind == b"fdAT"][-1][4:]
    assert (pixels(last, 48, 32) == drape.render(simulation, azimuth=-60)).all()
    film.save(tmp_path / "film.png")
    assert (tmp_path / "film.png").read_bytes() == film
    rest = drape.film(simulation, size=(16, 16))
    assert simulation.time == pytest.approx(simulation.duration)
    assert [kind for kind, _ in chunks(rest)].count(b"fcTL") == 6


def test_the_cloth_is_coloured_by_what_it_does(small):
    simulation = drape.Simulation(small)
    still = drape.render(simulation, color_by="speed", color_limit=2)
    simulation.step(10)
    moving = drape.render(simulation, color_by="speed", color_limit=2)
    covered = (still != moving).any(axis=2)
    red, green, blue = still[covered].astype(int).mean(axis=0)
    assert blue > green and red > green  # violet, the scale's first colour, in any light
    film = drape.film(simulation, 0.1, color_by="stretch", color_limit=0.1)
    assert film.startswith(b"\x89PNG")
    for wrong, said in [
        ({"color_by": "sped"}, "did you mean 'speed'"),
        ({"color_by": "speed", "color_limit": 0}, "above 0"),
        ({"color_by": "speed", "color_limit": float("nan")}, "above 0"),
        ({"color_limit": 1}, "no effect without color_by"),
    ]:
        with pytest.raises(drape.UsageError, match=said):
            drape.render(simulation, **wrong)
    with pytest.raises(drape.UsageError, match="color_limit"):
        drape.film(simulation, 0.1, color_by="speed")


@pytest.mark.parametrize("wrong", [{"fps": 0}, {"speed": -1}, {"seconds": -1}, {"seconds": float("nan")}])
def test_a_film_that_cannot_be_is_refused(small, wrong):
    with pytest.raises(drape.UsageError):
        drape.film(drape.Simulation(small), **wrong)


SCENE = (
    "[cloth]\nmesh = { grid = [4, 4] }\nstiffness = 50\npins = [\"edge:y+\"]\n"
    "[time]\nstep = 0.02\nduration = 0.2\n[video]\nsize = [32, 32]\n[effects.gravity]\n"
)


def test_a_recorded_motion_is_that_of_a_simulation(tmp_path, monkeypatch, program):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "m.toml").write_text(SCENE)
    assert program("simulate", "m.toml", "-o", "m.drape").returncode == 0
    motion = drape.load("m.drape")
    simulation = drape.Simulation("m.toml")
    assert len(motion) == 11 and repr(motion) == "<drape.Motion of m, 11 moments, 25 vertices>"
    simulation.step(10)
    assert (motion[-1] == simulation.positions).all() and motion.times[-1] == simulation.time
    assert (motion.triangles == simulation.triangles).all()
    with pytest.raises(drape.UsageError, match="none.drape"):
        drape.load("none.drape")
    with pytest.raises(drape.UsageError, match="expected a motion"):
        drape.load("m.toml")


def test_a_check_is_true_until_the_scene_changes(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "m.toml").write_text(SCENE)
    assert not drape.check("m.toml", update="missing")  # there was no golden
    assert drape.check("m.toml")
    changed = drape.check("m.toml", set={"cloth.stiffness": 60})
    assert not changed and (tmp_path / changed.page).exists() and "m" in changed.text


def test_a_sweep_has_a_row_for_each_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "m.toml").write_text(SCENE)
    rows = drape.sweep("m.toml", vary={"cloth.stiffness": [40, 80], "integrator.method": ["liu13", "implicit"]})
    assert len(rows) == 4 and (tmp_path / rows.folder / "report.html").exists()
    assert {row["cloth.stiffness"] for row in rows} == {"40", "80"}
    with pytest.raises(drape.UsageError):
        drape.sweep("m.toml", vary={"cloth.stifness": [1]})


def test_the_notebook_runs(tmp_path):
    nbclient = pytest.importorskip("nbclient", reason="apt-get install python3-nbclient python3-ipykernel")
    nbformat = pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    notebook = nbformat.read(SOURCE / "docs/cookbook/notebook.ipynb", as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(tmp_path)}}).execute()
    shown = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    assert sum("image/png" in output.get("data", {}) for output in shown) >= 2
    assert not [output for output in shown if output.output_type == "error"]
