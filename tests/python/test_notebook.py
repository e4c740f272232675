import json
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


INFINITE, NAN = float("inf"), float("nan")


@pytest.mark.parametrize(
    "wrong",
    [{name: value} for name in ("fps", "speed") for value in (0, -1, INFINITE, NAN)]
    + [{"seconds": -1}, {"seconds": NAN}, {"fps": 1e300}, {"speed": 1e-320}],
)
def test_a_film_that_cannot_be_is_refused_before_it_steps(small, wrong):
    simulation = drape.Simulation(small)
    with pytest.raises(drape.UsageError, match="^film: .*found|limit"):
        drape.film(simulation, **wrong)
    assert simulation.steps_taken == 0


@pytest.mark.parametrize(
    "fps, delay",
    [(25, (1, 25)), (3.7, (10, 37)), (0.3, (10, 3)), (100, (1, 100)), (1e-6, (65535, 1)), (1e6, (1, 65535))],
)
def test_a_film_shows_each_frame_for_its_time(small, fps, delay):
    simulation = drape.Simulation(small)
    parts = chunks(drape.film(simulation, 0.4, fps=fps, speed=0.2 * fps, size=(16, 16)))
    controls = [data for kind, data in parts if kind == b"fcTL"]
    assert len(controls) == 3 and {struct.unpack(">HH", data[20:24]) for data in controls} == {delay}


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


def test_a_motion_that_lacks_states_says_what_is_interpolated(tmp_path, monkeypatch, program, recwarn):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "m.toml").write_text(SCENE)
    assert program("simulate", "m.toml", "-o", "all.drape").returncode == 0
    drape.load("all.drape")
    assert not recwarn.list
    assert program("simulate", "m.toml", "--every", 7, "-o", "m.drape").returncode == 0
    with pytest.warns(UserWarning, match="^m.drape: 8 frames .* interpolated$"):
        assert len(drape.load("m.drape")) == 11


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


def test_values_of_a_sweep_are_what_they_are_in_python(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "m.toml").write_text(SCENE)
    texts = ["a,b", "5", "a b", 'say "x", y', "c:\\é\n\x7f", "true", "1..3/3", "liu13"]
    rows = drape.sweep("m.toml", vary={"caption.text": texts}, set={"time.duration": np.float64(0.02)})
    assert [json.loads(row["caption.text"]) for row in rows[:-1]] == texts[:-1]
    assert rows[-1]["caption.text"] == "liu13"
    rows = drape.sweep("m.toml", vary={"cloth.stiffness": np.array([40, 80])}, set={"time.duration": np.float32(0.25)})
    assert [row["cloth.stiffness"] for row in rows] == ["40", "80"]
    meshes = [{"grid": [2, 2]}, {"grid": np.array([3, 3])}]
    assert len(drape.sweep("m.toml", vary={"cloth.mesh": meshes})) == 2
    assert len(drape.sweep("m.toml", vary={"cloth.stiffness": "10..80/8"})) == 8
    with pytest.raises(drape.UsageError, match="found inf"):
        drape.sweep("m.toml", vary={"cloth.stiffness": [INFINITE]})
    with pytest.raises(drape.UsageError, match="none.obj"):
        drape.sweep("m.toml", vary={"cloth.mesh": [{"file": tmp_path / "none.obj"}]})
    with pytest.raises(TypeError, match="expected a number"):
        drape.check("m.toml", set={"cloth.stiffness": None})


def test_a_sweep_keeps_its_table_when_a_run_diverges(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "m.toml").write_text(SCENE + '[integrator]\nmethod = "verlet"\nallow_unstable = true\n')
    rows = drape.sweep("m.toml", vary={"cloth.stiffness": [20, 1e9]})
    assert [row["outcome"] for row in rows] == ["completed", "diverged"]
    with pytest.raises(drape.UsageError, match="stiffness"):  # which leaves the former table
        drape.sweep("m.toml", vary={"cloth.stiffness": [20, -1]})


def test_the_notebook_runs(tmp_path):
    nbclient = pytest.importorskip("nbclient", reason="apt-get install python3-nbclient python3-ipykernel")
    nbformat = pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    notebook = nbformat.read(SOURCE / "docs/cookbook/notebook.ipynb", as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(tmp_path)}}).execute()
    shown = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    assert sum("image/png" in output.get("data", {}) for output in shown) >= 2
    assert not [output for output in shown if output.output_type == "error"]
