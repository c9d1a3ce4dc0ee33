# SPDX-License-Identifier: Apache-2.0
"""Names of nodes, namespaces, topics and services."""

from __future__ import annotations

import pytest
from rclpy.exceptions import (
    InvalidNamespaceException,
    InvalidNodeNameException,
    InvalidParameterException,
    InvalidServiceNameException,
    InvalidTopicNameException,
    NameValidationException,
)
from rclpy.expand_topic_name import expand_topic_name
from rclpy.validate_full_topic_name import validate_full_topic_name
from rclpy.validate_namespace import validate_namespace
from rclpy.validate_node_name import validate_node_name
from rclpy.validate_parameter_name import validate_parameter_name
from rclpy.validate_topic_name import validate_topic_name


@pytest.mark.parametrize("name", ["node", "_hidden", "n0de", "CamelCase", "x" * 255])
def test_node_names(name):
    assert validate_node_name(name)


@pytest.mark.parametrize("name", ["", "two words", "a/b", "1st", "a-b", "a.b", "é", "x" * 256])
def test_bad_node_names(name, make_node):
    with pytest.raises(InvalidNodeNameException):
        validate_node_name(name)
    with pytest.raises(InvalidNodeNameException):
        make_node(name)


@pytest.mark.parametrize("name", ["/", "/a", "/a/b_1"])
def test_namespaces(name, make_node):
    assert validate_namespace(name)
    assert make_node("node", namespace=name).get_namespace() == name


@pytest.mark.parametrize("name", ["/a/", "//", "/a//b", "/1st", "/a b", "/a-b"])
def test_bad_namespaces(name, make_node):
    with pytest.raises(InvalidNamespaceException):
        validate_namespace(name)
    with pytest.raises(InvalidNamespaceException):
        make_node("node", namespace=name)


@pytest.mark.parametrize(("given", "got"), [(None, "/"), ("", "/"), ("a/b", "/a/b")])
def test_namespace_becomes_absolute(given, got, make_node):
    assert make_node("node", namespace=given).get_namespace() == got


@pytest.mark.parametrize(
    "name", ["a", "/a", "a/b", "~", "~/a", "{node}/a", "/a/{ns}", "_a", "A1/b_2"]
)
def test_topic_names(name):
    assert validate_topic_name(name)


@pytest.mark.parametrize(
    "name", ["", "a b", "a/", "/a/", "1a", "a/1b", "~a", "a/~", "{a", "a}", "{1a}", "{}/a", "a-b"]
)
def test_bad_topic_names(name):
    with pytest.raises(InvalidTopicNameException):
        validate_topic_name(name)
    with pytest.raises(InvalidServiceNameException):
        validate_topic_name(name, is_service=True)


@pytest.mark.parametrize("name", ["a", "~/a", "/{node}", "/a//b", "/1a", "/a/", ""])
def test_bad_full_names(name):
    with pytest.raises(InvalidTopicNameException):
        validate_full_topic_name(name)
    with pytest.raises(InvalidServiceNameException):
        validate_full_topic_name(name, is_service=True)


def test_full_name():
    assert validate_full_topic_name("/a/b")


def test_reason_points_at_the_place():
    with pytest.raises(NameValidationException, match=r"(?s)bad name.*\^"):
        validate_node_name("bad name")


def test_parameter_names():
    assert validate_parameter_name("a.b")
    with pytest.raises(InvalidParameterException):
        validate_parameter_name("")


@pytest.mark.parametrize(
    ("name", "full"),
    [
        ("/a", "/a"),
        ("a", "/ns/a"),
        ("a/b", "/ns/a/b"),
        ("~", "/ns/me"),
        ("~/a", "/ns/me/a"),
        ("{node}", "/ns/me"),
        ("/{node}/a", "/me/a"),
        ("{ns}/a", "/ns/a"),
    ],
)
def test_expansion(name, full):
    assert expand_topic_name(name, "me", "/ns") == full


def test_expansion_in_the_root():
    assert expand_topic_name("a", "me", "/") == "/a"
    assert expand_topic_name("~/a", "me", "/") == "/me/a"


@pytest.mark.parametrize(
    ("name", "node", "namespace"),
    [("a b", "me", "/ns"), ("a", "me!", "/ns"), ("a", "me", "ns"), ("{other}", "me", "/ns")],
)
def test_bad_expansion(name, node, namespace):
    with pytest.raises((ValueError, RuntimeError)):
        expand_topic_name(name, node, namespace)


def test_names_of_a_node(make_node):
    node = make_node("me", namespace="/ns")
    assert node.get_name() == "me"
    assert node.get_namespace() == "/ns"
    assert node.get_fully_qualified_name() == "/ns/me"
    assert make_node("top").get_fully_qualified_name() == "/top"
    assert node.resolve_topic_name("a") == "/ns/a"
    assert node.resolve_service_name("~/a") == "/ns/me/a"
