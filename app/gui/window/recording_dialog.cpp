// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/recording_dialog.h"

#include "app/gui/base/help_topics.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/plain_text.h"
#include "app/gui/theme/widgets.h"

#include <QDateTime>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>

namespace posewire::gui {

RecordingDialog::RecordingDialog(const RecordingChoice& choice, QWidget* parent)
    : QDialog(parent),
      m_folder(new QLineEdit(recordingFolder(choice), this)),
      m_pattern(new QLineEdit(choice.pattern, this)),
      m_next(dimText({}, this)) {
    setWindowTitle(tr("Recording options"));
    auto* form = new QFormLayout;
    auto* folder = new QWidget(this);
    auto* row = new QHBoxLayout(folder);
    row->setContentsMargins({});
    folder->setFocusProxy(m_folder);
    auto* choose = new QPushButton(tr("Choose…"), this);
    row->addWidget(m_folder, 1);
    row->addWidget(choose);
    form->addRow(tr("&Folder"), folder);
    form->addRow(tr("&Name"), m_pattern);
    form->addRow({}, m_next);
    m_pattern->setPlaceholderText(QLatin1String(RecordingChoice::kDefaultPattern));
    m_preRoll = addNumber(*form, tr("&Keep before"), tr(" s"), tr("nothing"), choice.preRollSeconds,
                          RecordingChoice::kMostPreRoll);
    m_megabytes = addNumber(*form, tr("New file &every"), tr(" MB"), tr("one file, however large"),
                            choice.fileMegabytes, RecordingChoice::kMostMegabytes);
    m_minutes = addNumber(*form, tr("New file &after"), tr(" min"), tr("one file, however long"),
                          choice.fileMinutes, RecordingChoice::kMostMinutes);
    m_free = addNumber(*form, tr("&Leave free"), tr(" MB"), tr("nothing: until the disk is full"),
                       choice.freeMegabytes, RecordingChoice::kMostMegabytes);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
    m_ok = buttons->button(QDialogButtonBox::Ok);
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    offerHelp(*this, *buttons, placeOf(HelpTopic::RecordingOptions));
    connect(choose, &QPushButton::clicked, this, &RecordingDialog::chooseFolder);
    connect(m_pattern, &QLineEdit::textChanged, this, &RecordingDialog::check);
    connect(m_folder, &QLineEdit::textChanged, this, &RecordingDialog::check);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(fontMetrics().height());
    column->addWidget(dimText(tr("A take has everything that is received while it runs, as pcapng: Posewire "
                                 "and Wireshark open it. In its name {take} is a number, {date} and {time} "
                                 "are when it begins. What is chosen here counts from the next take on."),
                              this));
    column->addLayout(form);
    column->addWidget(buttons);
    setMinimumWidth(fontMetrics().averageCharWidth() * 66);
    check();
}

QSpinBox* RecordingDialog::addNumber(QFormLayout& form, const QString& label, const QString& unit,
                                     const QString& none, int value, int most) {
    auto* box = new QSpinBox(this);
    box->setButtonSymbols(QAbstractSpinBox::NoButtons);
    box->setRange(0, most);
    box->setSuffix(unit);
    box->setSpecialValueText(none);
    box->setValue(value);
    form.addRow(label, box);
    return box;
}

void RecordingDialog::chooseFolder() {
    const QString folder =
        QFileDialog::getExistingDirectory(this, tr("Folder of recordings"), m_folder->text());
    if (!folder.isEmpty()) {
        m_folder->setText(folder);
    }
}

void RecordingDialog::check() {
    const QString problem = patternProblem(m_pattern->text());
    m_ok->setEnabled(problem.isEmpty());
    const QString next = QFileInfo(nextTakePath(choice(), QDateTime::currentDateTime())).fileName();
    m_next->setText(problem.isEmpty() ? tr("Next: %1").arg(next) : problem);
}

RecordingChoice RecordingDialog::choice() const {
    RecordingChoice choice;
    const QString folder = m_folder->text().trimmed();
    choice.folder = folder == recordingFolder({}) ? QString() : folder;
    choice.pattern = m_pattern->text().trimmed();
    choice.preRollSeconds = m_preRoll->value();
    choice.fileMegabytes = m_megabytes->value();
    choice.fileMinutes = m_minutes->value();
    choice.freeMegabytes = m_free->value();
    return choice;
}

} // namespace posewire::gui
