// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/field.h"
#include "core/wire/type_table.h"

#include <vector>

/// A message type that no sender has, added by the steps of CONTRIBUTING.md and nothing else. Included in
/// front of every unit of the copy of core that is built here. WITHOUT_… leaves a step out.
#define POSEWIRE_FURTHER_MESSAGES , Probe

namespace posewire::wire {

struct ProbeReading {
    std::uint32_t id = 0;
    float temperature = 0;
    Vec3 wind{};
    std::int32_t level = 0;
    friend bool operator==(const ProbeReading&, const ProbeReading&) = default;
};

struct Probe {
    static constexpr std::uint8_t kType = 26;
    std::uint16_t station = 0;
    std::vector<ProbeReading> readings;
    friend bool operator==(const Probe&, const Probe&) = default;
};

#ifndef WITHOUT_LAYOUT
template <>
inline constexpr auto kLayout<ProbeReading> = std::tuple{
    Field<&ProbeReading::id>{
        {"id", Unit::Identifier, "segment that carries the probe", "P 1.2", RefersTo::Segment}},
    Field<&ProbeReading::temperature>{{"temperature", Unit::ArbitraryUnits, "of the air", "P 1.2"}},
    Field<&ProbeReading::wind>{{"wind", Unit::MetresPerSecond, "global, Z-up", "P 1.2"}},
    Field<&ProbeReading::level>{{"level", Unit::None, "above or below the last", "P 1.2"}},
};
static_assert(kWireSize<ProbeReading> == 24);

template <>
inline constexpr auto kLayout<Probe> = std::tuple{
    Field<&Probe::station>{{"station", Unit::Count, "which station", "P 1.1"}},
    Items<&Probe::readings>{{"readings", Unit::None, "one a probe", "P 1.1", RefersTo::Segment}},
};
#endif

#ifndef WITHOUT_ROW
template <>
inline constexpr TypeInfo kRow<Probe>{"Probes", Frame::ZUp, "N", "P 1", "Only a test."};
#endif

} // namespace posewire::wire

namespace posewire::performer {

struct Subject;
#ifndef WITHOUT_PERFORMER
void perform(const Subject& subject, wire::Probe& message);
#endif

} // namespace posewire::performer
