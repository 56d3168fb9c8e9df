// SPDX-License-Identifier: MIT
#include "core/model/session/session.h"

namespace posewire::model {

void Session::setMarked(std::uint64_t packet, bool isMarked) {
    if (isMarked) {
        m_choices.annotations.marks.insert(packet);
    } else {
        m_choices.annotations.marks.erase(packet);
    }
}

void Session::setComment(std::uint64_t packet, std::string comment) {
    if (comment.empty()) {
        m_choices.annotations.comments.erase(packet);
    } else {
        m_choices.annotations.comments[packet] = std::move(comment);
    }
}

void Session::setHidden(const CharacterKey& key, bool isHidden) {
    if (isHidden) {
        m_choices.hidden.insert(key);
    } else {
        m_choices.hidden.erase(key);
    }
}

} // namespace posewire::model
