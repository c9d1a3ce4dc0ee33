# SPDX-License-Identifier: Apache-2.0
"""What a scenario says of bearings, read from its file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from radar_common.parameters import ParameterError
from radar_sim.bearings.sections import (
    ActiveChannelSection,
    BearingProcessSection,
    DirectionFinderSection,
    EmitterSection,
    IntervalSection,
    PassiveChannelSection,
)
from radar_sim.motion import Path
from radar_sim.motion.correlated import WanderSection
from radar_sim.motion.model import MotionModel
from radar_sim.moving import read_legs, read_motion, read_path
from radar_sim.yaml_sections import read_entries, read_keys, read_section

BEARING_KEYS = ("direction_finder", "emitters", "bearing_processes", "channels")


@dataclass(frozen=True, slots=True)
class Emitter:
    """Something that transmits.

    Attributes:
        section: when, and on which target.
        path: its way, where it is on no target.
        motion: draws the path's motion; None where its legs are all.
        wander: about the path; None for none.
    """

    section: EmitterSection
    path: Path
    motion: MotionModel | None = None
    wander: WanderSection | None = None


@dataclass(frozen=True, slots=True)
class Platform:
    """The direction finder with its way.

    Attributes:
        section: how it hears.
        path: where it is.
    """

    section: DirectionFinderSection
    path: Path


@dataclass(frozen=True, slots=True)
class BearingScene:
    """All that a scenario says of bearings.

    Attributes:
        platform: with the direction finder; None where only the active channel is simulated.
        emitters: those that are given.
        processes: bearings without a place.
        active: the active channel; None for none.
        jams: times in which it is jammed, beside its chain.
        passive: silence of the direction finder.
        silences: times in which its sources are silent, beside its chain.
    """

    platform: Platform | None
    emitters: tuple[Emitter, ...] = ()
    processes: tuple[BearingProcessSection, ...] = ()
    active: ActiveChannelSection | None = None
    jams: tuple[IntervalSection, ...] = ()
    passive: PassiveChannelSection = field(default_factory=PassiveChannelSection)
    silences: tuple[IntervalSection, ...] = ()


def read_scene(content: Mapping[str, Any], targets: int) -> BearingScene | None:
    """Read what a scenario says of bearings.

    Args:
        content: its keys and values.
        targets: number of its targets, traffic included.

    Returns:
        The scene; None where it says nothing of them.

    Raises:
        ParameterError: a key is unknown or a value impossible.
    """
    if not any(key in content for key in BEARING_KEYS):
        return None
    emitters = [_emitter(entry, where) for where, entry in read_entries(content, "emitters")]
    for number, emitter in enumerate(emitters):
        if emitter.section.target > targets:
            raise ParameterError(
                f"emitters[{number}]: there is no target {emitter.section.target} among {targets}"
            )
    processes = [
        read_section(BearingProcessSection, entry, where)
        for where, entry in read_entries(content, "bearing_processes")
    ]
    channels = read_keys(content.get("channels"), "channels")
    unknown = sorted(str(key) for key in channels if key not in ("active", "passive"))
    if unknown:
        raise ParameterError(f"channels: unknown key {', '.join(unknown)}")
    jams, active = _channel(ActiveChannelSection, channels, "active")
    silences, passive = _channel(PassiveChannelSection, channels, "passive")
    if "direction_finder" not in content and "active" not in channels:
        raise ParameterError("bearings need a direction_finder or channels.active")
    return BearingScene(
        _platform(content["direction_finder"]) if "direction_finder" in content else None,
        tuple(emitters),
        tuple(processes),
        active if "active" in channels else None,
        jams,
        passive,
        silences,
    )


def _emitter(entry: Any, where: str) -> Emitter:
    keys = read_keys(entry, where)
    motion, wander = read_motion(keys, where)
    legs = read_legs(keys, where)
    section = read_section(EmitterSection, keys, where)
    if section.target and (legs or motion is not None or wander is not None):
        raise ParameterError(f"{where}: legs, motion and wander are those of its target")
    return Emitter(section, read_path(section, legs, motion, where), motion, wander)


def _platform(entry: Any) -> Platform:
    where = "direction_finder"
    keys = read_keys(entry, where)
    legs = read_legs(keys, where)
    section = read_section(DirectionFinderSection, keys, where)
    return Platform(section, read_path(section, legs * section.cycles, None, where))


def _channel(
    cls: type[Any], channels: dict[Any, Any], key: str
) -> tuple[tuple[IntervalSection, ...], Any]:
    where = f"channels.{key}"
    keys = read_keys(channels.get(key), where)
    intervals = tuple(
        read_section(IntervalSection, entry, at)
        for at, entry in read_entries(keys, "intervals", f"{where}.")
    )
    keys.pop("intervals", None)
    return intervals, read_section(cls, keys, where)
