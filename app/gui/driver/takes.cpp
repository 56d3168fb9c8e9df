// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/takes.h"

#include "app/gui/base/background.h"
#include "app/gui/base/logging.h"
#include "app/gui/driver/history.h"
#include "core/model/session/listed_incidents.h"
#include "core/words/say.h"

#include <QDateTime>
#include <QDir>
#include <QFile>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr std::size_t kMostNotes = 1'000;

log::RecordedMark markOn(const model::SessionView& live, std::uint64_t packet, const std::string& comment) {
    const auto found = live.packet(packet);
    const QString when =
        found ? QDateTime::fromMSecsSinceEpoch(log::nanosecondsOf(live.wallOf(found->stamp)) / 1'000'000)
                    .toString(QStringLiteral("HH:mm:ss.zzz"))
              : QString();
    return {packet, when.toStdString(), comment};
}

} // namespace

Takes::~Takes() {
    m_recording.reset();
    m_ending.clear(); // waits for each
}

QString Takes::toggle(const RecordingChoice& choice) {
    QString problem;
    if (isRecording()) {
        stop();
    } else {
        problem = start(choice);
    }
    emit changed({});
    return problem;
}

void Takes::follow(log::Stamp now) {
    keepMarks();
    const std::string problem = takeProblem();
    if (problem.empty()) {
        return;
    }
    model::Occurrence one = model::Occurrence::at(model::IncidentKind::RecordingEnded, log::kNoSender, now,
                                                  m_live.end() == 0 ? 0 : m_live.end() - 1);
    one.detail = {words::Kind::RecordingEnded, {{"problem", problem}}};
    m_live.report(one);
    emit changed(QString::fromStdString(say(one.detail, words::Form::Sentence)));
}

QString Takes::start(const RecordingChoice& choice) {
    const QString folder = recordingFolder(choice);
    if (!QDir().mkpath(folder)) {
        return tr("%1 cannot be made: choose another folder under Recording options.").arg(folder);
    }
    const log::Stamp begin = m_live.now();
    const log::Duration preRoll = std::chrono::seconds(choice.preRollSeconds);
    m_from = choice.preRollSeconds == 0 ? m_live.end() : m_live.packetFrom(begin - preRoll);
    const auto first = m_live.packet(m_from);
    m_fromStamp = first ? first->stamp : begin;
    m_path = nextTakePath(choice, QDateTime::currentDateTime());
    const log::RecordingLimits limits{static_cast<std::uint64_t>(choice.fileMegabytes) * 1'000'000,
                                      std::chrono::minutes(choice.fileMinutes),
                                      static_cast<std::uint64_t>(choice.freeMegabytes) * 1'000'000};
    auto recording = log::Recording::start(m_log, QFile::encodeName(m_path).toStdString(), writtenByUs(), {},
                                           m_from, limits);
    if (!recording) {
        return QString::fromStdString(recording.error().text);
    }
    m_recording = std::move(*recording);
    m_annotations = {};
    keepMarks();
    qCInfo(filesLog).noquote() << "recording to" << m_path << "from packet" << m_from;
    return {};
}

void Takes::stop() {
    qCInfo(filesLog).noquote() << "recorded" << m_path;
    keepMarks();
    std::vector<std::string> notes = notesAtEnd();
    m_ending.push_back(std::async(std::launch::async, [recording = std::shared_ptr(std::move(m_recording)),
                                                       notes = std::move(notes)]() mutable {
        const auto stopped = recording->stop(std::move(notes));
        return stopped ? std::string() : stopped.error().text;
    }));
}

std::optional<TakeState> Takes::state() const {
    if (m_recording == nullptr) {
        return std::nullopt;
    }
    return TakeState{m_path, log::secondsOf(m_live.now() - m_fromStamp), m_recording->figures()};
}

std::string Takes::takeProblem() {
    std::string problem;
    if (m_recording != nullptr) {
        if (const auto why = m_recording->failure()) {
            problem = why->text;
            m_recording.reset();
        }
    }
    std::erase_if(m_ending, [&](std::future<std::string>& ending) {
        const bool isOver = isReady(ending);
        if (const std::string text = isOver ? ending.get() : std::string(); !text.empty()) {
            problem = text;
        }
        return isOver;
    });
    return problem;
}

void Takes::keepMarks() {
    if (m_recording == nullptr || m_live.choices().annotations == m_annotations) {
        return;
    }
    m_annotations = m_live.choices().annotations;
    std::vector<log::RecordedMark> marks;
    const auto& comments = m_annotations.comments;
    for (auto mark = m_annotations.marks.lower_bound(m_from); mark != m_annotations.marks.end(); ++mark) {
        if (!comments.contains(*mark)) {
            marks.push_back(markOn(m_live, *mark, {}));
        }
    }
    for (auto comment = comments.lower_bound(m_from); comment != comments.end(); ++comment) {
        marks.push_back(markOn(m_live, comment->first, comment->second));
    }
    marks.resize(std::min(marks.size(), kMostNotes));
    m_recording->setMarks(std::move(marks));
}

std::vector<std::string> Takes::notesAtEnd() const {
    std::vector<std::string> notes{log::receptionText(reception())};
    for (const model::ListedIncident& listed : model::listedIncidents(m_live, m_fromStamp)) {
        if (listed.incident.lastStamp >= m_fromStamp && !model::isOnlyComing(listed)) {
            notes.push_back(say(
                {words::Kind::Dated, {{"what", factOf(m_live, listed)}, {"when", whenOf(m_live, listed)}}},
                words::Form::Headline));
        }
    }
    notes.resize(std::min(notes.size(), kMostNotes));
    return notes;
}

log::Reception Takes::reception() const {
    const auto first = m_live.packet(m_recording->figures().fileBegin);
    const auto last = m_live.end() == 0 ? std::nullopt : m_live.packet(m_live.end() - 1);
    log::Reception reception;
    reception.time = m_live.now() - (first ? first->stamp : m_fromStamp);
    reception.afterLast = last ? m_live.now() - last->stamp : reception.time;
    reception.time = std::max(reception.time, log::Duration());
    reception.afterLast = std::clamp(reception.afterLast, log::Duration(), reception.time);
    return reception;
}

} // namespace posewire::gui
