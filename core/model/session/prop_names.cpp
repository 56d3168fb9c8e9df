// SPDX-License-Identifier: MIT
#include "core/model/session/prop_names.h"

#include "core/model/body/null_pose.h"
#include "core/model/session/messages.h"
#include "core/wire/messages.h"

#include <variant>

namespace posewire::model {

std::string propName(const SessionView& session, const CharacterKey& key, const SegmentLayout& layout,
                     int prop) {
    const NullPose* nullPose = session.messages().nullPose(key);
    const auto place = static_cast<std::size_t>(layout.body + prop);
    if (nullPose != nullptr && nullPose->segments.size() == static_cast<std::size_t>(layout.count())) {
        return nullPose->segments[place].name.shown();
    }
    const Message* message = session.messages().message(key, wire::PropInformation::kType);
    const auto* sent =
        message == nullptr ? nullptr : std::get_if<wire::PropInformation>(&message->datagram.body);
    const bool isNamed = sent != nullptr && static_cast<std::size_t>(prop) < sent->props.size();
    return isNamed ? ForeignText(sent->props[static_cast<std::size_t>(prop)].name).shown() : std::string();
}

} // namespace posewire::model
