// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/save_packets.h"

#include "app/gui/base/help_topics.h"
#include "app/gui/base/saving.h"
#include "app/gui/driver/history.h"
#include "app/gui/models/display_filter.h"
#include "app/gui/models/packet_search.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/help_link.h"
#include "core/log/log_reader.h"
#include "core/log/output_file.h"
#include "core/log/pcapng_writer.h"
#include "core/model/session/accounts.h"

#include <QDialogButtonBox>
#include <QFormLayout>

#include <chrono>
#include <string>
#include <utility>

namespace posewire::gui {

namespace {

constexpr std::chrono::milliseconds kSaveLook{100};
constexpr std::uint64_t kPacketsAtOnce = 4'096;

enum Saved : std::uint8_t { SavedRange, SavedList, SavedAll };

/// By value, for a thread.
struct Job {
    const log::PacketLog& log;
    PacketMatcher matcher;
    model::PacketDigests::Excerpt digests;
    model::Annotations annotations;
    std::string path;
    log::OutputRules rules;

    /// The comments that Wireshark shows beside a packet.
    [[nodiscard]] std::vector<std::string> commentsOn(std::uint64_t packet) const {
        const auto comment = annotations.comments.find(packet);
        const bool isMarked = annotations.marks.contains(packet);
        if (comment == annotations.comments.end()) {
            return isMarked ? std::vector{log::packetMarkText({})} : std::vector<std::string>();
        }
        return {isMarked ? log::packetMarkText(comment->second) : comment->second};
    }
};

using Result = tl::expected<std::uint64_t, log::FileError>;

Result write(Job& job, const Background<Result>::Progress& progress) {
    auto sink = log::createWholeFile(job.path, job.rules);
    if (!sink) {
        return tl::unexpected(sink.error());
    }
    log::PcapngWriter writer(**sink);
    auto written = writer.begin(writtenByUs());
    log::SenderFinder senders(job.log.senders());
    log::LogFollower follower(job.log, job.digests.begin());
    follower.refresh();
    const std::uint64_t first = job.digests.begin();
    while (written) {
        const auto packet = follower.next(job.digests.end());
        if (!packet) {
            break;
        }
        if (job.matcher.matches(*packet, job.digests.at(packet->number))) {
            const log::SenderInfo* sender = senders.find(packet->sender);
            written = writer.add(*packet, sender != nullptr ? *sender : log::SenderInfo{},
                                 job.commentsOn(packet->number), job.log.timeline().setByAt(packet->stamp));
        }
        const auto done = static_cast<double>(packet->number - first);
        if (packet->number % kPacketsAtOnce == 0 &&
            !progress(done / static_cast<double>(job.digests.end() - first))) {
            return tl::unexpected(log::FileError{"", log::FileError::Kind::Cancelled});
        }
    }
    return written.and_then([&] { return writer.addStatistics(); })
        .and_then([&] { return (*sink)->finish(); })
        .map([&] { return writer.packets(); });
}

} // namespace

SavePacketsDialog::SavePacketsDialog(model::SessionView& view, QString inUse, QWidget* parent)
    : QDialog(parent), m_view(view), m_inUse(std::move(inUse)) {
    setWindowTitle(tr("Save packets"));
    if (const auto range = view.range()) {
        m_what->addItem(rangeText(view, *range), SavedRange);
    }
    const QString filter = QString::fromStdString(view.choices().displayFilter);
    if (!filter.isEmpty()) {
        m_what->addItem(tr("Listed: %1").arg(filter), SavedList);
    }
    m_what->addItem(tr("All there is"), SavedAll);
    const auto key = shownCharacter(view);
    m_isOfOne->setText(key ? tr("Only of %1").arg(characterName(view, *key)) : tr("Only of one character"));
    m_isOfOne->setEnabled(key.has_value());
    auto* form = new QFormLayout;
    form->addRow(tr("&What"), m_what);
    form->addRow({}, m_isOfOne);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    buttons->addButton(m_button, QDialogButtonBox::ActionRole);
    m_button->setDefault(true);
    layOut(*this,
           {dimText(tr("Writes packets as a capture that Posewire and Wireshark open. Marks and comments are "
                       "comments of their packets."),
                    this),
            form, m_state},
           *buttons, placeOf(HelpTopic::SavePackets), 74);
    connect(m_button, &QPushButton::clicked, this, &SavePacketsDialog::toggle);
    m_watch->setInterval(kSaveLook);
    connect(m_watch, &QTimer::timeout, this, &SavePacketsDialog::watch);
    showState({});
}

QString SavePacketsDialog::condition() const {
    const int what = m_what->currentData().toInt();
    const auto range = m_view.range();
    QString text = what == SavedRange && range ? rangeFilter(m_view, *range)
                   : what == SavedList         ? QString::fromStdString(m_view.choices().displayFilter)
                                               : QString();
    const auto key = m_isOfOne->isChecked() ? shownCharacter(m_view) : std::nullopt;
    return key ? joinedFilter(text, characterFilter(m_view, *key), FilterJoin::And) : text;
}

void SavePacketsDialog::toggle() {
    if (m_watch->isActive()) {
        m_work->cancel();
    } else if (const QString path = askWhereToSave(this, windowTitle(), QStringLiteral("packets.pcapng"),
                                                   tr("Recordings (*.pcapng)"));
               !path.isEmpty()) {
        save(path);
    }
}

void SavePacketsDialog::save(const QString& path) {
    auto filter = filter::Filter::compile(condition().toStdString());
    if (!filter) {
        showState(QString::fromStdString(filter.error().text));
        return;
    }
    const model::PacketDigests& digests = m_view.accounts().digests();
    log::OutputRules rules = replacing();
    rules.inUse.push_back(m_inUse.toStdString());
    const auto job =
        std::make_shared<Job>(Job{m_view.log(), PacketMatcher(m_view, *std::move(filter)),
                                  digests.excerpt(digests.begin(), digests.end()),
                                  m_view.choices().annotations, path.toStdString(), std::move(rules)});
    m_path = path;
    m_work =
        std::make_unique<Background<Result>>([job](const auto& progress) { return write(*job, progress); });
    m_watch->start();
    watch();
}

void SavePacketsDialog::watch() {
    if (!m_work->isDone()) {
        showState(tr("Writing: %1 %").arg(std::floor(100 * m_work->share())));
        return;
    }
    m_watch->stop();
    const Result result = m_work->take();
    showState(result ? tr("Saved %1 packets as %2").arg(grouped(*result), m_path)
                     : whyNotWritten(result.error()));
}

void SavePacketsDialog::showState(const QString& text) {
    m_state->setText(text);
    m_button->setText(m_watch->isActive() ? tr("Ca&ncel") : tr("&Save as…"));
    resize(width(), std::max(height(), layout()->totalHeightForWidth(width())));
}

} // namespace posewire::gui
