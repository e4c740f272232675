import gc
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import drape
from conftest import SOURCE

METHODS = ["semi-implicit", "implicit", "liu13", "quasi-newton", "verlet"]
IMPLICIT = ["implicit", "liu13", "quasi-newton"]


@pytest.mark.parametrize("method,scheme", [(m, None) for m in METHODS] + [(m, "sdirk2") for m in IMPLICIT])
def test_the_bits_are_those_of_the_command_line(tmp_path, program, method, scheme):
    scene = SOURCE / "scenes/homework/4.toml"
    explicit = method not in IMPLICIT
    set = {"integrator.method": method, "time.duration": 0.5, "time.step": 0.0005 if explicit else 0.02}
    if scheme:
        set["integrator.scheme"] = scheme
    simulation = drape.Simulation(scene, set=set)
    simulation.step(simulation.step_count)

    options = [word for key, value in set.items() for word in ("--set", f"{key}={value}")]
    done = program("simulate", "--quiet", scene, *options, "--positions", tmp_path / "last.csv")
    assert done.returncode == 0, done.stderr
    last = np.loadtxt(tmp_path / "last.csv", delimiter=",", skiprows=1)[:, 1:]
    assert last.tobytes() == np.ascontiguousarray(simulation.positions).tobytes()


def test_free_fall_is_that_of_the_scheme(swinging):
    swinging["cloth"]["pins"] = []
    swinging["integrator"]["method"] = "semi-implicit"
    swinging["time"]["step"] = 0.001
    simulation = drape.Simulation(swinging)
    start = simulation.positions.copy()
    report = simulation.step(100)
    # v_n = −n g h, so x_n = x_0 − g h² n(n+1)/2
    assert np.allclose(simulation.positions[:, 2], start[:, 2] - 9.8 * 0.001**2 * 100 * 101 / 2, atol=1e-12)
    assert np.allclose(simulation.velocities[:, 2], -0.98)
    assert report.iterations == 0 and report.converged
    assert simulation.time == pytest.approx(0.1) and simulation.steps_taken == 100
    energies = simulation.energies
    assert energies.kinetic == pytest.approx(simulation.masses.sum() * 0.98**2 / 2)
    assert energies.total == energies.kinetic + energies.gravity + energies.elastic


def test_arrays_outlive_the_simulation_and_follow_it(swinging):
    simulation = drape.Simulation(swinging)
    positions = simulation.positions
    before = positions.copy()
    simulation.step()
    assert not np.array_equal(positions, before), "it shows where the cloth is now"
    assert np.array_equal(positions, simulation.positions)
    after = positions.copy()
    corner = positions[3:5, 2]
    del simulation, positions
    gc.collect()
    more = [np.full((49, 3), 7.0) for _ in range(200)]  # reuses the memory if it was freed
    assert np.array_equal(corner, after[3:5, 2]) and more


def test_arrays_are_read_only(swinging):
    simulation = drape.Simulation(swinging)
    for array in (simulation.positions, simulation.velocities):
        with pytest.raises(ValueError):
            array[0, 0] = 1
    with pytest.raises(ValueError):
        simulation.positions.flags.writeable = True


def test_several_threads_give_the_bits_of_one(swinging):
    swinging["cloth"]["mesh"] = {"grid": [92, 92]}  # large enough to be divided

    def after_two_steps(threads):
        before = len(list(Path("/proc/self/task").iterdir()))
        simulation = drape.Simulation(swinging, threads=threads)
        simulation.step(2)
        return simulation.hash, len(list(Path("/proc/self/task").iterdir())) - before

    hash, started = after_two_steps(1)
    assert started == 0
    for threads in (2, 3, 8):
        assert after_two_steps(threads) == (hash, threads - 1)


@pytest.mark.parametrize("threads", [0, -1, 257])
def test_a_number_of_threads_that_makes_no_sense_is_refused(swinging, threads):
    with pytest.raises(drape.UsageError, match=f"threads: expected a whole number from 1 to 256, found {threads}"):
        drape.Simulation(swinging, threads=threads)


@pytest.mark.parametrize("method", METHODS)
def test_restore_goes_on_to_the_bit(swinging, method):
    swinging["integrator"]["method"] = method
    swinging["time"]["step"] = 0.002
    simulation = drape.Simulation(swinging)
    simulation.step(5)
    state = simulation.state()
    simulation.step(5)
    last = simulation.hash
    simulation.restore(state)
    assert simulation.steps_taken == 5 and simulation.hash == state.hash != last
    simulation.step(5)
    assert simulation.hash == last

    other = drape.Simulation(swinging)
    other.restore(drape.State(state.positions, state.velocities, state.step))
    other.step(5)
    assert other.hash == last


