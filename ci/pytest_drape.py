"""pytest plugin: `drape_check(scene)` asserts that a scene is as its golden.

    def test_flag(drape_check):
        drape_check("scenes/flag.toml")

Options of pytest: --drape PROGRAM (default: $DRAPE_EXECUTABLE, else drape on the PATH), --drape-report FOLDER
(default out/check), --drape-update none|missing (default none).
"""

import os
import pathlib
import re
import shutil
import subprocess

import pytest


def pytest_addoption(parser):
    group = parser.getgroup("drape")
    group.addoption("--drape", metavar="PROGRAM", help="the program drape; default: $DRAPE_EXECUTABLE, or drape on the PATH")
    group.addoption("--drape-report", metavar="FOLDER", default="out/check", help="folder of the reports")
    group.addoption(
        "--drape-update", choices=["none", "missing"], default="none", help="record goldens that are missing; the test fails all the same"
    )


def run_check(program, scene, report, options):
    """Run drape check. Returns its exit code and what it printed."""
    done = subprocess.run(
        [program, "check", *options, "--report", str(report), "--", str(scene)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        errors="replace",
    )
    return done.returncode, done.stdout.strip()


@pytest.fixture
def drape_check(request):
    """Assert that a scene is as its golden.

    Call it with a scene file, relative to the folder in which pytest was started, and more options of `drape check`:
    drape_check("scenes/flag.toml", "--motion-tolerance", "1e-5"). A failed assertion has the verdict and the page's path.
    """
    config = request.config
    program = config.getoption("--drape") or os.environ.get("DRAPE_EXECUTABLE") or shutil.which("drape")
    if not program:
        pytest.fail("drape is not on the PATH: use --drape PROGRAM", pytrace=False)

    def check(scene, *options):
        __tracebackhide__ = True
        file = config.invocation_params.dir / scene
        # One folder per scene and test: tests may run in parallel, or check a scene twice.
        name = re.sub(r"[^\w.-]+", "-", f"{request.node.nodeid}-{pathlib.Path(scene).stem}")
        report = config.invocation_params.dir / config.getoption("--drape-report") / name
        code, text = run_check(program, file, report, ["--update", config.getoption("--drape-update"), *options])
        if code == 0:
            return
        page = report / "report.html"
        where = f"\nreport: {page}" if page.is_file() else ""
        pytest.fail(f"drape check ended with {code}\n{text}{where}", pytrace=False)

    return check
