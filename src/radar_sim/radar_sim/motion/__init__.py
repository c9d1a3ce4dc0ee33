# SPDX-License-Identifier: Apache-2.0
"""How targets move: legs and random motion, all in closed form between the times at which something changes."""

from radar_sim.motion.fleet import Fleet
from radar_sim.motion.legs import Leg, Path, State
from radar_sim.motion.turns import displacement

__all__ = ["Fleet", "Leg", "Path", "State", "displacement"]
