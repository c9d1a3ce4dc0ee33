# SPDX-License-Identifier: Apache-2.0
"""Scenes with names: two kinds of traffic, and a hard set of what trackers fail at."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from radar_sim.motion import Leg, Path
from radar_sim.plot_scenes.errors import PlotErrors
from radar_sim.plot_scenes.false_plots import ClutterPatch
from radar_sim.plot_scenes.scene import PlotScene
from radar_sim.radar import Radar
from radar_sim.scenario import Scenario, load_scenario
from radar_sim.targets import Target

_GRAVITY = 9.80665
_RADAR = Radar()


def plot_scene(name: str, *, scans: int = 60) -> PlotScene:
    """Make a named scene.

    Args:
        name: key of PLOT_SCENES.
        scans: turns of the antenna.

    Returns:
        The scene.

    Raises:
        ValueError: there is none of that name, or no scan is wanted.
    """
    if name not in PLOT_SCENES:
        raise ValueError(f"no scene {name!r}; there are {', '.join(PLOT_SCENES)}")
    return PLOT_SCENES[name](scans)


def _airport(scans: int) -> PlotScene:
    return PlotScene(
        title="airport: aircraft of mixed speed, detected by their strength at their range",
        scenario=load_scenario("airport"),
        share=0.4,
        scans=scans,
        errors=PlotErrors(range_std=20.0, azimuth_std=0.002, outliers=0.01),
        false_plots=25.0,
        nearest=5e3,
        range_resolution=1.5 * _RADAR.range_step,
        azimuth_resolution=math.radians(_RADAR.beamwidth_deg),
    )


def _coast(scans: int) -> PlotScene:
    radar = load_scenario("coast").radar
    return PlotScene(
        title="coast: slow ships and fast boats, a radar of short range",
        scenario=load_scenario("coast"),
        share=0.7,
        scans=scans,
        errors=PlotErrors(range_std=10.0, azimuth_std=0.003),
        integration_gain_db=4.0,
        false_plots=25.0,
        nearest=500.0,
        range_resolution=1.5 * radar.range_step,
        azimuth_resolution=math.radians(radar.beamwidth_deg),
    )


def _crossing(scans: int) -> PlotScene:
    # Pairs that meet half-way through the scene, at 10, 25, 45 and 90 degrees.
    middle, speed = 0.5 * scans * _RADAR.scan_period, 200.0
    targets = []
    for number, degrees in enumerate((10.0, 25.0, 45.0, 90.0)):
        east, north = 40e3 * math.cos(number * math.pi / 2), 40e3 * math.sin(number * math.pi / 2)
        for course in (60.0 * number, 60.0 * number + degrees):
            angle = math.radians(course)
            targets.append(
                _steady(
                    east - middle * speed * math.sin(angle),
                    north - middle * speed * math.cos(angle),
                    speed,
                    angle,
                )
            )
    return _hard("crossing: pairs that meet at 10 to 90 degrees", targets, scans, resolved=False)


def _parallel(scans: int) -> PlotScene:
    # Abreast and in trail, apart by once to thrice what the radar can resolve.
    across = 30e3 * math.radians(_RADAR.beamwidth_deg)
    targets = [
        _steady(-20e3 + 150.0 * lag, 30e3 + step * 1.5 * _RADAR.range_step, 180.0, math.pi / 2)
        for lag, step in ((0.0, 0.0), (1.0, 1.3))
    ]
    targets += [_steady(30e3 + step * across, -25e3, 180.0, 0.0) for step in (0.0, 1.2)]
    targets += [
        _steady(-15e3, -30e3 + step * 1.5 * _RADAR.range_step, 150.0, -math.pi / 2)
        for step in (0.0, 2.0, 4.0)
    ]
    return _hard("parallel: formations at the limit of resolution", targets, scans, resolved=False)


def _weave(scans: int) -> PlotScene:
    # Half circles to either side at seven times gravity, after a quiet beginning; a radar made for such targets.
    radar = Radar(scan_period=2.0, pulse_rate=2048.0, cells=512)
    speed = 250.0
    rate = 7.0 * _GRAVITY / speed
    half = math.pi / rate
    duration = scans * radar.scan_period
    weave = [Leg(0.25 * duration), Leg(0.5 * half, rate)]
    sign = -1.0
    while sum(leg.duration for leg in weave) < duration:
        weave += [Leg(half, sign * rate), Leg(10.0)]
        sign = -sign
    targets = [
        Target(Path(x, y, speed, course, tuple(weave)), 30.0, "slow")
        for x, y, course in (
            (-30e3, 20e3, 1.2),
            (35e3, 10e3, 4.0),
            (-10e3, -40e3, 0.3),
            (20e3, -30e3, 5.5),
        )
    ]
    return _hard("weave: half circles at 7 g, a turn in 2 s", targets, scans, radar=radar)


def _clutter(scans: int) -> PlotScene:
    # Aircraft cross two patches that hold most of the false plots.
    scene = _hard("clutter: through patches of dense false plots", _star(8), scans)
    patches = tuple(
        ClutterPatch(
            range_min=20e3,
            range_max=28e3,
            azimuth_min=math.radians(left),
            azimuth_max=math.radians(left + 30.0),
            per_scan=20.0,
        )
        for left in (20.0, 200.0)
    )
    return replace(scene, patches=patches)


def _half(scans: int) -> PlotScene:
    return replace(_hard("half: every second plot is missed", _star(8), scans), detection=0.5)


PLOT_SCENES: dict[str, Callable[[int], PlotScene]] = {
    "airport": _airport,
    "coast": _coast,
    "crossing": _crossing,
    "parallel": _parallel,
    "weave": _weave,
    "clutter": _clutter,
    "half": _half,
}
"""Makers of scenes by name; each takes the number of scans."""


def _hard(
    title: str,
    targets: list[Target],
    scans: int,
    *,
    resolved: bool = True,
    radar: Radar = _RADAR,
) -> PlotScene:
    return PlotScene(
        title=title,
        scenario=Scenario(radar=radar, targets=tuple(targets), title=title),
        scans=scans,
        detection=0.9,
        false_plots=25.0,
        nearest=2e3,
        range_resolution=0.0 if resolved else 1.5 * _RADAR.range_step,
        azimuth_resolution=0.0 if resolved else math.radians(_RADAR.beamwidth_deg),
    )


def _star(number: int) -> list[Target]:
    """Targets that come in from all sides, pass the radar at a distance and leave."""
    targets = []
    for i in range(number):
        bearing = 2.0 * math.pi * (i + 0.5) / number
        course = bearing + math.pi + 0.35
        targets.append(
            _steady(40e3 * math.sin(bearing), 40e3 * math.cos(bearing), 150.0 + 15.0 * i, course)
        )
    return targets


def _steady(x: float, y: float, speed: float, course: float) -> Target:
    return Target(Path(x, y, speed, course), 30.0, "slow")
