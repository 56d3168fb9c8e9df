// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/incident_model.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/session/verdict.h"

#include <algorithm>
#include <ranges>

namespace posewire::gui {

namespace {

using State = model::ListedIncident::State;
using IncidentColumn = TableColumn<IncidentLine>;

QString lasted(const model::SessionView& view, const IncidentLine& line) {
    if (line.state == State::Provisional) {
        return tr("provisional");
    }
    const model::Incident& incident = line.incident();
    if (line.state == State::Ongoing && (!line.isPart || line.part()->isCurrent)) {
        return view.isRecording() ? tr("to the end") : tr("going on");
    }
    const auto [from, to] = line.isPart ? std::pair(line.part()->from, line.part()->to)
                                        : std::pair(incident.firstStamp, incident.lastStamp);
    return from == to ? QString() : duration(log::secondsOf(to - from));
}

QString fromTo(const model::SessionView& view, const IncidentLine& line) {
    const model::Incident& incident = line.incident();
    return tr("From %1 to %2")
        .arg(timeOfDay(view.wallOf(incident.firstStamp)), line.state == State::Over
                                                              ? timeOfDay(view.wallOf(incident.lastStamp))
                                                          : view.isRecording() ? tr("the end")
                                                                               : tr("now (it may go on)"));
}

/// What happened, as far as it is settled, and what is still missing.
QString wordsOf(model::SessionView& view, const IncidentLine& line, words::Form form) {
    QStringList parts;
    if (line.isPart && line.settledPart != nullptr) {
        parts += said(line.incident().fact(*line.settledPart), words::Form::Line);
    }
    if (line.isPart && line.pendingPart != nullptr) {
        const std::uint64_t samples = line.pendingPart->samples;
        parts += samples != 0 ? tr("%1 not yet here").arg(grouped(samples)) : tr("no data");
    }
    if (!line.isPart && line.settled != nullptr) {
        parts +=
            said(form == words::Form::Line ? factOf(view, {*line.settled, line.state}) : line.settled->fact(),
                 form);
    }
    if (!line.isPart && line.pending != nullptr) {
        const words::Fact pending = factOf(view, {*line.pending, State::Provisional});
        parts += said(pending, line.settled == nullptr ? words::Form::Headline : words::Form::Brief);
    }
    const QString all = parts.join(QStringLiteral(" · "));
    const auto type = line.isPart ? line.part()->type : std::nullopt;
    return type ? tr("%1: %2").arg(typeTitle(*type), all) : all;
}

QString lostWords(const IncidentLine& line) {
    const std::uint64_t samples = line.settledPart != nullptr               ? line.settledPart->samples
                                  : line.settled != nullptr && !line.isPart ? line.settled->lost()
                                                                            : 0;
    return samples == 0 ? QString() : grouped(samples);
}

QString causeWords(const IncidentLine& line) {
    const model::Incident& incident = line.incident();
    const bool isKnown = !line.isPart && line.settled != nullptr && incident.cause;
    return isKnown ? translatedText(model::nameOf(*incident.cause)) : QString();
}

IncidentColumn severityColumn() {
    IncidentColumn column = IncidentColumn::words(tr("Severity"), {}, [](const IncidentLine& line) {
        const model::IncidentSeverity severity = line.incident().severity();
        return line.isPart ? QString()
               : line.state == State::Provisional
                   ? tr("provisional")
                   : PropertyValue{severityWord(severity), healthOf(severity)}.display();
    });
    column.room = {.usual = tr("    ▲ warning"), .least = tr("Severity")};
    column.colour = [](const IncidentLine& line) {
        const model::IncidentSeverity severity = line.incident().severity();
        const bool isQuiet = line.state == State::Provisional || severity == model::IncidentSeverity::Info;
        return QVariant(isQuiet ? theme().dim : healthColour(healthOf(severity)));
    };
    column.spoken = [](const IncidentLine& line) {
        return line.isPart                        ? QString()
               : line.state == State::Provisional ? tr("provisional")
                                                  : severityWord(line.incident().severity());
    };
    column.more = [](const IncidentLine& line, int role) {
        const bool isWanted = role == kShortTextRole && !line.isPart && line.state != State::Provisional;
        return isWanted ? QVariant(healthSymbol(healthOf(line.incident().severity()))) : QVariant();
    };
    return column;
}

std::vector<IncidentColumn> textColumns(model::SessionView& view) {
    const auto whose = [&view](const IncidentLine& line) {
        return line.isPart ? whoseWords(view, *line.part()) : whoseWords(view, line.incident());
    };
    const auto words = [&view](const IncidentLine& line) {
        return wordsOf(view, line, words::Form::Sentence);
    };
    return {
        IncidentColumn::numbers(tr("Began"), tr("When it began"),
                                [&view](const IncidentLine& line) {
                                    return timeOfDay(view.wallOf(line.isPart ? line.part()->from
                                                                             : line.incident().firstStamp));
                                })
            .in({.usual = QStringLiteral("10:42:17.508"), .order = 5})
            .withToolTip([&view](const IncidentLine& line) { return fromTo(view, line); }),
        IncidentColumn::words(tr("Affected"), tr("Character and stream, or the sender"), whose)
            .in({.usual = QStringLiteral("Mira Lindqvist · 02"),
                 .wish = QStringLiteral("Mira Lindqvist · 02 Pose, quaternion"),
                 .least = QStringLiteral("20 c")})
            .withToolTip(whose),
        // The cause has a column of its own.
        IncidentColumn::words(tr("What happened"), {}, words)
            .in({.usual = tr("11509 samples lost in 11293 gaps"),
                 .wish = tr("1509 samples lost in 1293 gaps. 10 not yet here."),
                 .least = tr("1509 samples lost"),
                 .isOpen = true})
            .withToolTip(words)
            .withMore([&view](const IncidentLine& line, int role) {
                const bool isLong =
                    line.settled != nullptr &&
                    (line.settled->cause || line.settled->kind == model::IncidentKind::Conflict);
                return role == kShortTextRole && isLong ? QVariant(wordsOf(view, line, words::Form::Line))
                                                        : QVariant();
            }),
    };
}

/// Whose fault it was stays longest beside what happened, which tells the rest.
std::vector<IncidentColumn> figureColumns(const model::SessionView& view) {
    return {
        IncidentColumn::numbers(tr("Lost"), tr("Samples lost for good"), lostWords)
            .in({.usual = QStringLiteral("99 999"), .order = 4}),
        IncidentColumn::words(tr("Cause"), tr("Whose loss it was"), causeWords)
            .in({.usual = tr("this computer"), .order = 7}),
        IncidentColumn::numbers(tr("Lasted"), tr("From its begin to its end"),
                                [&view](const IncidentLine& line) { return lasted(view, line); })
            .in({.usual = tr("provisional"), .order = 6}),
        IncidentColumn::numbers(tr("Count"), tr("How often it happened in this incident"),
                                [](const IncidentLine& line) {
                                    const auto* part = line.part();
                                    return grouped(part != nullptr ? part->count : line.incident().count);
                                })
            .in({.usual = QStringLiteral("99 999"), .order = 3}),
        IncidentColumn::words(tr("Kind"), {},
                              [](const IncidentLine& line) {
                                  return line.isPart ? QString()
                                                     : translatedText(nameOf(line.incident().kind));
                              })
            .in({.usual = tr("metadata change"), .order = 2}),
        IncidentColumn::words(tr("Group"), {},
                              [](const IncidentLine& line) {
                                  return line.isPart ? QString() : groupWord(line.incident().group());
                              })
            .in({.usual = tr("Content"), .order = 1}),
    };
}

/// Reads the model only where a cell is asked for.
std::vector<IncidentColumn> incidentColumns(model::SessionView& view, const IncidentModel& incidents) {
    std::vector<IncidentColumn> columns{severityColumn()};
    std::ranges::move(textColumns(view), std::back_inserter(columns));
    std::ranges::move(figureColumns(view), std::back_inserter(columns));
    for (IncidentColumn& column : columns) {
        if (!column.colour) {
            column.colour = [&incidents](const IncidentLine& line) {
                const bool isQuiet = line.settled == nullptr || incidents.isSeen(line.incident());
                return isQuiet ? QVariant(theme().dim) : QVariant();
            };
        }
    }
    return columns;
}

} // namespace

IncidentModel::IncidentModel(model::SessionView& view)
    : KeyedTreeModel(incidentColumns(view, *this)), m_view(view) {}

std::optional<IncidentLine> IncidentModel::whole(Key key) const {
    const auto pending = m_pending.find(key);
    const auto current = m_current.find(key);
    IncidentLine line;
    line.settled = key > 0 ? m_view.verdicts().incidents().find(static_cast<std::uint64_t>(key)) : nullptr;
    line.pending = pending == m_pending.end() ? nullptr : &pending->second.incident;
    line.state = current == m_current.end() ? State::Over : current->second;
    if (line.settled == nullptr && line.pending != nullptr) {
        line.state = pending->second.state;
    }
    if (line.state == State::Over && key < 0 && line.pending != nullptr) {
        line.settled = std::exchange(line.pending, nullptr); // a sum of what is not listed any more
    }
    return line.settled == nullptr && line.pending == nullptr ? std::nullopt : std::optional(line);
}

bool IncidentModel::matches(const IncidentLine& line) const {
    const model::Incident& incident = line.incident();
    if ((m_filter.onlyCurrent && line.state == State::Over && !incident.isCurrent) ||
        !m_filter.severities[static_cast<std::size_t>(incident.severity())] ||
        !m_filter.groups[static_cast<std::size_t>(incident.group())]) {
        return false;
    }
    if (m_filter.text.isEmpty()) {
        return true;
    }
    const bool isInCells = std::ranges::any_of(std::array{kText, kWho, kKind}, [&](int column) {
        return cell(line, column, Qt::DisplayRole).toString().contains(m_filter.text, Qt::CaseInsensitive);
    });
    return isInCells || std::ranges::any_of(incident.characters(), [&](const model::CharacterKey& character) {
               return characterName(m_view, character).contains(m_filter.text, Qt::CaseInsensitive);
           });
}

std::optional<IncidentModel::Key> IncidentModel::hostOf(const model::Incident& pending) const {
    using enum model::IncidentKind;
    constexpr std::array kHosts{Loss, Local, Outage, Reordered};
    constexpr log::Duration kJustNow = std::chrono::seconds(1);
    const auto& all = m_view.verdicts().incidents().all();
    const auto host = std::find_if(all.rbegin(), all.rend(), [&](const model::Incident& one) {
        const bool isRecent = one.isCurrent || m_view.now() - one.lastStamp < kJustNow;
        return isRecent && one.sender == pending.sender && std::ranges::count(kHosts, one.kind) != 0;
    });
    return host == all.rend() ? std::nullopt : std::optional(static_cast<Key>(host->number));
}

bool IncidentModel::readUnsettled() {
    std::map<Key, model::ListedIncident> pending;
    for (model::ListedIncident& one : unsettledIncidents(m_view)) {
        const model::Incident& incident = one.incident;
        const bool isPending = one.state == State::Provisional;
        const Key sum = -static_cast<Key>(static_cast<std::uint32_t>(incident.sender)) * model::kLossCauses -
                        static_cast<Key>(incident.cause.value_or(model::LossCause::Unknown)) - 1;
        const Key own = isPending ? static_cast<Key>(incident.number) : sum;
        const auto host = isPending ? hostOf(incident) : std::nullopt;
        pending.insert_or_assign(host.value_or(own), std::move(one));
    }
    std::map<Key, State> current;
    for (const model::Incident* one : m_view.verdicts().incidents().current()) {
        current.emplace(one->number, stateOf(m_view, *one));
    }
    const bool isSame = pending.empty() && m_pending.empty() && current == m_current;
    m_pending = std::move(pending);
    m_current = std::move(current);
    return !isSame;
}

void IncidentModel::refresh() {
    const model::Incidents& incidents = m_view.verdicts().incidents();
    std::vector<Key> changed;
    std::ranges::copy(std::views::keys(m_pending), std::back_inserter(changed));
    if (!readUnsettled() && incidents.version() == m_version && !m_isFilterNew) {
        return;
    }
    Keys keys;
    const auto take = [&](Key key) {
        if (const auto line = whole(key); line && matches(*line)) {
            keys.push_back(key);
        }
    };
    for (const auto& [key, one] : m_pending) {
        changed.push_back(key);
        if (key < 0 || incidents.find(static_cast<std::uint64_t>(key)) == nullptr) {
            take(key);
        }
    }
    for (const model::Incident& incident : incidents.all()) {
        take(static_cast<Key>(incident.number));
        if (incident.version > m_version) {
            changed.push_back(static_cast<Key>(incident.number));
        }
    }
    m_version = incidents.version();
    m_isFilterNew = false;
    std::ranges::sort(keys);
    show(keys);
    std::ranges::for_each(changed, [this](Key key) { showStreams(key); });
    announceChange();
}

void IncidentModel::show(const Keys& keys) {
    constexpr std::size_t kMostRuns = 16;
    const auto forget = [this](Key key) { m_streams.erase(key); };
    const auto read = [this](Key key) {
        if (auto streams = streamsOf(key); !streams.empty()) {
            m_streams.insert_or_assign(key, std::move(streams));
        }
    };
    if (!mergeRows({}, m_keys, keys, kMostRuns, forget, read)) {
        beginResetModel();
        m_streams.clear();
        m_keys = keys;
        std::ranges::for_each(keys, read);
        endResetModel();
    }
}

std::vector<IncidentModel::Stream> IncidentModel::streamsOf(Key key) const {
    const auto line = whole(key);
    std::vector<Stream> streams;
    for (const model::Incident* one : {line ? line->settled : nullptr, line ? line->pending : nullptr}) {
        for (const auto& part : one != nullptr ? one->parts : std::vector<model::Incident::Part>()) {
            streams.emplace_back(part.whose(), part.type);
        }
    }
    std::ranges::sort(streams);
    streams.erase(std::unique(streams.begin(), streams.end()), streams.end());
    // What it was to a character as a whole is told by its streams, where there are any.
    std::erase_if(streams, [all = streams](const Stream& one) {
        return !one.second && std::ranges::any_of(all, [&](const Stream& other) {
            return other.second && other.first == one.first;
        });
    });
    return streams.size() > 1 ? streams : std::vector<Stream>();
}

void IncidentModel::showStreams(Key key) {
    const int row = rowOf(key);
    const std::vector<Stream> now = row < 0 ? std::vector<Stream>() : streamsOf(key);
    if (row < 0 || (now.empty() && !m_streams.contains(key))) {
        return;
    }
    std::vector<Stream>& shown = m_streams[key];
    const auto nothing = [](const Stream&) {};
    mergeRows(index(row, 0), shown, now, shown.size() + now.size(), nothing, nothing);
    if (shown.empty()) {
        m_streams.erase(key);
    }
}

void IncidentModel::setFilter(const Filter& filter) {
    if (filter == m_filter) {
        return;
    }
    m_filter = filter;
    m_isFilterNew = true;
    refresh();
}

void IncidentModel::markSeen() {
    const auto& all = m_view.verdicts().incidents().all();
    m_seenEnd = all.empty() ? 0 : all.back().number + 1;
    announceChange();
}

IncidentModel::Counts IncidentModel::counts() const {
    Counts counts;
    for (const model::Incident& incident : m_view.verdicts().incidents().all()) {
        ++counts.all;
        counts.current += incident.isCurrent ? 1 : 0;
        counts.unseen += isSeen(incident) ? 0 : 1;
        ++counts.severities[static_cast<std::size_t>(incident.severity())];
    }
    return counts;
}

std::optional<IncidentLine> IncidentModel::line(const QModelIndex& index) const {
    if (!index.isValid()) {
        return std::nullopt;
    }
    const QModelIndex above = index.parent();
    const auto row = static_cast<std::size_t>(above.isValid() ? above.row() : index.row());
    auto line = row < m_keys.size() ? whole(m_keys[row]) : std::nullopt;
    if (!line || !above.isValid()) {
        return line;
    }
    const auto streams = m_streams.find(m_keys[row]);
    const auto place = static_cast<std::size_t>(index.row());
    if (streams == m_streams.end() || place >= streams->second.size()) {
        return std::nullopt;
    }
    const auto partIn = [&](const model::Incident* of) -> const model::Incident::Part* {
        const auto isIt = [&](const model::Incident::Part& part) {
            return Stream(part.whose(), part.type) == streams->second[place];
        };
        const auto found = of == nullptr ? std::vector<model::Incident::Part>::const_iterator()
                                         : std::ranges::find_if(of->parts, isIt);
        return of == nullptr || found == of->parts.end() ? nullptr : &*found;
    };
    line->isPart = true;
    line->settledPart = partIn(line->settled);
    line->pendingPart = partIn(line->pending);
    return line->part() == nullptr ? std::nullopt : line;
}

int IncidentModel::rowOf(Key key) const {
    const auto found = std::ranges::lower_bound(m_keys, key);
    return found != m_keys.end() && *found == key ? static_cast<int>(found - m_keys.begin()) : -1;
}

QModelIndex IncidentModel::indexOf(std::uint64_t number) const {
    const int row = rowOf(static_cast<Key>(number));
    return row < 0 ? QModelIndex() : index(row, 0);
}

std::vector<const model::Incident*> IncidentModel::listed() const {
    std::vector<const model::Incident*> incidents;
    for (const Key key : m_keys) {
        if (const auto line = whole(key); line && line->settled != nullptr) {
            incidents.push_back(line->settled);
        }
    }
    return incidents;
}

QModelIndex IncidentModel::index(int row, int column, const QModelIndex& parent) const {
    if (!hasIndex(row, column, parent)) {
        return {};
    }
    const Key above = parent.isValid() ? m_keys[static_cast<std::size_t>(parent.row())] : 0;
    return createIndex(row, column, static_cast<quintptr>(above));
}

QModelIndex IncidentModel::parent(const QModelIndex& index) const {
    const auto above = static_cast<Key>(index.internalId());
    const int row = index.isValid() && above != 0 ? rowOf(above) : -1;
    return row < 0 ? QModelIndex() : createIndex(row, 0, quintptr{0});
}

int IncidentModel::rowCount(const QModelIndex& parent) const {
    if (!parent.isValid()) {
        return static_cast<int>(m_keys.size());
    }
    if (parent.internalId() != 0 || parent.column() > 0) {
        return 0;
    }
    const auto streams = m_streams.find(m_keys[static_cast<std::size_t>(parent.row())]);
    return streams == m_streams.end() ? 0 : static_cast<int>(streams->second.size());
}

QVariant IncidentModel::data(const QModelIndex& index, int role) const {
    const auto shown = checkIndex(index, CheckIndexOption::IndexIsValid) ? line(index) : std::nullopt;
    return shown ? cell(*shown, index.column(), role) : QVariant();
}

} // namespace posewire::gui
