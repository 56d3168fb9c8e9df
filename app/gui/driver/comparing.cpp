// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/comparing.h"

#include "app/gui/base/logging.h"
#include "app/gui/base/saving.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace posewire::gui {

namespace {

using Table = std::shared_ptr<const exporting::Timetable>;

/// The one that is known, else a new one; null if it was cancelled.
Table tableOf(const Table& known, const feed::PoseSource& source, const exporting::ExportProgress& progress) {
    if (known != nullptr) {
        return known;
    }
    auto table = exporting::Timetable::of(source, progress);
    return table ? std::make_shared<const exporting::Timetable>(std::move(*table)) : nullptr;
}

/// Between the end of one comparison and the begin of the next, if only the moment has moved on; and this
/// many times as long as it took, so that it never takes more than a tenth of a processor.
constexpr log::Duration kPause = std::chrono::milliseconds(500);
constexpr int kRest = 9;

} // namespace

ComparisonOutcome compared(const ComparisonOrder& order, const exporting::ExportProgress& progress) {
    int part = 0;
    const int parts = (order.firstTable == nullptr ? 1 : 0) + (order.secondTable == nullptr ? 1 : 0) + 1;
    const exporting::ExportProgress ofAll = [&](double share) { return progress((part + share) / parts); };
    ComparisonOutcome outcome;
    const Table second = tableOf(order.secondTable, order.second, ofAll);
    part += order.secondTable == nullptr ? 1 : 0;
    const Table first = second != nullptr ? tableOf(order.firstTable, order.first, ofAll) : nullptr;
    part += order.firstTable == nullptr ? 1 : 0;
    if (first == nullptr) {
        return outcome;
    }
    const exporting::AlignBy by = order.by.value_or(exporting::naturalAlignment(*first, *second));
    outcome.partners =
        std::make_shared<const exporting::Partners>(first, second, exporting::Alignment{by, order.offset});
    const exporting::ComparisonTask task{order.firstRange, order.second, *outcome.partners, order.frame};
    outcome.firstTable = first;
    outcome.secondTable = second;
    if (auto comparison = exporting::compareMotion(task, ofAll)) {
        outcome.comparison = std::make_shared<const exporting::MotionComparison>(std::move(*comparison));
    }
    return outcome;
}

std::string writeDifferences(const ComparisonOrder& order,
                             const std::vector<exporting::SegmentFigures>& segments, const std::string& path,
                             const exporting::ExportProgress& progress) {
    const exporting::Partners partners(order.firstTable, order.secondTable,
                                       {order.by.value_or(exporting::AlignBy::Begin), order.offset});
    const exporting::ComparisonTask task{order.firstRange, order.second, partners, order.frame};
    const auto written = exporting::writeComparisonCsv(task, segments, path, replacing(), progress);
    return written ? std::string() : written.error().text;
}

Comparing::Comparing(Commands& commands, const log::Clock& clock, QString cacheFolder)
    : m_commands(commands), m_clock(clock), m_cacheFolder(std::move(cacheFolder)) {
    // Not only with the next tick: a series of pictures draws before it.
    connect(&commands, &Commands::changed, this, [this] {
        if (m_file != nullptr && m_known.log == &m_commands.session().log()) {
            followCursor(m_commands.session());
        }
    });
}

void Comparing::open(const QString& path) {
    qCInfo(filesLog).noquote() << "comparing with" << path;
    clear();
    m_file = std::make_unique<OpenedFile>(m_clock, path, m_cacheFolder);
    m_file->session().setUsual(m_commands.usual());
    m_state.isOpen = true;
    m_state.name = m_file->name();
    emit changed();
}

void Comparing::close() {
    clear();
    emit changed();
}

void Comparing::clear() {
    forgetResults();
    m_ending.clear();
    m_saving.reset();
    m_file.reset();
    ComparisonState none;
    none.choice.frame = m_state.choice.frame; // the rest was of this recording
    none.choice.isBeside = m_state.choice.isBeside;
    m_state = std::move(none);
}

