// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/character_health.h"

#include "app/gui/models/stream_state.h"
#include "core/log/time.h"
#include "core/model/body/character_pose.h"

#include <QCoreApplication>

#include <algorithm>

namespace posewire::gui {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("CharacterHealth", text);
}

/// Of the poses that are shown; 0 where there is none.
double poseRateHz(model::SessionView& session, const model::CharacterKey& key) {
    const model::CharacterPose* pose = session.pose(key);
    const model::Stream* stream =
        pose == nullptr ? nullptr : session.find(log::StreamKey{key.sender, key.character, pose->type});
    return stream == nullptr ? 0 : stream->statistics.rateHz();
}

} // namespace

double shownAgeSeconds(model::SessionView& session, const model::CharacterKey& key) {
    const model::CharacterPose* pose = session.pose(key);
    if (pose == nullptr) {
        return session.ageSeconds(key);
    }
    return std::max(0.0, log::secondsOf(session.cursorStamp() - pose->stamp));
}

CharacterHealth characterHealth(model::SessionView& session, const model::CharacterKey& key) {
    const double age = shownAgeSeconds(session, key);
    const model::Character* character = session.find(key);
    const PropertyValue state = character == nullptr ? PropertyValue{} : characterState(session, *character);
    if (state.health != Health::Good) {
        return {state.health, state.text, age};
    }
    if (session.pose(key) == nullptr) {
        return {Health::Good, tr("no pose"), age};
    }
    const double rateHz = poseRateHz(session, key);
    return {Health::Good, rateHz <= 0 ? tr("one sample") : tr("%1 Hz").arg(rateHz, 0, 'f', 0), age};
}

} // namespace posewire::gui
