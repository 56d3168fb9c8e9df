// SPDX-License-Identifier: MIT
#include "core/log/recorded_origin.h"

#include <array>

namespace posewire::log {
namespace {

constexpr std::string_view kSignature = "Posewire: ";
constexpr std::array<std::string_view, 4> kTransports{"UDP", "TCP", "file", "performer"};
constexpr std::string_view kTruncated = "; truncated";
constexpr std::string_view kSkipped = "; between datagrams";
constexpr std::string_view kDropsAlone = "; news of drops";
constexpr std::string_view kStampedOnReading = "; stamped on reading";
constexpr std::string_view kFrom = "; from ";

bool takes(std::string_view& text, std::string_view prefix) {
    const bool isThere = text.starts_with(prefix);
    text.remove_prefix(isThere ? prefix.size() : 0);
    return isThere;
}

std::optional<Transport> takeTransport(std::string_view& text) {
    for (std::size_t i = 0; i < kTransports.size(); ++i) {
        if (takes(text, kTransports[i])) {
            return static_cast<Transport>(i);
        }
    }
    return std::nullopt;
}

} // namespace

std::string originText(const RecordedOrigin& origin) {
    std::string text(kSignature);
    text += kTransports[static_cast<std::size_t>(origin.transport)];
    text += origin.flags.truncated ? kTruncated : "";
    text += origin.flags.skipped ? kSkipped : "";
    text += origin.flags.isDropRecord ? kDropsAlone : "";
    text += origin.flags.stampedByKernel ? "" : kStampedOnReading;
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
    const auto transport = takeTransport(comment);
    if (!transport) {
        return std::nullopt;
    }
    origin.transport = *transport;
    origin.flags.truncated = takes(comment, kTruncated);
    origin.flags.skipped = takes(comment, kSkipped);
    origin.flags.isDropRecord = takes(comment, kDropsAlone);
    origin.flags.stampedByKernel = !takes(comment, kStampedOnReading);
    if (takes(comment, kFrom)) {
        origin.address = comment;
        comment = {};
    }
    return comment.empty() ? std::optional(origin) : std::nullopt;
}

} // namespace posewire::log
