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


@pytest.fixture(scope="module", autouse=True)
def tunable(ros2_of_module):
    """A node with parameters and a service, for all tests of the module."""
    ros2_of_module.script(NODE).wait_for("ready")


def test_list(ros2):
    listed = ("param", "list", "--no-daemon")
    names = {"  count", "  filter.name", "  fixed", "  gain"}
    ros2.until(lambda out: names <= set(out.splitlines()), *listed, "/tunable")
    wanted = "/tunable:\n  count (type: integer)\n  gain (type: double)\n"
    ros2.until(lambda out: wanted in out, *listed, "--filter", "gain|count", "--param-type")


def test_get_set_and_refusals(ros2):
    def change(name, value):
        return ros2("param", "set", "/tunable", name, value, "--no-daemon")

    def get(*words):
        return ros2("param", "get", "/tunable", *words, "--no-daemon").stdout

    assert get("gain") == "Double value is: 0.5\n"
    assert change("gain", "1.5").stdout == "Set parameter successful\n"
    assert get("gain", "--hide-type") == "1.5\n"
    assert change("gain", "-1.0").stderr == "Setting parameter failed: gain is negative\n"
    assert "Setting parameter failed" in change("fixed", "false").stderr


def test_describe(ros2):
    done = ros2("param", "describe", "/tunable", "count", "fixed", "--no-daemon")
    assert done.stdout == (
        "Parameter name: count\n  Type: integer\n  Description: How many\n  Constraints:\n"
        "    Min value: 1\n    Max value: 9\n    Step: 2\n"
        "Parameter name: fixed\n  Type: boolean\n  Constraints:\n    Read only: true\n"
    )


def test_load_and_dump(ros2, tmp_path):
    file = tmp_path / "tunable.yaml"
    file.write_text("/tunable:\n  ros__parameters:\n    count: 5\n    filter.name: mean\n")
    loaded = ros2("param", "load", "/tunable", str(file), "--no-daemon")
    assert "Set parameter count successful\n" in loaded.stdout
    dumped = yaml.safe_load(ros2("param", "dump", "/tunable", "--no-daemon").stdout)
    parameters = dumped["/tunable"]["ros__parameters"]
    assert parameters["filter"] == {"name": "mean"}
    assert parameters["count"] == 5


def test_an_unknown_node(ros2):
    done = ros2("param", "get", "/nobody", "x", "--no-daemon")
    assert (done.returncode, done.stderr) == (1, "Node not found\n")


def test_services(ros2):
    line = "/switch [std_srvs/srv/SetBool]"
    listed = ("service", "list", "-t", "--no-daemon")
    ros2.until(lambda out: line in out.splitlines(), *listed)
    words = ("service", "type", "/switch", "--no-daemon")
    ros2.until(lambda out: out == "std_srvs/srv/SetBool\n", *words)
    called = ros2("service", "call", "/switch", "std_srvs/srv/SetBool", "data: true")
    assert called.returncode == 0
    assert (
        "requester: making request: std_srvs.srv.SetBool_Request(data=True)\n\n"
        "response:\nstd_srvs.srv.SetBool_Response(success=True, message='switched')\n"
    ) in called.stdout
