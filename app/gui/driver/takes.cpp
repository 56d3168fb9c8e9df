// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/takes.h"

#include "app/gui/base/background.h"
#include "app/gui/base/logging.h"
#include "app/gui/driver/history.h"
#include "app/system/sleep.h"
#include "core/model/session/listed_incidents.h"
#include "core/words/say.h"

#include <QDateTime>

#include <algorithm>
#include <array>
#include <utility>

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

/// The newest of what MVN sends seldom of each character, before a packet: without it a take begins with
/// bodies of no size and without names.
std::vector<std::uint64_t> bodiesBefore(const model::SessionView& live, std::uint64_t packet) {
    std::vector<std::uint64_t> packets;
    for (const model::Character* character : live.atNow().roster().listed()) {
        for (const std::uint8_t type : std::array<std::uint8_t, 4>{10, 11, 12, 13}) {
            const auto whole =
                live.messages().wholeBefore({character->key.sender, character->key.character, type}, packet);
            packets.insert(packets.end(), whole.begin(), whole.end());
        }
    }
    std::ranges::sort(packets);
    return packets;
}

} // namespace

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
    if (isRecording()) {
        tellDisplaced(now, m_take);
        if (m_take.recording->failure()) {
            m_ending.push_back(std::exchange(m_take, {}));
            system::preventSleep(false);
        }
    }
    std::erase_if(m_ending, [&](Take& take) {
        const bool isOver = !take.ending.valid() || isReady(take.ending);
        if (isOver) {
            conclude(now, take);
        }
        return isOver;
    });
}

bool Takes::end() {
    if (isRecording()) {
        stop();
    }
    for (Take& take : m_ending) {
        take.ending.wait();
        conclude(m_live.now(), take);
    }
    m_ending.clear();
    return !m_isAnyLost;
}

void Takes::conclude(log::Stamp now, Take& take) {
    const auto problem = take.recording->failure();
    if (!problem) {
        emit recorded(QString::fromStdString(take.recording->figures().path), take.seconds);
    }
    tellDisplaced(now, take);
    if (problem) {
        m_isAnyLost = true;
        tell(now, {words::Kind::RecordingEnded, {{"problem", problem->text}}});
    }
}

void Takes::tellDisplaced(log::Stamp now, Take& take) {
    const std::vector<log::Displaced> all = take.recording->figures().displaced;
    while (take.told < all.size()) {
        tell(now, model::factOf(all[take.told++]));
    }
}

void Takes::tell(log::Stamp now, const words::Fact& what) {
    const QString sentence = QString::fromStdString(say(what, words::Form::Sentence));
    qCWarning(filesLog).noquote() << sentence;
    m_live.report(model::IncidentKind::RecordingEnded, now, what);
    emit changed(sentence);
}

QString Takes::start(const RecordingChoice& choice) {
    const QString folder = recordingFolder(choice);
    if (!log::makeFolder(folder.toStdString())) {
        return tr("%1 cannot be made: choose another folder under Recording options.").arg(folder);
    }
    const log::Stamp begin = m_live.now();
    const log::Duration preRoll = std::chrono::seconds(choice.preRollSeconds);
    m_from = choice.preRollSeconds == 0 ? m_live.end() : m_live.packetFrom(begin - preRoll);
    const auto first = m_live.packet(m_from);
    m_fromStamp = first ? first->stamp : begin;
    const QString path = nextTakePath(choice, QDateTime::currentDateTime());
    const log::RecordingLimits limits{static_cast<std::uint64_t>(choice.fileMegabytes) * 1'000'000,
                                      std::chrono::minutes(choice.fileMinutes),
                                      static_cast<std::uint64_t>(choice.freeMegabytes) * 1'000'000,
                                      recordingFolder({}).toStdString()};
    auto recording = log::Recording::start(m_log, path.toStdString(), writtenByUs(), {}, m_from, limits,
                                           bodiesBefore(m_live, m_from));
    if (!recording) {
        return QString::fromStdString(recording.error().text);
    }
    m_take = {.recording = std::move(*recording)};
    system::preventSleep(true);
    m_annotations = {};
    keepMarks();
    qCInfo(filesLog).noquote() << "recording to" << path << "from packet" << m_from;
    return {};
}

void Takes::stop() {
    const TakeState now = *state();
    qCInfo(filesLog).noquote() << "recorded" << now.path;
    keepMarks();
    m_take.seconds = now.seconds;
    system::preventSleep(false);
    m_take.ending =
        std::async(std::launch::async, [recording = m_take.recording, notes = notesAtEnd()]() mutable {
            static_cast<void>(recording->stop(std::move(notes)));
        });
    m_ending.push_back(std::exchange(m_take, {}));
}

std::optional<TakeState> Takes::state() const {
    if (!isRecording()) {
        return std::nullopt;
    }
    const log::RecordingFigures figures = m_take.recording->figures();
    return TakeState{QString::fromStdString(figures.path), log::secondsOf(m_live.now() - m_fromStamp),
                     figures};
}

void Takes::keepMarks() {
    if (!isRecording() || m_live.choices().annotations == m_annotations) {
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
    m_take.recording->setMarks(std::move(marks));
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
    const auto first = m_live.packet(m_take.recording->figures().fileBegin);
    const auto last = m_live.end() == 0 ? std::nullopt : m_live.packet(m_live.end() - 1);
    log::Reception reception;
    reception.time = m_live.now() - (first ? first->stamp : m_fromStamp);
    reception.afterLast = last ? m_live.now() - last->stamp : reception.time;
    reception.time = std::max(reception.time, log::Duration());
    reception.afterLast = std::clamp(reception.afterLast, log::Duration(), reception.time);
    return reception;
}

} // namespace posewire::gui
