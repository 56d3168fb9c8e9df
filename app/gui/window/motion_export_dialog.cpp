// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/motion_export_dialog.h"

#include "app/figure/mannequin_body.h"
#include "app/gui/base/help_topics.h"
#include "app/gui/base/saving.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

#include <QCoreApplication>
#include <QDialogButtonBox>
#include <QFile>
#include <QFileInfo>
#include <QFormLayout>
#include <QListWidget>
#include <QPushButton>
#include <QTimer>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace posewire::gui {

namespace {

constexpr std::chrono::milliseconds kProgressLook{100};
constexpr int kMostRows = 8; // of characters, before the list scrolls

} // namespace

/// By value, for a thread.
struct MotionExportDialog::Job {
    feed::PoseSource source;
    exporting::MotionRequest request;

    Job(feed::PoseSource from, const exporting::MotionFormat& format, std::string path)
        : source(std::move(from)), request{source, format, std::move(path)} {}
};

MotionExportDialog::MotionExportDialog(model::SessionView& view, QWidget* parent)
    : QDialog(parent),
      m_view(view),
      m_format(new ComboBox(this)),
      m_about(dimText({}, this)),
      m_range(new RangeBox(this)),
      m_characters(new QListWidget(this)),
      m_state(dimText({}, this)),
      m_button(new QPushButton(this)),
      m_watch(new QTimer(this)) {
    setWindowTitle(tr("Export motion"));
    for (const exporting::MotionFormat& one : exporting::motionFormats()) {
        m_format->addItem(
            QStringLiteral("%1 (.%2)").arg(translatedText(one.kind), QLatin1String(one.suffix)));
    }
    auto* form = new QFormLayout;
    form->addRow(tr("&Format"), m_format);
    form->addRow({}, m_about);
    form->addRow(tr("&What"), m_range);
    form->addRow(tr("&Characters"), m_characters);
    m_characters->setAccessibleName(tr("Characters"));
    listCharacters();
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    buttons->addButton(m_button, QDialogButtonBox::ActionRole);
    m_button->setDefault(true);
    layOut(*this, {form, m_state}, *buttons, placeOf(HelpTopic::MotionExport), 66);
    connect(m_format, &QComboBox::currentIndexChanged, this, &MotionExportDialog::describe);
    connect(m_characters, &QListWidget::itemChanged, this, &MotionExportDialog::describe);
    connect(m_button, &QPushButton::clicked, this, &MotionExportDialog::toggle);
    m_watch->setInterval(kProgressLook);
    connect(m_watch, &QTimer::timeout, this, &MotionExportDialog::watch);
    describe();
    showState({});
}

MotionExportDialog::~MotionExportDialog() = default; // what is being written is given up

void MotionExportDialog::listCharacters() {
    for (const model::Character* one : m_view.atNow().roster().listed()) {
        auto* item = new QListWidgetItem(characterName(m_view, one->key), m_characters);
        item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
        item->setCheckState(m_view.roster().isHidden(one->key) ? Qt::Unchecked : Qt::Checked);
        item->setData(Qt::UserRole, QVariant::fromValue(static_cast<quint32>(one->key.sender)));
        item->setData(Qt::UserRole + 1, one->key.character);
    }
    const int rows = std::clamp(m_characters->count(), 1, kMostRows);
    m_characters->setFixedHeight(rows * m_characters->sizeHintForRow(0) + 2 * m_characters->frameWidth());
}

const exporting::MotionFormat& MotionExportDialog::format() const {
    return exporting::motionFormats()[static_cast<std::size_t>(m_format->currentIndex())];
}

std::vector<model::CharacterKey> MotionExportDialog::chosen() const {
    std::vector<model::CharacterKey> keys;
    for (int row = 0; row < m_characters->count(); ++row) {
        const QListWidgetItem* item = m_characters->item(row);
        if (item->checkState() == Qt::Checked) {
            keys.push_back({static_cast<log::SenderId>(item->data(Qt::UserRole).toUInt()),
                            static_cast<std::uint8_t>(item->data(Qt::UserRole + 1).toUInt())});
        }
    }
    return keys;
}

