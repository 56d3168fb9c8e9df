// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>

#include <future>

class QLabel;
class QPushButton;
class QTimer;
class QTreeWidget;

namespace posewire::gui {

class History;

/// What was received until Posewire was killed, the power failed or the like: files of the history on disk
/// that nobody has saved, to be opened, saved or discarded.
class RecoveryDialog final : public QDialog {
    Q_OBJECT

public:
    RecoveryDialog(History& history, QWidget* parent);

    [[nodiscard]] bool isEmpty() const;
    /// Copies the selected file, on a thread of its own.
    void save(const QString& path);

    void done(int result) override;

signals:
    void openRequested(const QString& path);
    /// It is closed, and saves nothing any more: what it was still saving then is at its end, as `text` says.
    void over(const QString& text);

private:
    void fill();
    [[nodiscard]] QString selected() const;
    void open();
    void askWhereToSave();
    void discard();
    void watchSaving();
    void showState(const QString& message);

    History& m_history;
    QTreeWidget* m_list;
    QPushButton* m_open;
    QPushButton* m_save;
    QPushButton* m_discard;
    QLabel* m_message;
    QTimer* m_watch;
    QString m_target;
    std::future<QString> m_saving; ///< with what went wrong
};

} // namespace posewire::gui
