# SPDX-License-Identifier: Apache-2.0
"""`ros2 node`, as ros2cli documents it."""

from __future__ import annotations

LISTENER = """
import rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("listener", namespace="/lab")
node.create_subscription(String, "in", lambda message: None, 10)
node.create_publisher(String, "out", 10)
print("ready", flush=True)
rclpy.spin(node)
"""


def test_list_and_info(ros2):
    ros2.script(LISTENER).wait_for("ready")
    listed = ros2.until(lambda out: "/lab/listener" in out.split(), "node", "list", "--no-daemon")
    assert "_ros2cli" not in listed

    info = ("node", "info", "/lab/listener", "--no-daemon")
    lines = ros2.until(lambda out: "/lab/out" in out, *info).splitlines()
    assert lines[:2] == ["/lab/listener", "  Subscribers:"]
    titles = ["Subscribers", "Publishers", "Service Servers", "Service Clients"]
    titles += ["Action Servers", "Action Clients"]
    assert [line for line in lines if line.startswith("  ") and line[2] != " "] == [
        f"  {title}:" for title in titles
    ]
    publishers = lines.index("  Publishers:")
    assert "    /lab/in: std_msgs/msg/String" in lines[:publishers]
    assert "    /lab/out: std_msgs/msg/String" in lines[publishers:]


def test_hidden_nodes_are_shown_on_request(ros2):
    assert "/_ros2cli" in ros2("node", "list", "--all", "--no-daemon").stdout


def test_info_of_an_unknown_node(ros2):
    done = ros2("node", "info", "/nobody", "--no-daemon")
    assert (done.returncode, done.stderr) == (1, "Unable to find node '/nobody'\n")
