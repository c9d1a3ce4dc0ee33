# SPDX-License-Identifier: Apache-2.0
"""The page of the simulator says what the code does."""

from __future__ import annotations

import re

import pytest

from radar_common.parameters import to_markdown
from radar_sim.radar import Radar
from radar_sim.scenario import parse_scenario
from radar_sim.targets import LegSection, TargetSection
from radar_sim.traffic import TrafficSection


@pytest.fixture
def page(repository):
    return (repository / "docs" / "radar_sim.md").read_text("utf-8")


@pytest.mark.parametrize("section", [Radar, TargetSection, LegSection, TrafficSection])
def test_the_tables_of_keys_are_current(page, section):
    assert to_markdown(section) in page


def test_the_example_is_a_scenario(page):
    (example,) = re.findall(r"```yaml\n(.*?)```", page, re.DOTALL)
    scenario = parse_scenario(example)
    assert len(scenario.targets) == 2
    assert len(scenario.targets[1].path.legs) == 2
