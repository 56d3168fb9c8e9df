// SPDX-License-Identifier: MIT
#include "core/log/pcapng_format.h"

#include <algorithm>
#include <array>
#include <utility>

namespace posewire::log {
namespace {

constexpr std::string_view kSignature = "Posewire: ";
constexpr std::array<std::string_view, 4> kTransports{"UDP", "TCP", "file", "performer"};
constexpr std::array<std::pair<bool PacketFlags::*, std::string_view>, 3> kFlags{
    {{&PacketFlags::truncated, "; truncated"},
     {&PacketFlags::skipped, "; between datagrams"},
     {&PacketFlags::isDropRecord, "; news of drops"}}};
constexpr std::string_view kStampedOnReading = "; stamped on reading";
constexpr std::string_view kFrom = "; from ";

bool takes(std::string_view& text, std::string_view prefix) {
    const bool isThere = text.starts_with(prefix);
    text.remove_prefix(isThere ? prefix.size() : 0);
    return isThere;
}

} // namespace

std::string originText(const RecordedOrigin& origin) {
    std::string text(kSignature);
    text += kTransports[static_cast<std::size_t>(origin.transport)];
    for (const auto& [flag, words] : kFlags) {
        text += origin.flags.*flag ? words : "";
    }
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
    const auto transport =
        std::ranges::find_if(kTransports, [&](std::string_view name) { return takes(comment, name); });
    if (transport == kTransports.end()) {
        return std::nullopt;
    }
    origin.transport = static_cast<Transport>(transport - kTransports.begin());
    for (const auto& [flag, words] : kFlags) {
        origin.flags.*flag = takes(comment, words);
    }
    origin.flags.stampedByKernel = !takes(comment, kStampedOnReading);
    if (takes(comment, kFrom)) {
        origin.address = comment;
        comment = {};
    }
    return comment.empty() ? std::optional(origin) : std::nullopt;
}

} // namespace posewire::log
