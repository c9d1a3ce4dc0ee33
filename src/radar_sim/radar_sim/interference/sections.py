# SPDX-License-Identifier: Apache-2.0
"""The kinds of interference by their key in a scenario."""

from __future__ import annotations

from radar_sim.disturbance import DisturbanceSection
from radar_sim.interference.jammer import JammerSection
from radar_sim.interference.other_radar import OtherRadarSection

INTERFERENCE: dict[str, type[DisturbanceSection]] = {
    "radars": OtherRadarSection,
    "jammers": JammerSection,
}
"""Each is a list below `interference`."""
