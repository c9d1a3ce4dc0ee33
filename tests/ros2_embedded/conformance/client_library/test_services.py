# SPDX-License-Identifier: Apache-2.0
"""Services and clients."""

from __future__ import annotations

import threading

import pytest
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.exceptions import InvalidHandle, InvalidServiceNameException
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from std_msgs.msg import String
from std_srvs.srv import Empty, SetBool, Trigger


def answer(request, response):
    response.success = request.data
    response.message = f"got {request.data}"
    return response


@pytest.fixture
def pair(make_node, executor, topic):
    """A server and a client in two nodes."""
    server, asker = make_node("server"), make_node("asker")
    server.create_service(SetBool, topic, answer)
    client = asker.create_client(SetBool, topic)
    executor.add_node(server)
    executor.add_node(asker)
    assert client.wait_for_service(timeout_sec=20.0)
    return server, client


def test_request_is_answered(pair, executor):
    future = pair[1].call_async(SetBool.Request(data=True))
    executor.spin_until_future_complete(future, timeout_sec=20.0)
    assert future.result() == SetBool.Response(success=True, message="got True")


def test_requests_are_told_apart(pair, executor):
    futures = [pair[1].call_async(SetBool.Request(data=n % 2 == 0)) for n in range(6)]
    for future in futures:
        executor.spin_until_future_complete(future, timeout_sec=20.0)
    assert [future.result().success for future in futures] == [True, False] * 3


def test_clients_are_told_apart(pair, make_node, executor, topic):
    other = make_node("other").create_client(SetBool, topic)
    assert other.wait_for_service(timeout_sec=20.0)
    first = pair[1].call_async(SetBool.Request(data=True))
    second = other.call_async(SetBool.Request(data=False))
    executor.spin_until_future_complete(first, timeout_sec=20.0)
    assert first.result().success
    assert not second.done()


def test_empty_service(make_node, executor, topic):
    node = make_node()
    calls = []

    def note(request, response):
        calls.append(request)
        return response

    node.create_service(Empty, topic, note)
    client = node.create_client(Empty, topic)
    executor.add_node(node)
    assert client.wait_for_service(timeout_sec=20.0)
    future = client.call_async(Empty.Request())
    executor.spin_until_future_complete(future, timeout_sec=20.0)
    assert future.result() == Empty.Response()
    assert calls == [Empty.Request()]


@pytest.mark.parametrize("wrong", [SetBool.Response(), True, None, Trigger.Request()])
def test_wrong_request_is_refused(wrong, pair):
    with pytest.raises(TypeError):
        pair[1].call_async(wrong)


def test_wrong_response_is_refused(make_node, executor, topic):
    node = make_node()
    node.create_service(Trigger, topic, lambda request, response: None)
    client = node.create_client(Trigger, topic)
    executor.add_node(node)
    assert client.wait_for_service(timeout_sec=20.0)
    future = client.call_async(Trigger.Request())
    with pytest.raises(TypeError):
        executor.spin_until_future_complete(future, timeout_sec=20.0)


def test_waiting_for_a_service_that_does_not_come(node, topic):
    client = node.create_client(Trigger, topic)
    assert not client.service_is_ready()
    assert not client.wait_for_service(timeout_sec=0.05)


def test_service_goes(pair, executor, spin_until):
    server, client = pair
    assert client.service_is_ready()
    (service,) = [s for s in server.services if s.srv_type is SetBool]
    assert server.destroy_service(service)
    assert not server.destroy_service(service)
    spin_until(executor, lambda: not client.service_is_ready())


def test_blocking_call(make_node, context, topic):
    server, asker = make_node("server"), make_node("asker")
    server.create_service(SetBool, topic, answer)
    client = asker.create_client(SetBool, topic)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(server)
    executor.add_node(asker)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    assert client.wait_for_service(timeout_sec=20.0)
    assert client.call(SetBool.Request(data=True)).success
    executor.shutdown()
    thread.join(timeout=20.0)


def test_service_called_from_a_callback(make_node, context, topic):
    node = make_node()
    group = ReentrantCallbackGroup()
    node.create_service(SetBool, topic, answer)
    client = node.create_client(SetBool, topic, callback_group=group)
    results = []
    finished = threading.Event()

    def ask():
        timer.cancel()
        results.append(client.call(SetBool.Request(data=True)).success)
        finished.set()

    timer = node.create_timer(0.001, ask, callback_group=group)
    executor = MultiThreadedExecutor(num_threads=3, context=context)
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin)
    assert client.wait_for_service(timeout_sec=20.0)
    thread.start()
    assert finished.wait(timeout=20.0)
    assert results == [True]
    executor.shutdown()
    thread.join(timeout=20.0)


def test_awaited_service(make_node, executor, topic, spin_until):
    node = make_node()
    group = ReentrantCallbackGroup()
    node.create_service(SetBool, topic, answer, callback_group=group)
    client = node.create_client(SetBool, topic, callback_group=group)
    received = []

    async def on_message(message):
        response = await client.call_async(SetBool.Request(data=message.data == "yes"))
        received.append(response.success)

    node.create_subscription(String, f"{topic}_in", on_message, 10, callback_group=group)
    publisher = node.create_publisher(String, f"{topic}_in", 10)
    executor.add_node(node)
    spin_until(executor, lambda: publisher.get_subscription_count() == 1)
    assert client.wait_for_service(timeout_sec=20.0)
    publisher.publish(String(data="yes"))
    spin_until(executor, lambda: received)
    assert received == [True]


def test_asynchronous_server(make_node, executor, topic):
    node = make_node()
    group = ReentrantCallbackGroup()

    async def relay(request, response):
        inner = await client_of_inner.call_async(SetBool.Request(data=True))
        response.message = inner.message
        return response

    node.create_service(SetBool, f"{topic}_inner", answer, callback_group=group)
    node.create_service(Trigger, topic, relay, callback_group=group)
    client_of_inner = node.create_client(SetBool, f"{topic}_inner", callback_group=group)
    client = node.create_client(Trigger, topic, callback_group=group)
    executor.add_node(node)
    assert client_of_inner.wait_for_service(timeout_sec=20.0)
    assert client.wait_for_service(timeout_sec=20.0)
    future = client.call_async(Trigger.Request())
    executor.spin_until_future_complete(future, timeout_sec=20.0)
    assert future.result().message == "got True"


def test_request_can_be_given_up(pair, executor):
    future = pair[1].call_async(SetBool.Request())
    pair[1].remove_pending_request(future)
    for _ in range(5):
        executor.spin_once(timeout_sec=0.02)
    assert not future.done()


@pytest.mark.parametrize("bad", ["", "two words", "a//b", "end/", "1st"])
def test_bad_name_is_refused(bad, node):
    with pytest.raises(InvalidServiceNameException):
        node.create_service(Trigger, bad, answer)
    with pytest.raises(InvalidServiceNameException):
        node.create_client(Trigger, bad)


def test_message_type_is_no_service_type(node, topic):
    with pytest.raises(RuntimeError):
        node.create_service(String, topic, answer)
    with pytest.raises(RuntimeError):
        node.create_client(String, topic)


def test_destroyed_client_is_refused(pair, make_node, topic):
    node = make_node("short")
    client = node.create_client(SetBool, topic)
    assert node.destroy_client(client)
    with pytest.raises(InvalidHandle):
        client.call_async(SetBool.Request())


def test_names(make_node):
    node = make_node("server", namespace="/site")
    assert node.create_service(Trigger, "reset", answer).service_name == "/site/reset"
    assert node.create_client(Trigger, "~/reset").service_name == "/site/server/reset"