def test_a_dictionary_is_the_file_that_says_the_same(swinging, tmp_path):
    file = tmp_path / "scene.toml"
    file.write_text(
        """[cloth]
mesh = { grid = [6, 6] }
stiffness = 50
pins = ["corner:x-y-", "corner:x+y-"]
[time]
step = 0.02
duration = 0.4
[integrator]
method = "liu13"
[effects.gravity]
"""
    )
    swinging["cloth"]["stiffness"] = np.float64(50)
    swinging["cloth"]["mesh"]["grid"] = np.array([6, 6])
    simulations = [drape.Simulation(file), drape.Simulation(swinging)]
    for simulation in simulations:
        assert simulation.step_count == 20 and simulation.method == "liu13"
        simulation.step(20)
    assert simulations[0].hash == simulations[1].hash


def test_set_is_that_of_the_command_line(swinging):
    one = drape.Simulation(swinging, set={"cloth.stiffness": 300, "effects.gravity.acceleration": [0, 0, -1.62]})
    swinging["cloth"]["stiffness"] = 300
    swinging["effects"]["gravity"]["acceleration"] = (0, 0, -1.62)
    other = drape.Simulation(swinging)
    one.step(3), other.step(3)
    assert one.hash == other.hash


def test_errors_have_the_text_of_the_command_line(tmp_path, program):
    file = tmp_path / "wrong.toml"
    file.write_text("[cloth]\nmesh = { grid = [6, 6] }\nstifness = 5\n[time]\nstep = -1\n")
    with pytest.raises(drape.UsageError) as raised:
        drape.Simulation(file, set={"cloth.mass": 0})
    said = program("simulate", file, "--set", "cloth.mass=0").stderr
    assert [f"drape: {line}" for line in str(raised.value).splitlines()] == said.splitlines()
    assert isinstance(raised.value, drape.Error)


def test_errors_of_a_dictionary_name_the_key(swinging):
    swinging["cloth"]["stifness"] = swinging["cloth"].pop("stiffness")
    with pytest.raises(drape.UsageError, match="^dictionary: unknown key 'stifness'.*did you mean 'stiffness'"):
        drape.Simulation(swinging)
    with pytest.raises(TypeError, match="cloth.mass: expected a number.*found None"):
        drape.Simulation({"cloth": {"mass": None}})
    for large in (2**63, -(2**63) - 1, np.uint64(2**63)):
        with pytest.raises(drape.UsageError, match="^cloth.mesh.grid.1: the number is too large$"):
            drape.Simulation({"cloth": {"mesh": {"grid": [4, large]}}})
        with pytest.raises(drape.UsageError, match="^cloth.stiffness: the number is too large$"):
            drape.Simulation(swinging, set={"cloth.stiffness": large})
    with pytest.raises(TypeError, match="expected a scene's file or a dictionary, found 3"):
        drape.Simulation(3)


def test_a_motion_that_blows_up_is_an_error(swinging):
    swinging["integrator"] = {"method": "semi-implicit", "allow_unstable": True}
    swinging["time"]["step"] = 0.5
    simulation = drape.Simulation(swinging)
    with pytest.raises(drape.DivergedError, match="step"):
        simulation.step(1000)
    assert 0 < simulation.steps_taken < 1000


def test_states_of_another_cloth_are_refused(swinging):
    simulation = drape.Simulation(swinging)
    with pytest.raises(drape.UsageError, match="is of 4 vertices, the cloth has 49"):
        simulation.restore(drape.State(np.zeros((4, 3)), np.zeros((4, 3))))
    with pytest.raises(drape.UsageError, match="positions: expected an array n×3"):
        drape.State(np.zeros(4), np.zeros((4, 3)))
    with pytest.raises(drape.UsageError, match="velocities: expected finite numbers"):
        drape.State(np.zeros((4, 3)), np.full((4, 3), np.nan))


def endless():
    """A simulation of which many steps take minutes."""
    return drape.Simulation(SOURCE / "scenes/homework/4.toml")