void Comparing::stopReading() {
    if (isReading()) {
        m_file->stop();
        const QString text = m_file->notes().join(QLatin1Char(' '));
        if (m_file->session().end() == 0) {
            clear();
        }
        emit changed(text);
    }
}

void Comparing::choose(const ComparisonChoice& choice) {
    ComparisonChoice before = std::exchange(m_state.choice, choice);
    before.isBeside = choice.isBeside; // changes no figure
    if (before != choice) {
        m_state.isStopped = false;
        m_nextWork = {};
        m_pairChosen = {};
    }
    emit changed();
}

void Comparing::stop() {
    if (m_work != nullptr) {
        endWork();
        m_subject.reset();
        m_state.isStopped = true;
    }
    emit changed();
}

void Comparing::workAgain() {
    m_state.isStopped = false;
    m_subject.reset();
    m_nextWork = {};
    emit changed();
}

void Comparing::endOf(const log::PacketLog& log) {
    if (m_known.log == &log) {
        close();
        return;
    }
    m_ending.clear();
    if (m_savingOf == &log) {
        m_saving.reset();
    }
}

/// Its thread ends on its own.
void Comparing::endWork() {
    if (m_work != nullptr) {
        m_work->cancel();
        m_ending.push_back(std::move(m_work));
    }
}

void Comparing::forgetResults() {
    endWork();
    m_subject.reset();
    m_known = {};
    m_firstTable.reset();
    m_secondTable.reset();
    m_partners.reset();
    m_order = {};
    m_shown = {};
    m_state.alignment.reset();
    m_state.atCursor.reset();
    m_state.range.reset();
    m_state.pair.reset();
    m_nextWork = {};
}

bool Comparing::follow(log::Duration most) {
    if (m_saving != nullptr && m_saving->isDone()) {
        const QString problem = QString::fromStdString(m_saving->take());
        m_saving.reset();
        emit changed(problem.isEmpty() ? tr("Saved %1").arg(m_savingTo) : problem);
    }
    if (m_file == nullptr) {
        return false;
    }
    model::SessionView& shown = m_commands.session();
    const bool wasReading = m_file->isReading();
    const bool hasRead = wasReading && m_file->follow(most);
    if (!m_file->failure().isEmpty()) {
        const QString problem = tr("Nothing to compare with: %1").arg(m_file->failure());
        clear();
        emit changed(problem);
        return true;
    }
    m_state.second = m_file->session().end() != 0 ? &m_file->session() : nullptr;
    std::erase_if(m_ending, [](const auto& one) { return one->isDone(); });
    updatePair(shown);
    const bool hasResult = takeResult();
    if (m_state.pair && !m_file->isReading() && isWorkDue(shown)) {
        beginWork(shown);
    }
    const auto before = m_file->session().choices().cursor;
    const bool hadPartner = m_state.atCursor.has_value();
    followCursor(shown);
    m_state.isWorking = m_work != nullptr || m_file->isReading();
    m_state.share = m_file->isReading() ? m_file->share() : m_work != nullptr ? m_work->share() : 0;
    m_state.problem = problemOf(shown);
    addNotes();
    if (wasReading && !m_file->isReading()) {
        emit changed();
    }
    return hasRead || hasResult || before != m_file->session().choices().cursor ||
           hadPartner != m_state.atCursor.has_value();
}

/// Not each tick: names of many characters are compared.
void Comparing::updatePair(model::SessionView& shown) {
    constexpr log::Duration kEvery = std::chrono::milliseconds(250);
    const log::Moment now = m_clock.monotonic();
    const bool isOther = m_known.log != &shown.log();
    const bool isAsBefore = m_state.pair && shown.choices().selection == m_pairSelection;
    if (!isOther && isAsBefore && now < m_pairChosen + kEvery) {
        return;
    }
    m_pairSelection = shown.choices().selection;
    m_pairChosen = now;
    const auto pair = choosePair(shown);
    if (isOther || pair != m_state.pair) {
        forgetResults();
        m_state.pair = pair;
        m_known = subjectOf(shown);
    }
}

