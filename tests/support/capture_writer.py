# SPDX-License-Identifier: MIT
"""Writes pcap and pcapng files of UDP and TCP packets, byte by byte, for tests of what reads them."""

import ipaddress
import struct

ETHERNET = 1
RAW_IP = 101


def ones_complement(data: bytes) -> int:
    if len(data) % 2:
        data += b"\0"
    total = sum(struct.unpack(f">{len(data) // 2}H", data))
    while total >> 16:
        total = (total & 0xFFFF) + (total >> 16)
    return ~total & 0xFFFF


def ip_packet(payload: bytes, protocol: int, source: str, target: str, *, identity=0, fragment=0, more=False) -> bytes:
    """`fragment`: offset of the payload in bytes, a multiple of eight; IPv6 gets a fragment header where needed."""
    first, second = ipaddress.ip_address(source).packed, ipaddress.ip_address(target).packed
    if len(first) == 4:
        flags = (0x2000 if more else 0) | fragment // 8
        header = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(payload), identity & 0xFFFF, flags, 64, protocol, 0,
                             first, second)
        return header[:10] + struct.pack(">H", ones_complement(header)) + header[12:] + payload
    if more or fragment:
        payload = struct.pack(">BBHI", protocol, 0, fragment | (1 if more else 0), identity) + payload
        protocol = 44
    return struct.pack(">IHBB16s16s", 0x60000000, len(payload), protocol, 64, first, second) + payload


def checksummed(segment: bytes, at: int, protocol: int, source: str, target: str) -> bytes:
    first, second = ipaddress.ip_address(source).packed, ipaddress.ip_address(target).packed
    pseudo = first + second + struct.pack(">II", len(segment), protocol)
    value = ones_complement(pseudo + segment) or 0xFFFF
    return segment[:at] + struct.pack(">H", value) + segment[at + 2:]


def udp(payload: bytes, source=("192.0.2.1", 40001), target=("192.0.2.2", 9763)) -> bytes:
    segment = struct.pack(">HHHH", source[1], target[1], 8 + len(payload), 0) + payload
    return checksummed(segment, 6, 17, source[0], target[0])


def udp_packet(payload: bytes, source=("192.0.2.1", 40001), target=("192.0.2.2", 9763)) -> bytes:
    return ip_packet(udp(payload, source, target), 17, source[0], target[0])


def udp_fragments(payload: bytes, size: int, identity: int, source=("192.0.2.1", 40001),
                  target=("192.0.2.2", 9763)) -> list:
    """One UDP packet in IP fragments of `size` bytes (a multiple of eight)."""
    whole = udp(payload, source, target)
    return [ip_packet(whole[at:at + size], 17, source[0], target[0], identity=identity, fragment=at,
                      more=at + size < len(whole)) for at in range(0, len(whole), size)]


SYN, FIN, PUSH, ACK = 0x02, 0x01, 0x08, 0x10


def tcp_packet(payload: bytes, sequence: int, source=("192.0.2.1", 40001), target=("192.0.2.2", 9763),
               flags=ACK | PUSH) -> bytes:
    segment = struct.pack(">HHIIBBHHH", source[1], target[1], sequence & 0xFFFFFFFF, 1, 0x50, flags, 65535, 0, 0)
    segment += payload
    return ip_packet(checksummed(segment, 16, 6, source[0], target[0]), 6, source[0], target[0])


def ethernet(packet: bytes) -> bytes:
    kind = 0x0800 if packet[0] >> 4 == 4 else 0x86DD
    return b"\x02\0\0\0\0\x02" + b"\x02\0\0\0\0\x01" + struct.pack(">H", kind) + packet


def frame(packet: bytes, link: int) -> bytes:
    return ethernet(packet) if link == ETHERNET else packet


def pcap(packets: list, link=ETHERNET, order="<", nanoseconds=True) -> bytes:
    """`packets`: pairs of (stamp in ns, IP packet)."""
    magic, unit = (0xA1B23C4D, 1) if nanoseconds else (0xA1B2C3D4, 1000)
    out = struct.pack(order + "IHHiIII", magic, 2, 4, 0, 0, 262144, link)
    for stamp, packet in packets:
        data = frame(packet, link)
        out += struct.pack(order + "IIII", stamp // 10 ** 9, stamp % 10 ** 9 // unit, len(data), len(data)) + data
    return out


def pcapng_block(order: str, kind: int, body: bytes) -> bytes:
    body += b"\0" * (-len(body) % 4)
    size = struct.pack(order + "I", len(body) + 12)
    return struct.pack(order + "I", kind) + size + body + size


def pcapng(packets: list, link=ETHERNET, order="<") -> bytes:
    out = pcapng_block(order, 0x0A0D0D0A, struct.pack(order + "IHHq", 0x1A2B3C4D, 1, 0, -1))
    resolution = struct.pack(order + "HHBxxxHH", 9, 1, 9, 0, 0)
    out += pcapng_block(order, 1, struct.pack(order + "HHI", link, 0, 262144) + resolution)
    for stamp, packet in packets:
        data = frame(packet, link)
        head = struct.pack(order + "IIIII", 0, stamp >> 32, stamp & 0xFFFFFFFF, len(data), len(data))
        out += pcapng_block(order, 6, head + data)
    return out