void MotionExportDialog::describe() {
    QString text = tr("Holds %1. A sample that is missing: %2.")
                       .arg(translatedText(format().holds), said(format().gaps, words::Form::Headline));
    if (!format().holdsSeveral && chosen().size() > 1) {
        text += u' ' + tr("Each character has a file of its own, with its name behind yours.");
    }
    for (const model::CharacterKey& key : chosen()) {
        const QString name = characterName(m_view, key);
        if (m_view.messages().pose(key) == nullptr) {
            text += u'\n' + tr("%1 sends no pose and is left out.").arg(name);
        }
        for (const words::Fact& line : m_view.messages().poseRemark(key).lines) {
            text += u'\n' + tr("%1: %2.").arg(name, said(line, words::Form::Headline));
        }
    }
    m_about->setText(text);
    m_button->setEnabled(!chosen().empty());
}

void MotionExportDialog::toggle() {
    if (m_watch->isActive()) {
        m_work->cancel();
    } else {
        askWhereToSave();
    }
}

void MotionExportDialog::askWhereToSave() {
    const QString suffix = QLatin1String(format().suffix);
    const QString path = gui::askWhereToSave(this, windowTitle(), QStringLiteral("motion.") + suffix,
                                             fileFilter(format().kind, format().suffix));
    if (path.isEmpty()) {
        return;
    }
    std::shared_ptr<Job> job = jobFor(path);
    for (const std::string& each : exporting::motionPaths(job->request)) {
        const QString other = QFile::decodeName(each.c_str());
        if (other != path && QFileInfo::exists(other) && !wantsToReplace(this, windowTitle(), other)) {
            return;
        }
    }
    begin(std::move(job));
}

void MotionExportDialog::save(const QString& path) {
    begin(jobFor(path));
}

std::shared_ptr<MotionExportDialog::Job> MotionExportDialog::jobFor(const QString& path) const {
    const auto range = m_range->isRangeOnly() ? m_view.range() : std::nullopt;
    auto job = std::make_shared<Job>(feed::poseSourceOf(m_view, range.value_or(model::kAllTime), chosen()),
                                     format(), QFile::encodeName(path).toStdString());
    job->request.rules = replacing();
    job->request.application = ("Posewire " + QCoreApplication::applicationVersion()).toStdString();
    job->request.makeBody = figure::mannequinBody;
    return job;
}

void MotionExportDialog::begin(std::shared_ptr<Job> job) {
    m_job = std::move(job);
    m_work = std::make_unique<Background<Result>>(
        [job = m_job](const auto& progress) { return exporting::exportMotion(job->request, progress); });
    m_watch->start();
    watch();
}

void MotionExportDialog::watch() {
    if (!m_work->isDone()) {
        showState(tr("Writing: %1 %").arg(std::floor(100 * m_work->share())));
        return;
    }
    m_watch->stop();
    const Result result = m_work->take();
    if (!result) {
        showState(result.error().kind == log::FileError::Kind::Cancelled
                      ? tr("Cancelled: nothing was written.")
                      : QString::fromStdString(result.error().text));
        return;
    }
    QStringList lines;
    for (const exporting::ExportedMotion& one : *result) {
        lines += said(exporting::describe(one, m_job->source, m_job->request.format), words::Form::Headline);
    }
    showState(
        lines.isEmpty()
            ? tr("Nothing was written: no poses (types 01, 02, 05, 21, 22, 03) of these characters came "
                 "in that time.")
            : lines.join(u'\n'));
}

void MotionExportDialog::showState(const QString& text) {
    m_state->setText(text);
    m_button->setText(m_watch->isActive() ? tr("Ca&ncel") : tr("&Save as…"));
    // A layout keeps no room for lines that are broken.
    resize(width(), std::max(height(), layout()->totalHeightForWidth(width())));
}

} // namespace posewire::gui