/// The first pair if no character is selected or it has no partner.
std::optional<exporting::CharacterPair> Comparing::choosePair(model::SessionView& shown) const {
    const auto& selected = shown.choices().selection.character;
    const auto pairs = exporting::pairCharacters(shown, m_file->session());
    const auto isShown = [&](const exporting::CharacterPair& one) {
        return selected && shown.roster().isSame(one.first, *selected);
    };
    const auto found = std::ranges::find_if(pairs, isShown);
    auto pair = found != pairs.end() ? std::optional(*found)
                : pairs.empty()      ? std::nullopt
                                     : std::optional(pairs.front());
    const auto& chosen = m_state.choice.pair;
    const bool isChosen = pair && chosen && shown.roster().isSame(chosen->first, pair->first) &&
                          m_file->session().roster().find(chosen->second) != nullptr;
    return isChosen ? exporting::CharacterPair{pair->first, chosen->second} : pair;
}

Comparing::Subject Comparing::subjectOf(const model::SessionView& shown) const {
    return {&shown.log(), m_state.pair.value_or(exporting::CharacterPair{}), m_state.choice.by,
            m_state.choice.offset, m_state.choice.frame};
}

bool Comparing::isWorkDue(const model::SessionView& shown) const {
    if (m_state.isStopped || shown.end() == 0) {
        return false;
    }
    if (!m_subject || *m_subject != subjectOf(shown)) {
        return true; // something else was chosen
    }
    const Reach reach{shown.range(), shown.end()};
    return m_work == nullptr && reach != m_reach && m_clock.monotonic() >= m_nextWork;
}

ComparisonOrder Comparing::orderFor(const model::SessionView& shown) const {
    const auto& [first, second] = *m_state.pair;
    const auto sourceOf = [](const model::SessionView& session, const model::TimeRange& range,
                             const model::CharacterKey& key) {
        return feed::poseSourceOf(session, range, std::span(&key, 1));
    };
    return {sourceOf(shown, model::kAllTime, first),
            sourceOf(shown, shown.range().value_or(model::kAllTime), first),
            sourceOf(m_file->session(), model::kAllTime, second),
            m_firstTableEnd == shown.end() ? m_firstTable : nullptr,
            m_secondTable,
            m_state.choice.by,
            m_state.choice.offset,
            m_state.choice.frame};
}

void Comparing::beginWork(model::SessionView& shown) {
    endWork();
    m_subject = subjectOf(shown);
    m_reach = {shown.range(), shown.end()};
    m_order = orderFor(shown);
    m_begun = m_clock.monotonic();
    m_work = std::make_unique<Work>(
        [order = m_order](const Work::Progress& progress) { return compared(order, progress); });
}

bool Comparing::takeResult() {
    if (m_work == nullptr || !m_work->isDone()) {
        return false;
    }
    const ComparisonOutcome outcome = m_work->take();
    m_work.reset();
    const log::Moment now = m_clock.monotonic();
    m_nextWork = now + std::max(kPause, kRest * (now - m_begun));
    if (outcome.partners == nullptr) {
        return false;
    }
    m_firstTable = outcome.firstTable;
    m_firstTableEnd = m_reach.end;
    m_secondTable = outcome.secondTable;
    m_partners = *outcome.partners;
    if (outcome.comparison != nullptr) {
        m_state.range = outcome.comparison;
        m_shown = std::move(m_order);
        m_shown.firstTable = m_firstTable;
        m_shown.secondTable = m_secondTable;
        m_shown.by = m_partners->alignment().by;
    }
    return true;
}