def test_ctrl_c_ends_stepping_after_a_whole_step():
    simulation = endless()
    threading.Timer(0.2, lambda: signal.raise_signal(signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        simulation.step(10**9)
    taken = simulation.steps_taken
    assert taken > 0
    again = endless()
    again.step(taken)
    assert again.hash == simulation.hash and np.array_equal(again.positions, simulation.positions)


def test_ctrl_c_ends_a_step_that_would_take_for_ever():
    """A limit that nothing can keep to, and more sweeps than a day has time for."""
    simulation = drape.Simulation(
        SOURCE / "scenes/homework/4.toml",
        set={"effects.strain_limit": {"max_stretch": 1, "tolerance": 1e-300, "iterations": 2 * 10**9}},
    )
    before = simulation.hash
    threading.Timer(0.2, lambda: signal.raise_signal(signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        simulation.step()
    assert simulation.steps_taken == 0 and simulation.hash == before


def test_other_threads_run_and_wait_while_it_steps():
    simulation = endless()
    stepping = threading.Thread(target=simulation.step, args=(200,))
    stepping.start()
    ticks = 0
    while stepping.is_alive():
        ticks += 1
        time.sleep(0)
    assert ticks > 10, "Python's lock was held all the time"

    both = [threading.Thread(target=simulation.step, args=(50,)) for _ in range(2)]
    for thread in both:
        thread.start()
    simulation.energies, simulation.hash, simulation.state()
    for thread in both:
        thread.join()
    assert simulation.steps_taken == 300
    alone = endless()
    alone.step(300)
    assert alone.hash == simulation.hash


def test_the_bits_do_not_depend_on_the_instruction_set(swinging):
    hashes = set()
    for name in drape.instruction_sets():
        drape.limit_instruction_set(name)
        simulation = drape.Simulation(swinging)
        simulation.step(20)
        hashes.add(simulation.hash)
    assert len(hashes) == 1
    with pytest.raises(drape.UsageError, match="'mmx', expected one of " + drape.instruction_sets()[0]):
        drape.limit_instruction_set("mmx")


def test_objects_without_init_are_refused():
    """__new__ alone made objects of whatever was in their memory: SIGSEGV."""
    bare = drape.Simulation.__new__(drape.Simulation)
    uses = [getattr_of(bare, name) for name in dir(type(bare)) if not name.startswith("_")]
    uses += [lambda: repr(bare), lambda: bare.step(), lambda: bare.state(), lambda: drape.render(bare)]
    for use in uses:
        with pytest.raises(TypeError, match="__init__"):
            value = use()
            if callable(value):
                value(*([drape.State(np.zeros((4, 3)), np.zeros((4, 3)))] if "restore" in repr(value) else []))
    state = drape.State.__new__(drape.State)
    for name in ("positions", "velocities", "step", "hash"):
        with pytest.raises(TypeError, match="__init__"):
            getattr(state, name)
    with pytest.raises(TypeError, match="__init__"):
        endless().restore(state)
    repr(drape.Energies.__new__(drape.Energies)), repr(drape.StepReport.__new__(drape.StepReport))


def getattr_of(thing, name):
    return lambda: getattr(thing, name)


def run_python(code):
    """How a Python ends that runs this with a simulation to step for ever."""
    scene = str(SOURCE / "scenes/homework/4.toml")
    head = f"import os, sys, threading, time, drape\nsimulation = drape.Simulation({scene!r})\n"
    return subprocess.run([sys.executable, "-c", head + code], capture_output=True, text=True, timeout=60)


def test_python_ends_while_daemon_threads_compute():
    for use in ("step(10**9)", "step(1)", "state()"):
        code = f"""
def compute():
    while True:
        simulation.{use}
for _ in range(3):
    threading.Thread(target=compute, daemon=True).start()
time.sleep(0.1)
"""
        done = run_python(code)
        assert (done.returncode, done.stderr) == (0, ""), use


def test_a_fork_after_a_picture_is_told_to_draw_elsewhere():
    code = """
drape.render(simulation, size=(32, 24))
child = os.fork()
if child == 0:
    simulation.step(3)
    try:
        drape.render(simulation, size=(32, 24))
    except drape.OutputError as error:
        print(error, flush=True)
    os._exit(7)
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
drape.render(simulation, size=(32, 24))
"""
    done = run_python(code)
    assert done.returncode == 0, done.stderr
    assert "forked from one that had drawn" in done.stdout and done.stdout.endswith("7\n")


def test_a_fork_before_the_first_picture_draws():
    code = """
child = os.fork()
drape.render(simulation, size=(32, 24))
if child == 0:
    os._exit(7)
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""
    done = run_python(code)
    assert (done.returncode, done.stdout) == (0, "7\n"), done.stderr


def test_a_cloth_that_diverged_is_not_drawn(swinging):
    swinging["integrator"]["method"] = "semi-implicit"
    swinging["time"]["step"] = 0.02
    swinging["cloth"]["stiffness"] = 1
    simulation = drape.Simulation(swinging)
    before = simulation.state()
    huge = np.full((49, 3), 1e200) * np.arange(49)[:, None]
    simulation.restore(drape.State(huge, huge))
    with pytest.raises(drape.DivergedError):
        simulation.step(100)
    with pytest.raises(drape.DivergedError, match="cannot be drawn"):
        drape.render(simulation)
    simulation.restore(before)
    drape.render(simulation, size=(32, 24))
