#!/usr/bin/env python3
"""Show what `drape check` found on GitHub: pictures in the job's summary and one comment on the pull request.

Runs as a step of action.yml. Without TOKEN the summary has no pictures, as GitHub shows only those that have an address. With
TOKEN they are pushed to a branch of the repository, which keeps those of the last runs, and a pull request gets one comment,
which later runs update. What the token does not allow is a warning: the verdict is the check's alone.
"""

import base64
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import urllib.error
import urllib.parse
import urllib.request

RUNS_KEPT = 20
SCENES_SHOWN = 20
LONGEST_COMMENT = 60_000  # GitHub's limit is 65 536 characters


def warn(message):
    print(f"::warning title=drape check::{message}".replace("\n", " "))


def escaped(text):
    """Make text harmless in Markdown and in HTML."""
    text = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace('"', "&quot;")
    return "".join("\\" + c if c in "\\`*_{}[]()#+!|~@" else c for c in text).replace("\n", " ")


def pictures_of(scene, folder):
    """List (title, file) of the pictures that show best what changed: an animation, or the frame that differs most."""
    animation = scene.get("animation")
    if animation and (folder / animation).is_file():
        return [("expected, actual and difference", animation)]
    frames = [f for f in scene.get("windows", {}).get("frames", []) if f.get("verdict") == "changed" and f.get("files")]
    if not frames:
        return []
    worst = max(frames, key=lambda frame: frame["max_flip"])
    kinds = ("expected", "actual", "difference")
    return [(f"frame {worst['frame']}, {kind}", worst["files"][kind]) for kind in kinds if kind in worst["files"]]


def changed_pictures(report, folder):
    """Map each changed scene's file to its pictures. A report is somebody's data: paths must stay inside its folder."""
    shown = {}
    for scene in report["scenes"]:
        if scene["verdict"] != "changed" or len(shown) == SCENES_SHOWN:
            continue
        inside = [
            (title, file)
            for title, file in pictures_of(scene, folder)
            if (folder / file).resolve().is_relative_to(folder.resolve()) and (folder / file).is_file()
        ]
        if inside:
            shown[scene["file"]] = inside
    return shown


class Git:
    """git in a folder, as the owner of a token."""

    def __init__(self, folder, token):
        secret = base64.b64encode(f"x-access-token:{token}".encode()).decode()
        self.folder = folder
        self.environment = dict(
            os.environ,
            GIT_TERMINAL_PROMPT="0",
            GIT_CONFIG_COUNT="1",
            GIT_CONFIG_KEY_0="http.extraheader",
            GIT_CONFIG_VALUE_0=f"Authorization: Basic {secret}",
        )
        for who in ("AUTHOR", "COMMITTER"):
            self.environment[f"GIT_{who}_NAME"] = "drape check"
            self.environment[f"GIT_{who}_EMAIL"] = "drape-check@users.noreply.invalid"

    def __call__(self, *arguments, check=True):
        return subprocess.run(
            ["git", "-C", self.folder, *arguments], env=self.environment, check=check, capture_output=True, text=True
        )


def push_pictures(shown, folder, token):
    """Push pictures to the branch, as its only commit.

    Returns the address of the folder that holds them.
    """
    server, repository = os.environ["GITHUB_SERVER_URL"], os.environ["GITHUB_REPOSITORY"]
    branch = os.environ["PICTURES_BRANCH"]
    run = f"{int(os.environ['GITHUB_RUN_ID']):012d}-{os.environ.get('GITHUB_RUN_ATTEMPT', '1')}-{os.environ['NAME']}"
    remote = f"{server}/{repository}.git"
    error = ""
    for _ in range(5):  # another job may push at the same time
        with tempfile.TemporaryDirectory() as place:
            git = Git(place, token)
            git("init", "--quiet")
            fetched = git("fetch", "--quiet", "--depth=1", remote, f"refs/heads/{branch}", check=False).returncode == 0
            before = git("rev-parse", "FETCH_HEAD").stdout.strip() if fetched else ""
            if fetched:
                git("checkout", "--quiet", "FETCH_HEAD")
            old = sorted(path for path in pathlib.Path(place).iterdir() if path.is_dir() and path.name != ".git")
            for path in old[: max(0, len(old) - RUNS_KEPT + 1)]:
                shutil.rmtree(path)
            for pictures in shown.values():
                for _, file in pictures:
                    target = pathlib.Path(place, run, file)
                    target.parent.mkdir(parents=True, exist_ok=True)
                    shutil.copyfile(folder / file, target)
            git("checkout", "--quiet", "--orphan", "pictures")
            git("add", "--all")
            git("commit", "--quiet", "--message", "Pictures of the last checks")
            pushed = git("push", "--quiet", f"--force-with-lease=refs/heads/{branch}:{before}", remote,
                         f"HEAD:refs/heads/{branch}", check=False)
            if pushed.returncode == 0:
                return f"{server}/{repository}/raw/{urllib.parse.quote(branch)}/{urllib.parse.quote(run)}"
            error = pushed.stderr.strip()
    raise OSError(f"the pictures could not be pushed to {branch}: {error}")


