# SPDX-License-Identifier: Apache-2.0
"""Whatever stands in a bag, a command ends with one line that says what is wrong, and exit code 1."""

from __future__ import annotations

import shutil

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from radar_common.bag import BagWriter
from radar_common.tables import PLOT, PLOTS_TOPIC, SWEEPS_TOPIC, TRACKS_TOPIC, Table

STORAGES = ["mcap", "sqlite3"]
READERS = {
    "score": lambda tmp_path: [],
    "report": lambda tmp_path: ["--out", tmp_path / "report"],
    "run_offline": lambda tmp_path: ["--out", tmp_path / "out"],
}


@pytest.fixture(params=STORAGES)
def bag(request, fixture_bags, tmp_path):
    """A copy of a fixture bag to be damaged."""
    return shutil.copytree(fixture_bags / f"tiny_{request.param}", tmp_path / "bag")


@pytest.fixture(params=list(READERS))
def fails(request, command, tmp_path):
    """Run a command that must fail, and give its one line."""

    def run(path):
        result = command(request.param, path, *READERS[request.param](tmp_path))
        assert result.code == 1, result
        assert result.out == ""
        assert result.err.startswith("error: ")
        assert result.err.count("\n") == 1
        assert not (tmp_path / "out").exists()
        return result.err

    return run


def storage_file(bag):
    return next(path for path in bag.iterdir() if path.suffix in (".mcap", ".db3"))


def write(path, *messages):
    with BagWriter(path) as writer:
        for topic, table in messages:
            writer.write(topic, table)
    return path


def test_no_bag(fails, tmp_path):
    assert "nothing" in fails(tmp_path / "nothing")


def test_a_folder_without_metadata(fails, bag):
    (bag / "metadata.yaml").unlink()
    fails(bag)


@pytest.mark.parametrize("text", ["", "rosbag2_bagfile_information: 3", "\t: ["])
def test_metadata_that_are_none(fails, bag, text):
    (bag / "metadata.yaml").write_text(text, encoding="utf-8")
    fails(bag)


def test_a_missing_storage_file(fails, bag):
    storage_file(bag).unlink()
    fails(bag)


@pytest.mark.parametrize("kept", [0, 10, 3000, 300_000])
def test_a_truncated_storage_file(fails, bag, kept):
    file = storage_file(bag)
    file.write_bytes(file.read_bytes()[:kept])
    fails(bag)


def test_noise_in_place_of_a_storage_file(fails, bag):
    file = storage_file(bag)
    file.write_bytes(np.random.default_rng(1).bytes(20_000))
    fails(bag)


@pytest.mark.parametrize("plugin", [StoragePlugin.MCAP, StoragePlugin.SQLITE3])
def test_a_bag_without_messages(fails, tmp_path, plugin):
    with Writer(tmp_path / "bag", version=9, storage_plugin=plugin):
        pass
    fails(tmp_path / "bag")


def test_a_bag_without_tables(fails, tmp_path):
    store = get_typestore(Stores.ROS2_JAZZY)
    text = store.types["std_msgs/msg/String"]
    with Writer(tmp_path / "bag", version=9) as writer:
        connection = writer.add_connection("/radar/plots", text.__msgtype__, typestore=store)
        writer.write(connection, 1, store.serialize_cdr(text("plots"), text.__msgtype__))
    fails(tmp_path / "bag")


def test_plots_with_a_missing_field(fails, tmp_path):
    names = [name for name in PLOT.names if name != "azimuth"]
    rows = np.zeros(5, [(name, PLOT[name]) for name in names])
    bag = write(tmp_path / "bag", *[(PLOTS_TOPIC, Table(10**18 + n, rows)) for n in range(5)])
    fails(bag)


def test_plots_with_a_field_of_another_type(fails, tmp_path):
    layout = [(name, "<f4" if name == "range" else PLOT[name]) for name in PLOT.names]
    rows = np.zeros(5, layout)
    bag = write(tmp_path / "bag", *[(PLOTS_TOPIC, Table(10**18 + n, rows)) for n in range(5)])
    fails(bag)


def test_sweeps_that_are_no_sweeps(command, tmp_path):
    table = Table(10**18, np.zeros(5, PLOT))
    result = command(
        "run_offline", write(tmp_path / "bag", (SWEEPS_TOPIC, table)), "--out", tmp_path / "out"
    )
    assert result.code == 1
    assert result.err.count("\n") == 1


def test_only_empty_plots_are_no_basis_for_a_score(command, tmp_path):
    tables = [(PLOTS_TOPIC, Table(10**18 + n, np.zeros(0, PLOT))) for n in range(40)]
    result = command("score", write(tmp_path / "bag", *tables))
    assert result.code == 1
    assert "no truth" in result.err


def test_numbers_that_are_not_finite_are_dropped_and_counted(command, world, write_bag):
    plots = world.plots()
    tracks = world.tracks(plots, world.owner(plots))
    plots.rows["range"][[3, 50]] = np.nan
    tracks.rows["x"][7] = np.inf
    tables = world.tables(plots, tracks)
    result = command("score", write_bag(tables))
    assert result.code == 0
    assert "2  radar/plots: row with a number that is not finite" in result.out
    assert "1  radar/tracks: row with a number that is not finite" in result.out


def test_a_bag_with_tracks_of_another_layout_still_gives_its_plots(
    command, world, tmp_path, write_bag
):
    bag = write_bag(world.tables())
    strange = write(tmp_path / "strange", (TRACKS_TOPIC, Table(10**18, np.zeros(3, PLOT))))
    result = command("score", strange, "--truth", bag)
    assert result.code == 1
    assert "radar/plots" in result.err
