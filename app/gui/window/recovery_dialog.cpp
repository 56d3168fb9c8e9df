// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/recovery_dialog.h"

#include "app/gui/base/help_topics.h"
#include "app/gui/base/saving.h"
#include "app/gui/driver/history.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/widgets.h"

#include <QDialogButtonBox>
#include <QFile>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QTimer>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <chrono>

namespace posewire::gui {

namespace {

constexpr std::chrono::milliseconds kLook{100};
constexpr int kPath = Qt::UserRole;
constexpr int kSize = 3; // column

QString day(log::WallTime time) {
    return QLocale().toString(dateTimeOf(time).date(), QLocale::ShortFormat);
}

} // namespace

RecoveryDialog::RecoveryDialog(History& history, QWidget* parent)
    : QDialog(parent),
      m_history(history),
      m_list(new QTreeWidget(this)),
      m_message(dimText({}, this)),
      m_watch(new QTimer(this)) {
    setWindowTitle(tr("Recovered packets"));
    m_list->setRootIsDecorated(false);
    m_list->setUniformRowHeights(true);
    m_list->setAccessibleName(tr("Recovered packets"));
    m_list->setHeaderLabels({tr("Day"), tr("Received from"), tr("Until"), tr("Size")});
    m_list->headerItem()->setTextAlignment(kSize, Qt::AlignRight | Qt::AlignVCenter);
    for (int column = 0; column < m_list->columnCount(); ++column) {
        m_list->header()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
    }
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    m_open = buttons->addButton(tr("&Open"), QDialogButtonBox::ActionRole);
    m_save = buttons->addButton(tr("&Save as…"), QDialogButtonBox::ActionRole);
    m_discard = buttons->addButton(tr("&Discard all"), QDialogButtonBox::ActionRole);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(fontMetrics().height());
    column->addWidget(dimText(tr("Posewire did not end as it should, and these packets were not saved. Each "
                                 "line is a file; the newest is selected. They are kept until the history "
                                 "needs their room on the disk."),
                              this));
    column->addWidget(m_list);
    column->addWidget(m_message);
    column->addWidget(buttons);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    offerHelp(*this, *buttons, placeOf(HelpTopic::Recovered));
    connect(m_open, &QPushButton::clicked, this, &RecoveryDialog::open);
    connect(m_save, &QPushButton::clicked, this, &RecoveryDialog::askWhereToSave);
    connect(m_discard, &QPushButton::clicked, this, &RecoveryDialog::discard);
    connect(m_list, &QTreeWidget::itemActivated, this, &RecoveryDialog::open);
    m_watch->setInterval(kLook);
    connect(m_watch, &QTimer::timeout, this, &RecoveryDialog::watchSaving);
    m_open->setDefault(true);
    m_list->setFocus();
    setMinimumWidth(fontMetrics().averageCharWidth() * 68);
    fill();
    showState({});
}

bool RecoveryDialog::isEmpty() const {
    return m_list->topLevelItemCount() == 0;
}

void RecoveryDialog::fill() {
    m_list->clear();
    for (const log::LostHistory& one : m_history.lost()) {
        const log::WallTime begin = log::beginOf(one.path).value_or(one.end);
        auto* item = new QTreeWidgetItem(
            m_list, {day(begin), timeOfDay(begin), timeOfDay(one.end), megabytes(one.bytes)});
        item->setTextAlignment(kSize, Qt::AlignRight | Qt::AlignVCenter);
        item->setData(0, kPath, QFile::decodeName(one.path.c_str()));
        m_list->setCurrentItem(item);
    }
}

QString RecoveryDialog::selected() const {
    const QTreeWidgetItem* item = m_list->currentItem();
    return item == nullptr ? QString() : item->data(0, kPath).toString();
}

void RecoveryDialog::open() {
    if (const QString path = selected(); !path.isEmpty()) {
        emit openRequested(path);
    }
}

void RecoveryDialog::askWhereToSave() {
    const QString path = gui::askWhereToSave(this, tr("Save recovered packets"),
                                             QStringLiteral("recovered.pcapng"), tr("Recording (*.pcapng)"));
    if (!path.isEmpty()) {
        save(path);
    }
}

void RecoveryDialog::save(const QString& path) {
    m_target = path;
    m_saving = saveCopy(selected(), path);
    m_watch->start();
    showState(tr("Saving %1 …").arg(path));
}

void RecoveryDialog::watchSaving() {
    if (m_saving.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        m_watch->stop();
        const QString problem = m_saving.get();
        const QString text = problem.isEmpty() ? tr("Saved %1").arg(m_target) : problem;
        showState(text);
        if (isHidden()) {
            emit over(text);
        }
    }
}

/// Nobody waits for a file to be copied.
void RecoveryDialog::done(int result) {
    QDialog::done(result);
    if (!m_watch->isActive()) {
        emit over({});
    }
}

void RecoveryDialog::discard() {
    MessageBox question(tr("Discard"), tr("Discard all recovered packets? They cannot be brought back."),
                        QMessageBox::Discard | QMessageBox::Cancel, this);
    if (question.exec() == QMessageBox::Discard) {
        m_history.discardLost();
        fill();
        showState({});
    }
}

void RecoveryDialog::showState(const QString& message) {
    const bool isSaving = m_watch->isActive();
    m_message->setText(message.isEmpty() && isEmpty() ? tr("There is nothing to recover.") : message);
    m_message->setVisible(!m_message->text().isEmpty());
    for (QPushButton* button : {m_open, m_save, m_discard}) {
        button->setEnabled(!isEmpty() && !isSaving);
    }
}

} // namespace posewire::gui
