// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

namespace posewire::gui {

/// A clock readable across a room: monospaced figures as large as the widget allows.
class ClockWidget : public QWidget {
    Q_OBJECT

public:
    explicit ClockWidget(QWidget* parent = nullptr);

    /// `caption` stands below the figures; a stale clock is dimmed and says so there.
    void setClock(const QString& text, const QString& caption, bool isStale);
    [[nodiscard]] const QString& text() const { return m_text; }

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

signals:
    /// Double click or F: to be shown on the full screen, or no longer.
    void fullScreenToggled();
    /// Escape.
    void left();

protected:
    void paintEvent(QPaintEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    QString m_text;
    QString m_caption;
    bool m_isStale = false;
};

} // namespace posewire::gui