/// The second recording to the moment of the first.
void Comparing::followCursor(model::SessionView& shown) {
    m_state.atCursor.reset();
    const auto& choice = m_state.choice;
    const bool isKnown = m_partners && (!choice.by || *choice.by == m_partners->alignment().by);
    if (!isKnown || !m_state.pair) {
        m_state.alignment.reset();
        return;
    }
    if (m_partners->alignment().offset != choice.offset) {
        m_partners = m_partners->withOffset(choice.offset);
    }
    m_state.alignment = m_partners->alignment();
    m_state.step = exporting::stepOf(m_state.alignment->by, m_partners->second());
    const model::CharacterPose* first = shown.messages().pose(m_state.pair->first);
    const auto place = first != nullptr
                           ? m_partners->of({first->sample, first->timeCode, first->stamp, first->packet})
                           : std::nullopt;
    if (!place) {
        return;
    }
    model::Session& session = m_file->session();
    const exporting::SampleMoment& partner = m_partners->second().samples()[*place];
    const model::Cursor cursor{model::Cursor::Mode::Paused, partner.packet};
    if (session.choices().cursor != cursor) {
        session.setCursor(cursor);
    }
    const model::CharacterPose* second = session.messages().pose(m_state.pair->second);
    model::PoseDifference difference;
    if (second != nullptr && second->sample == partner.sample &&
        differenceOf(*first, *second, choice.frame, difference)) {
        m_state.atCursor = std::move(difference);
    }
}

QString Comparing::problemOf(model::SessionView& shown) const {
    if (m_file->isReading()) {
        return {};
    }
    if (m_file->session().atNow().roster().listed().empty()) {
        return tr("There is no character in %1. Choose another recording.").arg(m_state.name);
    }
    if (shown.atNow().roster().listed().empty()) {
        return tr("There is no character yet to compare with %1.").arg(m_state.name);
    }
    const bool hasTables = m_firstTable != nullptr && m_secondTable != nullptr;
    const QString types = tr("poses (types 01, 02, 05, 21, 22, 03)");
    if (hasTables && m_secondTable->samples().empty()) {
        return tr("This character has no %1 in %2. Choose another one, or another recording.")
            .arg(types, m_state.name);
    }
    if (hasTables && m_firstTable->samples().empty()) {
        return tr("The shown character has no %1. Choose another one.").arg(types);
    }
    if (m_state.range != nullptr && m_state.range->pairs == 0 && m_work == nullptr) {
        return m_state.range->apart != 0
                   ? tr("These characters have no segment in common. Choose others.")
                   : tr("No sample of the one has a partner in the other. Align them otherwise, or choose "
                        "another range.");
    }
    return {};
}

void Comparing::addNotes() {
    m_state.notes = m_file->notes();
    if (m_partners) {
        const exporting::Timetable& first = m_partners->first();
        const exporting::Timetable& second = m_partners->second();
        constexpr double kSame = 0.02;
        if (first.rateHz() > 0 && second.rateHz() > 0 &&
            std::abs(first.rateHz() / second.rateHz() - 1) > kSame) {
            m_state.notes += tr("%1 Hz and %2 Hz: samples of the same moment are compared")
                                 .arg(first.rateHz(), 0, 'f', 0)
                                 .arg(second.rateHz(), 0, 'f', 0);
        }
        if (first.isCut() || second.isCut()) {
            m_state.notes += tr("Only the first %1 samples are compared").arg(exporting::Timetable::kMost);
        }
    }
}

void Comparing::save(const QString& path) {
    if (m_state.range == nullptr || m_state.range->segments.empty()) {
        emit changed(tr("There are no differences to save yet."));
        return;
    }
    m_savingTo = path;
    m_savingOf = m_shown.first.log;
    m_saving = std::make_unique<Background<std::string>>([order = m_shown, segments = m_state.range->segments,
                                                          file = path.toStdString()](const auto& progress) {
        return writeDifferences(order, segments, file, progress);
    });
}

} // namespace posewire::gui
