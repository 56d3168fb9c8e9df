// SPDX-License-Identifier: MIT
#include "core/log/pcapng_writer.h"

#include "core/log/ip_packet.h"
#include "core/wire/header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace posewire::log {
namespace {

constexpr std::size_t kLongestText = 65'000; ///< the length of an option has 16 bits
constexpr std::uint16_t kRawIp = 101;        ///< LINKTYPE_RAW

/// Where stamps of the second interface begin, in seconds since 1970: in 1684, before all that readFile()
/// gives.
constexpr std::int64_t kEarly = -9'000'000'000;

constexpr std::string_view kSignature = "Posewire: ";
constexpr std::array<std::string_view, 4> kTransports{"UDP", "TCP", "file", "performer"};
constexpr std::array<std::string_view, 7> kFlags{"; truncated",
                                                 "; between datagrams",
                                                 "; news of drops",
                                                 "; first after the input was closed",
                                                 "; from before the take",
                                                 "; lost on the way from the probe",
                                                 "; drops not counted"};
constexpr std::string_view kShared = "; datagrams in its packet: ";
constexpr std::string_view kStampedOnReading = "; stamped on reading";
constexpr std::string_view kClockSet = "; clock set by ";
constexpr std::string_view kProbe = "; received by probe ";
constexpr std::string_view kFrom = "; from ";
constexpr std::string_view kMarkNote = "Mark on packet ";
constexpr std::string_view kPacketMark = "Mark";
constexpr std::string_view kMarkedAt = " at ";
constexpr std::string_view kMarkComment = ": ";
constexpr std::string_view kReceivedFor = "received for ";
constexpr std::string_view kTheLast = ", the last ";
constexpr std::string_view kReceiveBuffer = " without a packet; receive buffer ";
constexpr std::string_view kBytes = " bytes";

bool takes(std::string_view& text, std::string_view prefix) {
    const bool isThere = text.starts_with(prefix);
    text.remove_prefix(isThere ? prefix.size() : 0);
    return isThere;
}

/// Builds one block in a buffer that is used again and again; little-endian.
class PcapngBlock {
public:
    /// Begins the block; `buffer` is cleared.
    PcapngBlock(std::vector<std::byte>& buffer, PcapngBlockType type) : m_buffer(buffer) {
        m_buffer.clear();
        number(static_cast<std::uint32_t>(type), 4);
        number(0, 4); // the length, once it is known
    }

    void number(std::uint64_t value, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i) {
            m_buffer.push_back(static_cast<std::byte>(value >> 8 * i & 0xffU));
        }
    }
    /// A stamp, or any number of 64 bits of which the upper half comes first.
    void halves(std::uint64_t value) {
        number(value >> 32, 4);
        number(value & 0xffffffffU, 4);
    }
    /// Followed by what is missing to a multiple of four bytes.
    void padded(std::span<const std::byte> bytes) {
        m_buffer.insert(m_buffer.end(), bytes.begin(), bytes.end());
        m_buffer.resize((m_buffer.size() + 3) / 4 * 4);
    }

    void option(PcapngOption code, std::span<const std::byte> bytes) {
        beginOption(code, bytes.size());
        padded(bytes);
    }
    /// Empty if `text` is empty.
    void option(PcapngOption code, std::string_view text) {
        if (!text.empty()) {
            option(code, std::as_bytes(std::span(text)));
        }
    }
    void option(PcapngOption code, std::uint64_t value) {
        beginOption(code, 8);
        number(value, 8);
    }
    void halvesOption(PcapngOption code, std::uint64_t value) {
        beginOption(code, 8);
        halves(value);
    }

    /// Ends the list of options, if there were any, and the block.
    void finish() {
        if (m_hasOptions) {
            number(0, 4);
        }
        const std::size_t length = m_buffer.size() + 4;
        number(length, 4);
        std::copy(m_buffer.end() - 4, m_buffer.end(), m_buffer.begin() + 4);
    }

private:
    void beginOption(PcapngOption code, std::size_t size) {
        m_hasOptions = true;
        number(static_cast<std::uint16_t>(code), 2);
        number(size, 2);
    }

    std::vector<std::byte>& m_buffer;
    bool m_hasOptions = false;
};

/// At most kLongestText bytes of a text, cut between characters of UTF-8.
std::string_view clipped(std::string_view text) {
    std::size_t most = kLongestText;
    if (text.size() <= most) {
        return text;
    }
    while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xc0U) == 0x80U) {
        --most;
    }
    return text.substr(0, most);
}

