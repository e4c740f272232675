#!/usr/bin/python3
"""tests/cli/first_minutes.py FOLDER RECORDING [LETTERS_PER_SECOND]: types docs/start/quick-start.md: a film, a figure, a golden.

Types into a shell at a terminal of 80x24, in FOLDER, with drape on the PATH. Everything that is seen goes to RECORDING with its time,
in the format of asciinema (version 2), which plays it. Prints how long each command took, and ends with 1 if one failed.
"""

import fcntl
import json
import os
import pty
import re
import select
import struct
import sys
import termios
import time

COLUMNS, LINES = 80, 24
PROMPT = "$ "
COMMANDS = [
    "drape",
    "drape new flag",
    "drape lint flag.toml",
    "drape render flag.toml",
    "sed -i 's/#c8322d/#2d5fc8/' flag.toml",
    "drape render flag.toml --quality draft",
    "drape compare flag.toml --vary effects.air.gust=1,5 --quality draft -o gusts.html",
    "ls gusts-diagrams/energy.pdf",
    "drape bless flag.toml",
    "drape check flag.toml",
]
MAY_FAIL = {"drape"}  # prints its help: no command was given


class Terminal:
    """A shell at a terminal, whose output is recorded."""

    def __init__(self, folder, recording, pace):
        self.begin, self.seen, self.pace = time.monotonic(), "", pace
        self.file = open(recording, "w", encoding="utf-8")
        self.file.write(json.dumps({"version": 2, "width": COLUMNS, "height": LINES}) + "\n")
        self.child, self.fd = pty.fork()
        if self.child == 0:
            os.chdir(folder)
            os.environ.update(PS1=PROMPT, TERM="xterm", LC_ALL="C.UTF-8", ENV="")
            os.environ.pop("COLUMNS", None)
            os.execvp("sh", ["sh"])
        fcntl.ioctl(self.fd, termios.TIOCSWINSZ, struct.pack("HHHH", LINES, COLUMNS, 0, 0))
        self.wait_for(PROMPT)

    def read(self, seconds):
        """Reads what comes within a time; false at the end."""
        if not select.select([self.fd], [], [], seconds)[0]:
            return True
        try:
            text = os.read(self.fd, 65536).decode("utf-8", "replace")
        except OSError:
            return False
        self.file.write(json.dumps([round(time.monotonic() - self.begin, 3), "o", text], ensure_ascii=False) + "\n")
        self.seen += text
        return bool(text)

    def wait_for(self, end):
        while not self.seen.endswith(end):
            if not self.read(600):
                raise RuntimeError("the shell has ended")

    def run(self, command):
        """Types a command and waits for its end; returns its output, its exit code and its time."""
        for letter in command:
            os.write(self.fd, letter.encode())
            self.read(1 / self.pace)
        self.seen, begin = "", time.monotonic()
        os.write(self.fd, b"\n")
        self.wait_for(PROMPT)
        output, seconds = self.seen, time.monotonic() - begin
        self.seen = ""
        os.write(self.fd, b"echo code=$?\n")
        self.wait_for(PROMPT)
        code = int(re.search(r"code=(\d+)", self.seen).group(1))
        self.seen = ""
        return output, code, seconds


def main():
    folder, recording = sys.argv[1:3]
    terminal = Terminal(folder, recording, float(sys.argv[3]) if len(sys.argv) > 3 else 12)
    failed, whole = False, 0.0
    for command in COMMANDS:
        output, code, seconds = terminal.run(command)
        whole = time.monotonic() - terminal.begin
        print(f"{seconds:6.1f} s  {whole:6.1f} s  {command}")
        if code != 0 and command not in MAY_FAIL:
            print(output, f"ended with {code}", sep="\n")
            failed = True
    terminal.file.close()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
