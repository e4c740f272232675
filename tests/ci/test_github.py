"""The GitHub action, step by step in bash, with a made-up pull request and a server that keeps its comments."""

import hashlib
import http.server
import json
import re
import subprocess
import sys
import threading

import pytest
from conftest import CHANGED, CI
from stand_ins import Comments, Runner

PULL_REQUEST = {"action": "synchronize", "number": 17, "pull_request": {"number": 17, "head": {"ref": "wind"}}}


@pytest.fixture
def api():
    comments = Comments()
    yield comments
    comments.close()


@pytest.fixture
def runner(project, tmp_path, api):
    return Runner(project, tmp_path, PULL_REQUEST, api)


def change(project, name="flag"):
    (project / "scenes" / f"{name}.toml").write_text(CHANGED)


def test_nothing_changed(runner, api, archive):
    code, log, summary = runner.run(archive=str(archive), token="secret")
    assert code == 0, log
    assert "scenes/still.toml" in summary and "scenes/flag.toml" in summary and "<img" not in summary
    assert api.comments == [] and runner.branch_files() == []
    assert (runner.project / "out/check/junit.xml").is_file()


def test_a_changed_scene_fails_with_pictures_and_a_comment(runner, api, archive, project):
    change(project)
    code, log, summary = runner.run(archive=str(archive), token="secret")
    assert code == 1, log
    sources = re.findall('src="([^"]*)"', summary)
    begin = runner.server.as_uri() + "/owner/name/raw/drape-pictures/"
    assert sources and all(source.startswith(begin) for source in sources)
    assert {source[len(begin) :] for source in sources} == set(runner.branch_files())
    assert "https://example.invalid/artifact" in summary
    assert len(api.comments) == 1 and "scenes/flag.toml" in api.comments[0]["body"]
    assert "::error file=scenes/flag.toml" in log


def test_the_comment_is_updated(runner, api, archive, project):
    api.comments.extend({"id": i, "body": f"looks good {i}"} for i in range(150))  # more than a page
    good = (project / "scenes/flag.toml").read_text()
    change(project)
    runner.run(archive=str(archive), token="secret")
    assert len(api.comments) == 151
    first = api.comments[-1]["body"]
    runner.run(archive=str(archive), token="secret")
    assert len(api.comments) == 151 and api.comments[-1]["body"] != first  # the pictures have another address
    (project / "scenes/flag.toml").write_text(good)
    code, log, _ = runner.run(archive=str(archive), token="secret")
    assert code == 0, log
    assert len(api.comments) == 151 and "2 scenes are as they were" in api.comments[-1]["body"]


def test_without_a_token_nothing_is_sent(runner, api, archive, project):
    change(project)
    code, log, summary = runner.run(archive=str(archive))
    assert code == 1, log
    assert "scenes/flag.toml" in summary and "<img" not in summary
    assert api.requests == [] and runner.branch_files() == []


def test_a_push_has_no_comment(project, tmp_path, api, archive):
    change(project)
    runner = Runner(project, tmp_path, {"ref": "refs/heads/main"}, api)
    code, log, summary = runner.run(archive=str(archive), token="secret")
    assert code == 1, log
    assert "<img" in summary and api.requests == []


def test_a_token_without_rights_does_not_change_the_verdict(project, tmp_path, archive):
    refusing = Comments(allowed=False)
    try:
        runner = Runner(project, tmp_path, PULL_REQUEST, refusing)
        subprocess.run(["rm", "-rf", runner.server / "owner"], check=True)  # pushing fails as well
        code, log, summary = runner.run(archive=str(archive), token="secret")
        assert code == 0, log
        assert "::warning title=drape check::the pull request has no comment" in log
        change(project)
        code, log, summary = runner.run(archive=str(archive), token="secret")
        assert code == 1, log
        assert "::warning title=drape check::no pictures are shown" in log and "scenes/flag.toml" in summary
    finally:
        refusing.close()


def test_pictures_of_old_runs_go(runner, archive, project):
    change(project)
    runner.run(archive=str(archive), token="secret")
    place = runner.place / "old"
    git = ["git", "-C", place]
    subprocess.run(["git", "clone", "--quiet", "--branch", "drape-pictures", runner.server / "owner/name.git", place], check=True)
    for run in range(30):
        (place / f"{run:012d}-1-drape-check").mkdir()
        (place / f"{run:012d}-1-drape-check" / "a.gif").write_text("old")
    subprocess.run([*git, "add", "--all"], check=True)
    who = ["-c", "user.name=a", "-c", "user.email=a@b.invalid"]
    subprocess.run([*git, *who, "commit", "--quiet", "--message", "old"], check=True)
    subprocess.run([*git, "push", "--quiet"], check=True)
    runner.run(archive=str(archive), token="secret")
    runs = sorted({file.split("/")[0] for file in runner.branch_files()})
    assert len(runs) == 20 and runs[-1] == "000000000102-1-drape-check" and runs[-2] == "000000000101-1-drape-check"
    bare = ["git", "-C", runner.server / "owner/name.git"]
    count = subprocess.run([*bare, "rev-list", "--count", "drape-pictures"], check=True, capture_output=True, text=True)
    assert count.stdout.strip() == "1"  # the branch does not grow


