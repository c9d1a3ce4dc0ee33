# SPDX-License-Identifier: Apache-2.0
"""What a scenario says about one target, and what a simulation needs to know of all of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from radar_common.parameters import parameter
from radar_sim.fluctuation import FLUCTUATIONS
from radar_sim.motion import Fleet, Path
from radar_sim.motion.correlated import WanderSection
from radar_sim.motion.model import MotionModel
from radar_sim.motion.sections import draw_paths
from radar_sim.moving import MovingSection, read_legs, read_motion, read_path
from radar_sim.yaml_sections import read_keys, read_section


@dataclass(frozen=True, kw_only=True)
class TargetSection(MovingSection):
    """One entry of a scenario's `targets`."""

    snr_db: float = parameter(
        15.0,
        "mean power signal-to-noise ratio at the radar's reference_range",
        unit="dB",
        low=-60.0,
        high=80.0,
    )
    fluctuation: str = parameter(
        "slow",
        "of the echo: none, slow (Swerling 1), fast (2), slow-dominant (3), fast-dominant (4)",
        choices=tuple(FLUCTUATIONS),
    )


@dataclass(frozen=True, slots=True)
class Target:
    """One target.

    Attributes:
        path: its motion.
        snr_db: mean power ratio of one pulse at the radar's reference range, dB.
        fluctuation: name of the model of its echo.
        motion: draws the path's motion; None where its legs are all.
        wander: about the path; None for none.
    """

    path: Path
    snr_db: float
    fluctuation: str
    motion: MotionModel | None = None
    wander: WanderSection | None = None

    def drawn(self, rng: np.random.Generator) -> Target:
        """Let it move at random.

        Args:
            rng: source of randomness of this target alone.

        Returns:
            The same target with its path drawn.
        """
        (path,) = draw_paths([self.path], self.motion, self.wander, rng)
        return replace(self, path=path)


def read_target(entry: Any, where: str) -> Target:
    """Read one entry of `targets`.

    Args:
        entry: keys and values.
        where: it stands.

    Returns:
        The target, its random motion not yet drawn.

    Raises:
        ParameterError: a key is unknown or a value impossible.
    """
    keys = read_keys(entry, where)
    motion, wander = read_motion(keys, where)
    legs = read_legs(keys, where)
    section = read_section(TargetSection, keys, where)
    return Target(
        read_path(section, legs, motion, where), section.snr_db, section.fluctuation, motion, wander
    )


class Targets:
    """All targets of a simulation as arrays; the index of a target plus one is its id.

    Attributes:
        paths: of each.
        fleet: the motion of all.
        snr_db: at the reference range.
        fluctuation: names of models.
    """

    def __init__(self, targets: Sequence[Target]) -> None:
        """Collect them.

        Args:
            targets: in order of their ids.
        """
        self.paths = tuple(target.path for target in targets)
        self.fleet = Fleet(self.paths)
        self.snr_db: npt.NDArray[np.float64] = np.array([t.snr_db for t in targets], dtype=float)
        self.fluctuation: npt.NDArray[np.str_] = np.array(
            [target.fluctuation for target in targets], dtype=str
        )

    def __len__(self) -> int:
        """Count them."""
        return len(self.fleet)
