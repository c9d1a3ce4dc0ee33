# SPDX-License-Identifier: Apache-2.0
"""One dataclass defines the parameters; files, tables and refusals follow from it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
import yaml

from radar_common.parameters import (
    ParameterError,
    Parameters,
    describe,
    from_file,
    parameter,
    to_markdown,
    to_yaml,
)


@dataclass(frozen=True, kw_only=True)
class GateParameters(Parameters):
    smallest: float = parameter(1.0, "smallest gate", unit="sigma", low=0.1, high=10.0)
    largest: float = parameter(5.0, "largest gate", unit="sigma", low=0.1)
    hits: int = parameter(3, "plots to confirm", low=1, high=16, read_only=True)
    rule: str = parameter("nearest", "how to choose", choices=("nearest", "strongest"))
    widen: bool = parameter(True, "whether misses widen the gate")

    def check(self):
        if self.smallest > self.largest:
            raise ParameterError("smallest must not exceed largest")


@pytest.mark.parametrize(
    ("values", "reason"),
    [
        ({"smallest": 0.0}, r"smallest must be in \[0.1, 10\]"),
        ({"largest": float("nan")}, "finite"),
        ({"largest": float("inf")}, "finite"),
        ({"smallest": 6.0}, "must not exceed"),
        ({"hits": 3.0}, "hits must be int"),
        ({"hits": True}, "hits must be int"),
        ({"hits": 17}, "hits must be in"),
        ({"rule": "furthest"}, "one of nearest, strongest"),
        ({"widen": 1}, "widen must be bool"),
        ({"gate": 1.0}, "unknown parameter gate"),
    ],
)
def test_impossible_values_are_refused_with_the_reason(values, reason):
    with pytest.raises(ParameterError, match=reason):
        GateParameters().changed(values)


def test_a_whole_number_serves_as_a_float():
    assert GateParameters(smallest=2).smallest == 2


def test_the_default_file_gives_the_defaults(tmp_path):
    path = tmp_path / "gate.yaml"
    path.write_text(to_yaml(GateParameters, "tracker"))
    content = yaml.safe_load(path.read_text())["/**/tracker"]["ros__parameters"]
    assert content == {d.name: d.default for d in describe(GateParameters)}
    assert from_file(GateParameters, path, "tracker") == GateParameters()


def test_a_file_is_read_as_ros_reads_it(tmp_path):
    path = tmp_path / "all.yaml"
    path.write_text(
        "/**:\n  ros__parameters: {use_sim_time: true, largest: 7.0, hits: 4}\n"
        "/tracker:\n  ros__parameters: {hits: 5}\n"
        "other:\n  ros__parameters: {smallest: 99.0}\n"
    )
    assert from_file(GateParameters, path, "tracker") == GateParameters(largest=7.0, hits=5)


@pytest.mark.parametrize("text", ["- a list\n", "tracker: [unclosed\n"])
def test_a_file_of_another_kind_is_refused(tmp_path, text):
    path = tmp_path / "bad.yaml"
    path.write_text(text)
    with pytest.raises(ParameterError, match=r"bad\.yaml"):
        from_file(GateParameters, path, "tracker")


@pytest.mark.parametrize(
    "text",
    [
        "tracker: 3\n",
        "tracker:\n  ros__parameters: 3\n",
    ],
)
def test_sections_that_hold_no_parameters_are_refused(tmp_path, text):
    path = tmp_path / "bad.yaml"
    path.write_text(text)
    with pytest.raises(ParameterError, match="ros__parameters"):
        from_file(GateParameters, path, "tracker")


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(ParameterError, match=r"nowhere\.yaml"):
        from_file(GateParameters, tmp_path / "nowhere.yaml", "tracker")


def test_the_table_has_a_row_for_each_parameter():
    table = to_markdown(GateParameters)
    assert table.count("\n") == 2 + len(describe(GateParameters))
    assert "| `smallest` | `1.0` | sigma | [0.1, 10] | smallest gate |" in table
    assert "[1, 16] | plots to confirm (fixed at start) |" in table


def test_a_number_of_numpy_serves_as_a_float():
    assert GateParameters(smallest=np.float64(2.0)).smallest == 2.0
