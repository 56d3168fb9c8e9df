// SPDX-License-Identifier: MIT
#include "core/log/file_contents.h"

namespace posewire::log {
namespace {

void append(std::string& list, std::uint64_t count, const std::string& what) {
    if (count != 0) {
        list += (list.empty() ? "" : ", ") + std::to_string(count) + ' ' + what;
    }
}

std::string ofCapture(const FileContents& contents) {
    if (contents.packets == 0) {
        return "is a capture without packets; record again while the sender streams";
    }
    std::string list;
    append(list, contents.udp, "UDP");
    append(list, contents.tcp, "TCP");
    append(list, contents.withoutIp, "neither");
    append(list, contents.ofOtherLinks,
           "of link type " + std::to_string(contents.otherLink) + ", which is not looked through");
    const bool isAllUnknown = contents.ofOtherLinks == contents.packets;
    return "has no MXTP datagram in " + std::to_string(contents.packets) +
           (contents.packets == 1 ? " packet (" : " packets (") + list + "); " +
           (isAllUnknown ? "capture at an Ethernet or a loopback interface"
                         : "capture where the sender sends to, while it streams");
}

} // namespace

std::string otherContents(const FileContents& contents) {
    using Format = FileContents::Format;
    if (contents.datagrams != 0) {
        return {};
    }
    if (contents.isEmpty) {
        return "is empty; was it copied whole?";
    }
    if (contents.format == Format::Capture) {
        return ofCapture(contents);
    }
    return contents.format == Format::Compressed
               ? "is compressed; unpack it first"
               : "has no MXTP datagram and is no capture (pcap, pcapng); is it a recording of MXTP?";
}

} // namespace posewire::log
