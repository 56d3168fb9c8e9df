// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "app/gui/base/settings.h"
#include "app/gui/driver/receiving.h"
#include "app/gui/driver/replaying.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/window/range_box.h"

#include <QCheckBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QPushButton>
#include <QTimer>
#include <QTreeWidget>

#include <future>

class QFormLayout;

namespace posewire::gui {

class History;

/// Adds fields for where recordings go, what they are called and how large they become. They write each
/// choice that can be used into `choice`, which outlives them.
void addRecordingRows(QFormLayout& rows, RecordingChoice& choice);

/// Adds fields for how much of what was received stays on disk, and how far one can look back now.
void addHistoryRows(QFormLayout& rows, HistoryChoice& choice, const History& history,
                    const model::SessionView& live);

/// What was received until Posewire was killed, the power failed or the like: files of the history on disk
/// that nobody has saved, to be opened, saved or discarded.
class RecoveryDialog final : public QDialog {
    Q_OBJECT

public:
    RecoveryDialog(History& history, QWidget* parent);

    [[nodiscard]] bool isEmpty() const { return m_list->topLevelItemCount() == 0; }
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
    QTreeWidget* m_list = new QTreeWidget(this);
    QPushButton* m_open;
    QPushButton* m_save;
    QPushButton* m_discard;
    QLabel* m_message = dimText({}, this);
    QTimer* m_watch = new QTimer(this);
    QString m_target;
    std::future<QString> m_saving; ///< with what went wrong
};

/// Sends what is shown to the network again: where to, what of it and how fast; and how that goes.
class ReplayDialog final : public QDialog {
    Q_OBJECT

public:
    /// `target` is what was sent to last, and is kept from now on. All must outlive it.
    ReplayDialog(Replaying& replaying, const Receiving& receiving, const Commands& commands, QString& target,
                 QWidget* parent);

    void toggle();

private:
    void begin();
    void refresh();

    /// Sends to an input of this monitor itself only if that is meant.
    [[nodiscard]] bool isMeant(const net::Endpoint& target);

    Replaying& m_replaying;
    const Receiving& m_receiving;
    const Commands& m_commands; ///< what is shown
    QString& m_kept;
    QLineEdit* m_target = new QLineEdit(m_kept, this);
    QComboBox* m_transport = new ComboBox(this);
    RangeBox* m_range = new RangeBox(m_commands.session(), this);
    QDoubleSpinBox* m_speed = new QDoubleSpinBox(this);
    QCheckBox* m_loop = new QCheckBox(tr("&Again and again"), this);
    QLabel* m_state = dimText({}, this);
    QPushButton* m_button = new QPushButton(this);
    QString m_problem; ///< why it did not begin
};

/// "Sending to 10.0.0.7:9763: 43 %, 5 883 datagrams", and what went wrong.
[[nodiscard]] QString replayText(const net::Replay& replay);

} // namespace posewire::gui
