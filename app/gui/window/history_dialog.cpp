// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/history_dialog.h"

#include "app/gui/base/help_topics.h"
#include "app/gui/driver/history.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/widgets.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QSpinBox>
#include <QVBoxLayout>

namespace posewire::gui {

QString historyText(const model::SessionView& live, const History& history) {
    const auto first = live.packet(live.begin());
    const QString inMemory =
        HistoryDialog::tr("In memory: %1 of at most %2.")
            .arg(megabytes(live.log().figures().memoryInUse), megabytes(live.log().figures().memoryCap));
    const log::DiskHistory* disk = history.onDisk();
    const auto failure = disk != nullptr ? disk->failure() : std::nullopt;
    QString onDisk = disk != nullptr ? HistoryDialog::tr("On disk: %1.").arg(megabytes(disk->figures().bytes))
                                     : HistoryDialog::tr("On disk: nothing.");
    onDisk = failure ? QString::fromStdString(failure->text) : onDisk;
    if (live.log().past().isDamaged()) {
        onDisk += u' ' + HistoryDialog::tr("Another program has changed its files: some of it is lost.");
    }
    const QString since =
        first ? HistoryDialog::tr("The oldest packet is from %1.").arg(timeOfDay(live.wallOf(first->stamp)))
              : HistoryDialog::tr("Nothing was received yet.");
    return inMemory + u' ' + onDisk + u' ' + since;
}

HistoryDialog::HistoryDialog(const model::SessionView& live, const History& history,
                             const HistoryChoice& choice, QWidget* parent)
    : QDialog(parent),
      m_isOnDisk(new QCheckBox(tr("Keep on &disk what memory has no room for"), this)),
      m_gigabytes(new QSpinBox(this)) {
    setWindowTitle(tr("History"));
    m_isOnDisk->setChecked(choice.isOnDisk);
    m_gigabytes->setButtonSymbols(QAbstractSpinBox::NoButtons);
    m_gigabytes->setRange(1, HistoryChoice::kMostGigabytes);
    m_gigabytes->setSuffix(tr(" GB"));
    m_gigabytes->setValue(choice.gigabytes);
    m_gigabytes->setEnabled(choice.isOnDisk);
    m_gigabytes->setAccessibleName(tr("Size of the history on disk, at most"));
    connect(m_isOnDisk, &QCheckBox::toggled, m_gigabytes, &QWidget::setEnabled);
    auto* form = new QFormLayout;
    form->addRow(m_isOnDisk);
    form->addRow(tr("At &most"), m_gigabytes);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    offerHelp(*this, *buttons, placeOf(HelpTopic::History));
    auto* column = new QVBoxLayout(this);
    column->setSpacing(fontMetrics().height());
    column->addWidget(dimText(tr("What was received can be looked back at as long as it is in memory or on "
                                 "disk; the oldest goes first. On disk it takes at most a tenth of what is "
                                 "free, in %1, and goes when Posewire ends. To keep a take, record it.")
                                  .arg(history.folder()),
                              this));
    column->addLayout(form);
    column->addWidget(dimText(historyText(live, history), this));
    column->addWidget(buttons);
    setMinimumWidth(fontMetrics().averageCharWidth() * 62);
}

HistoryChoice HistoryDialog::choice() const {
    return {m_isOnDisk->isChecked(), m_gigabytes->value()};
}

} // namespace posewire::gui
