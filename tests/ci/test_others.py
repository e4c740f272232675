"""GitLab's template, the hooks for git and pre-commit, the pytest plugin and the function for CTest."""

import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree

import pytest
import yaml
from conftest import CHANGED, CI, DRAPE, SCENE, SOURCE

CMAKE, CTEST = os.environ["CMAKE"], os.environ["CTEST"]


def run(*command, cwd, env=None):
    done = subprocess.run(command, cwd=cwd, env=env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout


# GitLab


def gitlab_job(project, **variables):
    """Run the template's script as GitLab's shell does: every line ends the job where it fails."""
    job = yaml.safe_load((CI / "gitlab.yml").read_text())[".drape-check"]
    unknown = [name for name in variables if name not in job["variables"] and not name.startswith("CI_")]
    assert not unknown, unknown
    script = "\n".join(["set -eo pipefail", *job["before_script"], *job["script"]])
    return run("bash", "-c", script, cwd=project, env={**os.environ, **job["variables"], **variables})


def test_gitlab_template_has_what_gitlab_knows():
    job = yaml.safe_load((CI / "gitlab.yml").read_text())[".drape-check"]
    assert set(job) == {"image", "variables", "cache", "before_script", "script", "artifacts"}
    assert set(job["artifacts"]) == {"when", "expose_as", "paths", "reports"} and job["artifacts"]["when"] == "always"
    assert all(isinstance(value, str) for value in job["variables"].values())


def test_gitlab_job(project, archive):
    code, log = gitlab_job(project, DRAPE_ARCHIVE=str(archive))
    assert code == 0, log
    (project / "scenes/flag.toml").write_text(CHANGED)
    code, log = gitlab_job(project, DRAPE_ARCHIVE="/no/such/file")  # it is in the cache
    assert code == 1, log
    report = xml.etree.ElementTree.parse(project / "out/check/junit.xml").getroot()
    suite = report if report.tag == "testsuite" else report.find("testsuite")
    assert suite.get("failures") == "1", log


def test_gitlab_job_divides_scenes_among_nodes(project, archive):
    for node in ("1", "2"):
        code, log = gitlab_job(project, DRAPE_ARCHIVE=str(archive), CI_NODE_INDEX=node, CI_NODE_TOTAL="2")
        assert code == 0, log
        assert len(re.findall(r"\.toml: passed", log)) == 1
        assert (project / f"out/check/shard-{node}-of-2/junit.xml").is_file()


def test_gitlab_job_refuses(project, archive):
    code, log = gitlab_job(project)
    assert code == 2 and "Set DRAPE_ARCHIVE" in log
    code, log = gitlab_job(project, DRAPE_ARCHIVE=str(archive), DRAPE_SHA256="0" * 64)
    assert code == 2 and not (project / ".drape/drape-0.2.0-x86_64").exists()


# Hooks


@pytest.fixture
def repository(project, drape_on_path):
    environment = dict(drape_on_path, GIT_AUTHOR_NAME="a", GIT_COMMITTER_NAME="a", GIT_AUTHOR_EMAIL="a@b.invalid",
                       GIT_COMMITTER_EMAIL="a@b.invalid")

    def git(*arguments):
        return run("git", *arguments, cwd=project, env=environment)

    git("init", "--quiet")
    shutil.copy(CI / "pre-commit", project / ".git/hooks/pre-commit")
    git("add", "--all")
    code, log = git("commit", "--quiet", "--message", "scenes")
    assert code == 0, log
    return project, git


def test_pre_commit_refuses_a_scene_with_a_mistake(repository):
    project, git = repository
    (project / "scenes/flag.toml").write_text(SCENE.replace("stiffness", "stifness"))
    git("add", "--all")
    code, log = git("commit", "--message", "typo")
    assert code != 0 and "stifness" in log and "scenes/flag.toml" in log


def test_pre_commit_looks_at_what_is_staged(repository):
    project, git = repository
    (project / "scenes/flag.toml").write_text(SCENE.replace("stiffness", "stifness"))
    git("add", "--all")
    (project / "scenes/flag.toml").write_text(SCENE)
    assert git("commit", "--message", "typo")[0] != 0
    git("add", "--all")
    (project / "scenes/flag.toml").write_text("[cloth")
    (project / "notes").write_text("x")
    git("add", "notes")
    code, log = git("commit", "--message", "notes")
    assert code == 0, log


def test_pre_commit_takes_a_pattern(repository):
    project, git = repository
    (project / "other.toml").write_text("[cloth")
    git("add", "--all")
    assert git("commit", "--message", "not a scene")[0] == 0
    git("config", "drape.scenes", "*.toml")
    (project / "other.toml").write_text("[cloth]]")
    git("add", "--all")
    assert git("commit", "--message", "a scene")[0] != 0


def test_pre_commit_framework_finds_its_hook(project, drape_on_path):
    (hook,) = yaml.safe_load((SOURCE / ".pre-commit-hooks.yaml").read_text())
    assert {"id", "name", "entry", "language"} <= set(hook)
    assert re.search(hook["files"], "scenes/a/flag.toml") and not re.search(hook["files"], "pyproject.toml")
    code, log = run(*hook["entry"].split(), "scenes/flag.toml", "scenes/still.toml", cwd=project, env=drape_on_path)
    assert code == 0, log
    (project / "scenes/flag.toml").write_text("[cloth")
    assert run(*hook["entry"].split(), "scenes/flag.toml", cwd=project, env=drape_on_path)[0] == 2


# pytest


def pytest_run(project, *options, env=None):
    environment = {**(env or os.environ), "PYTHONPATH": str(CI), "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "PYTHONDONTWRITEBYTECODE": "1"}
    return run(sys.executable, "-m", "pytest", "-q", "-p", "pytest_drape", "-p", "no:cacheprovider", *options, cwd=project, env=environment)


def test_pytest_plugin(project):
    (project / "test_cloth.py").write_text(
        "import pytest\n\n\n@pytest.mark.parametrize('name', ['still', 'flag'])\ndef test_scene(drape_check, name):\n"
        "    drape_check(f'scenes/{name}.toml', '--motion-tolerance', '1e-5')\n"
    )
    code, log = pytest_run(project, "--drape", DRAPE)
    assert code == 0 and "2 passed" in log, log
    (project / "scenes/flag.toml").write_text(CHANGED)
    code, log = pytest_run(project, "--drape", DRAPE)
    assert code == 1 and "1 failed, 1 passed" in log, log
    assert "scenes/flag.toml: changed" in log
    page = re.search(r"report: (\S+report\.html)", log)
    assert page and os.path.isfile(page[1]), log


def test_pytest_plugin_says_what_is_missing(project):
    (project / "test_cloth.py").write_text("def test_scene(drape_check):\n    drape_check('scenes/none.toml')\n")
    without = {name: value for name, value in os.environ.items() if name != "DRAPE_EXECUTABLE"}
    code, log = pytest_run(project, env={**without, "PATH": "/usr/bin:/bin"})
    assert code == 1 and "drape is not on the PATH: use --drape PROGRAM" in log, log
    code, log = pytest_run(project)
    assert code == 1 and "drape check ended with 2" in log and "none.toml" in log, log


# CTest


def cmake_project(project, scenes):
    (project / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.16)\nproject(cloth NONE)\n"
        f'include("{CI}/DrapeCheck.cmake")\nenable_testing()\n'
        + "".join(f"drape_add_check({name} {scene} --motion-tolerance 1e-5)\n" for name, scene in scenes.items())
    )
    return run(CMAKE, "-G", "Ninja", "-B", "build", f"-DDRAPE_EXECUTABLE={DRAPE}", cwd=project)


def test_ctest_function(project):
    code, log = cmake_project(project, {"flag": "scenes/flag.toml", "still": "scenes/still.toml"})
    assert code == 0, log
    code, log = run(CTEST, "--test-dir", "build", "-L", "drape", "--no-tests=error", cwd=project)
    assert code == 0 and "100% tests passed, 0 tests failed out of 2" in log, log
    (project / "scenes/flag.toml").write_text(CHANGED)
    code, log = run(CTEST, "--test-dir", "build", "--output-on-failure", cwd=project)
    assert code != 0 and "1 tests failed out of 2" in log and "scenes/flag.toml: changed" in log, log
    assert (project / "build/drape-check/flag/report.html").is_file()


def test_ctest_function_refuses_a_missing_scene(project):
    code, log = cmake_project(project, {"flag": "scenes/none.toml"})
    assert code != 0 and "no such scene" in log, log


# Versions


def test_versions_are_those_of_the_project():
    version = re.search(r"^project\(drape VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text(), re.MULTILINE)[1]
    action = yaml.safe_load((CI / "action.yml").read_text())
    template = yaml.safe_load((CI / "gitlab.yml").read_text())
    plugin = re.search('^version = "(.*)"$', (CI / "pyproject.toml").read_text(), re.MULTILINE)[1]
    assert action["inputs"]["version"]["default"] == version
    assert template[".drape-check"]["variables"]["DRAPE_VERSION"] == version
    assert plugin == version
    assert str(yaml.safe_load((SOURCE / "CITATION.cff").read_text())["version"]) == version


def test_forms_of_issues_are_complete():
    """GitHub ignores a form that lacks one of these."""
    forms = [file for file in (SOURCE / ".github/ISSUE_TEMPLATE").glob("*.yml") if file.name != "config.yml"]
    assert len(forms) == 2
    for file in forms:
        form = yaml.safe_load(file.read_text())
        assert form["name"] and form["description"] and form["body"]
        ids = [field["id"] for field in form["body"]]
        assert len(set(ids)) == len(ids)
        for field in form["body"]:
            assert field["type"] in ("textarea", "input") and field["attributes"]["label"]
