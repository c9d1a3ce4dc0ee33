# SPDX-License-Identifier: Apache-2.0
"""The pages of the simulator say what the code does."""

from __future__ import annotations

import re

import pytest

from radar_common.parameters import to_markdown
from radar_sim.clutter.sections import CLUTTER
from radar_sim.interference.sections import INTERFERENCE
from radar_sim.moving import LegSection
from radar_sim.radar import Radar
from radar_sim.scenario import parse_scenario, scenario_names
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


@pytest.mark.parametrize("section", SECTIONS)
def test_the_tables_of_keys_are_current(page, section):
    assert to_markdown(section) in page


def test_the_examples_are_scenarios(page):
    targets, disturbances = map(parse_scenario, re.findall(r"```yaml\n(.*?)```", page, re.DOTALL))
    assert len(targets.targets) == 2
    assert len(targets.targets[1].path.legs) == 2
    assert len(disturbances.disturbances) == 6


def test_every_scenario_of_the_package_is_listed(repository):
    page = (repository / "docs" / "radar_sim.md").read_text("utf-8")
    for name in scenario_names():
        assert f"| `{name}` |" in page
