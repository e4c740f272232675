import os
import pathlib
import shutil
import subprocess
import tarfile

import pytest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
CI = SOURCE / "ci"
DRAPE = os.environ["DRAPE_EXECUTABLE"]
os.environ["PATH"] = "/usr/sbin:/usr/bin:/sbin:/bin"  # Debian's packages, as on a runner, and no other python3

SCENE = """
[cloth]
mesh = { grid = [6, 6] }
stiffness = 50
pins = ["corner:x-y-", "corner:x+y-"]
[time]
step = 0.02
duration = 0.4
[integrator]
method = "liu13"
tolerance = 1e-3
[effects.gravity]
[video]
size = [64, 48]
"""
CHANGED = SCENE + "[look]\ncolor = '#ff0000'\n"


@pytest.fixture(scope="session")
def blessed(tmp_path_factory):
    """A folder with scenes/still.toml and scenes/flag.toml, and their goldens."""
    folder = tmp_path_factory.mktemp("blessed")
    (folder / "scenes").mkdir()
    for name in ("still", "flag"):
        (folder / "scenes" / f"{name}.toml").write_text(SCENE)
    subprocess.run([DRAPE, "bless", "scenes/still.toml", "scenes/flag.toml"], cwd=folder, check=True, capture_output=True)
    return folder


@pytest.fixture
def project(blessed, tmp_path):
    """A copy of that folder, to be changed."""
    shutil.copytree(blessed, tmp_path / "project")
    return tmp_path / "project"


@pytest.fixture(scope="session")
def archive(tmp_path_factory):
    """An archive that is laid out as the portable one, and starts the program that was built."""
    folder = tmp_path_factory.mktemp("archive")
    program = folder / "drape-0.2.0-x86_64" / "bin" / "drape"
    program.parent.mkdir(parents=True)
    program.write_text(f'#!/bin/sh\nexec "{DRAPE}" "$@"\n')
    program.chmod(0o755)
    file = folder / "drape-0.2.0-x86_64.tar.xz"
    with tarfile.open(file, "w:xz") as tar:
        tar.add(program.parents[1], program.parents[1].name)
    return file


@pytest.fixture
def drape_on_path(archive, tmp_path):
    """The environment in which drape is on the PATH."""
    shutil.unpack_archive(archive, tmp_path / "installed")
    return dict(os.environ, PATH=f"{tmp_path}/installed/drape-0.2.0-x86_64/bin:{os.environ['PATH']}")
