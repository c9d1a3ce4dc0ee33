# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import struct

import dpkt
import pytest
from hypothesis import given
from hypothesis import strategies as st

from radar_common.health import Health
from radar_eval.errors import RecordingError
from radar_eval.recording_file import data_blocks, split_blocks

BLOCKS = st.lists(
    st.tuples(st.sampled_from([34, 48]), st.binary(min_size=1, max_size=40)), max_size=20
)


def raw(category, records):
    return struct.pack(">BH", category, len(records) + 3) + records


def capture(path, payloads, *, protocol=dpkt.ip.IP_PROTO_UDP):
    with path.open("wb") as file:
        writer = dpkt.pcap.Writer(file)
        for number, payload in enumerate(payloads):
            datagram = dpkt.udp.UDP(sport=1, dport=2, data=payload)
            datagram.ulen = len(datagram)
            packet = dpkt.ip.IP(src=b"\x7f\0\0\1", dst=b"\x7f\0\0\1", p=protocol, data=datagram)
            packet.len = len(packet)
            frame = dpkt.ethernet.Ethernet(type=dpkt.ethernet.ETH_TYPE_IP, data=packet)
            writer.writepkt(bytes(frame), ts=1000.0 + number)
    return path


@given(BLOCKS)
def test_blocks_come_out_as_they_went_in(blocks):
    health = Health()
    content = b"".join(raw(*block) for block in blocks)
    assert list(split_blocks(content, health)) == blocks
    assert not health.dropped


@given(st.binary(max_size=300))
def test_any_octets_are_read_to_the_end(content):
    health = Health()
    taken = sum(len(records) + 3 for _, records in split_blocks(content, health))
    assert taken + health.dropped["octet outside of data blocks"] == len(content)


def test_reading_goes_on_behind_damage():
    health = Health()
    before, after = raw(48, b"first"), raw(48, b"second") + raw(34, b"third")
    blocks = list(split_blocks(before + b"\x30\xff\xff damaged" + after, health))
    assert [records for _, records in blocks] == [b"first", b"second", b"third"]
    assert health.dropped["damaged data block"] == 1


def test_a_truncated_block_is_counted():
    health = Health()
    content = raw(48, b"whole") + raw(48, b"cut off")[:-2]
    assert list(split_blocks(content, health)) == [(48, b"whole")]
    assert health.dropped["damaged data block"] == 1


def test_other_categories_are_counted(tmp_path):
    path = tmp_path / "recording.ast"
    path.write_bytes(raw(62, b"track") + raw(48, b"plot"))
    health = Health()
    assert [block.records for block in data_blocks(path, health)] == [b"plot"]
    assert health.dropped == {"data block of category 62": 1}


def test_captures_give_the_datagrams_and_drop_second_copies(tmp_path):
    once, other = raw(48, b"plot"), raw(48, b"other")
    path = capture(tmp_path / "capture", [once + other, once])
    health = Health()
    blocks = list(data_blocks(path, health))
    assert [block.records for block in blocks] == [b"plot", b"other"]
    assert blocks[0].captured == 1000.0
    assert health.dropped == {"data block received twice": 1}


def test_what_is_no_datagram_in_a_capture_is_counted(tmp_path):
    path = capture(tmp_path / "capture", [raw(48, b"plot")], protocol=dpkt.ip.IP_PROTO_TCP)
    health = Health()
    assert list(data_blocks(path, health)) == []
    assert health.dropped == {"frame without a whole UDP datagram": 1}


@pytest.mark.parametrize("content", [b"\xd4\xc3\xb2\xa1", b"\x0a\x0d\x0d\x0a\0\0\0\x1c"])
def test_a_damaged_capture_is_one_clear_error(tmp_path, content):
    path = tmp_path / "capture"
    path.write_bytes(content)
    with pytest.raises(RecordingError, match="capture"):
        list(data_blocks(path, Health()))


def test_a_missing_file_is_one_clear_error(tmp_path):
    with pytest.raises(RecordingError, match="No such file"):
        list(data_blocks(tmp_path / "nothing", Health()))
