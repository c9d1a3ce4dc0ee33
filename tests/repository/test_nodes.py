# SPDX-License-Identifier: Apache-2.0
"""A node keeps out of the attributes that rclpy's Node has itself: overwriting one breaks it far from here."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest
import rclpy
from rclpy.context import Context

ROOT = Path(__file__).resolve().parents[2]
NODES = sorted(ROOT.glob("src/*/*/*_node.py"))


@pytest.fixture(scope="module")
def taken():
    context = Context()
    rclpy.init(context=context)
    node = rclpy.create_node("plain", context=context)
    names = set(vars(node)) | set(dir(type(node)))
    node.destroy_node()
    rclpy.shutdown(context=context)
    return names


@pytest.mark.parametrize("path", NODES, ids=lambda path: path.stem)
def test_a_node_overwrites_nothing_of_rclpy(path, taken):
    own = set()
    for item in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(item, ast.Attribute) and isinstance(item.ctx, ast.Store):
            if isinstance(item.value, ast.Name) and item.value.id == "self":
                own.add(item.attr)
        elif isinstance(item, ast.ClassDef):
            own |= {f.name for f in item.body if isinstance(f, ast.FunctionDef)} - {"__init__"}
    assert not own & taken


def test_the_nodes_are_found():
    assert {path.stem for path in NODES} >= {
        "radar_simulator_node",
        "plot_extractor_node",
        "tracker_node",
    }
