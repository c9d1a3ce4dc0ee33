# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic echo`."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import rclpy
import yaml
from rclpy.task import Future

from ros2_embedded.cli.arguments import non_negative_int, positive_float
from ros2_embedded.cli.direct_node import add_node_arguments, direct_node
from ros2_embedded.cli.graph import full_topic_name, topic_class
from ros2_embedded.cli.interfaces import requested_message_class
from ros2_embedded.cli.message_text import TextOptions, message_to_csv, message_to_yaml
from ros2_embedded.cli.qos_options import (
    adapt_to_offers,
    add_qos_arguments,
    has_overrides,
    profile_of,
)

DEFAULT_TRUNCATE_LENGTH = 128


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Args:
        parser: The parser of the verb.
    """
    add_node_arguments(parser)
    add_qos_arguments(parser, "subscribe", "sensor_data")
    add = parser.add_argument
    add("topic_name", help="Name of the ROS topic to listen to (e.g. '/chatter')")
    add("message_type", nargs="?", help="Type of the ROS message (e.g. 'std_msgs/msg/String')")
    add("--csv", action="store_true", help="Output all recursive fields separated by commas")
    add("--field", help="Echo a selected field of a message; '.' selects sub-fields")
    add("-f", "--full-length", action="store_true", help="Output all elements of arrays, strings")
    add(
        *("-l", "--truncate-length"),
        type=non_negative_int,
        default=DEFAULT_TRUNCATE_LENGTH,
        help="The length to truncate arrays, bytes, and string to (default: %(default)d)",
    )
    add("--no-arr", action="store_true", help="Don't print array fields of messages")
    add("--no-str", action="store_true", help="Don't print string fields of messages")
    add("--flow-style", action="store_true", help="Print collections in the flow style")
    add("--no-lost-messages", action="store_true", help="Accepted; losses are never reported")
    add("--raw", action="store_true", help="Echo the raw binary representation")
    add("--filter", dest="filter_expr", help="Python expression of m (the message) to filter by")
    add("--once", action="store_true", help="Print the first message received and then exit.")
    add("--timeout", metavar="N", type=positive_float, help="Stop after so many seconds")
    add("-i", "--include-message-info", action="store_true", help="Show the message info as well")


def main(args: argparse.Namespace) -> None:
    """Print the messages of a topic until interrupted.

    Args:
        args: The parsed arguments.

    Raises:
        RuntimeError: The topic, its type or the field is not known.
    """
    printer = Printer.from_arguments(args)
    with direct_node(args) as node:
        publishers = node.get_publishers_info_by_topic(full_topic_name(node, args.topic_name))
        profile = profile_of(args)
        if not has_overrides(args):
            for warning in adapt_to_offers(profile, publishers, args.topic_name):
                print(warning)
        named = args.message_type is not None
        kind = (
            requested_message_class(args.message_type)
            if named
            else topic_class(node, args.topic_name)
        )
        if kind is None:
            raise RuntimeError("Could not determine the type for the passed topic")
        finished: Future = Future()

        def on_message(message: Any, info: Mapping[str, Any]) -> None:
            if not finished.done() and printer.show(message, info) and args.once:
                finished.set_result(None)

        node.create_subscription(kind, args.topic_name, on_message, profile, raw=args.raw)
        if args.timeout is not None:
            node.create_timer(args.timeout, lambda: finished.set_result(None))
        rclpy.spin_until_future_complete(node, finished)


@dataclass(frozen=True, kw_only=True)
class Printer:
    """Prints what the user selected of each message.

    Attributes:
        path: Names of the nested fields down to the one to print; empty prints the message.
        accepts: Tells whether a message is printed at all.
        text: How much of a message is shown.
        csv: Comma-separated values instead of YAML.
        with_info: Print the message info first.
    """

    path: tuple[str, ...]
    accepts: Callable[[Any], bool]
    text: TextOptions
    csv: bool
    with_info: bool

    @classmethod
    def from_arguments(cls, args: argparse.Namespace) -> Printer:
        """Make the printer that the options ask for.

        Args:
            args: The parsed arguments.

        Raises:
            RuntimeError: The field or the filter makes no sense.
        """
        path = tuple(part for part in (args.field or "").split(".") if part)
        if args.field is not None and not path:
            raise RuntimeError(f"Invalid field value '{args.field}'")
        return cls(
            path=path,
            accepts=_filter(args.filter_expr),
            text=TextOptions(
                truncate_length=None if args.full_length else args.truncate_length,
                no_arr=args.no_arr,
                no_str=args.no_str,
                flow_style=args.flow_style,
            ),
            csv=args.csv,
            with_info=args.include_message_info,
        )

    def show(self, message: Any, info: Mapping[str, Any]) -> bool:
        """Print a message, or the selected field of it.

        Args:
            message: The message, or its serialised bytes.
            info: What rclpy tells about its reception.

        Returns:
            Whether it passed the filter and was printed.

        Raises:
            RuntimeError: The message has no such field.
        """
        for name in self.path:
            try:
                message = getattr(message, name)
            except AttributeError as error:
                raise RuntimeError(f"Invalid field '{'.'.join(self.path)}': {error}") from error
        if not self.accepts(message):
            return False
        if not hasattr(message, "get_fields_and_field_types"):
            if self.with_info:
                print(f"---Got new message, message info:---\n{info}\n---Message data:---")
            print(message, end="\n---\n")
        elif self.csv:
            values = [str(value) for value in info.values()] if self.with_info else []
            print(",".join([*values, message_to_csv(message, self.text)]))
        else:
            if self.with_info:
                print(yaml.dump(dict(info)), end="---\n")
            print(message_to_yaml(message, self.text), end="---\n")
        return True


def _filter(expression: str | None) -> Callable[[Any], bool]:
    if expression is None:
        return lambda _message: True
    try:
        code = compile(expression, "--filter", "eval")
    except SyntaxError as error:
        raise RuntimeError(f"Invalid filter '{expression}': {error}") from error
    # The expression is the user's own, given on the user's own command line.
    return lambda message: bool(eval(code, {"m": message}))
