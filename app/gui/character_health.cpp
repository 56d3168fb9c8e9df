// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/character_health.h"

#include "app/gui/models/stream_state.h"
#include "app/gui/models/text.h"

#include <QCoreApplication>

#include <algorithm>

namespace posewire::gui {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("CharacterHealth", text);
}

/// Counts over all streams of a character.
struct Totals {
    std::uint64_t lost = 0;
    std::uint64_t malformed = 0;
    double rateHz = 0;
};

Totals totalsOf(const model::Session& session, const model::CharacterKey& key) {
    Totals totals;
    const model::CharacterPose* pose = session.pose(key);
    for (const model::Stream& stream : session.streams()) {
        if (stream.key.source != key.source || stream.key.character != key.character) {
            continue;
        }
        totals.malformed += stream.malformed;
        if (pose != nullptr && stream.key.type == pose->type) {
            totals.lost = stream.accounting.counts().lost;
            totals.rateHz = stream.statistics.rateHz();
        }
    }
    return totals;
}

/// What does not fit together about the sender, in brief; empty where all does.
QString contradictionOf(const model::Session& session, const model::CharacterKey& key) {
    const model::Source* source = session.find(key.source);
    const auto found = source != nullptr ? source->contradictions() : std::vector<model::Contradiction>();
    return found.empty() ? QString() : QString::fromStdString(found.front().brief);
}

} // namespace

double shownAgeSeconds(const model::Session& session, const model::CharacterKey& key) {
    const model::CharacterPose* pose = session.pose(key);
    if (pose == nullptr) {
        return session.ageSeconds(key);
    }
    return std::max(0.0, static_cast<double>(session.cursorStampNs() - pose->stampNs) * 1e-9);
}

CharacterHealth characterHealth(const model::Session& session, const model::CharacterKey& key) {
    const double age = shownAgeSeconds(session, key);
    const Totals totals = totalsOf(session, key);
    if (age >= kStaleAge) {
        return {Health::Error, tr("stale %1").arg(duration(age)), age};
    }
    if (age >= kSilentAge) {
        return {Health::Warning, tr("silent %1").arg(duration(age)), age};
    }
    if (session.pose(key) == nullptr) {
        return {Health::Warning, tr("no pose"), age};
    }
    if (totals.malformed > 0) {
        return {Health::Error, tr("%1 malformed").arg(grouped(totals.malformed)), age};
    }
    if (const QString words = contradictionOf(session, key); !words.isEmpty()) {
        return {Health::Warning, words, age};
    }
    if (totals.lost > 0) {
        return {Health::Warning, tr("%1 lost").arg(grouped(totals.lost)), age};
    }
    if (totals.rateHz <= 0) {
        return {Health::Good, tr("one sample"), age};
    }
    return {Health::Good, tr("%1 Hz").arg(totals.rateHz, 0, 'f', 0), age};
}

} // namespace posewire::gui
