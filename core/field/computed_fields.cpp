// SPDX-License-Identifier: MIT
#include "core/field/field.h"

#include <algorithm>

namespace posewire::field {
namespace {

using model::PacketKind;

using Read = std::optional<Value>;

Value number(auto from) {
    return {static_cast<double>(from), {}};
}

/// A field that every packet has, one value each.
template <auto Get>
Read always(Subject& subject, std::size_t index) {
    return index == 0 ? Read(number(Get(subject.candidate))) : std::nullopt;
}

template <auto Get>
Read fromHeader(Subject& subject, std::size_t index) {
    const wire::Header* header = index == 0 ? subject.header() : nullptr;
    return header != nullptr ? Read(number(Get(*header))) : std::nullopt;
}

template <auto Get>
Read fromSender(Subject& subject, std::size_t index) {
    const log::SenderInfo* sender = subject.candidate.sender;
    return sender != nullptr && index == 0 ? Get(*sender) : std::nullopt;
}

Read readDelta(Subject& subject, std::size_t index) {
    const float deltaS = subject.candidate.digest.deltaS;
    return index == 0 && deltaS >= 0 ? Read(number(deltaS)) : std::nullopt;
}

Read readError(Subject& subject, std::size_t index) {
    const Candidate& candidate = subject.candidate;
    const PacketKind kind = candidate.digest.kind;
    if (index != 0 || (kind != PacketKind::Malformed && kind != PacketKind::Foreign)) {
        return std::nullopt;
    }
    if (candidate.fault != nullptr) {
        return Value{0, wire::errorName(candidate.fault->code)};
    }
    static thread_local wire::Datagram scratch; // its memory is reused: no allocation for each packet
    const auto decoded = wire::decodeInto(candidate.packet.bytes, scratch);
    return Value{0, decoded ? std::string_view() : wire::errorName(decoded.error().code)};
}

Read readNotice(Subject& subject, std::size_t index) {
    const wire::Datagram* datagram = subject.candidate.datagram;
    const bool isThere = datagram != nullptr && index < datagram->notices.size();
    return isThere ? Read({0, wire::noticeName(datagram->notices[index].code)}) : std::nullopt;
}

struct Row {
    std::string_view name;
    Kind kind;
    std::string_view unit;
    std::string_view text;
    ReadPacket read;
    bool isTrueByValue = false;
    bool isJudged = false;
};

template <PacketKind Wanted>
bool isKind(const Candidate& candidate) {
    return candidate.digest.kind == Wanted;
}

constexpr auto kGap = [](const Candidate& c) { return c.digest.gap; };
constexpr auto kDuplicate = [](const Candidate& c) -> bool { return c.digest.isDuplicate; };
constexpr auto kReordered = [](const Candidate& c) -> bool { return c.digest.isReordered; };
constexpr auto kRestart = [](const Candidate& c) -> bool { return c.digest.isRestart; };
constexpr auto kTruncated = [](const Candidate& c) -> bool { return c.packet.flags.truncated; };
constexpr auto kProblem = [](const Candidate& c) { return c.digest.isProblem(); };
constexpr auto kSize = [](const Candidate& c) { return c.packet.bytes.size(); };
constexpr auto kNumber = [](const Candidate& c) { return c.packet.number; };
constexpr auto kDrops = [](const Candidate& c) { return c.packet.kernelDropsBefore; };
constexpr auto kTime = [](const Candidate& c) { return log::secondsOf(c.packet.stamp - c.firstStamp); };
/// As near as a double comes to it: a time has more digits in nanoseconds than a double.
constexpr auto kUtc = [](const Candidate& c) {
    const log::WallTime time = log::asWallTime(c.packet.stamp + c.setBy);
    const auto second = std::chrono::floor<std::chrono::seconds>(time);
    return static_cast<double>(second.time_since_epoch().count()) + log::secondsOf(time - second);
};
constexpr auto kAddress = [](const log::SenderInfo& sender) { return Read({0, sender.address}); };
constexpr auto kTransport = [](const log::SenderInfo& sender) {
    return Read({0, log::nameOf(sender.transport)});
};
constexpr auto kPort = [](const log::SenderInfo& sender) {
    return sender.localPort != 0 ? Read(number(sender.localPort)) : std::nullopt;
};
constexpr auto kProbe = [](const log::SenderInfo& sender) {
    return sender.probe.empty() ? std::nullopt : Read({0, sender.probe});
};
constexpr auto kType = [](const wire::Header& header) { return header.type(); };
constexpr auto kIndex = [](const wire::Header& header) { return header.datagramIndex(); };
constexpr auto kLast = [](const wire::Header& header) { return header.isLast(); };

constexpr std::array kRows{
    Row{"type", Kind::Type, "", "message type: 02 and 2 are the same", fromHeader<kType>},
    Row{"source", Kind::Text, "", "where the packet came from: address and port, or file",
        fromSender<kAddress>},
    Row{"time", Kind::Number, "s", "since the first packet", always<kTime>},
    Row{"utc", Kind::Time, "s", "when it came: a time such as \"2026-01-31T12:00:00\"", always<kUtc>},
    Row{"number", Kind::Number, "", "of the packet, in the order of arrival", always<kNumber>},
    Row{"size", Kind::Number, "bytes", "of the packet", always<kSize>},
    Row{"delta", Kind::Number, "s", "since the packet before it in its stream", readDelta},
    Row{"gap", Kind::Number, "", "samples that are missing just before it", always<kGap>, true, true},
    Row{"duplicate", Kind::Flag, "", "the same sample and datagram came before", always<kDuplicate>, false,
        true},
    Row{"reordered", Kind::Flag, "", "came after a packet with a higher sample", always<kReordered>, false,
        true},
    Row{"restart", Kind::Flag, "", "the sender's counter restarted", always<kRestart>, false, true},
    Row{"drops", Kind::Number, "", "datagrams that this computer lost just before it", always<kDrops>, true},
    Row{"problem", Kind::Flag, "", "anything that an operator should look at", always<kProblem>, false, true},
    Row{"notice", Kind::Text, "", "what is odd but readable, such as \"notFinite\"", readNotice},
    Row{"error", Kind::Text, "", "why it cannot be read, such as \"itemsTruncated\"", readError},
    Row{"malformed", Kind::Flag, "", "begins with MXTP and cannot be read",
        always<isKind<PacketKind::Malformed>>},
    Row{"foreign", Kind::Flag, "", "does not begin with MXTP", always<isKind<PacketKind::Foreign>>},
    Row{"skipped", Kind::Flag, "", "bytes that belong to no datagram", always<isKind<PacketKind::Skipped>>},
    Row{"truncated", Kind::Flag, "", "was longer than what could be received", always<kTruncated>},
    Row{"datagram", Kind::Number, "", "index of the datagram in its sample, from 0", fromHeader<kIndex>},
    Row{"last", Kind::Flag, "", "the last datagram of its sample", fromHeader<kLast>},
    Row{"transport", Kind::Transport, "", "udp, tcp, file or performer", fromSender<kTransport>},
    Row{"port", Kind::Number, "", "of this computer, that the packet arrived at", fromSender<kPort>},
    Row{"probe", Kind::Text, "", "that received the packet; nothing if this computer did",
        fromSender<kProbe>},
};

template <class Code, std::size_t Count>
std::vector<std::string_view> namesOf(std::string_view (*name)(Code)) {
    std::vector<std::string_view> names;
    for (std::size_t code = 0; code < Count; ++code) {
        names.push_back(name(static_cast<Code>(code)));
    }
    return names;
}

std::vector<std::string_view> wordsOf(const Row& row) {
    std::vector<std::string_view> words;
    if (row.kind == Kind::Transport) {
        words.assign(log::kTransportNames.begin(), log::kTransportNames.end());
    } else if (row.kind == Kind::Flag) {
        words = {"true", "false"};
    } else if (row.read == &readError) {
        words = namesOf<wire::ErrorCode, wire::kErrorCodeCount>(wire::errorName);
    } else if (row.read == &readNotice) {
        words = namesOf<wire::NoticeCode, wire::kNoticeCodeCount>(wire::noticeName);
    }
    return words;
}

} // namespace

const wire::Header* Subject::header() {
    if (candidate.datagram != nullptr) {
        return &candidate.datagram->header;
    }
    if (!m_header && candidate.digest.kind == PacketKind::Malformed) {
        const auto header = wire::decodeHeader(candidate.packet.bytes);
        m_header = header ? std::optional(*header) : std::nullopt;
    }
    return m_header ? &*m_header : nullptr;
}

const std::vector<FieldInfo>& fieldTable() {
    static const auto table = [] {
        std::vector<FieldInfo> fields;
        for (const Row& row : kRows) {
            FieldInfo info;
            info.name = row.name;
            info.kind = row.kind;
            info.unit = row.unit;
            info.read = row.kind == Kind::Number ? findUnit(row.unit) : nullptr;
            info.dimension = info.read != nullptr ? info.read->dimension : Dimension::None;
            info.text = row.text;
            info.readPacket = row.read;
            info.words = wordsOf(row);
            info.isTrueByValue = row.isTrueByValue;
            info.isJudged = row.isJudged;
            fields.push_back(std::move(info));
        }
        std::ranges::move(wireFields(), std::back_inserter(fields));
        return fields;
    }();
    return table;
}

} // namespace posewire::field