struct Ends {
    IpEndpoint sender;
    IpEndpoint target;
};

/// The address a packet came to is not known, but that this computer sends to itself over loopback.
Ends endsOf(const SenderInfo& info) {
    const bool isNetwork = info.transport == Transport::Udp || info.transport == Transport::Tcp;
    const auto found = isNetwork ? parseIpEndpoint(info.address) : std::nullopt;
    Ends ends{found.value_or(IpEndpoint{}), {}};
    ends.target.address.isIpv6 = ends.sender.address.isIpv6;
    if (isLoopback(ends.sender.address)) {
        ends.target.address = ends.sender.address;
    }
    ends.target.port = info.localPort;
    return ends;
}

/// Of "-1.500000000 s".
std::optional<Duration> takeSeconds(std::string_view& text) {
    const bool isNegative = takes(text, "-");
    std::uint64_t whole = 0;
    const auto seconds = std::from_chars(text.data(), text.data() + text.size(), whole);
    constexpr std::uint64_t most = 9'000'000'000;
    const auto used = static_cast<std::size_t>(seconds.ptr - text.data());
    if (seconds.ec != std::errc() || whole > most || text.size() < used + 12 || text[used] != '.') {
        return std::nullopt;
    }
    std::uint64_t fraction = 0;
    const char* end = text.data() + used + 10;
    const auto decimals = std::from_chars(text.data() + used + 1, end, fraction);
    text.remove_prefix(used + 10);
    if (decimals.ec != std::errc() || decimals.ptr != end || !takes(text, " s")) {
        return std::nullopt;
    }
    const auto size = static_cast<std::int64_t>(whole * 1'000'000'000 + fraction);
    return Duration(isNegative ? -size : size);
}

RecordedOrigin originOf(const Packet& packet, const SenderInfo& sender, const Ends& ends, Duration setBy) {
    constexpr std::size_t ipv4Most = 65'507;
    const bool isMapped = !ends.sender.address.isIpv6 && packet.bytes.size() > ipv4Most;
    const bool isInHeaders = !isMapped && endpointText(ends.sender) == sender.address;
    return {sender.transport, packet.flags, isInHeaders ? std::nullopt : std::optional(sender.address), setBy,
            sender.probe};
}

} // namespace

std::string originText(const RecordedOrigin& origin) {
    std::string text(kSignature);
    text += kTransports[static_cast<std::size_t>(origin.transport)];
    const PacketFlags& flags = origin.flags;
    const std::array said{flags.truncated,    flags.skipped,     flags.isDropRecord,  flags.afterClosed,
                          flags.isFromBefore, flags.isLostOnWay, flags.dropsUncounted};
    for (std::size_t i = 0; i < kFlags.size(); ++i) {
        text += said[i] ? kFlags[i] : "";
    }
    text += origin.flags.stampedByKernel ? "" : kStampedOnReading;
    if (flags.shared != 0) {
        text.append(kShared) += static_cast<char>('0' + flags.shared);
    }
    if (origin.setBy != Duration::zero()) {
        text.append(kClockSet).append(secondsText(origin.setBy)).append(" s");
    }
    if (!origin.probe.empty()) {
        text.append(kProbe).append(origin.probe);
    }
    if (origin.address) {
        text.append(kFrom).append(*origin.address); // last, as it may hold anything
    }
    return text;
}

std::optional<RecordedOrigin> parseOrigin(std::string_view comment) {
    RecordedOrigin origin;
    if (!takes(comment, kSignature)) {
        return std::nullopt;
    }
    const auto transport =
        std::ranges::find_if(kTransports, [&](std::string_view name) { return takes(comment, name); });
    if (transport == kTransports.end()) {
        return std::nullopt;
    }
    origin.transport = static_cast<Transport>(transport - kTransports.begin());
    std::array<bool, kFlags.size()> said{};
    std::ranges::transform(kFlags, said.begin(), [&](auto words) { return takes(comment, words); });
    origin.flags = {.truncated = said[0],
                    .stampedByKernel = !takes(comment, kStampedOnReading),
                    .skipped = said[1],
                    .isDropRecord = said[2],
                    .afterClosed = said[3],
                    .isFromBefore = said[4],
                    .isLostOnWay = said[5],
                    .dropsUncounted = said[6]};
    if (takes(comment, kShared) && !comment.empty()) {
        origin.flags.shared = static_cast<unsigned>(comment.front() - '0') & PacketFlags::kMostShared;
        comment.remove_prefix(1);
    }
    if (takes(comment, kClockSet)) {
        const auto setBy = takeSeconds(comment);
        if (!setBy) {
            return std::nullopt;
        }
        origin.setBy = *setBy;
    }
    if (takes(comment, kProbe)) {
        origin.probe = comment.substr(0, comment.find(';'));
        comment.remove_prefix(origin.probe.size());
    }
    if (takes(comment, kFrom)) {
        origin.address = comment;
        comment = {};
    }
    return comment.empty() ? std::optional(origin) : std::nullopt;
}

