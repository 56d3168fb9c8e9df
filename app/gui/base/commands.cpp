// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/commands.h"

#include "core/model/session/accounts.h"

namespace posewire::gui {

namespace {

/// A packet with its sender and character; none if there is no such packet.
std::optional<model::Selection> selectionOf(const model::SessionView& session, std::uint64_t number) {
    const auto packet = session.packet(number);
    const model::PacketDigest* digest = session.accounts().digests().find(number);
    if (!packet || digest == nullptr) {
        return std::nullopt;
    }
    model::Selection selection{packet->sender, std::nullopt, -1, number};
    if (digest->type != 0) {
        selection.character = model::CharacterKey{packet->sender, digest->character};
    }
    const model::Selection& before = session.choices().selection;
    selection.segment = before.character == selection.character ? before.segment : -1;
    return selection;
}

void stopPlaying(model::Session& session) {
    model::Cursor cursor = session.choices().cursor;
    cursor.speed = 0;
    session.setCursor(cursor);
}

} // namespace

void Commands::show(model::Session& session) {
    if (m_shown != &session) {
        stopPlaying(*m_shown);
        m_shown = &session;
        emit changed();
        emit switched();
    }
}

void Commands::selectPacket(std::uint64_t number) {
    const auto selection = selectionOf(*m_shown, number);
    if (!selection) {
        return;
    }
    if (m_shown->choices().cursor.mode == model::Cursor::Mode::Paused) {
        playTo({model::Cursor::Mode::Paused, number});
    }
    select(*selection);
}

void Commands::unselectPacket() {
    model::Selection selection = m_shown->choices().selection;
    if (selection.packet) {
        selection.packet.reset();
        select(selection);
    }
}

void Commands::jump(std::uint64_t packet, const QString& filter) {
    stopPlaying(*m_shown);
    change(&model::Session::jump, selectionOf(*m_shown, packet).value_or(m_shown->choices().selection),
           filter.toStdString());
}

bool Commands::travel(bool (model::Session::*step)()) {
    stopPlaying(*m_shown);
    const bool isThere = (m_shown->*step)();
    if (isThere) {
        emit changed();
        emit wentBack();
    }
    return isThere;
}

void Commands::showIncident(std::optional<std::uint64_t> number, std::optional<model::CharacterKey> of) {
    change(&model::Session::askForIncident, number, of);
    emit showDock(QStringLiteral("events"));
}

void Commands::resetForTake() {
    m_live.resetForTake();
    emit changed();
}

void Commands::setThresholds(const model::Thresholds& thresholds) {
    m_live.setThresholds(thresholds);
    emit changed();
}

} // namespace posewire::gui
