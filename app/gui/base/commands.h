// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/session/session.h"

#include <QObject>
#include <QString>
#include <QStringList>

namespace posewire::gui {

/// Which session is shown (of what is received, or of the opened file), and what is chosen in it. Each
/// command is carried out at once, and shown at the next display tick. Panels never change the session
/// themselves.
class Commands final : public QObject {
    Q_OBJECT

public:
    /// The session must outlive this.
    explicit Commands(model::Session& live) : m_live(live), m_shown(&live) {}

    /// The session that is shown.
    [[nodiscard]] model::SessionView& session() const { return *m_shown; }
    [[nodiscard]] model::SessionView& live() const { return m_live; }
    [[nodiscard]] bool isFileShown() const { return m_shown != &m_live; }
    void showLive() { show(m_live); }
    /// Stops what plays in the one that was shown.
    void show(model::Session& session);

    /// Moves what plays on, without the haste of a command.
    void playTo(const model::Cursor& cursor) { m_shown->setCursor(cursor); }
    void setCursor(const model::Cursor& cursor) { change(&model::Session::setCursor, cursor); }
    void select(const model::Selection& selection) { change(&model::Session::setSelection, selection); }
    /// Selects a packet with its sender and character; a display that is stopped moves there. Ignored if
    /// there is no such packet.
    void selectPacket(std::uint64_t number);
    void unselectPacket();
    /// Chooses the time range of the statistics.
    void selectRange(const model::RangeChoice& range) { change(&model::Session::setRange, range); }
    void setMarked(std::uint64_t packet, bool isMarked) {
        change(&model::Session::setMarked, packet, isMarked);
    }
    void setComment(std::uint64_t packet, const QString& comment) {
        change(&model::Session::setComment, packet, comment.toStdString());
    }
    /// Declares facts about a sender, which then replace the detected ones.
    void setOverride(log::SenderId sender, const model::SenderOverride& overrides) {
        change(&model::Session::setOverride, sender, overrides);
    }
    /// Filters the list of packets; an empty filter shows all.
    void setDisplayFilter(const QString& filter) {
        change(&model::Session::setDisplayFilter, filter.toStdString());
    }
    /// Stops at a packet with another filter, or the same, so that goBack() brings all back as it was.
    /// Selects nothing else if there is no such packet.
    void jump(std::uint64_t packet, const QString& filter);
    /// Before another moment is shown: goBack() leads here again.
    void leave() { change(&model::Session::leave); }
    /// False if there is nothing to go to.
    bool goBack() { return travel(&model::Session::goBack); }
    bool goForward() { return travel(&model::Session::goForward); }
    void setCharacterVisible(const model::CharacterKey& key, bool isVisible) {
        change(&model::Session::setHidden, key, !isVisible);
    }
    /// Puts a character on the floor that is sent below it.
    void setLifted(const model::CharacterKey& key, bool isLifted) {
        change(&model::Session::setLifted, key, isLifted);
    }
    /// Takes a sender out of all lists from which no more is expected. Ignored while it sends.
    void forgetSender(log::SenderId sender) { change(&model::Session::forget, sender); }
    /// Shows the null pose of the shown character as a ghost over its figure.
    void setGhostVisible(bool isVisible) { change(&model::Session::setGhostShown, isVisible); }
    /// Brings the list of incidents to the front: with one selected if there is a number, with those of a
    /// character alone if there is one.
    void showIncident(std::optional<std::uint64_t> number, std::optional<model::CharacterKey> of = {});

    /// Brings the plots to the front with curves of these signals (see feed::parseSignal) of the shown
    /// character.
    void plot(const QStringList& curves) {
        emit showDock(QStringLiteral("plots"));
        emit plotRequested(curves);
    }

    // On the live session, whichever is shown:
    /// A new span counts for the take: counts, incidents and verdict from now on.
    void resetForTake();
    void setThresholds(const model::Thresholds& thresholds);

    /// Declares facts about all senders that come from now on, live or in files that are opened.
    void setUsual(const model::SenderOverride& usual) {
        m_usual = usual;
        m_live.setUsual(usual);
    }
    [[nodiscard]] const model::SenderOverride& usual() const { return m_usual; }

signals:
    void changed();
    /// Another session is shown.
    void switched();
    /// The view before the newest jump is shown again, or the one after it.
    void wentBack();

    // Requests that the window carries out.
    void frameCharacter(const model::CharacterKey& key);
    /// Brings a dock before the others, by its object name.
    void showDock(const QString& dock);
    // A request that docks carry out.
    void plotRequested(const QStringList& curves);

private:
    bool travel(bool (model::Session::*step)());
    template <class Setter, class... Arguments>
    void change(Setter setter, const Arguments&... arguments) {
        (m_shown->*setter)(arguments...);
        emit changed();
    }

    model::Session& m_live;
    model::SenderOverride m_usual;
    model::Session* m_shown;
};

} // namespace posewire::gui
