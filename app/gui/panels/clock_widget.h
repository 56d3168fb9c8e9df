// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

namespace posewire::gui {

/// A clock readable across a room: monospaced figures as large as the widget allows.
class ClockWidget : public QWidget {
    Q_OBJECT

public:
    explicit ClockWidget(QWidget* parent = nullptr);

    /// A clock that does not run is dimmed; `caption`, below the figures, says why.
    enum class Run { Running, Stale, None };
    void setClock(const QString& text, const QString& caption, Run run);
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
    Run m_run = Run::None;
};

} // namespace posewire::gui
