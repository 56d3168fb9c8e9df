// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/performer/sending.h"
#include "core/wire/codec.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace posewire::performer {

struct ContentBreakSettings {
    std::string kind; ///< one of contentBreaks()
    double fromSeconds = 0.0;
};
/// Named as what the report says of them; "floor" is a convention there, "header" makes a datagram malformed.
[[nodiscard]] std::vector<std::string_view> contentBreaks();

/// A sender that fills its datagrams wrongly in one way: the headers of all that count samples, or the poses.
class ContentBreak {
public:
    /// The kind must be one of contentBreaks().
    explicit ContentBreak(ContentBreakSettings settings) : m_settings(std::move(settings)) {}

    /// Breaks what leaves at its time. What the network damaged stays as it is.
    void apply(Sending& sending);

private:
    struct Stream {
        log::Duration since{};  ///< of its first broken datagram
        wire::Datagram first{}; ///< that one, before it was
    };
    ContentBreakSettings m_settings;
    std::map<std::pair<std::uint8_t, std::uint8_t>, Stream> m_streams; ///< by character and type
};

} // namespace posewire::performer
