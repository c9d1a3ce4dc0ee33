# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import importlib.util

import numpy as np
import pytest

from radar_common.bag import read_tables
from radar_common.tables import SWEEPS_TOPIC, TRUTH, TRUTH_TOPIC


@pytest.fixture(scope="module")
def made(repository, tmp_path_factory):
    """The fixture bags, made afresh by their script."""
    path = repository / "tests" / "fixtures" / "make_fixtures.py"
    specification = importlib.util.spec_from_file_location("make_fixtures", path)
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    folder = tmp_path_factory.mktemp("fixtures")
    module.make_fixtures(folder)
    return folder


def tables(bag):
    return list(read_tables(bag, {SWEEPS_TOPIC: None, TRUTH_TOPIC: TRUTH}))


def test_the_script_makes_the_bags_that_are_kept(made, fixture_bags):
    kept = sorted(path.name for path in fixture_bags.iterdir())
    assert kept == sorted(path.name for path in made.iterdir())
    for name in kept:
        for (topic, old), (other, new) in zip(
            tables(fixture_bags / name), tables(made / name), strict=True
        ):
            assert (topic, old.stamp, old.frame_id) == (other, new.stamp, new.frame_id)
            assert old.rows.dtype == new.rows.dtype
            assert len(old.rows) == len(new.rows)
            for field in old.rows.dtype.names:
                # Another processor's sine may differ in the last bits, and with it a sample by one step.
                step = 1.0 if field == "video" else 1e-6
                difference = np.abs(old.rows[field].astype(float) - new.rows[field].astype(float))
                assert not len(old.rows) or difference.max() <= step, field


def test_both_storages_hold_the_same(fixture_bags):
    sqlite3, mcap = (tables(fixture_bags / f"tiny_{s}") for s in ("sqlite3", "mcap"))
    assert [(topic, t.stamp, t.rows.tobytes()) for topic, t in sqlite3] == [
        (topic, t.stamp, t.rows.tobytes()) for topic, t in mcap
    ]


def test_the_bags_stay_small(fixture_bags):
    assert sum(f.stat().st_size for f in fixture_bags.rglob("*") if f.is_file()) < 2_000_000
