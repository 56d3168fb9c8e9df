// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QLabel>
#include <QTimer>

namespace posewire::gui {

/// A label that is there only while it has something to say.
class PassingMessage final : public QLabel {
    Q_OBJECT

public:
    PassingMessage(int milliseconds, QWidget* parent);

    /// Shows a text for its time; a narrow label has it as its tooltip as well.
    void say(const QString& text);
    /// What is being said; empty where nothing is.
    [[nodiscard]] QString said() const { return isHidden() ? QString() : text(); }

private:
    QTimer m_timer;
};

} // namespace posewire::gui
