// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/commands.h"
#include "app/gui/theme/theme.h"
#include "core/model/session/session_view.h"

#include <QFrame>

class QVBoxLayout;

namespace posewire::gui {

/// Says of one character why it is as it is: figures of the last seconds, and what is going on. Each line
/// leads to its packets. Deletes itself when it is closed: by a click elsewhere or Escape.
class HealthPopup final : public QFrame {
    Q_OBJECT

public:
    HealthPopup(model::SessionView& session, Commands& commands, const model::CharacterKey& key,
                QWidget* parent);

    /// Over a widget at the bottom of the window.
    void showAbove(const QWidget& widget);

    /// "Lost 12 of 2 400 samples in the last 10 s."
    [[nodiscard]] static QString lossText(model::SessionView& session, const model::CharacterKey& key);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void addTitle(QVBoxLayout& column);
    void addTroubles(QVBoxLayout& column);
    void addButtons(QVBoxLayout& column);
    void showPackets(std::uint64_t event);

    model::SessionView& m_session;
    Commands& m_commands;
    model::CharacterKey m_key;
};

} // namespace posewire::gui
