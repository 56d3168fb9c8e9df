// SPDX-License-Identifier: MIT
#include "core/model/body/provenance.h"

#include <cctype>
#include <string_view>

namespace posewire::model {
namespace {

std::string_view wordOf(Provenance provenance) {
    switch (provenance) {
    case Provenance::Sent:
        return "sent";
    case Provenance::Solved:
        return "solved";
    case Provenance::Assumed:
        return "assumed";
    case Provenance::None:
        break;
    }
    return "missing";
}

} // namespace

std::string sourceText(const SegmentSource& source) {
    std::string text;
    if (source.position == source.orientation) {
        text = wordOf(source.position);
        text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    } else {
        text.append("Position ").append(wordOf(source.position));
        text.append(", orientation ").append(wordOf(source.orientation));
    }
    return source.isTwistAssumed ? text + ", turn about itself assumed" : text;
}

} // namespace posewire::model
