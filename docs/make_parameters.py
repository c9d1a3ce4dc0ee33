# SPDX-License-Identifier: Apache-2.0
"""Write docs/parameters.md and every config/<node>.yaml from the parameter classes, their only definition."""

from __future__ import annotations

from pathlib import Path

from bearing_tracker.fusion_parameters import FusionParameters
from bearing_tracker.locator_parameters import LocatorParameters
from primary_proc.parameters import ExtractorParameters
from radar_common.parameters import Parameters, to_markdown, to_yaml
from radar_sim.bearings.parameters import BearingSimulatorParameters
from radar_sim.parameters import SimulatorParameters
from secondary_proc.parameters import TrackerParameters

ROOT = Path(__file__).resolve().parents[1]
NODES: dict[str, tuple[str, type[Parameters]]] = {
    "radar_simulator": ("radar_sim", SimulatorParameters),
    "bearing_simulator": ("radar_sim", BearingSimulatorParameters),
    "plot_extractor": ("primary_proc", ExtractorParameters),
    "tracker": ("secondary_proc", TrackerParameters),
    "bearing_fusion": ("bearing_tracker", FusionParameters),
    "emitter_locator": ("bearing_tracker", LocatorParameters),
}


def files() -> dict[Path, str]:
    """Render every generated file.

    Returns:
        Path and content.
    """
    page = [
        "# Parameters",
        "",
        "Written by `make parameters` from the parameter class of each node.",
        "",
    ]
    rendered = {}
    for node, (package, cls) in NODES.items():
        page += [f"## `{node}` ({package})", "", to_markdown(cls)]
        rendered[ROOT / "src" / package / "config" / f"{node}.yaml"] = to_yaml(cls, node)
    rendered[ROOT / "docs" / "parameters.md"] = "\n".join(page)
    return rendered


if __name__ == "__main__":
    for path, content in files().items():
        path.write_text(content, encoding="utf-8")
