// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/export_dialogs.h"

#include "app/figure/mannequin_body.h"
#include "app/gui/base/help_topics.h"
#include "app/gui/base/saving.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/words.h"
#include "app/gui/viewport/picture_series.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

#include <QCoreApplication>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QSpinBox>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace posewire::gui {

namespace {

constexpr std::chrono::milliseconds kProgressLook{100};
constexpr int kMostRows = 8; // of characters, before the list scrolls

enum What : std::uint8_t { TimeOfFigures, ThisMoment, AllThereIs };

constexpr int kMostPictures = 100'000;
constexpr std::array kSizes{QSize(1280, 720), QSize(1920, 1080), QSize(2560, 1440), QSize(3840, 2160)};
/// Labels are as large in a picture as they would be in a window of about this height.
constexpr double kUsualHeight = 900;

QString textOf(const QSize& size) {
    return QStringLiteral("%1 × %2").arg(size.width()).arg(size.height());
}

} // namespace

/// By value, for a thread.
struct MotionExportDialog::Job {
    feed::PoseSource source;
    exporting::MotionRequest request;

    Job(feed::PoseSource from, const exporting::MotionFormat& format, std::string path)
        : source(std::move(from)), request{source, format, std::move(path)} {}
};

MotionExportDialog::MotionExportDialog(model::SessionView& view, QWidget* parent)
    : QDialog(parent), m_view(view) {
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
    layOut(*this, {form, m_state}, *buttons, placeOf(HelpTopic::MotionExport), 74);
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
        return;
    }
    const QString suffix = QLatin1String(format().suffix);
    const QString path = askWhereToSave(this, windowTitle(), QStringLiteral("motion.") + suffix,
                                        fileFilter(format().kind, format().suffix));
    if (path.isEmpty()) {
        return;
    }
    std::shared_ptr<Job> job = jobFor(path);
    for (const std::string& each : exporting::motionPaths(job->request)) {
        const QString other = QString::fromStdString(each);
        if (other != path && QFileInfo::exists(other) && !wantsToReplace(this, windowTitle(), other)) {
            return;
        }
    }
    begin(std::move(job));
}

