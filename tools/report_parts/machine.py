"""What the figures were measured on, and with."""

from __future__ import annotations

import os
import platform
import subprocess
from pathlib import Path
from typing import Optional


def processors() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def processor_model() -> str:
    return _value(Path("/proc/cpuinfo"), "model name") or platform.processor() or platform.machine()


def _value(path: Path, name: str) -> Optional[str]:
    """Of a line `name : value` or `name=value`."""
    try:
        for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
            left, mark, right = line.partition("=" if path.name == "os-release" else ":")
            if mark and left.strip() == name:
                return right.strip().strip('"')
    except OSError:
        pass
    return None


def _memory_bytes() -> Optional[int]:
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (ValueError, OSError):
        return None


def load_average() -> Optional[float]:
    """Programs that wanted to run in the last minute: other work makes times longer."""
    try:
        return os.getloadavg()[0]
    except OSError:
        return None


def machine() -> dict:
    return {
        "processor": processor_model(),
        "processors": processors(),
        "memory_bytes": _memory_bytes(),
        "system": _value(Path("/etc/os-release"), "PRETTY_NAME") or platform.system(),
        "kernel": f"{platform.system()} {platform.release()}",
    }


def _first_line(command: list[str]) -> Optional[str]:
    try:
        run = subprocess.run(
            command, capture_output=True, text=True, timeout=60, stdin=subprocess.DEVNULL
        )
    except (OSError, subprocess.SubprocessError):
        return None
    lines = run.stdout.splitlines()
    return lines[0].strip() if run.returncode == 0 and lines else None


# Of CMakeCache.txt.
_BUILD_ENTRIES = {
    "build_type": "CMAKE_BUILD_TYPE",
    "compiler": "CMAKE_CXX_COMPILER",
    "compiler_flags": "CMAKE_CXX_FLAGS",
}


def versions(program: Path, build: Path, checkout: Path) -> dict:
    cache: dict[str, str] = {}
    try:
        for line in (build / "CMakeCache.txt").read_text(encoding="utf-8").splitlines():
            name, mark, value = line.partition("=")
            if mark:
                cache[name.partition(":")[0]] = value
    except OSError:
        pass
    compiler = cache.get("CMAKE_CXX_COMPILER")
    return {
        "lumivec": _first_line([str(program.resolve()), "--version"]),
        "checkout": _first_line(["git", "-C", str(checkout), "describe", "--always", "--dirty"]),
        "compiler_version": _first_line([compiler, "--version"]) if compiler else None,
        **{name: cache.get(entry) or None for name, entry in _BUILD_ENTRIES.items()},
        "python": platform.python_version(),
    }