def gallery(shown, address):
    text = ""
    for scene, pictures in shown.items():
        text += f"\n#### {escaped(scene)}\n\n"
        for title, file in pictures:
            text += f'<img alt="{escaped(title)}" title="{escaped(title)}" src="{address}/{urllib.parse.quote(file)}">\n'
    return text


class Api:
    """The part of GitHub's REST interface that comments need."""

    def __init__(self, token):
        self.base = f"{os.environ['GITHUB_API_URL']}/repos/{os.environ['GITHUB_REPOSITORY']}/issues"
        self.token = token

    def call(self, method, path, body=None):
        request = urllib.request.Request(
            f"{self.base}/{path}",
            method=method,
            data=None if body is None else json.dumps({"body": body}).encode(),
            headers={
                "Authorization": f"Bearer {self.token}",
                "Accept": "application/vnd.github+json",
                "Content-Type": "application/json",
                "X-GitHub-Api-Version": "2022-11-28",
            },
        )
        with urllib.request.urlopen(request, timeout=30) as answer:
            return json.load(answer)

    def find(self, number, mark):
        """Find the comment that begins with a mark. Returns its id, or None."""
        page = 1
        while True:
            comments = self.call("GET", f"{number}/comments?per_page=100&page={page}")
            for comment in comments:
                if (comment.get("body") or "").startswith(mark):
                    return comment["id"]
            if len(comments) < 100:
                return None
            page += 1


def comment(text, passed, token):
    """Update the pull request's comment. Posts a new one only where something failed."""
    event = json.loads(pathlib.Path(os.environ["GITHUB_EVENT_PATH"]).read_text(encoding="utf-8"))
    number = (event.get("pull_request") or {}).get("number")
    if number is None:
        return
    mark = f"<!-- {os.environ['NAME']} -->\n"
    api = Api(token)
    existing = api.find(number, mark)
    if existing is not None:
        api.call("PATCH", f"comments/{existing}", mark + text)
    elif not passed:
        api.call("POST", f"{number}/comments", mark + text)


def report_folder(folder):
    """Find the folder of the newest report.json: of a check with --shard, it is below that of --report."""
    reports = [folder / "report.json", *folder.glob("shard-*-of-*/report.json")]
    return max((file for file in reports if file.is_file()), key=lambda file: file.stat().st_mtime, default=reports[0]).parent


def main():
    folder = report_folder(pathlib.Path(os.environ["REPORT"]))
    table = pathlib.Path(os.environ["RUNNER_TEMP"], "drape-summary.md")
    text = table.read_text(encoding="utf-8") if table.is_file() else ""
    try:
        report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    except FileNotFoundError:
        report = {"passed": False, "scenes": []}  # the check ended before any verdict, and has printed the reason
        text = text or "### drape check: ended without a report\n"
    token = os.environ.get("TOKEN", "")
    shown = changed_pictures(report, folder)
    if shown and token:
        try:
            text += gallery(shown, push_pictures(shown, folder, token))
        except (OSError, subprocess.CalledProcessError) as error:
            warn(f"no pictures are shown: {getattr(error, 'stderr', '') or error}")
    if os.environ.get("ARTEFACT"):
        text += f"\n[The whole report]({os.environ['ARTEFACT']}): unpack it and open report.html.\n"
    with open(os.environ["GITHUB_STEP_SUMMARY"], "a", encoding="utf-8") as summary:
        summary.write(text)
    if not token:
        return
    if len(text) > LONGEST_COMMENT:
        text = text[:LONGEST_COMMENT].rsplit("\n", 1)[0] + "\n\nThe job's summary has the rest.\n"
    try:
        comment(text, report["passed"], token)
    except (OSError, ValueError) as error:
        warn(f"the pull request has no comment: {error}")


if __name__ == "__main__":
    sys.exit(main())
