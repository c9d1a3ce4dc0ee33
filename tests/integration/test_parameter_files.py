# SPDX-License-Identifier: Apache-2.0
"""The parameter files that the packages ship fit their nodes, in any namespace."""

from __future__ import annotations

import pytest

from radar_common.tables import PLOTS_TOPIC


@pytest.mark.parametrize("namespace", ["", "/north"])
def test_the_shipped_file_reaches_the_node(
    namespace, repository, listener, ros2, spin_until, tmp_path
):
    shipped = repository / "src" / "primary_proc" / "config" / "plot_extractor.yaml"
    changed = tmp_path / "changed.yaml"
    text = shipped.read_text(encoding="utf-8")
    assert "beamwidth_deg: 1.4" in text
    changed.write_text(text.replace("beamwidth_deg: 1.4", "beamwidth_deg: 500.0"))
    arguments = ["--ros-args", "-r", f"__ns:={namespace or '/'}", "--params-file"]
    command = ["run", "primary_proc", "plot_extractor", *arguments]
    with ros2(*command, str(shipped)):
        spin_until(
            lambda: listener.node.count_publishers(f"{namespace}/{PLOTS_TOPIC}") == 1, "the node"
        )
    with ros2(*command, str(changed)) as refused:
        # The value is out of range, so that a file that reaches the node keeps it from starting.
        assert refused.wait(60) != 0
    assert "beamwidth_deg" in "".join(refused.lines)
