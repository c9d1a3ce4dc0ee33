# SPDX-License-Identifier: Apache-2.0
"""`ros2 param` and `ros2 service`, as ros2cli documents them."""

from __future__ import annotations

import pytest
import yaml

NODE = """
import rclpy
from rcl_interfaces.msg import IntegerRange, ParameterDescriptor, SetParametersResult
from std_srvs.srv import SetBool
rclpy.init()
node = rclpy.create_node("tunable")
bounds = [IntegerRange(from_value=1, to_value=9, step=2)]
about = ParameterDescriptor(description="How many", integer_range=bounds)
node.declare_parameter("count", 3, about)
node.declare_parameter("gain", 0.5)
node.declare_parameter("filter.name", "median")
node.declare_parameter("fixed", True, ParameterDescriptor(read_only=True))
def check(parameters):
    bad = any(p.name == "gain" and p.value < 0 for p in parameters)
    return SetParametersResult(successful=not bad, reason="gain is negative" if bad else "")
node.add_on_set_parameters_callback(check)
def switch(request, response):
    response.success = request.data
    response.message = "switched"
    return response
node.create_service(SetBool, "switch", switch)
print("ready", flush=True)
rclpy.spin(node)
"""


@pytest.fixture
def tunable(ros2):
    """A node with parameters and a service, discovered."""
    ros2.script(NODE).wait_for("ready")
    ros2.until(lambda out: "/tunable" in out.split(), "node", "list", "--no-daemon")


def test_list(ros2, tunable):
    shown = ros2("param", "list", "/tunable", "--no-daemon").stdout.splitlines()
    assert {"  count", "  filter.name", "  fixed", "  gain"} <= set(shown)
    shown = ros2("param", "list", "/tunable", "--param-type", "--no-daemon").stdout
    assert "  count (type: integer)\n" in shown
    shown = ros2("param", "list", "--filter", "gain|count", "--no-daemon").stdout
    assert "/tunable:\n  count\n  gain\n" in shown


@pytest.mark.parametrize(
    ("name", "printed"),
    [
        ("count", "Integer value is: 3\n"),
        ("gain", "Double value is: 0.5\n"),
        ("filter.name", "String value is: median\n"),
        ("fixed", "Boolean value is: True\n"),
    ],
)
def test_get(ros2, tunable, name, printed):
    assert ros2("param", "get", "/tunable", name, "--no-daemon").stdout == printed


def test_set_and_refusals(ros2, tunable):
    def change(name, value):
        return ros2("param", "set", "/tunable", name, value, "--no-daemon")

    assert change("gain", "1.5").stdout == "Set parameter successful\n"
    assert ros2("param", "get", "tunable", "gain", "--hide-type", "--no-daemon").stdout == "1.5\n"
    assert change("gain", "-1.0").stderr == "Setting parameter failed: gain is negative\n"
    assert "Setting parameter failed" in change("fixed", "false").stderr
    assert "Setting parameter failed" in change("count", "4").stderr


def test_describe(ros2, tunable):
    done = ros2("param", "describe", "/tunable", "count", "fixed", "--no-daemon")
    assert done.stdout == (
        "Parameter name: count\n  Type: integer\n  Description: How many\n  Constraints:\n"
        "    Min value: 1\n    Max value: 9\n    Step: 2\n"
        "Parameter name: fixed\n  Type: boolean\n  Constraints:\n    Read only: true\n"
    )


def test_dump_and_load(ros2, tunable, tmp_path):
    dumped = yaml.safe_load(ros2("param", "dump", "/tunable", "--no-daemon").stdout)
    parameters = dumped["/tunable"]["ros__parameters"]
    assert parameters["filter"] == {"name": "median"}
    file = tmp_path / "tunable.yaml"
    file.write_text("/tunable:\n  ros__parameters:\n    gain: 2.5\n    filter.name: mean\n")
    loaded = ros2("param", "load", "/tunable", str(file), "--no-daemon")
    assert "Set parameter gain successful\n" in loaded.stdout
    assert "String value is: mean" in ros2("param", "get", "/tunable", "filter.name").stdout


def test_an_unknown_node(ros2):
    done = ros2("param", "get", "/nobody", "x", "--no-daemon")
    assert (done.returncode, done.stderr) == (1, "Node not found\n")


def test_services(ros2, tunable):
    listed = ros2("service", "list", "-t", "--no-daemon").stdout.splitlines()
    assert "/switch [std_srvs/srv/SetBool]" in listed
    assert ros2("service", "type", "/switch", "--no-daemon").stdout == "std_srvs/srv/SetBool\n"
    called = ros2("service", "call", "/switch", "std_srvs/srv/SetBool", "data: true")
    assert called.returncode == 0
    assert (
        "requester: making request: std_srvs.srv.SetBool_Request(data=True)\n\n"
        "response:\nstd_srvs.srv.SetBool_Response(success=True, message='switched')\n"
    ) in called.stdout
