# SPDX-License-Identifier: Apache-2.0
"""Bearing simulator, fusion and locator in one executor give what the offline pipelines give."""

from __future__ import annotations

import numpy as np
import pytest
import rclpy
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile

from bearing_tracker.bearing_fusion import BearingFusion
from bearing_tracker.bearing_fusion_node import BearingFusionNode
from bearing_tracker.emitter_locator import EmitterLocator
from bearing_tracker.emitter_locator_node import EmitterLocatorNode
from bearing_tracker.fusion_parameters import FusionParameters
from bearing_tracker.locator_parameters import LocatorParameters
from radar_common.frames import wrap_pi
from radar_common.health import Health
from radar_common.ros.messages import TableSubscription
from radar_common.tables import (
    BEARING,
    BEARINGS_TOPIC,
    CHANNEL_TRUTH_TOPIC,
    EMITTER,
    EMITTERS_TOPIC,
    FUSED_BEARINGS_TOPIC,
    NANOSECONDS,
    PLATFORM_TOPIC,
    PLOTS_TOPIC,
)
from radar_sim.bearing_simulator_node import BearingSimulatorNode
from radar_sim.bearings.parameters import BearingSimulatorParameters
from radar_sim.bearings.simulator import BearingSimulator

HEARD = {FUSED_BEARINGS_TOPIC: BEARING, EMITTERS_TOPIC: EMITTER, CHANNEL_TRUTH_TOPIC: BEARING}
# Fifteen times as fast as real, a busy machine is late by as many times as much.
FUSION = {"active_input": "plots", "buffer": 30.0}
LOCATOR = {"odometry_wait": 30.0, "buffer": 10.0}


@pytest.fixture
def live(context, executor, spin_until):
    """Run a scenario with one of the two nodes of bearing_tracker and return the tables heard by topic."""

    def run(node, duration, **settings):
        observer = rclpy.create_node("observer", context=context)
        executor.add_node(observer)
        tables, health, finished = {topic: [] for topic in HEARD}, Health(), []
        for topic, dtype in HEARD.items():
            TableSubscription(
                observer,
                topic,
                tables[topic].append,
                health,
                expected=dtype,
                profile=QoSProfile(depth=2000),
            )
        executor.add_node(node)
        given = {
            "duration": duration,
            "rate": 15.0,
            "wait_for_subscribers": 1,
            "wait_for_truth_subscribers": 1,
            **settings,
        }
        # The node under test hears odometry and plots too, which nobody else waits for.
        mine = [PLATFORM_TOPIC] if isinstance(node, EmitterLocatorNode) else [PLOTS_TOPIC]
        spin_until(lambda: all(observer.count_subscribers(f"/{t}") for t in mine), "the node")
        executor.add_node(
            BearingSimulatorNode(
                context=context,
                on_finished=lambda: finished.append(True),
                parameter_overrides=[Parameter(k, value=v) for k, v in given.items()],
            )
        )
        spin_until(lambda: finished, "the end of the simulation")
        expected = list(simulated(duration, tables, **settings))
        looks = sum(topic == CHANNEL_TRUTH_TOPIC for _, topic, _ in expected)
        spin_until(lambda: len(tables[CHANNEL_TRUTH_TOPIC]) == looks, "all looks")
        if mine == [PLOTS_TOPIC]:
            spin_until(lambda: len(tables[FUSED_BEARINGS_TOPIC]) == looks, "all fused bearings")
        assert not health.dropped
        return tables, expected

    return run


def simulated(duration, tables, **settings):
    simulator = BearingSimulator.from_parameters(
        BearingSimulatorParameters(duration=duration, **settings)
    )
    # The first message on the truth is of the first look, at time zero.
    simulator.start = tables[CHANNEL_TRUTH_TOPIC][0].stamp
    return simulator


def in_order(tables):
    """Rows with their times, s after the first table's stamp."""
    start = tables[0].stamp
    times = np.concatenate(
        [(t.stamp - start) / NANOSECONDS + t.rows["time_offset"] for t in tables]
    )
    rows = np.concatenate([t.rows for t in tables])
    order = np.lexsort((rows["azimuth"], np.round(times, 6)))
    return times[order], rows[order]


def test_fused_bearings_live_are_those_of_the_offline_run(live, context):
    node = BearingFusionNode(
        context=context, parameter_overrides=[Parameter(k, value=v) for k, v in FUSION.items()]
    )
    tables, made = live(node, 50.0, scenario="countermeasures", seed=2)
    fusion = BearingFusion(FusionParameters(**FUSION))
    offline = [
        fusion.process(content)
        for _, topic, content in made
        if topic in (BEARINGS_TOPIC, PLOTS_TOPIC)
    ]
    times, rows = in_order(tables[FUSED_BEARINGS_TOPIC])
    expected_times, expected = in_order(offline)
    # What still waits for earlier bearings at the end depends on which message came last.
    common = (times < 19.0).sum()
    assert common > 80
    assert common == (expected_times < 19.0).sum()
    np.testing.assert_allclose(times[:common], expected_times[:common], atol=1e-6)
    for name in ("azimuth", "azimuth_std", "rate", "active_health", "passive_health"):
        np.testing.assert_allclose(rows[name][:common], expected[name][:common], rtol=1e-5)
    true = np.concatenate([t.rows for t in tables[CHANNEL_TRUTH_TOPIC]])
    assert len(np.unique(rows["id"])) == len(np.unique(true["id"])) == 4
    true_times = np.concatenate([t.times for t in tables[CHANNEL_TRUTH_TOPIC]])
    shift = tables[FUSED_BEARINGS_TOPIC][0].stamp / NANOSECONDS
    errors = [
        np.abs(
            wrap_pi(row["azimuth"] - true["azimuth"][np.abs(true_times - shift - t) < 0.3])
        ).min()
        for t, row in zip(times, rows, strict=True)
    ]
    # The better channel has 0.3 degrees a look; a few looks together must do better.
    assert np.degrees(np.sqrt(np.mean(np.square(errors)))) < 0.25


def test_emitters_live_are_those_of_the_offline_run(live, context):
    node = EmitterLocatorNode(
        context=context, parameter_overrides=[Parameter(k, value=v) for k, v in LOCATOR.items()]
    )
    tables, made = live(node, 50.0, scenario="direction_finder")
    locator = EmitterLocator(LocatorParameters(**LOCATOR))
    offline = {}
    for _, topic, content in made:
        if topic == BEARINGS_TOPIC:
            found = locator.process(content)
        elif topic == PLATFORM_TOPIC:
            found = locator.process_platform(content)
        else:
            continue
        for row, at in zip(found.rows, found.times, strict=True):
            offline[int(row["id"]), round(float(at), 4)] = row
    heard = {
        (int(row["id"]), round(float(at), 4)): row
        for table in tables[EMITTERS_TOPIC]
        for row, at in zip(table.rows, table.times, strict=True)
    }
    # What the last messages let go depends on which of them came last.
    last = max(at for _, at in offline)
    assert (
        {1, 2, 4, 5} <= {key[0] for key in offline if key[1] < last - 5.0} <= {k[0] for k in heard}
    )
    both = [key for key in heard if key in offline]
    assert len(both) > 0.9 * len(offline)
    for key in both:
        for name in ("azimuth", "range", "range_std", "x", "y", "hits"):
            np.testing.assert_allclose(heard[key][name], offline[key][name], rtol=1e-3)
