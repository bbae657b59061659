#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Show how far a command is, reading its output from standard input.

progress.py build TITLE     lines of Ninja with NINJA_STATUS='[%f/%t] '
progress.py run TITLE LOG   screen output of LAMMPS, which writes the file LOG as well

On a terminal one line is rewritten; elsewhere a line is written now and then.  The length of a run
is that of its `run N` command, which LAMMPS echoes to the log, or better, what the input prints:
    Progress: steps N [name]      the next N steps are one thing, called name
What a user must see passes through: warnings, errors, lines that begin with Talus or Result
(indented lines after them belong to them), and blocks from  --- title ---  to an empty line.
"""

import re
import sys
import time

QUIET_INTERVAL = 10.0       # seconds between lines when not on a terminal
TERMINAL_INTERVAL = 0.2


def clock(seconds):
    minutes, seconds = divmod(int(seconds + 0.5), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02d}:{seconds:02d}" if hours else f"{minutes}:{seconds:02d}"


class Display:
    """One line about the state, not more often than useful."""

    def __init__(self, title, stream=sys.stderr, now=time.monotonic):
        self.title, self.stream, self.now = title, stream, now
        self.terminal = stream.isatty()
        self.start = self.last = now()
        self.open_line = False

    def restart(self, title):
        self.title, self.start = title, self.now()

    def show(self, done, total, unit="", force=False):
        interval = TERMINAL_INTERVAL if self.terminal else QUIET_INTERVAL
        if not force and self.now() - self.last < interval:
            return
        self.last = self.now()
        self._write(self.describe(done, total, unit))

    def describe(self, done, total, unit):
        elapsed = self.now() - self.start
        if not total:
            return f"{self.title}: {unit}{done}, {clock(elapsed)} so far"
        text = f"{self.title}: {unit}{done} of {total} ({100 * done // total} %), {clock(elapsed)} so far"
        if 0 < done < total and elapsed > 0:
            text += f", about {clock(elapsed * (total - done) / done)} left"
        return text

    def _write(self, text):
        if self.terminal:
            self.stream.write("\r\x1b[K" + text)
            self.open_line = True
        else:
            self.stream.write(f"talus: {text}\n")
        self.stream.flush()

    def pass_through(self, line):
        self.close()
        sys.stdout.write(line + "\n")
        sys.stdout.flush()

    def close(self):
        if self.open_line:
            self.stream.write("\n")
            self.stream.flush()
            self.open_line = False


def follow_build(lines, display):
    done = total = 0
    for line in lines:
        match = re.match(r"\[(\d+)/(\d+)\] ", line)
        if match:
            done, total = map(int, match.groups())
        if done:
            display.show(done, total)
    if done:    # otherwise all was up to date
        display.show(done, total, force=True)


class RunFollower:
    """Turns the screen output of LAMMPS into progress."""

    SHOWN = re.compile(r"(WARNING|ERROR|Talus|talus|Result)\b")
    BLOCK = re.compile(r"--- .* ---$")
    NUMBERS = re.compile(r"\s*(\d+)(\s+[-+.\deEnaif]+)+\s*$")

    def __init__(self, display, say, log=None):
        self.display, self.say, self.log = display, say, log
        self.title = display.title
        self.total = None           # steps of the phase, if known
        self.announced = False      # by the scene: `run` commands do not change it
        self.first = None           # step at which the phase began
        self.in_thermo = self.failed = self.speaking = self.in_block = False

    def begin(self, total, name=""):
        self.total, self.first = total, None
        self.display.restart(name or self.title)

    def is_shown(self, line):
        # nothing but the cause follows an error
        self.failed = self.failed or line.startswith("ERROR")
        self.in_block = bool(line.strip()) and (self.in_block or bool(self.BLOCK.match(line)))
        row = self.in_thermo and self.NUMBERS.match(line)    # may follow a warning: it is no part of it
        self.speaking = bool(self.SHOWN.match(line)) or bool(
            self.speaking and line.startswith("  ") and line.split()[:1] != ["Step"] and not row)
        return self.failed or self.in_block or self.speaking

    def line(self, line):
        words = line.split()
        if self.is_shown(line):
            self.say(line)
        elif line.startswith("Progress: steps ") and len(words) >= 3 and words[2].isdigit():
            self.announced = True
            self.begin(int(words[2]), " ".join(words[3:]))
        elif words[:1] == ["Step"]:
            self.in_thermo = True
            if not self.announced:
                self.begin(self.last_run_command())
        elif line.startswith("Loop time of"):
            self.in_thermo = False
        elif self.in_thermo and self.NUMBERS.match(line):
            self.step(int(words[0]))

    def last_run_command(self):
        try:
            with open(self.log, errors="replace") as file:
                commands = re.findall(r"^run\s+(\d+)", file.read(), re.MULTILINE)
        except (OSError, TypeError):
            return None
        return int(commands[-1]) if commands else None

    def step(self, step):
        if self.first is None:
            self.first = step
        done = step - self.first
        self.display.show(done, self.total, "step ")
        if self.announced and self.total and done >= self.total:
            self.announced = False


def follow_run(lines, display, log=None):
    follower = RunFollower(display, display.pass_through, log)
    for line in lines:
        follower.line(line)


def main():
    kind, title, *log = sys.argv[1:]
    display = Display(title)
    lines = (line.rstrip("\n") for line in sys.stdin)
    try:
        {"build": follow_build, "run": follow_run}[kind](lines, display, *log)
    except KeyboardInterrupt:
        sys.exit(130)
    finally:
        display.close()


if __name__ == "__main__":
    sys.stdin.reconfigure(errors="replace")
    main()
