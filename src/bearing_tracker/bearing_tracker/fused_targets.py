# SPDX-License-Identifier: Apache-2.0
"""The targets of the fusion: what is believed of each, and which identities of the sensors are its own."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bearing_tracker.bearing_association import Directions
from bearing_tracker.fusion import Belief, Motion, Output, Reading, join
from bearing_tracker.fusion_model import FusionModel
from radar_common.frames import wrap_pi, wrap_two_pi
from radar_common.tables import BEARING, CHANNEL_STATES, BearingChannel

if TYPE_CHECKING:
    from bearing_tracker.fusion_parameters import FusionParameters

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
IndexArray = npt.NDArray[np.intp]
IdArray = npt.NDArray[np.int64]
Rows = npt.NDArray[np.void]

TARGET = np.dtype(
    [
        ("id", "<i8"),
        ("time", "<f8"),  # of the belief, that is of the last bearing, s
        ("heard", "<f8", (2,)),  # last bearing of the active and of the passive channel, s
        ("partner", "<i8", (2,)),  # identity in the active and in the passive channel, 0 for none
        ("misfits", "<i8", (2,)),  # of that channel in a row on one side, negative to the left
        ("range", "<f8"),  # m; NaN while the radar has never seen it
        ("ranged", "<f8"),  # when that was, s
        ("closing_speed", "<f8"),  # m/s at that time; NaN while not known
        ("axis", "<f8"),  # direction that it has kept to in the mean, rad in [-pi, pi)
        ("bearings", "<i8"),  # that the mean is of
        ("hits", "<i8"),
        ("confirmed", "?"),
        ("mean", "<f8", (2,)),  # azimuth in [-pi, pi) and its rate, rad and rad/s
        ("covariance", "<f8", (2, 2)),
        ("health", "<f8", (2, CHANNEL_STATES)),  # probability of each state of either channel
        ("twin", "<i8"),  # id of the target that looks like the same, 0 for none
        ("agreed", "<i8"),  # times in a row that it did
    ]
)


class FusedTargets:
    """All targets, and what can be done with many of them at once."""

    def __init__(self, parameters: FusionParameters) -> None:
        """Start without targets.

        Args:
            parameters: of the fusion.
        """
        self.columns = np.zeros(0, TARGET)
        self.reconfigure(parameters)
        self._belief: Belief = self.model.start(np.zeros(0), np.zeros(0))

    def __len__(self) -> int:
        """Number of targets."""
        return len(self.columns)

    def reconfigure(self, parameters: FusionParameters) -> None:
        """Go on with other parameters and the same targets.

        Args:
            parameters: of the fusion from now on.
        """
        self._parameters = parameters
        self.model = FusionModel(parameters)

    def expected(self, which: IndexArray, time: float) -> tuple[Directions, FloatArray]:
        """Tell where targets are expected.

        Args:
            which: indices, shape (n,).
            time: seconds.

        Returns:
            (directions, jammed): azimuths with their deviations, without the error of a bearing; probability that the
            active channel is jammed for the target, shape (n,).
        """
        part = self.columns[which]
        seconds = np.maximum(time - part["time"], 0.0)
        mean, covariance, _ = self._predicted(part, seconds)
        clear = self.model.active_clear(part["health"][:, BearingChannel.ACTIVE, 0], seconds)
        return Directions(wrap_two_pi(mean[:, 0]), np.sqrt(covariance[:, 0, 0])), 1.0 - clear

    def open(self, sightings: Rows, ids: IdArray) -> IndexArray:
        """Begin targets.

        Args:
            sightings: dtype SIGHTING, the first of each, all of one channel, shape (n,).
            ids: theirs, shape (n,).

        Returns:
            Their indices.
        """
        before, channel = len(self), sightings["channel"][0]
        columns = np.zeros(len(sightings), TARGET)
        columns["id"], columns["hits"], columns["bearings"] = ids, 1, 1
        columns["range"], columns["closing_speed"] = sightings["range"], sightings["closing_speed"]
        columns["heard"] = -np.inf
        columns["time"] = columns["heard"][:, channel] = columns["ranged"] = sightings["time"]
        columns["axis"] = wrap_pi(sightings["azimuth"])
        columns["partner"][:, channel] = sightings["id"]
        started = self.model.start(wrap_pi(sightings["azimuth"]), sightings["azimuth_std"])
        self._belief = join([self._belief, started]) if before else started
        self.columns = np.concatenate([self.columns, columns])
        which = np.arange(before, len(self))
        self._remember(which, started)
        return which

    def update(self, which: IndexArray, sightings: Rows) -> None:
        """Give targets a bearing of one channel each.

        A bearing outside the gate is taken in as well: if its identity says that it is the target's, only the filter
        can tell a disturbed channel from a manoeuvre.

        Args:
            which: indices, each once, shape (n,).
            sightings: theirs, dtype SIGHTING, all of one channel, shape (n,).
        """
        part, channel = self.columns[which], int(sightings["channel"][0])
        seconds = np.maximum(sightings["time"] - part["time"], 0.0)
        ranged = ~np.isnan(sightings["range"])
        part["range"][ranged] = sightings["range"][ranged]
        part["ranged"][ranged] = (part["time"] + seconds)[ranged]
        timed = ~np.isnan(sightings["closing_speed"])
        part["closing_speed"][timed] = sightings["closing_speed"][timed]
        mean, covariance, motion = self._predicted(part, seconds)
        # Within a look a bearing may be older than the target's last; the rate carries it over.
        late = part["time"] + seconds - sightings["time"]
        azimuth = sightings["azimuth"] + mean[:, 1] * late
        variance = sightings["azimuth_std"] ** 2
        reading = Reading(azimuth[:, None], variance[:, None, None], np.ones(len(which), bool))
        readings = (reading, None) if channel == BearingChannel.ACTIVE else (None, reading)
        updated = self.model.filter.step(self._belief.take(which), motion, *readings)
        self._belief = self._belief.put(which, updated)
        innovation = wrap_pi(azimuth - mean[:, 0])
        gate = self._parameters.gate_sigmas * np.sqrt(covariance[:, 0, 0] + variance)
        # Noise falls to both sides; a bearing that belongs to something else stays on one.
        side = np.where(np.abs(innovation) > gate, np.sign(innovation), 0.0).astype(np.int64)
        before = part["misfits"][:, channel]
        part["misfits"][:, channel] = np.where(before * side > 0, before + side, side)
        part["hits"] = np.maximum(part["hits"] + np.where(side == 0, 1, -1), 0)
        part["time"] += seconds
        part["heard"][:, channel] = part["time"]
        self.columns[which] = part
        self._remember(which, updated)
        self._average(which, seconds)

    def rows(self, which: IndexArray) -> Rows:
        """Write targets as rows of the table.

        Args:
            which: indices, shape (n,).

        Returns:
            dtype BEARING, shape (n,); `time_offset` still holds the pipeline's time.
        """
        part = self.columns[which]
        rows = np.zeros(len(which), BEARING)
        rows["azimuth"], rows["rate"] = wrap_two_pi(part["mean"][:, 0]), part["mean"][:, 1]
        rows["azimuth_std"] = np.sqrt(part["covariance"][:, 0, 0])
        rows["rate_std"] = np.sqrt(part["covariance"][:, 1, 1])
        rows["elevation"] = rows["elevation_std"] = np.nan
        rows["time_offset"] = part["time"]
        rows["id"], rows["channel"] = part["id"], BearingChannel.FUSED
        rows["active_health"] = part["health"][:, BearingChannel.ACTIVE]
        rows["passive_health"] = part["health"][:, BearingChannel.PASSIVE]
        return rows

    def disturbed(self, channel: int) -> float:
        """Probability that a channel is disturbed, as a mean over the published targets that it reports of.

        Args:
            channel: BearingChannel.

        Returns:
            0 to 1; NaN without such targets.
        """
        columns = self.columns
        silence = columns["time"] - columns["heard"][:, channel]
        reported = columns["confirmed"] & (silence <= self._parameters.end_after)
        if not reported.any():
            return np.nan
        return float(1.0 - columns["health"][reported, channel, 0].mean())

    def of_identities(self, ids: IdArray, channel: int) -> IndexArray:
        """Find the targets that identities of a sensor belong to.

        Args:
            ids: shape (n,); 0 belongs to none.
            channel: BearingChannel.

        Returns:
            Indices, -1 where there is none, shape (n,).
        """
        partner = self.columns["partner"][:, channel]
        order = np.argsort(partner, kind="stable")
        place = np.searchsorted(partner[order], ids)
        found = np.full(len(ids), -1)
        possible = (place < len(partner)) & (ids != 0)
        candidate = order[place[possible]]
        found[possible] = np.where(partner[candidate] == ids[possible], candidate, -1)
        return found

    def remove(self, gone: BoolArray) -> None:
        """Forget targets.

        Args:
            gone: which, shape (len(self),).
        """
        self.columns = self.columns[~gone]
        self._belief = self._belief.take(~gone)

    def _predicted(self, part: Rows, seconds: FloatArray) -> tuple[FloatArray, FloatArray, Motion]:
        # The motion is the same under every hypothesis, so the moments of their mixture move like one state.
        motion = self.model.motion(seconds, part)
        turned = np.swapaxes(motion.transition, 1, 2)
        apart = part["mean"]
        if motion.axis is not None:
            apart = apart - motion.axis
            apart[:, 0] = wrap_pi(apart[:, 0])
        mean = (motion.transition @ apart[..., None])[..., 0]
        if motion.axis is not None:
            mean += motion.axis
        return mean, motion.transition @ part["covariance"] @ turned + motion.noise, motion

    def _average(self, which: IndexArray, seconds: FloatArray) -> None:
        # A mean of all bearings at first, then one that forgets.
        part = self.columns[which]
        part["bearings"] += 1
        share = np.maximum(1.0 / part["bearings"], seconds / self._parameters.axis_time)
        part["axis"] += np.minimum(share, 1.0) * wrap_pi(part["mean"][:, 0] - part["axis"])
        part["axis"] = wrap_pi(part["axis"])
        self.columns[which] = part

    def _remember(self, which: IndexArray, belief: Belief) -> None:
        output: Output = "map" if self._parameters.output == "map" else "mmse"
        estimate = self.model.filter.estimate(belief, output)
        part = self.columns[which]
        part["mean"], part["covariance"], part["health"] = (
            estimate.mean,
            estimate.covariance,
            np.nan,
        )
        for channel, told in enumerate((estimate.active, estimate.passive)):
            part["health"][:, channel, : told.shape[1]] = told
        tracked = part["partner"][:, BearingChannel.ACTIVE] != 0
        part["confirmed"] |= tracked | (part["hits"] >= self._parameters.confirm_hits)
        self.columns[which] = part
