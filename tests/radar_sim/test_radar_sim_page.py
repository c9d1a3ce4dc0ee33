# SPDX-License-Identifier: Apache-2.0
"""The pages of the simulator say what the code does."""

from __future__ import annotations

import re

import pytest

from radar_common.parameters import to_markdown
from radar_sim.bearings.sections import (
    ActiveChannelSection,
    BearingProcessSection,
    DirectionFinderSection,
    EmitterSection,
    IntervalSection,
    PassiveChannelSection,
)
from radar_sim.clutter.sections import CLUTTER
from radar_sim.interference.sections import INTERFERENCE
from radar_sim.moving import LegSection
from radar_sim.radar import Radar
from radar_sim.scenario import load_scenario, parse_scenario, scenario_names
from radar_sim.targets import TargetSection
from radar_sim.traffic import TrafficSection

SECTIONS = [
    Radar,
    TargetSection,
    LegSection,
    TrafficSection,
    *CLUTTER.values(),
    *INTERFERENCE.values(),
]


@pytest.fixture
def page(repository):
    return (repository / "docs" / "scenarios.md").read_text("utf-8")


@pytest.fixture
def bearing_page(repository):
    return (repository / "docs" / "bearing_simulator.md").read_text("utf-8")


@pytest.mark.parametrize("section", SECTIONS)
def test_the_tables_of_keys_are_current(page, section):
    assert to_markdown(section) in page


@pytest.mark.parametrize(
    "section",
    [
        DirectionFinderSection,
        EmitterSection,
        BearingProcessSection,
        ActiveChannelSection,
        PassiveChannelSection,
        IntervalSection,
    ],
)
def test_the_tables_of_bearings_are_current(bearing_page, section):
    assert to_markdown(section) in bearing_page


def test_the_example_of_bearings_is_a_scenario(bearing_page):
    (example,) = re.findall(r"```yaml\n(.*?)```", bearing_page, re.DOTALL)
    scene = parse_scenario(example).bearings
    assert len(scene.emitters) == 2
    assert len(scene.platform.path.legs) == 40


def test_every_scenario_of_bearings_is_listed(bearing_page):
    for name in scenario_names():
        if load_scenario(name).bearings is not None:
            assert f"| `{name}` |" in bearing_page


def test_the_examples_are_scenarios(page):
    targets, disturbances = map(parse_scenario, re.findall(r"```yaml\n(.*?)```", page, re.DOTALL))
    assert len(targets.targets) == 2
    assert len(targets.targets[1].path.legs) == 2
    assert len(disturbances.disturbances) == 6


def test_every_scenario_of_the_package_is_listed(repository):
    page = (repository / "docs" / "radar_sim.md").read_text("utf-8")
    for name in scenario_names():
        assert f"| `{name}` |" in page
