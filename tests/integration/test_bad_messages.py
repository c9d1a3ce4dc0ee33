# SPDX-License-Identifier: Apache-2.0
"""Messages that no node should ever see are dropped, counted in diagnostics, and followed by normal work."""

from __future__ import annotations

import numpy as np
import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.parameter import Parameter
from sensor_msgs.msg import PointCloud2, PointField

from primary_proc.plot_extractor_node import PlotExtractorNode
from radar_common.cloud import encode
from radar_common.ros import qos
from radar_common.ros.messages import TYPES, TablePublisher
from radar_common.tables import PLOT, PLOTS_TOPIC, SWEEPS_TOPIC, TRACKS_TOPIC, Table
from radar_sim.parameters import SimulatorParameters
from radar_sim.simulator import Simulator
from secondary_proc.tracker_node import TrackerNode


def sectors(count):
    simulator = Simulator.from_parameters(SimulatorParameters(scenario="tiny"))
    return [next(simulator).sweeps for _ in range(count)]


def good_plots():
    rows = np.zeros(1, PLOT)
    rows["range"], rows["azimuth"] = 3000.0, 1.0
    rows["range_std"], rows["azimuth_std"] = 30.0, 0.01
    return Table(10**18, rows)


def broken(table):
    """Messages made from a good table, each wrong in another way."""
    good = encode(table, TYPES)
    empty = PointCloud2()
    short = encode(table, TYPES)
    short.data = short.data[: len(short.data) // 2]
    renamed = encode(table, TYPES)
    for field in renamed.fields:
        field.name = f"not_{field.name}"
    retyped = encode(table, TYPES)
    for field in retyped.fields:
        field.datatype = PointField.INT8
    beyond = encode(table, TYPES)
    beyond.fields[0].offset = 2**31
    no_number = Table(table.stamp, table.rows.copy(), table.frame_id)
    for name in no_number.rows.dtype.names:
        if no_number.rows[name].dtype.kind == "f":
            no_number.rows[name] = np.nan
    return [empty, short, renamed, retyped, beyond, encode(no_number, TYPES), good, good]


@pytest.fixture
def driver(context, executor):
    node = rclpy.create_node("driver", context=context)
    executor.add_node(node)
    node.diagnostics = []
    node.create_subscription(DiagnosticArray, "/diagnostics", node.diagnostics.append, 10)
    return node


def dropped(driver, name):
    for message in reversed(driver.diagnostics):
        for status in message.status:
            if status.name == name:
                return {v.key: int(v.value) for v in status.values if v.key.startswith("dropped")}
    return {}


def test_the_extractor_survives(context, executor, driver, listener, spin_until):
    executor.add_node(
        PlotExtractorNode(
            context=context, parameter_overrides=[Parameter("beamwidth_deg", value=10.0)]
        )
    )
    publisher = driver.create_publisher(PointCloud2, SWEEPS_TOPIC, qos.SWEEPS_OUT)
    spin_until(lambda: publisher.get_subscription_count() == 1, "the extractor")
    first, *rest = sectors(40)
    for message in broken(first):
        publisher.publish(message)
    spin_until(lambda: sum(dropped(driver, "/plot_extractor").values()) >= 6, "the counts")
    heard = len(listener.tables[PLOTS_TOPIC])
    for number, sweeps in enumerate(rest, heard + 1):
        publisher.publish(encode(sweeps, TYPES))
        spin_until(
            lambda number=number: len(listener.tables[PLOTS_TOPIC]) >= number,
            "plots of a good sector",
        )
    assert len(listener.rows(PLOTS_TOPIC)) > 0


def test_the_tracker_survives(context, executor, driver, listener, spin_until):
    executor.add_node(TrackerNode(context=context))
    publisher = driver.create_publisher(PointCloud2, PLOTS_TOPIC, qos.TABLES)
    spin_until(lambda: publisher.get_subscription_count() == 2, "tracker and listener")
    for message in broken(good_plots()):
        publisher.publish(message)
    spin_until(lambda: sum(dropped(driver, "/tracker").values()) >= 6, "the counts")
    heard = len(listener.tables[TRACKS_TOPIC])
    TablePublisher(driver, PLOTS_TOPIC).publish(Table(10**18 + 10**9, np.empty(0, PLOT)))
    spin_until(lambda: len(listener.tables[TRACKS_TOPIC]) > heard, "tracks after good plots")