std::shared_ptr<MotionExportDialog::Job> MotionExportDialog::jobFor(const QString& path) const {
    const auto range = m_range->range();
    auto job = std::make_shared<Job>(feed::poseSourceOf(m_view, range.value_or(model::kAllTime), chosen()),
                                     format(), path.toStdString());
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
        showState(whyNotWritten(result.error()));
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

/// Writes what the viewport shows as PNG: of this moment, or a series of a time. The window shows the moments
/// as they are drawn; what is received goes on meanwhile.
class PicturesDialog final : public QDialog {
public:
    PicturesDialog(const Commands& commands, Playback& playback, const ComparisonState& comparison,
                   const ViewportWidget& viewport, QWidget* parent)
        : QDialog(parent),
          m_commands(commands),
          m_playback(playback),
          m_comparison(comparison),
          m_viewport(viewport) {
        constexpr int kUsualRate = 30;
        constexpr int kMostRate = 240;
        setWindowTitle(tr("Export pictures"));
        if (const auto range = commands.session().range()) {
            m_what->addItem(rangeText(commands.session(), *range), TimeOfFigures);
        }
        m_what->addItem(tr("This moment"), ThisMoment);
        m_what->addItem(tr("All there is"), AllThereIs);
        m_rate->setButtonSymbols(QAbstractSpinBox::NoButtons);
        m_rate->setRange(1, kMostRate);
        m_rate->setValue(kUsualRate);
        m_rate->setSuffix(tr(" pictures per second"));
        const QSize own = viewport.size() * viewport.devicePixelRatioF();
        m_size->addItem(tr("As the viewport: %1").arg(textOf(own)), own);
        for (const QSize& size : kSizes) {
            m_size->addItem(textOf(size), size);
        }
        auto* form = new QFormLayout;
        form->addRow(tr("&What"), m_what);
        form->addRow(tr("&Rate"), m_rate);
        form->addRow(tr("&Pixels"), m_size);
        form->addRow({}, m_about);
        auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
        buttons->addButton(m_button, QDialogButtonBox::ActionRole);
        m_button->setDefault(true);
        layOut(*this,
               {dimText(tr("Pictures show what the viewport shows (of a split view, the active one), "
                           "with its labels and overlays, drawn as "
                           "well as it can be. The display moves to each moment while they are drawn."),
                        this),
                form, m_state},
               *buttons, placeOf(HelpTopic::PicturesExport), 74);
        connect(m_what, &QComboBox::currentIndexChanged, this, &PicturesDialog::describe);
        connect(m_rate, &QSpinBox::valueChanged, this, &PicturesDialog::describe);
        connect(m_button, &QPushButton::clicked, this, &PicturesDialog::toggle);
        connect(&commands, &Commands::switched, this, [this] {
            if (m_series != nullptr) {
                m_series->leave();
                end(tr("Stopped after %1 pictures: another session is shown now.").arg(m_series->written()));
            }
        });
        describe();
    }

    /// Begins to write what is chosen. Files that are there are replaced.
    void save(const QString& path) {
        m_series = std::make_unique<PictureSeries>(m_commands.session(), m_playback,
                                                   m_viewport.choice().look(), request(path));
        m_series->setComparison(&m_comparison);
        const auto showState = [this] {
            m_state->setText(tr("Writing: %1 of %2").arg(m_series->written()).arg(m_series->request().count));
        };
        connect(m_series.get(), &PictureSeries::progressed, this, showState);
        connect(
            m_series.get(), &PictureSeries::finished, this,
            [this](const QString& problem) {
                const int count = m_series->request().count;
                end(!problem.isEmpty()
                        ? tr("%1 of %2 pictures are written. %3")
                              .arg(QString::number(m_series->written()), QString::number(count), problem)
                    : count == 1 ? tr("Saved %1").arg(m_series->request().path)
                                 : tr("Saved %1 pictures, %2 and on")
                                       .arg(QString::number(count), m_series->request().pathOf(0)));
            },
            Qt::QueuedConnection); // the series goes with it
        showState();
        describe();
        m_series->start();
    }

private:
    [[nodiscard]] model::TimeRange time() const {
        const model::SessionView& view = m_commands.session();
        const auto oldest = view.packet(view.begin());
        const auto newest = view.end() > 0 ? view.packet(view.end() - 1) : std::nullopt;
        model::TimeRange time{view.cursorStamp(), view.cursorStamp()};
        if (m_what->currentData() == ThisMoment || !oldest || !newest) {
            return time;
        }
        time = {oldest->stamp, newest->stamp};
        if (const auto range = m_what->currentData() == TimeOfFigures ? view.range() : std::nullopt) {
            time = {std::max(time.from, range->from), std::min(time.to, range->to)};
        }
        return time;
    }
    [[nodiscard]] PictureRequest request(const QString& path) const {
        const model::TimeRange span = time();
        PictureRequest request;
        request.first = span.from;
        request.every = log::durationOf(1.0 / m_rate->value());
        const double seconds = std::max(0.0, log::secondsOf(span.to - span.from));
        request.count =
            1 + static_cast<int>(std::min<double>(kMostPictures, std::floor(seconds * m_rate->value())));
        request.size = m_size->currentData().toSize().expandedTo({1, 1});
        request.scale = m_size->currentIndex() == 0 ? m_viewport.devicePixelRatioF()
                                                    : std::max(1.0, request.size.height() / kUsualHeight);
        request.path = path;
        return request;
    }
    void describe() {
        m_rate->setEnabled(m_what->currentData() != ThisMoment);
        const model::TimeRange span = time();
        const int count = request({}).count;
        const bool isTooMany = count > kMostPictures;
        m_about->setText(count == 1  ? tr("One picture.")
                         : isTooMany ? tr("More than %1 pictures: take a shorter time or a lower rate.")
                                           .arg(grouped(static_cast<std::uint64_t>(kMostPictures)))
                                     : tr("%1 pictures of %2 s, each with its number in its name.")
                                           .arg(grouped(static_cast<std::uint64_t>(count)),
                                                fixed(log::secondsOf(span.to - span.from), 1)));
        m_button->setText(m_series != nullptr ? tr("S&top") : tr("&Save as…"));
        m_button->setEnabled(m_series != nullptr || !isTooMany);
        for (QWidget* each : {static_cast<QWidget*>(m_what), static_cast<QWidget*>(m_size)}) {
            each->setEnabled(m_series == nullptr);
        }
        m_rate->setEnabled(m_rate->isEnabled() && m_series == nullptr);
    }
    void toggle() {
        if (m_series != nullptr) {
            end(tr("Stopped: %1 of %2 pictures are written.")
                    .arg(m_series->written())
                    .arg(m_series->request().count));
            return;
        }
        const QString path =
            askWhereToSave(this, windowTitle(), QStringLiteral("viewport.png"), tr("Pictures (*.png)"));
        if (path.isEmpty()) {
            return;
        }
        const PictureRequest wanted = request(path);
        for (int number = 0; wanted.count > 1 && number < wanted.count; ++number) {
            if (QFileInfo::exists(wanted.pathOf(number))) {
                if (!wantsToReplace(this, windowTitle(), wanted.pathOf(number))) {
                    return;
                }
                break; // one answer is for all of them
            }
        }
        save(path);
    }
    void end(const QString& text) {
        m_series.reset();
        m_state->setText(text);
        describe();
    }

    const Commands& m_commands; ///< what is shown
    Playback& m_playback;
    const ComparisonState& m_comparison;
    const ViewportWidget& m_viewport;
    QComboBox* m_what = new ComboBox(this);
    QSpinBox* m_rate = new QSpinBox(this);
    QComboBox* m_size = new ComboBox(this);
    QLabel* m_about = dimText({}, this);
    QLabel* m_state = dimText({}, this);
    QPushButton* m_button = new QPushButton(this);
    std::unique_ptr<PictureSeries> m_series; ///< null where nothing is written
};

void showPicturesDialog(const Commands& commands, Playback& playback, const ComparisonState& comparison,
                        const ViewportWidget& viewport, QWidget* parent) {
    PicturesDialog(commands, playback, comparison, viewport, parent).exec();
}

} // namespace posewire::gui
