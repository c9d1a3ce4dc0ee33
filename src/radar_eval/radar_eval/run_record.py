# SPDX-License-Identifier: Apache-2.0
"""What an offline run notes down beside the bag it wrote: its throughput and the health of its pipelines.

It stands in a file of its own because the bag's content is the same at each run, and a measured time is not.
"""

from __future__ import annotations

import dataclasses
import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from radar_common.health import Health
from radar_eval.errors import EvaluationError

RECORD_FILE = "run.json"


@dataclass(frozen=True, slots=True)
class StageRecord:
    """One pipeline of the run.

    Attributes:
        seconds: spent in the pipeline.
        counts: as its health counted them.
        dropped: reasons and numbers.
        watches: name of a rate with its expected and observed value.
    """

    seconds: float
    counts: dict[str, int]
    dropped: dict[str, int]
    watches: dict[str, dict[str, float]]


@dataclass(frozen=True, slots=True)
class RunRecord:
    """An offline run.

    Attributes:
        plots_per_second: plots that came out of the run over the time spent in its pipelines.
        stages: by name of the node that runs the same pipeline.
    """

    plots_per_second: float
    stages: dict[str, StageRecord] = field(default_factory=dict)

    def write(self, bag: str | Path) -> None:
        """Write the record beside the bag's files.

        Args:
            bag: folder of the bag.
        """
        text = json.dumps(dataclasses.asdict(self), indent=2)
        (Path(bag) / RECORD_FILE).write_text(text + "\n", encoding="utf-8")

    @classmethod
    def read(cls, bag: str | Path) -> RunRecord | None:
        """Read the record of a bag.

        Args:
            bag: folder of the bag.

        Returns:
            The record; None if the bag has none.

        Raises:
            EvaluationError: the file is there but holds no record.
        """
        path = Path(bag) / RECORD_FILE
        if not path.is_file():
            return None
        try:
            content: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
            stages = {name: StageRecord(**stage) for name, stage in content["stages"].items()}
            return cls(float(content["plots_per_second"]), stages)
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise EvaluationError(f"{path} is no record of a run: {error}") from error


def stage_record(seconds: float, health: Health) -> StageRecord:
    """Note down one pipeline.

    Args:
        seconds: spent in it.
        health: of the pipeline.

    Returns:
        The record.
    """
    watches = {name: dataclasses.asdict(watch) for name, watch in health.watches.items()}
    return StageRecord(seconds, dict(health.counts), dict(health.dropped), watches)
