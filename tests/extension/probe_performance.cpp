// SPDX-License-Identifier: MIT
#include "core/performer/messages.h"

namespace posewire::performer {

void perform(const Subject& subject, wire::Probe& message) {
    message.station = 7;
    for (std::uint32_t id = 1; id <= 4; ++id) {
        const auto seconds = static_cast<float>(subject.seconds);
        message.readings.push_back({id, 20.0F + seconds, {seconds, 0, 0}, -static_cast<std::int32_t>(id)});
    }
}

} // namespace posewire::performer
