# SPDX-License-Identifier: Apache-2.0
"""The whole of primary processing: sweeps in, plots out."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from primary_proc.detectors.burst_detector import joined
from primary_proc.extraction_chain import ExtractionChain
from primary_proc.parameters import ExtractorParameters
from primary_proc.stream.sweep_stream import Pulses, SweepStream
from primary_proc.stream.video_law import expansion
from radar_common.cloud import TableError
from radar_common.health import Health
from radar_common.tables import NANOSECONDS, PLOT, RADAR_FRAME, Table

_NO_PLOTS = np.zeros(0, PLOT)


class PlotExtractor:
    """Turns sectors of sweeps into plots, one table for each sector; see docs/primary_proc.md."""

    def __init__(self, parameters: ExtractorParameters, health: Health | None = None) -> None:
        """Start with no radar known; the first pulses tell its geometry.

        Args:
            parameters: what the user wants.
            health: where counts and rates go; None for a new one.
        """
        self._parameters = parameters
        self._health = health if health is not None else Health()
        self._stream = SweepStream(
            self._health, expansion(parameters.video_law, parameters.db_per_count)
        )
        self._chain: ExtractionChain | None = None
        self._stamp, self._frame = 0, RADAR_FRAME

    def process(self, sweeps: Table) -> Table:
        """Extract the plots whose bursts the sector completes.

        Args:
            sweeps: one message of `radar/sweeps`, dtype `sweep_dtype`.

        Returns:
            Plots, dtype PLOT, in order of time, with the stamp and frame of the sector; often none. A plot may have
            its time in the sector before, hence a negative `time_offset`.

        Raises:
            TableError: the message holds no sweeps, or sweeps that the parameters do not fit.
        """
        found = [self._extract(pulses) for pulses in self._stream.take(sweeps)]
        self._stamp, self._frame = sweeps.stamp, sweeps.frame_id
        return self._table(found)

    def flush(self) -> Table:
        """End the stream.

        Returns:
            Plots that waited for their neighbours, with the stamp of the last sector.
        """
        found = [self._chain.finish()] if self._chain is not None else []
        self._stream.restart()
        return self._table(found)

    def _extract(self, pulses: Pulses) -> npt.NDArray[np.void]:
        """Plots of consecutive pulses, and those that a break before them has completed."""
        finished = _NO_PLOTS
        if pulses.fresh and self._chain is not None:
            finished = self._chain.finish()
        try:
            if self._chain is None or not self._chain.fits(pulses):
                self._chain = ExtractionChain(self._parameters, pulses, self._health)
            return joined(finished, self._chain.extract(pulses))
        except ValueError as error:
            self._chain = None
            self._stream.restart()
            raise TableError(f"sweeps do not fit the parameters: {error}") from error

    def _table(self, found: list[npt.NDArray[np.void]]) -> Table:
        """Plots in order of time, their times counted from the sector's stamp."""
        plots = joined(_NO_PLOTS, *found)
        if len(plots):
            plots["time_offset"] -= (self._stamp - (self._stream.origin or 0)) / NANOSECONDS
            plots = plots[plots["time_offset"].argsort(kind="stable")]
        return Table(self._stamp, plots, self._frame)
