"""The program: where it is, and how it is started and followed."""
from __future__ import annotations

import dataclasses
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile
import warnings
from typing import Callable, Sequence

from .errors import InputError, RunError


@dataclasses.dataclass(frozen=True)
class Progress:
    """A line of progress of a run, about every ten seconds."""

    phase: str                  #: what the run does, as "loading"
    share: float                #: done of the phase, 0 to 1
    steps_per_s: float          #: rate of time steps [1/s]
    seconds_left: float | None  #: estimate [s], None at the beginning
    numbers: str                #: what the kind of test shows
    line: str                   #: the line itself


_PROGRESS = re.compile(
    r"^(?P<phase>.+?)\s+(?P<share>\d+\.\d) %\s+(?P<rate>\d+) steps/s"
    r"(?:  (?P<minutes>\d+):(?P<seconds>\d\d) left)?(?:  (?P<numbers>.*))?$")
_NOTE = "note: "  # how lines on likely slips of the case begin


def parse_progress(line: str) -> Progress | None:
    """A line of the output as progress; None if it is another line."""
    found = _PROGRESS.match(line)
    if not found:
        return None
    left = None
    if found["minutes"]:
        left = 60.0 * int(found["minutes"]) + int(found["seconds"])
    return Progress(found["phase"].strip(), float(found["share"]) / 100,
                    float(found["rate"]), left, found["numbers"] or "", line)


def find_program() -> pathlib.Path:
    """The program ``spall``: that of the environment variable SPALL, else the
    one that was built or installed with this package, else that of PATH."""
    chosen = os.environ.get("SPALL")
    if chosen:
        if not os.access(chosen, os.X_OK) or pathlib.Path(chosen).is_dir():
            raise InputError(f"SPALL = {chosen}: is no program")
        return pathlib.Path(chosen).absolute()
    here = pathlib.Path(__file__).resolve().parent
    # PREFIX/lib/python3/dist-packages/spall, or apps/python/spall.
    near = [here.parents[3] / "bin" / "spall",
            here.parents[2] / "build" / "apps" / "spall"]
    found = next((one for one in near if os.access(one, os.X_OK)), None)
    in_path = shutil.which("spall")
    if found is None and in_path is None:
        raise InputError("the program spall was not found: set the "
                         "environment variable SPALL to its path, or add its "
                         "folder to PATH; looked for "
                         f"{', '.join(map(str, near))} and in PATH")
    return found or pathlib.Path(str(in_path)).absolute()


def version() -> str:
    """Version of the program, as 0.2.0."""
    return call("--version").split()[1]


def call(*words: str | pathlib.Path) -> str:
    """Runs the program and returns what it printed. InputError or RunError
    with its one line if it fails."""
    ended = subprocess.run([str(find_program()), *map(str, words)],
                           capture_output=True, text=True, check=False)
    _raise_failure(ended.returncode, ended.stderr)
    return ended.stdout


def message_of(errors: str) -> str:
    """The line of the program among what was printed to stderr."""
    lines = [line.strip() for line in errors.splitlines() if line.strip()]
    ours = [line for line in lines if line.startswith("spall: ")
            and ": deprecated " not in line]
    if ours:
        return ours[-1][len("spall: "):]
    return lines[-1] if lines else "no message"


def _raise_failure(status: int, errors: str) -> None:
    for line in errors.splitlines():
        if line.startswith("spall: ") and ": deprecated " in line:
            warnings.warn(line[len("spall: "):], FutureWarning, stacklevel=4)
    if status == 0:
        return
    if status == 1:
        raise InputError(message_of(errors))
    by = f"ended by signal {-status}: " if status < 0 else ""
    raise RunError(by + message_of(errors), status)


def start_words(ranks: int, mpirun: str | None) -> list[str]:
    """The words before those of the program."""
    if ranks == 1:
        return []
    words = shlex.split(mpirun or os.environ.get("SPALL_MPIRUN") or "mpirun")
    if not shutil.which(words[0]):
        raise InputError(f"ranks = {ranks}: {words[0]} was not found")
    return [*words, "-n", str(ranks)]


def follow(words: Sequence[str],
           progress: Callable[[Progress], object] | None,
           note: Callable[[str], object] | None = None) -> None:
    """Runs a command to its end and hands its lines of progress, and its notes
    on the case, on. Where a callback raises, or on Ctrl-C, the run is asked to
    stop, writes its checkpoint, and the exception goes on."""
    with tempfile.TemporaryFile("w+") as errors:
        with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=errors,
                              text=True, bufsize=1) as process:
            assert process.stdout is not None
            try:
                for line in process.stdout:
                    step = parse_progress(line.rstrip("\n"))
                    if step and progress:
                        progress(step)
                    if note and line.startswith(_NOTE):
                        note(line.removeprefix(_NOTE).rstrip("\n"))
                process.wait()
            except BaseException:
                process.terminate()
                process.stdout.read()
                process.wait()
                raise
        errors.seek(0)
        _raise_failure(process.returncode, errors.read())
