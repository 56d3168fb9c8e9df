// SPDX-License-Identifier: MIT
#include "core/wire/field.h"

namespace posewire::wire {

std::string_view unitSymbol(Unit unit) {
    switch (unit) {
    case Unit::None:
    case Unit::Identifier:
    case Unit::Count:
    case Unit::Flags:
    case Unit::Reserved:
    case Unit::TagLines:
    case Unit::TimeOfDay:
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

std::string_view scalarName(Scalar scalar) {
    constexpr std::array<std::string_view, 7> names{"uint8",   "uint16",     "uint32", "int32",
                                                    "float32", "characters", "text"};
    return names[static_cast<std::size_t>(scalar)];
}

std::span<const std::string_view> componentNames(std::size_t components) {
    static constexpr std::array<std::string_view, 3> vector{"x", "y", "z"};
    static constexpr std::array<std::string_view, 4> quaternion{"re", "i", "j", "k"};
    static constexpr std::array<std::string_view, 9> matrix{"1,1", "1,2", "1,3", "2,1", "2,2",
                                                            "2,3", "3,1", "3,2", "3,3"};
    switch (components) {
    case vector.size():
        return vector;
    case quaternion.size():
        return quaternion;
    case matrix.size():
        return matrix;
    default:
        return {};
    }
}

} // namespace posewire::wire
