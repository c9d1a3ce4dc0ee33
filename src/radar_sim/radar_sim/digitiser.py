# SPDX-License-Identifier: Apache-2.0
"""The digitiser: the power of each range cell becomes a sample of linear or logarithmic video."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from radar_sim.radar import Radar

_LARGEST = {"float32": math.inf, "uint8": 255.0, "uint16": 65535.0}
SAMPLES = tuple(_LARGEST)
VIDEO_LAWS = ("linear", "logarithmic")

_DB_PER_NEPER = 10.0 / math.log(10.0)


class Digitiser:
    """Turns power into samples.

    Linear video is the envelope: of float video in the units of `noise_level`, of integers so that the largest code
    is `full_scale` times `noise_level`. Logarithmic video counts steps of `db_per_count` from `log_floor_db` on the
    noise level; zero is that and everything below. Integers are rounded and saturate.
    """

    def __init__(self, radar: Radar, sample: str, law: str) -> None:
        """Set the scale.

        Args:
            radar: noise level, gain, full scale, and the steps of logarithmic video.
            sample: type of a video sample, one of SAMPLES.
            law: one of VIDEO_LAWS.
        """
        self._largest = _LARGEST[sample]
        self._logarithmic = law == "logarithmic"
        self._steps_per_neper = np.float32(_DB_PER_NEPER / radar.db_per_count)
        if self._logarithmic:
            unit = 10.0 ** (-radar.log_floor_db / 20.0)
        elif math.isinf(self._largest):
            unit = radar.noise_level
        else:
            unit = self._largest / radar.full_scale
        # The squared envelope is 2 sigma² e, where e is exponential with mean one in noise.
        self._level = (2.0 * np.square(unit * radar.gain())).astype(np.float32)

    def digitise(self, power: npt.NDArray[np.float32], video: npt.NDArray[np.generic]) -> None:
        """Fill the video.

        Args:
            power: over the mean power of the receiver's noise, shape (pulses, cells); used up.
            video: samples to write, same shape.
        """
        power *= self._level
        if self._logarithmic:
            np.maximum(power, np.float32(1.0), out=power)
            np.log(power, out=power)
            power *= self._steps_per_neper
        else:
            np.sqrt(power, out=power)
        if not math.isinf(self._largest):
            power += np.float32(0.5)
            np.minimum(power, np.float32(self._largest), out=power)
        np.copyto(video, power, casting="unsafe")