std::string packetMarkText(const std::string& comment) {
    return std::string(kPacketMark).append(comment.empty() ? std::string() : kMarkComment.data() + comment);
}

std::optional<std::string> parsePacketMark(std::string_view comment) {
    if (!takes(comment, kPacketMark) || !(comment.empty() || takes(comment, kMarkComment))) {
        return std::nullopt;
    }
    return std::string(comment);
}

std::string receptionText(const Reception& reception) {
    std::string text(kSignature);
    text.append(kReceivedFor).append(secondsText(reception.time)).append(" s");
    text.append(kTheLast).append(secondsText(reception.afterLast)).append(" s");
    return text.append(kReceiveBuffer).append(std::to_string(reception.receiveBufferBytes)).append(kBytes);
}

std::optional<Reception> parseReception(std::string_view note) {
    Reception reception;
    if (!takes(note, kSignature) || !takes(note, kReceivedFor)) {
        return std::nullopt;
    }
    const auto time = takeSeconds(note);
    const auto afterLast = takes(note, kTheLast) ? takeSeconds(note) : std::nullopt;
    // A year after any stamp that readFile() gives is still a stamp.
    constexpr Duration most = std::chrono::hours(24) * 365;
    const auto isSound = [most](const std::optional<Duration>& one) {
        return one && *one >= Duration::zero() && *one <= most;
    };
    if (!isSound(time) || !isSound(afterLast) || !takes(note, kReceiveBuffer)) {
        return std::nullopt;
    }
    const auto bytes = std::from_chars(note.data(), note.data() + note.size(), reception.receiveBufferBytes);
    note.remove_prefix(static_cast<std::size_t>(bytes.ptr - note.data()));
    if (bytes.ec != std::errc() || note != kBytes) {
        return std::nullopt;
    }
    reception.time = *time;
    reception.afterLast = *afterLast;
    return reception;
}

std::optional<Reception> receptionIn(std::span<const std::string_view> notes) {
    std::optional<Reception> found;
    for (const std::string_view note : notes) {
        const auto reception = parseReception(note);
        found = reception ? reception : found;
    }
    return found;
}

std::string markText(const RecordedMark& mark) {
    std::string text(kMarkNote);
    text.append(std::to_string(mark.packet));
    if (!mark.time.empty()) {
        text.append(kMarkedAt).append(mark.time);
    }
    if (!mark.comment.empty()) {
        text.append(kMarkComment).append(mark.comment);
    }
    return text;
}

std::optional<RecordedMark> parseMark(std::string_view note) {
    RecordedMark mark;
    if (!takes(note, kMarkNote)) {
        return std::nullopt;
    }
    const auto number = std::from_chars(note.data(), note.data() + note.size(), mark.packet);
    note.remove_prefix(static_cast<std::size_t>(number.ptr - note.data()));
    if (number.ec != std::errc()) {
        return std::nullopt;
    }
    if (takes(note, kMarkedAt)) {
        const std::size_t end = std::min(note.find(kMarkComment), note.size());
        mark.time = note.substr(0, end);
        note.remove_prefix(end);
    }
    if (takes(note, kMarkComment)) {
        mark.comment = note;
        note = {};
    }
    return note.empty() ? std::optional(mark) : std::nullopt;
}

PcapngWriter::Result PcapngWriter::begin(const RecordingInfo& info) {
    PcapngBlock section(m_block, PcapngBlockType::SectionHeader);
    section.number(0x1a2b3c4d, 4);
    section.number(1, 2); // version 1.0
    section.number(0, 2);
    section.number(~std::uint64_t{0}, 8); // of a length that is not known
    section.option(PcapngOption::Hardware, clipped(info.hardware));
    section.option(PcapngOption::System, clipped(info.system));
    section.option(PcapngOption::Application, clipped(info.application));
    section.finish();
    if (auto result = write(); !result) {
        return result;
    }
    return beginInterface(0);
}

