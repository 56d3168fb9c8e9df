// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/event_words.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/statistics_filter.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/filter/completion.h"
#include "core/wire/type_table.h"

#include <QStringList>

#include <algorithm>

namespace posewire::gui {

namespace {

using model::EventKind;

QString digitsOf(std::uint8_t type) {
    const auto digits = wire::typeDigits(type);
    return QString::fromLatin1(digits.data(), 2);
}

QString equals(const char* field, const std::string& value) {
    return QString::fromStdString(filter::expressionFor(field, value));
}

QString lossWords(const model::Event& event) {
    const QString lost = tr("%1 lost").arg(grouped(event.samples));
    return event.cause && *event.cause != model::LossCause::Unknown
               ? lost + QStringLiteral(" · ") + QString::fromLatin1(model::nameOf(*event.cause).data())
               : lost;
}

/// What packets have at which such a thing happened; null where no packet shows it.
const char* conditionOf(EventKind kind) {
    switch (kind) {
    case EventKind::Gap:
    case EventKind::Burst:
    case EventKind::LossLimit:
        return "gap > 0";
    case EventKind::Restart:
        return "restart";
    case EventKind::Malformed:
        return "malformed";
    case EventKind::Foreign:
        return "foreign";
    case EventKind::Dropped:
        return "drops > 0";
    default:
        return nullptr;
    }
}

/// Conditions that go on are found by the clock: no packet is theirs.
bool hasPacket(EventKind kind) {
    return kind != EventKind::SenderDown && kind < EventKind::LossLimit;
}

/// A limit was exceeded in the window before; what is silent has no packets.
model::TimeRange rangeOf(model::SessionView& view, const model::Event& event) {
    const auto window = log::durationOf(view.thresholds().windowS);
    return {event.firstStamp - window,
            std::max(event.lastStamp, event.firstStamp + std::chrono::milliseconds(1))};
}

/// The last packet that came before a moment.
std::optional<std::uint64_t> packetBefore(model::SessionView& view, log::Stamp stamp) {
    const std::uint64_t first = view.packetFrom(stamp);
    return first == view.begin() ? std::nullopt : std::optional(first - 1);
}

} // namespace

Health healthOf(model::EventSeverity severity) {
    switch (severity) {
    case model::EventSeverity::Error:
        return Health::Error;
    case model::EventSeverity::Warning:
        return Health::Warning;
    case model::EventSeverity::Info:
        break;
    }
    return Health::Good;
}

QString severityWord(model::EventSeverity severity) {
    switch (severity) {
    case model::EventSeverity::Error:
        return tr("error");
    case model::EventSeverity::Warning:
        return tr("warning");
    case model::EventSeverity::Info:
        break;
    }
    return tr("note");
}

QString groupWord(model::EventGroup group) {
    switch (group) {
    case model::EventGroup::Sender:
        return tr("Sender");
    case model::EventGroup::Loss:
        return tr("Loss");
    case model::EventGroup::Content:
        return tr("Content");
    case model::EventGroup::Limit:
        break;
    }
    return tr("Limit");
}

QString whoseWords(model::SessionView& view, const model::Event& event) {
    if (!event.character) {
        const model::Sender* sender = view.find(event.sender);
        return sender == nullptr ? QString() : QString::fromStdString(sender->info.address);
    }
    const QString name = characterName(view, {event.sender, *event.character});
    return event.type ? name + QStringLiteral(" · ") + digitsOf(*event.type) : name;
}

QString briefWords(const model::Event& event) {
    switch (event.kind) {
    case EventKind::Gap:
    case EventKind::Burst:
        return lossWords(event);
    case EventKind::Malformed:
        return tr("%1 malformed").arg(grouped(event.count));
    case EventKind::Foreign:
        return tr("%1 foreign").arg(grouped(event.count));
    case EventKind::Dropped:
        return tr("%1 dropped here").arg(grouped(event.samples));
    case EventKind::TimeCodeJump:
        return tr("time code %1 ms").arg(signedFixed(event.value, 0));
    case EventKind::CharacterConflict:
        return tr("two senders");
    case EventKind::SenderDown:
    case EventKind::Stale:
    case EventKind::AgeLimit:
        return tr("stale");
    case EventKind::LossLimit:
        return tr("loss %1 %").arg(fixed(event.value, 1));
    case EventKind::JitterLimit:
        return tr("jitter %1 ms").arg(fixed(event.value, 1));
    case EventKind::GapLimit:
        return tr("gap %1 ms").arg(fixed(event.value, 0));
    case EventKind::RateLimit:
        return tr("rate off %1 %").arg(fixed(event.value, 0));
    default:
        return QString::fromLatin1(model::nameOf(event.kind).data());
    }
}

QString packetFilterOf(model::SessionView& view, const model::Event& event) {
    const char* condition = conditionOf(event.kind);
    const bool isLimit = event.group() == model::EventGroup::Limit;
    if (condition == nullptr && !isLimit) {
        return {};
    }
    QStringList conditions;
    if (condition != nullptr) {
        conditions += QLatin1String(condition);
    }
    if (event.type) {
        conditions += equals("type", digitsOf(*event.type).toStdString());
    }
    if (event.character) {
        conditions += equals("character", std::to_string(*event.character));
    }
    const model::Sender* sender = view.find(event.sender);
    if (sender != nullptr && view.senders().size() > 1) {
        conditions += equals("source", sender->info.address);
    }
    conditions +=
        isLimit ? rangeFilter(view, rangeOf(view, event))
                : QStringLiteral("number >= %1 && number <= %2").arg(event.firstPacket).arg(event.lastPacket);
    return conditions.join(QStringLiteral(" && "));
}

std::optional<std::uint64_t> eventPacket(model::SessionView& view, const model::Event& event) {
    if (!hasPacket(event.kind)) {
        return packetBefore(view, event.firstStamp);
    }
    return event.lastPacket >= view.begin() && event.lastPacket < view.end() ? std::optional(event.lastPacket)
                                                                             : std::nullopt;
}

bool showPacketsOf(model::SessionView& view, Commands& commands, const model::Event& event) {
    const auto packet = eventPacket(view, event);
    if (!packet) {
        return false;
    }
    commands.setDisplayFilter(packetFilterOf(view, event));
    commands.selectPacket(*packet);
    commands.showDock(QStringLiteral("packets"));
    return true;
}

} // namespace posewire::gui
