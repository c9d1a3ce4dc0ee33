# SPDX-License-Identifier: Apache-2.0
"""Traffic drawn from a seed keeps to what its group allows, and really manoeuvres."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from radar_sim.motion.correlated import WanderSection
from radar_sim.motion.speed_course import ArcsMotion
from radar_sim.radar import Radar
from radar_sim.targets import Targets
from radar_sim.traffic import TrafficGroup, TrafficSection, draw_traffic

RADAR = Radar(x=3000.0, y=-2000.0)
GROUP = TrafficSection(
    number=40, range_min=5e3, range_max=4e4, speed_min=60.0, speed_max=240.0, duration=900.0
)
TIMES = np.arange(0.0, 900.0, 5.0)


def states(group, seed=0):
    targets = Targets(draw_traffic(group, RADAR, np.random.default_rng(seed)))
    target = np.broadcast_to(np.arange(len(targets))[:, None], (len(targets), len(TIMES)))
    return targets, targets.fleet.state(target, np.broadcast_to(TIMES, target.shape))


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 2**32), manoeuvre=st.floats(0.0, 1.0))
def test_speeds_stay_in_bounds_and_targets_in_their_ring(seed, manoeuvre):
    _, state = states(GROUP.changed({"manoeuvre": manoeuvre}), seed)
    speed = np.hypot(state.vx, state.vy)
    assert speed.min() >= 60.0 - 1e-6
    assert speed.max() <= 240.0 + 1e-6
    distance = np.hypot(state.x - RADAR.x, state.y - RADAR.y)
    assert distance[:, 0].min() >= 5e3
    # The longest leg along the ring's edge leads past it; a turn back at the lowest turn rate takes two radii more.
    edge = np.hypot(4e4, 3.0 * GROUP.leg_duration * 240.0)
    assert distance.max() <= edge + 2.0 * 240.0 / np.radians(0.5)


def test_the_same_seed_draws_the_same_traffic():
    one, same, other = (draw_traffic(GROUP, RADAR, np.random.default_rng(k)) for k in (1, 1, 2))
    assert one == same
    assert one != other


def test_without_manoeuvres_a_target_turns_only_to_come_back():
    group = GROUP.changed({"manoeuvre": 0.0, "speed_max": 60.0, "range_max": 2e5})
    targets = draw_traffic(group, RADAR, np.random.default_rng(0))
    inner = [t for t in targets if np.hypot(t.path.x - RADAR.x, t.path.y - RADAR.y) < 1e5]
    assert inner
    assert all(leg.turn_rate == 0.0 for target in inner for leg in target.path.legs)


def test_manoeuvres_have_the_share_and_the_size_asked_for():
    group = GROUP.changed({"number": 400, "manoeuvre": 0.4, "range_max": 1e6, "duration": 600.0})
    targets = draw_traffic(group, RADAR, np.random.default_rng(0))
    legs = [leg for target in targets for leg in target.path.legs[:4]]
    turning = np.array([leg.turn_rate != 0.0 for leg in legs])
    assert abs(turning.mean() - 0.4) < 4.0 * np.sqrt(0.24 / len(legs))
    assert max(abs(leg.turn_rate) for leg in legs) <= np.radians(3.0)


def test_fluctuations_are_mixed_as_asked():
    shares = {"steady": 0.2, "fast": 0.3, "slow_dominant": 0.15, "fast_dominant": 0.1}
    group = GROUP.changed({"number": 1000} | shares)
    kinds = Targets(draw_traffic(group, RADAR, np.random.default_rng(0))).fluctuation
    expected = {"none": 0.2, "fast": 0.3, "slow-dominant": 0.15, "fast-dominant": 0.1, "slow": 0.25}
    for kind, share in expected.items():
        assert abs(np.mean(kinds == kind) - share) < 4.0 * np.sqrt(share * (1 - share) / 1000)


def test_lifetimes_and_appearances_are_spread():
    group = GROUP.changed({"number": 500, "appear_within": 100.0, "lifetime": 60.0})
    fleet = Targets(draw_traffic(group, RADAR, np.random.default_rng(0))).fleet
    assert fleet.appears.min() >= 0.0
    assert fleet.appears.max() < 100.0
    life = (fleet.disappears - fleet.appears).mean()
    assert abs(life - 60.0) < 4.0 * 60.0 / np.sqrt(500)


def test_an_empty_group_has_no_targets():
    assert draw_traffic(GROUP.changed({"number": 0}), RADAR, np.random.default_rng(0)) == []


def test_a_group_with_a_motion_of_its_own_begins_as_the_others_do():
    plain, moved = TrafficGroup(GROUP), TrafficGroup(GROUP, ArcsMotion(duration=300.0))
    one, other = (group.draw(RADAR, np.random.default_rng(4)) for group in (plain, moved))
    for before, after in zip(one, other, strict=True):
        assert (before.path.x, before.path.course) == (after.path.x, after.path.course)
        assert before.path.legs != after.path.legs
        assert all(leg.acceleration == 0.0 for leg in after.path.legs)


def test_a_group_wanders_about_its_manoeuvres():
    plain = TrafficGroup(GROUP).draw(RADAR, np.random.default_rng(4))
    wandering = TrafficGroup(GROUP, wander=WanderSection()).draw(RADAR, np.random.default_rng(4))
    assert [t.path.legs for t in plain] == [t.path.legs for t in wandering]
    assert all(t.path.wander is not None for t in wandering)
