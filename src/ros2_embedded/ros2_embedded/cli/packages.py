# SPDX-License-Identifier: Apache-2.0
"""Where packages and their executables are: the ament index first, then installed distributions."""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from urllib.parse import unquote, urlsplit

_MARKERS = Path("share", "ament_index", "resource_index", "packages")


class PackageNotFoundError(LookupError):
    """No package of that name is in the ament index or among the installed distributions."""


@dataclass(frozen=True)
class Executable:
    """A program of a package.

    Attributes:
        name: The name that `ros2 run` takes.
        command: The words that start it.
    """

    name: str
    command: tuple[str, ...]

    @property
    def path(self) -> str:
        """What identifies the program: its file, or its entry point."""
        return self.command[-1]


def prefixes() -> list[Path]:
    """Return the ament prefixes, the nearest overlay first; this Python's own prefix is last."""
    listed = [
        Path(entry) for entry in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if entry
    ]
    return [*listed, Path(sys.prefix)]


def package_names() -> list[str]:
    """Return the names of all packages of the ament index, sorted."""
    names: set[str] = set()
    for prefix in prefixes():
        markers = prefix / _MARKERS
        if markers.is_dir():
            names.update(entry.name for entry in markers.iterdir() if entry.is_file())
    for distribution in metadata.distributions():
        if _is_ros_package(distribution):
            names.add(_package_name(distribution.metadata["Name"]))
    return sorted(names)


def package_prefix(name: str) -> Path | None:
    """Return the prefix that a package is installed in, None if there is no such package.

    Args:
        name: The package's name.
    """
    for prefix in prefixes():
        if (prefix / _MARKERS / name).is_file():
            return prefix
    return Path(sys.prefix) if _distribution(name) is not None else None


def executables(package: str) -> list[Executable]:
    """Return the executables of a package, sorted by name.

    Files of `<prefix>/lib/<package>` come from the ament layout, isolated or merged; a package
    that pip has installed has console scripts instead. A file hides a script of the same name.

    Args:
        package: The package's name; for a distribution `-` and `_` are the same.

    Raises:
        PackageNotFoundError: There is no such package.
    """
    prefix = package_prefix(package)
    if prefix is None:
        raise PackageNotFoundError(package)
    found = list(_console_scripts(package))
    files = list(_files(prefix / "lib" / package))
    taken = {executable.name for executable in files}
    found = files + [script for script in found if script.name not in taken]
    return sorted(found, key=lambda executable: (executable.name, executable.path))


def _files(folder: Path) -> Iterator[Executable]:
    for directory, folders, names in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        for name in sorted(names):
            path = Path(directory, name)
            if os.access(path, os.X_OK):
                yield Executable(name, (str(path),))


def _console_scripts(package: str) -> Iterator[Executable]:
    distribution = _distribution(package)
    if distribution is None:
        return
    for script in distribution.entry_points.select(group="console_scripts"):
        runner = (sys.executable, "-m", "ros2_embedded.cli.entry_point", script.name, script.value)
        yield Executable(script.name, runner)


def _distribution(package: str) -> metadata.Distribution | None:
    try:
        return metadata.distribution(package)
    except (metadata.PackageNotFoundError, ValueError):
        return None


def _package_name(distribution: str) -> str:
    return re.sub(r"[-_.]+", "_", distribution).lower()


def _is_ros_package(distribution: metadata.Distribution) -> bool:
    """Tell whether a distribution brings the ament marker that every ROS package installs."""
    if any(
        file.parts[-len(_MARKERS.parts) - 1 : -1] == _MARKERS.parts
        for file in distribution.files or ()
    ):
        return True
    # An editable installation has no data files, but the source of the package.
    origin = json.loads(distribution.read_text("direct_url.json") or "{}")
    source = urlsplit(origin.get("url", ""))
    return source.scheme == "file" and Path(unquote(source.path), "package.xml").is_file()
