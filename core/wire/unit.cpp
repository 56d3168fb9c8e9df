// SPDX-License-Identifier: MIT
#include "core/wire/field.h"

namespace posewire::wire {

std::string_view unitSymbol(Unit unit) {
    switch (unit) {
    case Unit::None:
    case Unit::Identifier:
    case Unit::Count:
    case Unit::Flags:
        return "";
    case Unit::ByteCount:
        return "bytes";
    case Unit::Milliseconds:
        return "ms";
    case Unit::Metres:
        return "m";
    case Unit::Centimetres:
        return "cm";
    case Unit::Degrees:
        return "°";
    case Unit::MetresPerSecond:
        return "m/s";
    case Unit::MetresPerSecondSquared:
        return "m/s²";
    case Unit::RadiansPerSecond:
        return "rad/s";
    case Unit::RadiansPerSecondSquared:
        return "rad/s²";
    case Unit::ArbitraryUnits:
        return "a.u.";
    }
    return "";
}

} // namespace posewire::wire
