# SPDX-License-Identifier: Apache-2.0
"""The kinds of clutter by their key in a scenario."""

from __future__ import annotations

from radar_sim.clutter.patch import PatchSection
from radar_sim.clutter.points import PointsSection
from radar_sim.clutter.rain import RainSection
from radar_sim.disturbance import DisturbanceSection

CLUTTER: dict[str, type[DisturbanceSection]] = {
    "patches": PatchSection,
    "rain": RainSection,
    "points": PointsSection,
}
"""Each is a list below `clutter`."""
