// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QString>

class QToolButton;

namespace posewire::gui {

class MainWindow;

/// Opens recordings, also those that are dropped on the window, and says at the bottom of the window how that
/// goes.
class Opening final : public QObject {
    Q_OBJECT

public:
    /// The window has its menus and bars by then.
    explicit Opening(MainWindow& window);

    void open(const QString& path);
    void compareWith(const QString& path);
    /// Puts a recording on top of the list of recent files.
    void noteRecent(const QString& path);
    /// Beside the newest recording, else where takes go.
    [[nodiscard]] QString folder() const;
    /// Has the window tell what the run before has left: packets, and a take that was cut off, empty for
    /// none. False if it has left nothing.
    bool tellRecovery(const QString& take);

    bool eventFilter(QObject* window, QEvent* event) override;

private:
    void showState();
    /// Also once a file has been opened, which is said meanwhile.
    void sayAlsoAfterwards(const QString& text);

    MainWindow& m_window;
    QToolButton* m_stop;        ///< shown while a file is being opened
    bool m_saysOpening = false; ///< the bar at the bottom does
    QString m_sayAgain;         ///< the bar at the bottom says that a file is being opened instead
};

} // namespace posewire::gui
