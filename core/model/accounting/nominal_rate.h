// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace posewire::model {

/// The sender's own frame rate: how far its time code advances with its sample counter. Receive times play no
/// part, so it is the rate that should be, beside the measured one. Rests on the last 10 to 20 s;
/// O(1).
class NominalRate {
public:
    /// Sample counter and header time code (ms) of a message, oldest first; the same one may come again. A
    /// jump of either starts over.
    void add(std::uint32_t sample, std::uint32_t timeCode);

    /// Samples of the capture a second; nothing before the time code has advanced by half a second. A whole
    /// number where the resolution of the time code cannot show the difference.
    [[nodiscard]] std::optional<double> frameHz() const;

private:
    struct Mark {
        std::uint32_t sample = 0;
        std::uint32_t timeCode = 0;
    };
    [[nodiscard]] bool continues(const Mark& mark) const;

    bool m_hasMarks = false;
    Mark m_base;
    Mark m_nextBase;
    Mark m_newest;
};

} // namespace posewire::model
