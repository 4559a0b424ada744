"""A step is one run of one program; its result is kept under a hash of all that it depends on."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import resource
import shlex
import shutil
import signal
import subprocess
import time
from dataclasses import asdict, dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any, Iterator, Optional

STDOUT = "stdout"  # as a step's output: the program prints its JSON
KIBIBYTE = 1024
MOST_TEXT = 200_000  # characters of a program's output that are kept


class ReportError(Exception):
    """What the user can mend."""


@lru_cache(maxsize=None)
def fingerprint(path: Path) -> str:
    """Of a file's bytes: a program that was built again to the same bytes is the same program."""
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError:
        return "missing"


@dataclass(frozen=True)
class Step:
    kind: str  # what it measures; with the tags, its name
    tags: dict[str, str]
    program: Path
    arguments: tuple[str, ...]
    key: str
    place: Path  # of the files that it leaves
    output: Optional[str]  # the JSON file that it writes, STDOUT, or none: text
    leaves: tuple[str, ...]  # files that are kept
    needs: tuple[str, ...]  # names of steps whose files it reads
    estimate: float  # seconds

    @property
    def name(self) -> str:
        return ", ".join([self.kind, *self.tags.values()])

    @property
    def command(self) -> str:
        return shlex.join([str(self.program), *self.arguments])


@dataclass
class Result:
    status: str = "not run"  # or ok, failed
    message: str = ""  # why it failed
    seconds: Optional[float] = None
    core_seconds: Optional[float] = None
    peak_bytes: Optional[int] = None  # largest resident size; none: less than this program's own
    when: str = ""
    output: Any = None  # the program's JSON
    text: str = ""  # what it printed, where it prints no JSON
    was_kept: bool = field(default=False, compare=False)


def step_key(folder: Path, program: Path, arguments: tuple[str, ...], about: list[str]) -> str:
    """A work folder may be moved: its place is not part of the key."""
    words = [word.replace(str(folder), "FOLDER") for word in arguments]
    text = json.dumps([program.name, fingerprint(program), words, about])
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def write_atomically(path: Path, text: str) -> None:
    """Whoever reads the file finds the old or the new one, never half of it."""
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    try:
        part.write_text(text, encoding="utf-8")
        os.replace(part, path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise ReportError(f"{path}: cannot be written: {error.strerror}") from error


class Keeper:
    """Results in a folder: steps/KEY.json, and the files of steps in files/KEY/."""

    def __init__(self, folder: Path) -> None:
        self.steps = folder / "steps"

    def find(self, step: Step) -> Optional[Result]:
        try:
            kept = json.loads((self.steps / f"{step.key}.json").read_text(encoding="utf-8"))
            result = Result(**kept["result"])
        except (OSError, ValueError, KeyError, TypeError):  # not there, cut short, or of old
            return None
        if result.status != "ok" or not all((step.place / name).is_file() for name in step.leaves):
            return None
        result.was_kept = True
        return result

    def keep(self, step: Step, result: Result) -> None:
        content = {"name": step.name, "command": step.command, "result": asdict(result)}
        del content["result"]["was_kept"]
        self.steps.mkdir(parents=True, exist_ok=True)
        write_atomically(self.steps / f"{step.key}.json", json.dumps(content, indent=1) + "\n")


def _last_words(text: str) -> str:
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[-1][:500] if lines else ""


def _how_it_ended(code: int, errors: str) -> str:
    if code >= 0:
        ending = f"ended with status {code}"
    else:
        try:
            ending = f"was ended by {signal.Signals(-code).name}"
        except ValueError:
            ending = f"was ended by signal {-code}"
    words = _last_words(errors)
    return f"{ending}: {words}" if words else ending


def _read_json(path: Path) -> Any:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


@contextlib.contextmanager
def _held_interrupts() -> Iterator[list[int]]:
    """Yields what arrives meanwhile. One that ended Popen itself would leave its program running."""
    arrived: list[int] = []
    handlers = {
        number: signal.signal(number, lambda number, frame: arrived.append(number))
        for number in (signal.SIGINT, signal.SIGTERM)
    }
    try:
        yield arrived
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)


def _run_program(step: Step, place: Path) -> tuple[int, Any]:
    """The exit code, and the resources that the program used."""
    # A colour configuration of the user's would change pictures and FLIP.
    environment = {name: value for name, value in os.environ.items() if name != "OCIO"}
    with open(place / "stdout.txt", "wb") as out, open(place / "stderr.txt", "wb") as errors:
        with _held_interrupts() as interrupts:
            process = subprocess.Popen(
                [str(step.program.resolve()), *step.arguments],
                cwd=place,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=errors,
            )
        try:
            if interrupts:
                raise KeyboardInterrupt
            # Not process.wait(): it does not tell this one child's resources.
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        except BaseException:
            process.kill()
            process.wait()
            raise
    return process.returncode, usage


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace")[-MOST_TEXT:]


def run_step(step: Step) -> Result:
    result = Result(when=time.strftime("%Y-%m-%d %H:%M:%S"))
    place = step.place.with_suffix(".part")
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    start = time.monotonic()
    try:
        code, usage = _run_program(step, place)
    except OSError as error:
        result.status, result.message = "failed", f"{step.program}: {error.strerror}"
        return result
    result.seconds = time.monotonic() - start
    result.core_seconds = usage.ru_utime + usage.ru_stime
    # Until it became the program, the process was a copy of this one, which counts as its size.
    if usage.ru_maxrss > resource.getrusage(resource.RUSAGE_SELF).ru_maxrss:
        result.peak_bytes = usage.ru_maxrss * KIBIBYTE
    # What a program wrote before it failed is shown too.
    if step.output:
        result.output = _read_json(place / ("stdout.txt" if step.output == STDOUT else step.output))
    else:
        result.text = _text(place / "stdout.txt")
    missing = [name for name in step.leaves if not (place / name).is_file()]
    if code != 0:
        result.message = _how_it_ended(code, _text(place / "stderr.txt"))
    elif step.output and not isinstance(result.output, dict):
        result.message = f"wrote no JSON ({step.output})"
    elif missing:
        result.message = f"did not write {', '.join(missing)}"
    result.status = "failed" if result.message else "ok"
    for path in list(place.rglob("*")):
        if path.is_file() and str(path.relative_to(place)) not in step.leaves:
            path.unlink()
    shutil.rmtree(step.place, ignore_errors=True)
    place.rename(step.place)
    return result
