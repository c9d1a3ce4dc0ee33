# SPDX-License-Identifier: Apache-2.0
"""What the page says of the fourth chapter is what the functions compute."""

from __future__ import annotations

import importlib
import pkgutil
import re

import pytest

from secondary_proc import calculators
from secondary_proc.calculators.false_initiation import false_initiation
from secondary_proc.calculators.gate_size import three_gates
from secondary_proc.calculators.manoeuvre_detector import manoeuvre_detection
from secondary_proc.calculators.plot_selection import nearest_in_metres
from secondary_proc.calculators.rule_chain import rule_chain
from secondary_proc.calculators.track_detection import confirmation_delay
from secondary_proc.calculators.track_resolution import resolved_distance

TABLE = re.compile(r"^\| (.+) \|$", re.MULTILINE)


@pytest.fixture(scope="module")
def page(repository):
    return (repository / "docs" / "kuzmin_chapter_4.md").read_text("utf-8")


@pytest.fixture(scope="module")
def rows(page):
    cells = [[cell.strip() for cell in row.split("|")] for row in TABLE.findall(page)]
    return {row[0]: row[1:] for row in cells}


def test_every_function_named_exists(page):
    modules = [
        importlib.import_module(f"{calculators.__name__}.{module.name}")
        for module in pkgutil.iter_modules(calculators.__path__)
    ]
    known = {name for module in modules for name in vars(module)}
    known |= {module.__name__.rpartition(".")[2] for module in modules}
    known |= {"feedback", "correct", "expected", "alpha_beta", "secondary_proc"}
    named = set(re.findall(r"`([a-z_]+)`", page))
    assert named <= known, named - known


def test_rules_are_as_tabled(rows):
    rules = [tuple(int(part) for part in rule.split("/")) for rule in rows["rule"]]
    for (hits, window), false in zip(
        rules, rows["false tracks per false plot, p_a = 0.1"], strict=True
    ):
        ours = false_initiation(hits, window, 0.1).handed_over
        assert ours == pytest.approx(float(false), abs=5.1e-5)
    for label, found in (
        ("scans from the first plot to confirmation, p_d = 0.9", 0.9),
        ("the same, p_d = 0.7", 0.7),
    ):
        for (hits, window), scans in zip(rules, rows[label], strict=True):
            assert confirmation_delay(found, hits, window) == pytest.approx(float(scans), abs=0.051)


def test_detections_of_manoeuvres_are_as_tabled(rows):
    for label, sigmas in (("1 (the book)", 1.0), ("2", 2.0), ("3", 3.0)):
        ours = manoeuvre_detection(4, sigmas, [0.0, 1.0, 2.0, 4.0])
        assert ours == pytest.approx([float(cell) for cell in rows[label]], abs=5.1e-3)


def test_numbers_in_the_text(page):
    gates = three_gates(0.5, 0.2, intensity=1.0, misses=2)
    assert "are {:.1f}, {:.1f} and {:.1f} σ_y half".format(*gates) in page
    assert f"right in {100 * nearest_in_metres(0.05, 10.0, 0.5):.0f} % of scans" in page
    for rule in ("book", "nearest", "assignment"):
        assert f"{resolved_distance(0.05, rule):.2f}" in page


@pytest.mark.parametrize("hits", range(1, 11))
def test_every_rule_up_to_ten_scans_fits(hits):
    assert len(rule_chain(hits, 10)) <= 256
