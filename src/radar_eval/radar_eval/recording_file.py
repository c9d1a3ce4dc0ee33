# SPDX-License-Identifier: Apache-2.0
"""ASTERIX data blocks out of the files that radar recordings come in.

A raw recording is a sequence of data blocks: one octet of category, two octets of length (the header included), then
the records. A network capture holds the same blocks in the payload of its UDP datagrams.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import dpkt

from radar_common.health import Health
from radar_eval.errors import RecordingError

TARGET_REPORTS = 48
SERVICE_MESSAGES = 34

_HEADER = struct.Struct(">BH")
_CAPTURE_MAGIC = {
    bytes.fromhex(magic) for magic in ("a1b2c3d4", "d4c3b2a1", "a1b23c4d", "4d3cb2a1", "0a0d0d0a")
}
_LINK_LAYERS = {
    dpkt.pcap.DLT_NULL: dpkt.loopback.Loopback,
    dpkt.pcap.DLT_EN10MB: dpkt.ethernet.Ethernet,
    dpkt.pcap.DLT_RAW: dpkt.ip.IP,
    101: dpkt.ip.IP,
    dpkt.pcap.DLT_LINUX_SLL: dpkt.sll.SLL,
    276: dpkt.sll2.SLL2,
}


@dataclass(frozen=True, slots=True)
class DataBlock:
    """One data block of a known category.

    Attributes:
        category: ASTERIX category.
        records: octets after the header.
        captured: seconds since the epoch at which a capture took it; NaN in a raw recording.
    """

    category: int
    records: bytes
    captured: float


def data_blocks(path: str | Path, health: Health) -> Iterator[DataBlock]:
    """Read the data blocks of CAT048 and CAT034; the first octets tell which kind of file it is.

    Two networks often carry the same blocks; the second copy is dropped.

    Args:
        path: raw recording or network capture (pcap or pcapng).
        health: counts what was dropped, and why.

    Yields:
        The blocks in the order of the file.

    Raises:
        RecordingError: the file cannot be opened or is no capture although it begins as one.
    """
    try:
        content = Path(path).read_bytes()
    except OSError as error:
        raise RecordingError(f"recording {path}: {error.strerror}") from error
    seen: set[tuple[int, bytes]] = set()
    is_capture = content[:4] in _CAPTURE_MAGIC
    chunks = _datagrams(Path(path), health) if is_capture else iter([(float("nan"), content)])
    for captured, chunk in chunks:
        for category, records in split_blocks(chunk, health):
            if category not in (TARGET_REPORTS, SERVICE_MESSAGES):
                health.drop(f"data block of category {category}")
            elif (category, records) in seen:
                health.drop("data block received twice")
            else:
                seen.add((category, records))
                yield DataBlock(category, records, captured)


def split_blocks(content: bytes, health: Health) -> Iterator[tuple[int, bytes]]:
    """Cut octets into data blocks; after damage, go on at the next place that looks like a block.

    Args:
        content: data blocks one after the other.
        health: counts damage and the octets skipped because of it.

    Yields:
        (category, octets after the header).
    """
    position = 0
    while position < len(content):
        length = _block_length(content, position)
        if length is None:
            health.drop("damaged data block")
            start, position = position, _resume(content, position + 1)
            health.drop("octet outside of data blocks", position - start)
            continue
        yield content[position], content[position + _HEADER.size : position + length]
        position += length


def _block_length(content: bytes, position: int) -> int | None:
    if position + _HEADER.size > len(content):
        return None
    category, length = _HEADER.unpack_from(content, position)
    whole = _HEADER.size < length <= len(content) - position
    return length if whole and category else None


def _resume(content: bytes, position: int) -> int:
    known = (TARGET_REPORTS, SERVICE_MESSAGES)
    for candidate in range(position, len(content)):
        if content[candidate] not in known:
            continue
        length = _block_length(content, candidate)
        if length is None:
            continue
        # A lone match of one octet is chance; a block that ends where another begins is not.
        following = candidate + length
        if following == len(content) or content[following] in known:
            return candidate
    return len(content)


def _datagrams(path: Path, health: Health) -> Iterator[tuple[float, bytes]]:
    with path.open("rb") as file:
        try:
            reader = dpkt.pcap.UniversalReader(file)
            link_layer = _LINK_LAYERS.get(reader.datalink())
            if link_layer is None:
                raise RecordingError(f"recording {path}: link layer {reader.datalink()} unknown")
            for captured, frame in reader:
                payload = _udp_payload(link_layer, frame)
                if payload is None:
                    health.drop("frame without a whole UDP datagram")
                else:
                    yield float(captured), payload
        except (dpkt.dpkt.Error, ValueError, struct.error) as error:
            raise RecordingError(f"recording {path}: {error or 'capture is damaged'}") from error


def _udp_payload(link_layer: type[dpkt.Packet], frame: bytes) -> bytes | None:
    try:
        packet = link_layer(frame)
    except (dpkt.dpkt.Error, struct.error, IndexError):
        return None
    while isinstance(packet, dpkt.Packet) and not isinstance(packet, dpkt.udp.UDP):
        packet = packet.data
    if not isinstance(packet, dpkt.udp.UDP) or len(packet.data) + 8 != packet.ulen:
        return None
    return bytes(packet.data)
