# SPDX-License-Identifier: Apache-2.0
"""The emitters that are followed: what is believed of each, which identity it has, how long it lives."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bearing_tracker.bearing_association import Directions
from bearing_tracker.emitters.filters import FILTERS
from bearing_tracker.emitters.interface import Belief, Estimate, Prior
from bearing_tracker.sightings import SIGHTING
from radar_common.frames import wrap_pi
from radar_common.tables import EMITTER, TrackStatus

if TYPE_CHECKING:
    from bearing_tracker.locator_parameters import LocatorParameters

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
IndexArray = npt.NDArray[np.intp]
IdArray = npt.NDArray[np.int64]
Rows = npt.NDArray[np.void]

PLACED = np.dtype(
    [
        *((name, SIGHTING[name]) for name in SIGHTING.fields or ()),
        ("position", "<f8", (3,)),  # of the platform, m east, north, up
        ("variance", "<f8"),  # of east and of north, m^2
    ]
)
"""A sighting with the place that it was taken from."""

_RECORD = np.dtype(
    [
        ("id", "<i8"),
        ("source", "<i8"),  # identity of the sensor, 0 for none
        ("time", "<f8"),  # of the belief, s
        ("seen", "<f8"),  # last bearing that fitted, s
        ("first", "<f8"),  # first bearing, s
        ("hits", "<i8"),
        ("rejected", "<i8"),
        ("misfits", "<i8"),  # rejected in a row
        ("confirmed", "?"),
        ("height", "<f8"),  # m, from elevations
        ("height_weight", "<f8"),  # 1/m^2
    ]
)


class LocatedEmitters:
    """All emitters, and what can be done with many of them at once."""

    def __init__(self, parameters: LocatorParameters) -> None:
        """Start without emitters.

        Args:
            parameters: of the locator.
        """
        self.parameters = parameters
        self.columns = np.zeros(0, _RECORD)
        self._filter = FILTERS[parameters.filter](parameters.filter_settings)
        self._belief = self._filter.start(
            np.zeros(0), np.zeros(0), np.zeros((0, 2)), self._prior(0)
        )

    def __len__(self) -> int:
        """Number of emitters."""
        return len(self.columns)

    def expected(self, which: IndexArray, time: float, observer: FloatArray) -> Directions:
        """Tell where emitters would be heard.

        Args:
            which: indices, shape (n,).
            time: seconds.
            observer: place of the platform, metres east and north, shape (2,).

        Returns:
            Azimuths, and deviations without the error of a bearing.
        """
        seconds = np.maximum(time - self.columns["time"][which], 0.0)
        places = np.broadcast_to(observer, (len(which), 2))
        predicted = self._filter.predict(self._belief.take(which), seconds, places)
        expected = self._filter.expected(predicted)
        return Directions(expected.azimuth, expected.azimuth_std)

    def open(self, sightings: Rows, ids: IdArray) -> IndexArray:
        """Begin emitters.

        Args:
            sightings: dtype PLACED, the first of each, shape (n,).
            ids: theirs, shape (n,).

        Returns:
            Their indices.
        """
        before, count = len(self), len(sightings)
        record = np.zeros(count, _RECORD)
        record["id"], record["source"], record["hits"] = ids, sightings["id"], 1
        record["time"] = record["seen"] = record["first"] = sightings["time"]
        record["confirmed"] = self.parameters.confirm_hits <= 1
        self._belief = self._belief.joined(self._started(sightings))
        self.columns = np.concatenate([self.columns, record])
        return np.arange(before, before + count)

    def update(self, which: IndexArray, sightings: Rows) -> tuple[int, int]:
        """Give emitters a bearing each; what does not fit is rejected, and too many in a row begin anew.

        Args:
            which: indices, each once, shape (n,).
            sightings: theirs, dtype PLACED, shape (n,).

        Returns:
            (rejected, begun anew): numbers of emitters.
        """
        part = self.columns[which]
        observer, azimuth = sightings["position"][:, :2], sightings["azimuth"]
        seconds = np.maximum(sightings["time"] - part["time"], 0.0)
        predicted = self._filter.predict(self._belief.take(which), seconds, observer)
        expected = self._filter.expected(predicted)
        std = sightings["azimuth_std"]
        if sightings["variance"].any():
            std = self._deviation(sightings, self._filter.estimate(predicted).range)
        gate = self.parameters.gate_sigmas * np.hypot(expected.azimuth_std, std)
        fits = np.abs(wrap_pi(azimuth - expected.azimuth)) <= gate
        part["misfits"] = np.where(fits, 0, part["misfits"] + 1)
        part["hits"] += fits
        part["rejected"] += ~fits
        part["time"] += seconds
        part["seen"][fits] = part["time"][fits]
        anew = part["misfits"] >= self.parameters.restart_after
        part["misfits"][anew] = 0
        part["seen"][anew] = part["time"][anew]
        part["confirmed"] |= part["hits"] >= self.parameters.confirm_hits
        self.columns[which] = part
        now = np.zeros(len(which))
        updated = self._filter.step(predicted, now, observer, azimuth, std, fits)
        self._belief = self._belief.put(which, updated)
        if anew.any():
            self._belief = self._belief.put(which[anew], self._started(sightings[anew]))
        self._weigh_heights(which[fits], sightings[fits])
        return int(np.count_nonzero(~fits)), int(np.count_nonzero(anew))

    def estimate(self, which: IndexArray) -> Estimate:
        """Tell where emitters are.

        Args:
            which: indices, shape (n,).

        Returns:
            The filter's answer, at the time of each.
        """
        return self._filter.estimate(self._belief.take(which))

    def rows(self, which: IndexArray, ended: bool = False) -> Rows:
        """Write emitters as rows of the table.

        Args:
            which: indices, shape (n,).
            ended: whether these rows are their last.

        Returns:
            dtype EMITTER, shape (n,); `time_offset` still holds the pipeline's time.
        """
        rows = np.zeros(len(which), EMITTER)
        estimate, record = self.estimate(which), self.columns[which]
        rows["x"], rows["y"], rows["vx"], rows["vy"] = estimate.state.T
        rows["z"] = record["height"]
        rows["covariance"] = estimate.covariance.reshape(-1, 16)
        rows["id"], rows["time_offset"] = record["id"], record["time"]
        alive = np.where(record["confirmed"], TrackStatus.CONFIRMED, TrackStatus.TENTATIVE)
        rows["status"] = TrackStatus.ENDED if ended else alive
        for name in ("range_known", "azimuth", "azimuth_std", "range", "range_std", "bound_std"):
            rows[name] = getattr(estimate, name)
        for name in ("hits", "rejected"):
            rows[name] = record[name]
        rows["age"] = record["time"] - record["first"]
        return rows

    def of_identities(self, ids: IdArray) -> IndexArray:
        """Find the emitters that have identities of the sensor.

        Args:
            ids: shape (n,); 0 is none.

        Returns:
            Indices, -1 where there is none, shape (n,).
        """
        if not len(self):
            return np.full(len(ids), -1)
        order = np.argsort(self.columns["source"], kind="stable")
        known = self.columns["source"][order]
        place = np.minimum(np.searchsorted(known, ids), len(known) - 1)
        return np.where((known[place] == ids) & (ids != 0), order[place], -1)

    def remove(self, gone: BoolArray) -> None:
        """Forget emitters.

        Args:
            gone: which, shape (len(self),).
        """
        self.columns = self.columns[~gone]
        self._belief = self._belief.take(~gone)

    def _started(self, sightings: Rows) -> Belief:
        limits = self.parameters
        middle = np.full(len(sightings), np.sqrt(limits.minimum_range * limits.maximum_range))
        return self._filter.start(
            sightings["azimuth"],
            self._deviation(sightings, middle),
            sightings["position"][:, :2],
            self._prior(len(sightings)),
        )

    def _prior(self, emitters: int) -> Prior:
        limits = self.parameters
        return Prior.between(
            limits.minimum_range,
            limits.maximum_range,
            speed_std=limits.speed_std,
            emitters=emitters,
        )

    def _deviation(self, sightings: Rows, distance: FloatArray) -> FloatArray:
        # Not to know where the platform is turns the bearing as seen from where it is thought to be.
        distance = np.maximum(distance, self.parameters.minimum_range)
        return np.hypot(sightings["azimuth_std"], np.sqrt(sightings["variance"]) / distance)

    def _weigh_heights(self, which: IndexArray, sightings: Rows) -> None:
        elevated = ~np.isnan(sightings["elevation"])
        which, sightings = which[elevated], sightings[elevated]
        if not len(which):
            return
        estimate = self.estimate(which)
        elevation, known = sightings["elevation"], estimate.range_known
        height = sightings["position"][:, 2] + estimate.range * np.tan(elevation)
        spread = estimate.range * sightings["elevation_std"] / np.cos(elevation) ** 2
        weight = known / np.maximum(spread, 1.0) ** 2
        part = self.columns[which]
        total = np.maximum(part["height_weight"] + weight, np.finfo(float).tiny)
        part["height"] += weight / total * (height - part["height"])
        part["height_weight"] += weight
        self.columns[which] = part
