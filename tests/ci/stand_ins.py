"""What of GitHub the action meets: a runner of composite actions, the interface for comments, and a repository's remote."""

import http.server
import json
import os
import re
import subprocess
import threading

import yaml
from conftest import CI


class Comments:
    """The interface of one pull request's comments, on a port of this machine."""

    def __init__(self, allowed=True):
        self.comments, self.requests, self.allowed = [], [], allowed
        outer = self

        class Handler(http.server.BaseHTTPRequestHandler):
            def log_message(self, *_):
                pass

            def answer(self, code, value):
                self.send_response(code)
                self.end_headers()
                self.wfile.write(json.dumps(value).encode())

            def handle_any(self):
                outer.requests.append((self.command, self.path))
                body = self.rfile.read(int(self.headers.get("Content-Length") or 0))
                if not outer.allowed or self.headers["Authorization"] != "Bearer secret":
                    return self.answer(403, {"message": "Resource not accessible by integration"})
                if self.command == "GET":
                    page = int(re.search(r"[?&]page=(\d+)", self.path)[1])
                    return self.answer(200, outer.comments[100 * (page - 1) : 100 * page])
                text = json.loads(body)["body"]
                if self.command == "POST":
                    assert self.path == "/repos/owner/name/issues/17/comments"
                    outer.comments.append({"id": 1000 + len(outer.comments), "body": text})
                    return self.answer(201, outer.comments[-1])
                number = int(re.fullmatch("/repos/owner/name/issues/comments/([0-9]+)", self.path)[1])
                next(c for c in outer.comments if c["id"] == number)["body"] = text
                return self.answer(200, {})

            do_GET = do_POST = do_PATCH = handle_any

        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.address = f"http://127.0.0.1:{self.server.server_port}"
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def close(self):
        self.server.shutdown()
        self.server.server_close()


class Runner:
    """Runs the steps of ci/action.yml as GitHub does: bash for those that run something, nothing for other actions."""

    def __init__(self, project, place, event, api):
        self.project, self.place, self.api = project, place, api
        self.server = place / "server"
        subprocess.run(["git", "init", "--quiet", "--bare", self.server / "owner" / "name.git"], check=True)
        self.event = place / "event.json"
        self.event.write_text(json.dumps(event))
        self.runs = 0

    def run(self, **inputs):
        """Run the action. Returns its exit code, its log and the summary."""
        self.runs += 1
        action = yaml.safe_load((CI / "action.yml").read_text())
        values = {name: str(value["default"]) for name, value in action["inputs"].items()}
        unknown = [name for name in inputs if name.replace("_", "-") not in values]
        assert not unknown, unknown
        values.update({name.replace("_", "-"): value for name, value in inputs.items()})
        temp = self.place / f"temp-{self.runs}"
        temp.mkdir()
        summary, path_file = temp / "summary.md", temp / "path"
        path_file.touch()
        steps, log, code = {}, "", 0
        environment = dict(
            os.environ,
            GITHUB_ACTIONS="true",
            GITHUB_ACTION_PATH=str(CI),
            GITHUB_STEP_SUMMARY=str(summary),
            GITHUB_PATH=str(path_file),
            GITHUB_EVENT_PATH=str(self.event),
            GITHUB_REPOSITORY="owner/name",
            GITHUB_SERVER_URL=self.server.as_uri(),
            GITHUB_API_URL=self.api.address,
            GITHUB_RUN_ID=str(100 + self.runs),
            GITHUB_RUN_ATTEMPT="1",
            RUNNER_TEMP=str(temp),
            PYTHONDONTWRITEBYTECODE="1",
        )

        def value(expression):
            expression = expression.strip()
            if any(mark in expression for mark in ("always()", "!=")):
                return str(condition(expression)).lower()
            for part in expression.split("||"):
                part = part.strip()
                if part.startswith("format("):
                    found = "https://example.invalid/drape.tar.xz"
                elif part.startswith("inputs."):
                    found = values[part[len("inputs.") :]]
                elif part == "runner.temp":
                    found = str(temp)
                elif match := re.fullmatch(r"steps\.(\S+)\.outputs\.(\S+)", part):
                    found = steps.get(match[1], {}).get(match[2], "")
                else:
                    raise AssertionError(f"the runner of the tests does not know {part}")
                if found:
                    return found
            return ""

        def condition(expression):
            always, output = re.fullmatch(r"(always\(\) && )?(steps\.\S+) != ''", expression).groups()
            return (always is not None or code == 0) and value(output) != ""

        def filled(text):
            return re.sub(r"\$\{\{(.*?)\}\}", lambda match: value(match[1]), str(text))

        for step in action["runs"]["steps"]:
            # Without a condition a step runs only if all previous steps have succeeded.
            if not (condition(step["if"].removeprefix("${{").removesuffix("}}").strip()) if "if" in step else code == 0):
                continue
            if "uses" in step:
                for text in step["with"].values():
                    filled(text)
                if step["uses"].startswith("actions/upload-artifact@"):
                    steps[step["id"]] = {"artifact-url": "https://example.invalid/artifact"}
                continue
            assert step["shell"] == "bash"
            output = temp / f"output-{len(log)}"
            output.touch()
            path = os.pathsep.join([*path_file.read_text().split(), environment["PATH"]])
            own = {name: filled(text) for name, text in step.get("env", {}).items()}
            done = subprocess.run(
                ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", filled(step["run"])],
                cwd=self.project,
                env={**environment, **own, "GITHUB_OUTPUT": str(output), "PATH": path},
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
            )
            log += done.stdout
            steps[step.get("id", step["name"])] = dict(line.split("=", 1) for line in output.read_text().splitlines())
            code = code or done.returncode
        return code, log, summary.read_text() if summary.exists() else ""

    def branch_files(self, branch="drape-pictures"):
        listed = subprocess.run(
            ["git", "-C", self.server / "owner" / "name.git", "ls-tree", "-r", "--name-only", branch], capture_output=True, text=True
        )
        return listed.stdout.split()
