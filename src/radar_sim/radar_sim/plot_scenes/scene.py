# SPDX-License-Identifier: Apache-2.0
"""What a scene of plots is made of."""

from __future__ import annotations

from dataclasses import dataclass, field

from radar_sim.plot_scenes.errors import PlotErrors
from radar_sim.plot_scenes.false_plots import ClutterPatch
from radar_sim.scenario import Scenario


@dataclass(frozen=True, kw_only=True, slots=True)
class PlotScene:
    """A scenario's targets as plots; clutter and interference of its video are not used.

    Attributes:
        title: one line for people.
        scenario: radar, targets and traffic.
        scans: turns of the antenna.
        errors: of measured positions.
        detection: probability of a plot each pass, the same for all; None takes each target's own, which its
            signal-to-noise ratio gives it at its range.
        false_alarm_probability: of the extractor's threshold, which sets that probability and the powers of plots.
        integration_gain_db: of the extractor over one pulse.
        false_plots: mean number a scan, uniform in range.
        patches: of clutter.
        share: of the scenario's targets that is taken, evenly over their order.
        range_resolution: m, nearer targets give one plot if they are within both; 0 resolves all.
        azimuth_resolution: rad.
        nearest: m, no plots nearer than this.
    """

    title: str
    scenario: Scenario
    scans: int
    errors: PlotErrors = field(default_factory=PlotErrors)
    detection: float | None = None
    false_alarm_probability: float = 1e-6
    integration_gain_db: float = 8.0
    false_plots: float = 0.0
    patches: tuple[ClutterPatch, ...] = ()
    share: float = 1.0
    range_resolution: float = 0.0
    azimuth_resolution: float = 0.0
    nearest: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what cannot be simulated.

        Raises:
            ValueError: a number of scans or false plots, a share or a probability that there cannot be.
        """
        if self.scans < 1 or not self.false_plots >= 0.0 or not 0.0 < self.share <= 1.0:
            raise ValueError(
                f"{self.scans} scans with {self.false_plots:g} false plots each, {self.share:g} of the targets"
            )
        if not 0.0 < self.false_alarm_probability < 1.0:
            raise ValueError(
                f"false_alarm_probability {self.false_alarm_probability:g} is not within (0, 1)"
            )
        if self.detection is not None and not self.false_alarm_probability < self.detection <= 1.0:
            raise ValueError(f"detection {self.detection:g} is not above that of a false alarm")
