# SPDX-License-Identifier: Apache-2.0
"""The rules of the house that a machine can check."""

from __future__ import annotations

import ast
import configparser
import importlib.util
import inspect
import pkgutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = [
    "radar_common",
    "radar_sim",
    "primary_proc",
    "secondary_proc",
    "bearing_tracker",
    "radar_eval",
]
BELOW = {
    "radar_common": set(),
    "radar_sim": {"radar_common"},
    "primary_proc": {"radar_common"},
    "secondary_proc": {"radar_common"},
    "bearing_tracker": {"radar_common"},
    "radar_eval": {
        "radar_common",
        "radar_sim",
        "primary_proc",
        "secondary_proc",
        "bearing_tracker",
    },
}
ROS = {"rclpy", "ament_index_python", "launch", "launch_ros"}
LONGEST_MODULE = 300
LONGEST_NODE = 200


def modules(package):
    return sorted((ROOT / "src" / package / package).rglob("*.py"))


def imports(path):
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name.split(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module.split(".")[0]


def is_shell(path):
    return path.name.endswith("_node.py") or path.parent.name == "ros"


@pytest.mark.parametrize("package", PACKAGES)
def test_cores_import_no_ros(package):
    offenders = {
        f"{path.relative_to(ROOT)}: {name}"
        for path in modules(package)
        if not is_shell(path)
        for name in imports(path)
        if name in ROS or name.endswith(("_msgs", "_interfaces"))
    }
    assert not offenders


@pytest.mark.parametrize("package", PACKAGES)
def test_imports_go_one_way(package):
    forbidden = ({*PACKAGES, "ros2_embedded"}) - BELOW[package] - {package}
    offenders = {
        f"{path.relative_to(ROOT)}: {name}"
        for path in modules(package)
        for name in imports(path)
        if name in forbidden
    }
    assert not offenders


def test_importing_every_core_loads_no_ros():
    cores = [
        ".".join(path.relative_to(ROOT / "src" / package).with_suffix("").parts)
        for package in PACKAGES
        for path in modules(package)
        if not is_shell(path) and path.name != "__init__.py"
    ]
    script = (
        "import importlib, sys\n"
        f"for name in {cores!r}: importlib.import_module(name)\n"
        "print([m for m in sys.modules if m == 'rclpy' or m.endswith('_msgs')])"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize("package", [*PACKAGES, "ros2_embedded"])
def test_modules_hold_one_idea(package):
    for path in modules(package):
        lines = len(path.read_text(encoding="utf-8").splitlines())
        longest = LONGEST_NODE if path.name.endswith("_node.py") else LONGEST_MODULE
        assert lines <= longest, f"{path.relative_to(ROOT)} has {lines} lines"
        assert path.stem not in {"utils", "helpers", "misc", "common"}


@pytest.mark.parametrize("package", PACKAGES)
def test_metadata_agree(package):
    xml = ElementTree.parse(ROOT / "src" / package / "package.xml").getroot()
    setup = configparser.ConfigParser()
    setup.read(ROOT / "src" / package / "setup.cfg")
    for tag in ("name", "version", "description", "license"):
        assert xml.findtext(tag) == setup["metadata"][tag], tag
    depends = {element.text for element in xml.findall("exec_depend")}
    used = {name for path in modules(package) for name in imports(path)} & set(PACKAGES)
    assert used - {package} <= depends
    messages = {
        n for p in modules(package) for n in imports(p) if n.endswith(("_msgs", "_interfaces"))
    }
    assert messages <= depends


@pytest.mark.parametrize("package", PACKAGES)
def test_every_executable_and_data_file_exists(package):
    setup = configparser.ConfigParser()
    setup.read(ROOT / "src" / package / "setup.cfg")
    for line in setup["options.data_files"].values():
        for name in line.replace(",", " ").split():
            assert (ROOT / "src" / package / name).is_file(), name
    if not setup.has_section("options.entry_points"):
        return
    for line in setup["options.entry_points"]["console_scripts"].split("\n"):
        if line:
            module, function = line.split("=")[1].strip().split(":")
            assert importlib.util.find_spec(module), module
            tree = ast.parse(Path(importlib.util.find_spec(module).origin).read_text("utf-8"))
            assert function in {n.name for n in tree.body if isinstance(n, ast.FunctionDef)}


def public_functions(package):
    root = importlib.import_module(package)
    for info in pkgutil.walk_packages(root.__path__, f"{package}."):
        if info.name.endswith("_node"):
            continue
        module = importlib.import_module(info.name)
        for name, item in vars(module).items():
            if name.startswith("_") or getattr(item, "__module__", None) != module.__name__:
                continue
            if inspect.isfunction(item):
                yield f"{info.name}.{name}", item
            elif inspect.isclass(item):
                for method, function in vars(item).items():
                    if inspect.isfunction(function) and (
                        method == "__init__" or not method.startswith("_")
                    ):
                        yield f"{info.name}.{name}.{method}", function


@pytest.mark.parametrize("package", PACKAGES)
def test_every_public_argument_is_documented(package):
    missing = []
    for name, function in public_functions(package):
        if function.__qualname__.endswith("__init__") and function.__doc__ is None:
            continue
        text = inspect.getdoc(function) or ""
        for argument in inspect.signature(function).parameters:
            if argument not in ("self", "args", "kwargs") and f"{argument}:" not in text:
                missing.append(f"{name}({argument})")
    assert not missing


def test_generated_files_are_current():
    spec = importlib.util.spec_from_file_location(
        "make_parameters", ROOT / "docs/make_parameters.py"
    )
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    for path, content in module.files().items():
        assert path.read_text(encoding="utf-8") == content, f"{path}: run `make parameters`"
