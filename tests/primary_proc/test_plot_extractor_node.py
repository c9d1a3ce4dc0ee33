# SPDX-License-Identifier: Apache-2.0
"""The node does what the pipeline does, answers every sector, and survives what is no sector."""

from __future__ import annotations

import os

import numpy as np
import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from sensor_msgs.msg import Image

from primary_proc.parameters import ExtractorParameters
from primary_proc.plot_extractor import PlotExtractor
from primary_proc.plot_extractor_node import PPI_TOPIC, PlotExtractorNode, main
from radar_common.health import Health
from radar_common.ros import qos
from radar_common.ros.messages import TablePublisher, TableSubscription
from radar_common.ros.run import EXIT_BAD_PARAMETERS
from radar_common.tables import PLOT, PLOTS_TOPIC, SWEEPS_TOPIC, TRUTH, Table

TIMEOUT = 20.0
SETTINGS = {"beamwidth_deg": 3.0, "false_plots_per_scan": 5.0}
# Tests that run at the same time on one machine do not hear each other.
NAMESPACE = f"/extractor_{os.getpid()}"
RELIABLE = f"qos_overrides.{NAMESPACE}/{SWEEPS_TOPIC}.subscription.reliability"


@pytest.fixture
def context():
    context = Context()
    rclpy.init(context=context)
    yield context
    rclpy.shutdown(context=context)


@pytest.fixture
def extractor(context):
    overrides = [Parameter(name, value=value) for name, value in SETTINGS.items()]
    overrides.append(Parameter(RELIABLE, value="reliable"))
    node = PlotExtractorNode(context=context, namespace=NAMESPACE, parameter_overrides=overrides)
    yield node
    node.destroy_node()


@pytest.fixture
def user(context):
    node = rclpy.create_node("user", context=context, namespace=NAMESPACE)
    yield node
    node.destroy_node()


@pytest.fixture
def received(user):
    tables = []
    TableSubscription(user, PLOTS_TOPIC, tables.append, Health(), expected=PLOT)
    return tables


@pytest.fixture
def spin(context, extractor, user):
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(extractor)
    executor.add_node(user)

    def until(condition):
        clock = user.get_clock()
        end = clock.now().nanoseconds + TIMEOUT * 1e9
        while not condition() and clock.now().nanoseconds < end:
            executor.spin_once(timeout_sec=0.1)
        assert condition()

    yield until
    executor.shutdown()


@pytest.fixture
def send(user, spin):
    publisher = TablePublisher(user, SWEEPS_TOPIC, qos.SWEEPS_OUT)
    spin(
        lambda: (
            user.count_subscribers(f"{NAMESPACE}/{SWEEPS_TOPIC}")
            and user.count_publishers(f"{NAMESPACE}/{PLOTS_TOPIC}")
        )
    )
    return publisher.publish


@pytest.fixture
def sectors(scene, cut):
    made = scene(31, 512, 128, [(100.0, 40.5, 12.0), (255.0, 80.2, 12.0), (400.0, 20.9, 12.0)])
    return made.sectors(*cut(64, made))


def test_plots_are_those_of_the_pipeline(send, spin, received, sectors):
    for table in sectors:
        send(table)
    spin(lambda: len(received) == len(sectors))
    pipeline = PlotExtractor(ExtractorParameters(**SETTINGS), Health())
    for table, mine in zip(sectors, received, strict=True):
        expected = pipeline.process(table)
        assert (mine.stamp, mine.frame_id) == (table.stamp, table.frame_id)
        assert mine.rows.tobytes() == expected.rows.tobytes()
    assert sum(len(table.rows) for table in received) >= 3


def test_a_message_that_is_no_sweep_is_dropped(send, spin, received, sectors, extractor):
    send(Table(0, np.zeros(3, TRUTH)))
    send(sectors[0])
    spin(lambda: len(received) == 1)
    assert any("float64 field" in reason for reason in extractor._health.dropped)


def test_a_change_of_parameters_takes_effect(send, spin, received, sectors, extractor):
    assert extractor.set_parameters([Parameter("detector", value="4/4-2")])[0].successful
    refused = extractor.set_parameters([Parameter("normaliser", value="fixed-level")])[0]
    assert not refused.successful
    assert "noise_level" in refused.reason
    for table in sectors:
        send(table)
    spin(lambda: len(received) == len(sectors))
    pipeline = PlotExtractor(ExtractorParameters(**SETTINGS, detector="4/4-2"), Health())
    assert [t.rows.tobytes() for t in received] == [
        pipeline.process(t).rows.tobytes() for t in sectors
    ]


def test_a_picture_a_turn_for_those_who_ask(send, spin, user, extractor, scene, cut):
    pictures = []
    user.create_subscription(Image, PPI_TOPIC, pictures.append, 5)
    assert extractor.set_parameters([Parameter("ppi_pixels", value=64)])[0].successful
    spin(lambda: user.count_subscribers(f"{NAMESPACE}/{PPI_TOPIC}") == 1)
    spin(lambda: extractor._pictures.get_subscription_count() == 1)
    made = scene(32, 1100, 64, [(256.0, 48.5, 40.0)])
    for table in made.sectors(*cut(100, made)):
        send(table)
    spin(lambda: pictures)
    picture = pictures[0]
    assert (picture.height, picture.width, picture.step, picture.encoding) == (64, 64, 64, "mono8")
    brightest = np.argmax(np.frombuffer(picture.data, np.uint8))
    row, column = divmod(int(brightest), 64)
    assert abs(row - 32) <= 2, "in the east"
    assert abs(column - 56) <= 2, "three quarters out"


def test_impossible_parameters_end_the_node_with_the_reason(capsys):
    code = main(["--ros-args", "-p", "normaliser:=fixed-level"])
    assert code == EXIT_BAD_PARAMETERS
    assert "noise_level" in capsys.readouterr().err
