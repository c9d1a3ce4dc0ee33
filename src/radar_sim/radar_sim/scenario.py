# SPDX-License-Identifier: Apache-2.0
"""Scenarios: YAML files that name a radar, its targets and its traffic."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from radar_common.parameters import ParameterError
from radar_sim.bearings.scene import BEARING_KEYS, BearingScene, read_scene
from radar_sim.clutter.sections import CLUTTER
from radar_sim.disturbance import Disturbance, DisturbanceSection
from radar_sim.interference.sections import INTERFERENCE
from radar_sim.radar import Radar
from radar_sim.targets import Target, Targets, read_target
from radar_sim.traffic import TrafficGroup, read_group
from radar_sim.yaml_sections import read_entries, read_section

_DISTURBANCES: dict[str, dict[str, type[DisturbanceSection]]] = {
    "clutter": CLUTTER,
    "interference": INTERFERENCE,
}
_KEYS = {"title", "radar", "targets", "traffic", *_DISTURBANCES, *BEARING_KEYS}


class ScenarioError(ParameterError):
    """A scenario cannot be used; the text names the file, the key and the reason."""


@dataclass(frozen=True, slots=True)
class Scenario:
    """What is simulated.

    Attributes:
        radar: the radar.
        targets: those given one by one; they have the first ids.
        traffic: groups drawn from the seed.
        disturbances: clutter and interference.
        title: one line for people.
        bearings: what a bearing simulator makes; None where the scenario says nothing of it.
    """

    radar: Radar
    targets: tuple[Target, ...] = ()
    traffic: tuple[TrafficGroup, ...] = ()
    disturbances: tuple[DisturbanceSection, ...] = ()
    title: str = ""
    bearings: BearingScene | None = None

    def draw(self, rng: np.random.Generator) -> Targets:
        """Put together all targets, the traffic drawn at random.

        Args:
            rng: source of randomness.

        Returns:
            Targets in order of their ids.
        """
        streams = rng.spawn(len(self.targets))
        drawn = [target.drawn(own) for target, own in zip(self.targets, streams, strict=True)]
        for group in self.traffic:
            drawn += group.draw(self.radar, rng)
        return Targets(drawn)

    def disturb(self, seed: np.random.SeedSequence) -> list[Disturbance]:
        """Make the sources of clutter and interference.

        Args:
            seed: spawns a stream for each of them, so that none changes another.

        Returns:
            Sources in the order of the scenario.
        """
        streams = map(np.random.default_rng, seed.spawn(len(self.disturbances)))
        return [
            section.disturbance(self.radar, rng)
            for section, rng in zip(self.disturbances, streams, strict=True)
        ]


def scenario_names() -> list[str]:
    """List the scenarios that come with the package.

    Returns:
        Names, sorted.
    """
    folder = resources.files("radar_sim") / "scenarios"
    return sorted(
        entry.name.removesuffix(".yaml")
        for entry in folder.iterdir()
        if entry.name.endswith(".yaml")
    )


def load_scenario(name: str | Path) -> Scenario:
    """Read a scenario.

    Args:
        name: one of `scenario_names()`, or a path to a YAML file.

    Returns:
        The scenario, every value checked.

    Raises:
        ScenarioError: there is no such scenario, or it is impossible.
    """
    if str(name) in scenario_names():
        text = (resources.files("radar_sim") / "scenarios" / f"{name}.yaml").read_text("utf-8")
    else:
        try:
            text = Path(name).read_text("utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise ScenarioError(
                f"scenario {name}: neither one of {', '.join(scenario_names())} nor a readable file ({error})"
            ) from error
    return parse_scenario(text, source=str(name))


def parse_scenario(text: str, *, source: str = "text") -> Scenario:
    """Read a scenario from the text of its file.

    Args:
        text: YAML.
        source: name of the file for error messages.

    Returns:
        The scenario, every value checked.

    Raises:
        ScenarioError: it is not YAML, a key is unknown, or a value is impossible.
    """
    try:
        content = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise ScenarioError(f"scenario {source}: {error}") from error
    if not isinstance(content, dict):
        raise ScenarioError(f"scenario {source}: the top level must be keys and values")
    try:
        unknown = sorted(str(key) for key in content if key not in _KEYS)
        if unknown:
            raise ParameterError(f"unknown key {', '.join(unknown)}")
        targets = [read_target(entry, where) for where, entry in read_entries(content, "targets")]
        traffic = [read_group(entry, where) for where, entry in read_entries(content, "traffic")]
        radar = read_section(Radar, content.get("radar"), "radar")
        disturbances = [
            section for key in _DISTURBANCES for section in _disturbances(content, key, radar)
        ]
        return Scenario(
            radar=radar,
            targets=tuple(targets),
            traffic=tuple(traffic),
            disturbances=tuple(disturbances),
            title=str(content.get("title", "")),
            bearings=read_scene(
                content, len(targets) + sum(group.section.number for group in traffic)
            ),
        )
    except ParameterError as error:
        raise ScenarioError(f"scenario {source}: {error}") from error


def _disturbances(content: Mapping[str, Any], key: str, radar: Radar) -> list[DisturbanceSection]:
    kinds = content.get(key)
    if kinds is None:
        return []
    if not isinstance(kinds, dict):
        raise ParameterError(f"{key}: must be keys and values")
    unknown = sorted(str(kind) for kind in kinds if kind not in _DISTURBANCES[key])
    if unknown:
        raise ParameterError(f"{key}: unknown key {', '.join(unknown)}")
    sections = []
    for kind, cls in _DISTURBANCES[key].items():
        for where, entry in read_entries(kinds, kind, f"{key}."):
            section = read_section(cls, entry, where)
            try:
                section.require_fit(radar)
            except ParameterError as error:
                raise ParameterError(f"{where}: {error}") from error
            sections.append(section)
    return sections
