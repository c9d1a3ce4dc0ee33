# SPDX-License-Identifier: Apache-2.0
"""Health counts, and tells each piece of news once."""

from __future__ import annotations

from radar_common.health import Health, Watch


def test_news_is_told_once():
    health = Health()
    health.drop("late", 2)
    health.drop("torn", 0)
    assert health.news() == {"late": 2}
    assert health.news() == {}
    health.drop("late")
    assert health.news() == {"late": 1}
    assert health.dropped == {"late": 3}


def test_a_watch_keeps_the_latest_observation():
    health = Health()
    health.watch("false plots per scan", 10.0, 12.0)
    health.watch("false plots per scan", 10, 11)
    assert health.watches == {"false plots per scan": Watch(10.0, 11.0)}


def test_counts_add_up():
    health = Health()
    health.count("plots out", 3)
    health.count("plots out")
    assert health.counts["plots out"] == 4