def test_pictures_outside_of_the_report_are_not_sent(runner, archive, project):
    change(project)
    (project / "secret.png").write_text("secret")
    runner.run(archive=str(archive))
    folder = project / "out/check"
    report = json.loads((folder / "report.json").read_text())
    changed = next(scene for scene in report["scenes"] if scene["verdict"] == "changed")
    changed["animation"] = "../../secret.png"
    report["scenes"].append({**changed, "file": "<b>evil</b>](x)", "animation": "flag/difference.gif"})
    environment = {"PYTHONPATH": str(CI), "PYTHONDONTWRITEBYTECODE": "1"}
    program = (
        "import github_report as g, json, pathlib, sys\n"
        "shown = g.changed_pictures(json.load(sys.stdin), pathlib.Path('out/check'))\n"
        "print(g.gallery(shown, 'https://example.invalid'))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=project, env=environment, input=json.dumps(report), capture_output=True, text=True, check=True
    )
    assert "secret" not in done.stdout and "difference.gif" in done.stdout and "<b>" not in done.stdout


def test_no_scene_matches(runner, archive):
    code, log, _ = runner.run(archive=str(archive), scenes="nowhere/*.toml")
    assert code == 2 and "::error title=drape check::no scene matches nowhere/*.toml" in log


def test_options_and_patterns(runner, archive, project):
    change(project, "still")
    code, log, _ = runner.run(
        archive=str(archive), scenes="scenes/**/fl*.toml\nscenes/still.toml", options="--frames 0 --channel-limit 255 --pixel-limit 1 --flip-limit 1"
    )
    assert code == 0, log
    assert "scenes/still.toml: passed" in log and "scenes/flag.toml: passed" in log


def test_a_shard_shows_its_pictures(runner, archive, project):
    change(project)
    results = [runner.run(archive=str(archive), token="secret", name=f"shard-{k}", options=f"--shard {k}/2") for k in (1, 2)]
    assert sorted(code for code, _, _ in results) == [0, 1], results
    assert sorted("<img" in summary for _, _, summary in results) == [False, True]
    assert all("without a report" not in summary for _, _, summary in results)


def test_a_damaged_scene_is_an_error(runner, archive, project):
    (project / "scenes/flag.toml").write_text("[cloth\n")
    code, log, summary = runner.run(archive=str(archive))
    assert code == 2 and "scenes/flag.toml" in log and "drape check" in summary


def get_drape(*arguments):
    return subprocess.run([CI / "get-drape", *arguments], capture_output=True, text=True)


def test_get_drape_unpacks_once(archive, tmp_path):
    digest = hashlib.sha256(archive.read_bytes()).hexdigest()
    first = get_drape(archive, tmp_path / "cache", digest)
    assert first.returncode == 0 and (tmp_path / "cache/drape-0.2.0-x86_64/bin") == type(tmp_path)(first.stdout.strip())
    assert get_drape("/no/such/file", tmp_path / "cache").stdout == first.stdout
    assert not list((tmp_path / "cache").glob("*.partial"))


def test_get_drape_downloads(archive, tmp_path):
    class Handler(http.server.SimpleHTTPRequestHandler):
        def __init__(self, *arguments, **named):
            super().__init__(*arguments, directory=str(archive.parent), **named)

        def log_message(self, *_):
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    base = f"http://127.0.0.1:{server.server_port}"
    try:
        assert get_drape(f"{base}/{archive.name}", tmp_path / "a").returncode == 0
        missing = get_drape(f"{base}/none.tar.xz", tmp_path / "b")
    finally:
        server.shutdown()
        server.server_close()
    assert missing.returncode == 2 and "cannot download" in missing.stderr


@pytest.mark.parametrize("damage", ["checksum", "bytes", "contents", "nothing"])
def test_get_drape_refuses(archive, tmp_path, damage):
    file, digest = tmp_path / "archive.tar.xz", ""
    if damage == "checksum":
        file.write_bytes(archive.read_bytes())
        digest = "0" * 64
    elif damage == "bytes":
        file.write_bytes(archive.read_bytes()[:100])
    elif damage == "contents":
        subprocess.run(["tar", "-C", tmp_path, "-cJf", file, "--files-from", "/dev/null"], check=True)
    done = get_drape(file, tmp_path / "cache", digest)
    expected = {"checksum": "checksum", "bytes": "cannot be unpacked", "contents": "contains no", "nothing": "no such file"}
    assert done.returncode == 2 and expected[damage] in done.stderr and done.stdout == ""
