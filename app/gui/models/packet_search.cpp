// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/packet_search.h"

#include "app/gui/theme/words.h"
#include "core/log/log_reader.h"
#include "core/wire/text.h"

#include <QRegularExpression>

#include <algorithm>

namespace posewire::gui {

namespace {

/// So many packets are looked at before what the log has dropped is let go.
constexpr std::uint64_t kPacketsAtATime = 8192;

std::byte folded(std::byte byte) {
    const auto value = std::to_integer<unsigned char>(byte);
    return value >= 'A' && value <= 'Z' ? static_cast<std::byte>(value + ('a' - 'A')) : byte;
}

} // namespace

tl::expected<BytePattern, QString> parsePattern(const QString& text, bool isHexadecimal) {
    if (!isHexadecimal) {
        BytePattern pattern{{}, true};
        const QByteArray utf8 = text.toUtf8();
        const auto bytes = std::as_bytes(std::span(utf8.constData(), static_cast<std::size_t>(utf8.size())));
        pattern.bytes.assign(bytes.begin(), bytes.end());
        std::ranges::transform(pattern.bytes, pattern.bytes.begin(), folded);
        return pattern;
    }
    static const QRegularExpression between(QStringLiteral("0[xX]|[\\s,;:]"));
    QString digits = text;
    digits.remove(between);
    auto bytes = wire::fromHexadecimal(digits.toStdString());
    if (!bytes) {
        return tl::unexpected(tr("Write whole bytes, two digits 0–9 and a–f each, such as 4d 58 54 50."));
    }
    return BytePattern{std::move(*bytes), false};
}

std::optional<std::size_t> findPattern(const BytePattern& pattern, wire::Bytes bytes) {
    if (pattern.bytes.empty()) {
        return std::nullopt;
    }
    const auto place = std::search(bytes.begin(), bytes.end(), pattern.bytes.begin(), pattern.bytes.end(),
                                   [&](std::byte byte, std::byte wanted) {
                                       return (pattern.ignoresCase ? folded(byte) : byte) == wanted;
                                   });
    return place == bytes.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(place - bytes.begin()));
}

PacketSearch::PacketSearch(const log::PacketLog& log, Request request)
    : m_log(log), m_request(std::move(request)) {
    m_thread = std::thread([this] { run(); });
}

PacketSearch::~PacketSearch() {
    m_isCancelled.store(true, std::memory_order_relaxed);
    if (m_thread.joinable()) {
        m_thread.join();
    }
}

std::optional<PacketSearch::Result> PacketSearch::result() const {
    return m_isDone.load(std::memory_order_acquire) ? std::optional(m_result) : std::nullopt;
}

PacketSearch::Result PacketSearch::wait() {
    m_thread.join();
    return m_result;
}

void PacketSearch::run() {
    log::LogReader reader(m_log);
    const std::vector<std::uint64_t>& among = m_request.among;
    const std::uint64_t base = among.empty() ? reader.begin() : 0;
    const std::uint64_t count = among.empty() ? reader.end() - base : among.size();
    const auto numberAt = [&](std::uint64_t place) { return among.empty() ? base + place : among[place]; };
    // Places of the packets before the start, and of those up to and with it.
    const auto placeOf = [&](std::uint64_t number) {
        return among.empty()
                   ? std::clamp(number, base, base + count) - base
                   : static_cast<std::uint64_t>(std::ranges::lower_bound(among, number) - among.begin());
    };
    const std::uint64_t start = m_request.isForward ? placeOf(m_request.from + 1) : placeOf(m_request.from);
    for (std::uint64_t i = 0; i < count && !m_isCancelled.load(std::memory_order_relaxed); ++i) {
        const std::uint64_t place =
            m_request.isForward ? (start + i) % count : (start + 2 * count - 1 - i) % count;
        if (i % kPacketsAtATime == kPacketsAtATime - 1) {
            reader.refresh();
        }
        const auto packet = reader.packet(numberAt(place));
        const auto offset = packet ? findPattern(m_request.pattern, packet->bytes) : std::nullopt;
        if (offset) {
            m_result = {packet->number, *offset, m_request.isForward ? place < start : place >= start};
            break;
        }
    }
    m_isDone.store(true, std::memory_order_release);
}

} // namespace posewire::gui