PcapngWriter::Result PcapngWriter::beginInterface(std::int64_t offsetSeconds) {
    constexpr std::array<std::byte, 1> nanoseconds{std::byte{9}};
    PcapngBlock interface(m_block, PcapngBlockType::Interface);
    interface.number(kRawIp, 2);
    interface.number(0, 2);
    interface.number(0, 4); // packets are never cut
    interface.option(PcapngOption::InterfaceName, "posewire");
    interface.option(PcapngOption::InterfaceDescription,
                     "MXTP datagrams as received; IP and UDP headers are made up");
    interface.option(PcapngOption::StampResolution, nanoseconds);
    if (offsetSeconds != 0) {
        interface.option(PcapngOption::StampOffset, static_cast<std::uint64_t>(offsetSeconds));
    }
    interface.finish();
    return write();
}

PcapngWriter::Result PcapngWriter::add(const Packet& packet, const SenderInfo& sender,
                                       std::span<const std::string> comments, Duration setBy) {
    m_setBefore = m_setBefore.value_or(setBy);
    const WallTime time = asWallTime(packet.stamp + setBy);
    const Ends ends = endsOf(sender);
    m_frame.clear();
    appendUdpFrame(m_frame, ends.sender, ends.target, packet.bytes);
    const bool isEarly = time < WallTime();
    if (isEarly && !std::exchange(m_hasEarlyInterface, true)) {
        if (auto begun = beginInterface(kEarly); !begun) {
            return begun;
        }
    }
    const Duration since = isEarly ? time - WallTime(std::chrono::seconds(kEarly)) : time.time_since_epoch();
    PcapngBlock block(m_block, PcapngBlockType::EnhancedPacket);
    block.number(isEarly ? 1 : 0, 4);
    block.halves(static_cast<std::uint64_t>(since.count()));
    block.number(m_frame.size(), 4);
    block.number(m_frame.size(), 4);
    m_packetOffset = m_bytes + m_block.size() + m_frame.size() - packet.bytes.size();
    block.padded(m_frame);
    const RecordedOrigin origin = originOf(packet, sender, ends, setBy - *m_setBefore);
    const bool isMistakable =
        std::ranges::any_of(comments, [](const std::string& text) { return parseOrigin(text).has_value(); });
    const bool headersAreEnough = origin == RecordedOrigin{} && wire::startsWithMagic(packet.bytes);
    if (!headersAreEnough || isMistakable) {
        block.option(PcapngOption::Comment, clipped(originText(origin)));
    }
    for (const std::string& comment : comments) {
        block.option(PcapngOption::Comment, clipped(comment));
    }
    if (packet.kernelDropsBefore != 0) {
        block.option(PcapngOption::DropCount, std::uint64_t{packet.kernelDropsBefore});
    }
    block.finish();
    ++m_packets;
    m_kernelDrops += packet.droppedBefore();
    if (!isEarly) { // the statistics are of the first interface
        m_firstTime = std::min(m_firstTime, time);
        m_lastTime = std::max(m_lastTime, time);
    }
    return write();
}

PcapngWriter::Result PcapngWriter::addStatistics(std::span<const std::string> notes) {
    const auto last = static_cast<std::uint64_t>(nanosecondsOf(m_lastTime));
    const auto first =
        m_firstTime <= m_lastTime ? static_cast<std::uint64_t>(nanosecondsOf(m_firstTime)) : last;
    PcapngBlock block(m_block, PcapngBlockType::InterfaceStatistics);
    block.number(0, 4);
    block.halves(last);
    for (const std::string& note : notes) {
        block.option(PcapngOption::Comment, clipped(note));
    }
    block.halvesOption(PcapngOption::StartTime, first);
    block.halvesOption(PcapngOption::EndTime, last);
    block.option(PcapngOption::Received, m_packets + m_kernelDrops);
    block.option(PcapngOption::DroppedBySystem, m_kernelDrops);
    block.option(PcapngOption::Delivered, m_packets);
    block.finish();
    return write();
}

PcapngWriter::Result PcapngWriter::write() {
    m_bytes += m_block.size();
    return m_sink.write(m_block);
}

} // namespace posewire::log
