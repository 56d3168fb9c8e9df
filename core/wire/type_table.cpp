// SPDX-License-Identifier: MIT
#include "core/wire/type_table.h"

namespace posewire::wire {
namespace {

constexpr std::array<TypeInfo, 15> kTypes{{
    {1, "Pose, Euler", "Y-up, right-handed", "E–N", "2.5.1",
     "Centimetres and degrees. The same data as type 02: (x, y, z) is 100 · (y, z, x) of it.", true},
    {2, "Pose, quaternion", "Z-up, right-handed", "E–N", "2.5.2",
     "Metres on the wire, although the text says centimetres.", true},
    {3, "Point positions", "Y-up, right-handed", "E–N", "2.5.3",
     "Point IDs are 256 × segment + point, in older revisions 100 × segment + point.", true},
    {4, "Tag positions", "Y-up, right-handed", "E", "E 2.5",
     "Deprecated since J. Newer programs use the number for a layout that is not published.", true},
    {5, "Pose, Unity3D", "Y-up, left-handed", "F–N", "2.5.5",
     "The pelvis is global, all others are relative to their parents, in an order of their own.", true},
    {10, "Scale (deprecated)", "Z-up, right-handed", "E", "E 2.6", "Replaced by type 13.", false},
    {11, "Props (deprecated)", "", "E", "E 2.6", "Names end with a zero byte. Replaced by type 13.", false},
    {12, "Metadata", "", "E–N", "2.6.3",
     "Real senders put a length before the text; revision E has the bare text. The tags count and timeOffset "
     "are "
     "not documented.",
     false},
    {13, "Null pose", "Z-up, right-handed", "J–N", "2.6.4",
     "Comes in several datagrams with sample counter 0: segments first, then points. Metres.", false},
    {20, "Joint angles", "ISB axes", "J–N", "2.7.1",
     "Six ergonomic angles may follow the 22 joints; two of them have the same pair of IDs.", true},
    {21, "Linear kinematics", "Z-up, right-handed", "J–N", "2.7.2", "", true},
    {22, "Angular kinematics", "Z-up, right-handed", "J–N", "2.7.3", "Radians per second.", true},
    {23, "Trackers", "Z-up, right-handed", "J–N", "2.7.4",
     "68 bytes an item on the wire; 44 in the text since M. The payload size tells.", true},
    {24, "Centre of mass", "Z-up, right-handed", "J–N", "2.7.5",
     "Recent senders add velocity and acceleration (36 bytes).", true},
    {25, "Time code", "", "J–N", "2.7.6", "Real senders put the length 12 before the text.", true},
}};

} // namespace

std::span<const TypeInfo> typeTable() {
    return kTypes;
}

const TypeInfo* findType(std::uint8_t type) {
    for (const TypeInfo& row : kTypes) {
        if (row.type == type) {
            return &row;
        }
    }
    return nullptr;
}

std::array<char, 2> typeDigits(std::uint8_t type) {
    return {static_cast<char>('0' + type / 10 % 10), static_cast<char>('0' + type % 10)};
}

std::string typeTitle(std::uint8_t type) {
    const TypeInfo* row = findType(type);
    const auto digits = typeDigits(type);
    return std::string(digits.data(), digits.size()) + ' ' +
           std::string(row != nullptr ? row->name : "unknown type");
}

bool isSampled(std::uint8_t type) {
    const TypeInfo* row = findType(type);
    return row == nullptr || row->isSampled;
}

} // namespace posewire::wire
