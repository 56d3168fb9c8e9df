// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/event_model.h"

#include "app/gui/models/display_filter.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <iterator>
#include <span>

namespace posewire::gui {

namespace {

using model::IncidentKind;

QString lossWords(const model::Incident& event) {
    if (event.samples == 0) {
        return tr("%1 dropped here").arg(grouped(static_cast<std::uint64_t>(event.value)));
    }
    const QString lost = tr("%1 lost").arg(grouped(event.samples));
    return event.cause && *event.cause != model::LossCause::Unknown
               ? lost + QStringLiteral(" · ") + fromUtf8(model::nameOf(*event.cause))
               : lost;
}

} // namespace

Health healthOf(model::IncidentSeverity severity) {
    constexpr std::array kHealths{Health::Good, Health::Warning, Health::Error}; // by IncidentSeverity
    return kHealths[static_cast<std::size_t>(severity)];
}

QString severityWord(model::IncidentSeverity severity) {
    const std::array words{tr("note"), tr("warning"), tr("error")}; // by IncidentSeverity
    return words[static_cast<std::size_t>(severity)];
}

QString groupWord(model::IncidentGroup group) {
    const std::array words{tr("Sender"), tr("Loss"), tr("Content"), tr("Limit")}; // by IncidentGroup
    return words[static_cast<std::size_t>(group)];
}

QString whoseWords(model::SessionView& view, const model::Incident& event) {
    const std::vector<std::uint8_t> characters = event.characters();
    if (characters.empty()) {
        return shown(view.addressOf(event.sender));
    }
    const QString name = characters.size() == 1 ? characterName(view, {event.sender, characters.front()})
                                                : tr("%1 characters").arg(grouped(characters.size()));
    const auto type = event.type();
    return type ? name + QStringLiteral(" · ") + QString::fromStdString(wire::typeDigits(*type)) : name;
}

QString briefWords(const model::Incident& event) {
    switch (event.kind) {
    case IncidentKind::Loss:
    case IncidentKind::Local:
        return lossWords(event);
    case IncidentKind::Outage:
        return tr("no data");
    case IncidentKind::Reordered:
        return tr("%1 reordered").arg(grouped(event.count));
    case IncidentKind::Duplicates:
        return tr("%1 doubled").arg(grouped(event.count));
    case IncidentKind::Malformed:
        return tr("%1 malformed").arg(grouped(event.count));
    case IncidentKind::Foreign:
        return tr("%1 foreign").arg(grouped(event.count));
    case IncidentKind::TimeCode:
        return event.value == 0 ? tr("time code stands still")
                                : tr("time code %1 ms").arg(signedFixed(event.value, 0));
    case IncidentKind::AgeLimit:
        return tr("stale");
    case IncidentKind::LossLimit:
        return tr("loss %1 %").arg(fixed(event.value, 1));
    case IncidentKind::JitterLimit:
        return tr("jitter %1 ms").arg(fixed(event.value, 1));
    case IncidentKind::GapLimit:
        return tr("gap %1 ms").arg(fixed(event.value, 0));
    case IncidentKind::RateLimit:
        return tr("rate off %1 %").arg(fixed(event.value, 0));
    default:
        return fromUtf8(model::nameOf(event.kind));
    }
}

std::optional<std::uint64_t> eventPacket(model::SessionView& view, const model::Incident& event) {
    // Conditions that last are found by the clock: no packet is theirs.
    if (event.kind == IncidentKind::Outage || event.kind >= IncidentKind::LossLimit) {
        const std::uint64_t after = view.packetFrom(event.firstStamp + log::Duration(1));
        return after == view.begin() ? std::nullopt : std::optional(after - 1);
    }
    return event.lastPacket >= view.begin() && event.lastPacket < view.end() ? std::optional(event.lastPacket)
                                                                             : std::nullopt;
}

bool showPacketsOf(model::SessionView& view, Commands& commands, const model::Incident& event) {
    const auto packet = eventPacket(view, event);
    if (!packet) {
        return false;
    }
    commands.setDisplayFilter(packetFilterOf(view, event));
    commands.selectPacket(*packet);
    commands.showDock(QStringLiteral("packets"));
    return true;
}

namespace {

using EventColumn = TableColumn<model::Incident>;

QString lasted(const model::Incident& event) {
    return event.isCurrent ? tr("lasts") : duration(log::secondsOf(event.lastStamp - event.firstStamp));
}

QString fromTo(const model::SessionView& view, const model::Incident& event) {
    return tr("From %1 to %2")
        .arg(timeOfDay(view.wallOf(event.firstStamp)),
             event.isCurrent ? tr("now: it lasts, or may last") : timeOfDay(view.wallOf(event.lastStamp)));
}

EventColumn severityColumn() {
    EventColumn column = EventColumn::words(tr("Severity"), {}, [](const model::Incident& event) {
        return PropertyValue{severityWord(event.severity()), healthOf(event.severity())}.display();
    });
    column.colour = [](const model::Incident& event) {
        const bool isNote = event.severity() == model::IncidentSeverity::Info;
        return QVariant(isNote ? theme().dim : healthColour(healthOf(event.severity())));
    };
    column.spoken = [](const model::Incident& event) { return severityWord(event.severity()); };
    return column;
}

/// Reads the model only where a cell is asked for.
std::vector<EventColumn> eventColumns(model::SessionView& view, const EventModel& events) {
    const auto whose = [&view](const model::Incident& event) { return whoseWords(view, event); };
    const auto words = [](const auto& event) { return QString::fromStdString(event.text()); };
    std::vector<EventColumn> columns{
        severityColumn(),
        EventColumn::numbers(tr("Time"), tr("When it began"),
                             [&view](const auto& event) { return timeOfDay(view.wallOf(event.firstStamp)); })
            .withToolTip([&view](const auto& event) { return fromTo(view, event); }),
        EventColumn::words(tr("Whose"), tr("Character and type, or the sender"), whose).withToolTip(whose),
        EventColumn::words(tr("Text"), {}, words).withToolTip(words),
        EventColumn::numbers(tr("Count"), tr("How often it happened in this episode"),
                             [](const auto& event) { return grouped(event.count); }),
        EventColumn::words(tr("Event"), {}, [](const auto& event) { return fromUtf8(nameOf(event.kind)); }),
        EventColumn::words(tr("Group"), {}, [](const auto& event) { return groupWord(event.group()); }),
        EventColumn::numbers(tr("Lasted"), tr("From the first to the last of this episode"), lasted),
    };
    for (EventColumn& column : columns) {
        if (!column.colour) {
            column.colour = [&events](const model::Incident& event) {
                return events.isSeen(event) ? QVariant(theme().dim) : QVariant();
            };
        }
    }
    return columns;
}

using Numbers = std::vector<std::uint64_t>;

/// Those in `from` that are not in `others`, both in growing order; nothing where others lie between them.
std::optional<std::span<const std::uint64_t>> missing(const Numbers& from, const Numbers& others) {
    Numbers lone;
    std::ranges::set_difference(from, others, std::back_inserter(lone));
    const auto first = lone.empty() ? from.begin() : std::ranges::lower_bound(from, lone.front());
    const std::span<const std::uint64_t> span(first, lone.size());
    return std::ranges::equal(span, lone) ? std::optional(span) : std::nullopt;
}

} // namespace

EventModel::EventModel(model::SessionView& view, QObject* parent)
    : ColumnModel(eventColumns(view, *this), parent), m_view(view) {}

bool EventModel::matches(const model::Incident& event) const {
    if ((m_filter.onlyCurrent && !event.isCurrent) ||
        !m_filter.severities[static_cast<std::size_t>(event.severity())] ||
        !m_filter.groups[static_cast<std::size_t>(event.group())]) {
        return false;
    }
    if (m_filter.text.isEmpty()) {
        return true;
    }
    return std::ranges::any_of(std::array{kText, kWho, kKind}, [&](int column) {
        return cell(event, column, Qt::DisplayRole).toString().contains(m_filter.text, Qt::CaseInsensitive);
    });
}

void EventModel::refresh() {
    const model::Incidents& events = m_view.incidents();
    if (events.version() == m_version) {
        return;
    }
    m_version = events.version();
    Numbers numbers;
    for (const model::Incident& event : events.all()) {
        if (matches(event)) {
            numbers.push_back(event.number);
        }
    }
    show(std::move(numbers));
}

void EventModel::show(Numbers numbers) {
    const auto gone = missing(m_numbers, numbers);
    const auto come = missing(numbers, m_numbers);
    if (!gone || !come) {
        beginResetModel();
        m_numbers = std::move(numbers);
        endResetModel();
        return;
    }
    if (!gone->empty()) {
        const auto first = gone->data() - m_numbers.data();
        const auto end = first + static_cast<std::ptrdiff_t>(gone->size());
        beginRemoveRows({}, static_cast<int>(first), static_cast<int>(end) - 1);
        m_numbers.erase(m_numbers.begin() + first, m_numbers.begin() + end);
        endRemoveRows();
    }
    if (!come->empty()) {
        const auto first = static_cast<int>(come->data() - numbers.data());
        beginInsertRows({}, first, first + static_cast<int>(come->size()) - 1);
        m_numbers = std::move(numbers);
        endInsertRows();
    }
    announceChange();
}

void EventModel::setFilter(const Filter& filter) {
    if (filter == m_filter) {
        return;
    }
    m_filter = filter;
    m_version = UINT64_MAX;
    refresh();
}

void EventModel::markSeen() {
    const auto& all = m_view.incidents().all();
    m_seenEnd = all.empty() ? 0 : all.back().number + 1;
    announceChange();
}

EventModel::Counts EventModel::counts() const {
    Counts counts;
    for (const model::Incident& event : m_view.incidents().all()) {
        ++counts.all;
        counts.current += event.isCurrent ? 1 : 0;
        counts.unseen += isSeen(event) ? 0 : 1;
        ++counts.severities[static_cast<std::size_t>(event.severity())];
    }
    return counts;
}

const model::Incident* EventModel::event(const QModelIndex& index) const {
    return index.isValid() && index.row() < rowCount()
               ? m_view.incidents().find(m_numbers[static_cast<std::size_t>(index.row())])
               : nullptr;
}

int EventModel::rowOf(std::uint64_t number) const {
    const auto found = std::ranges::lower_bound(m_numbers, number);
    return found != m_numbers.end() && *found == number ? static_cast<int>(found - m_numbers.begin()) : -1;
}

std::vector<const model::Incident*> EventModel::listed() const {
    std::vector<const model::Incident*> events;
    for (const std::uint64_t number : m_numbers) {
        if (const model::Incident* event = m_view.incidents().find(number)) {
            events.push_back(event);
        }
    }
    return events;
}

int EventModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(m_numbers.size());
}

QVariant EventModel::data(const QModelIndex& index, int role) const {
    const model::Incident* shown = checkIndex(index, CheckIndexOption::IndexIsValid) ? event(index) : nullptr;
    return shown == nullptr ? QVariant() : cell(*shown, index.column(), role);
}

} // namespace posewire::gui
