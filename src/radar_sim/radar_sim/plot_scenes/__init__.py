# SPDX-License-Identifier: Apache-2.0
"""Plots without video: what a radar and its extractor make of targets, drawn from the laws of their errors."""

from radar_sim.plot_scenes.false_plots import ClutterPatch
from radar_sim.plot_scenes.named import PLOT_SCENES, plot_scene
from radar_sim.plot_scenes.scene import PlotScene
from radar_sim.plot_scenes.simulator import PlotSimulator

__all__ = ["PLOT_SCENES", "ClutterPatch", "PlotScene", "PlotSimulator", "plot_scene"]
