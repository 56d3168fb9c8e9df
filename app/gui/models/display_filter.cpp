// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/display_filter.h"

#include "app/gui/models/packet_choice.h"
#include "app/gui/models/packet_search.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/theme/words.h"
#include "core/filter/completion.h"
#include "core/model/accounting/attribution.h"
#include "core/model/incidents/thresholds.h"
#include "core/model/session/accounts.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "core/wire/type_table.h"

#include <QRegularExpression>
#include <QStringList>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

namespace posewire::gui {

namespace {

QString expression(const char* field, const std::string& value) {
    return QString::fromStdString(filter::expressionFor(field, value));
}

QStringList conditionsOf(std::optional<std::uint8_t> type, std::optional<std::uint8_t> character,
                         const model::Sender* source) {
    QStringList conditions;
    if (type) {
        conditions += expression("type", wire::typeDigits(*type));
    }
    if (character) {
        conditions += expression("character", std::to_string(*character));
    }
    if (source != nullptr) {
        conditions += expression("source", source->info.address);
    }
    return conditions;
}

QString anyOf(const QStringList& conditions) {
    const QString any = conditions.join(QStringLiteral(" || "));
    return conditions.size() < 2 ? any : QLatin1Char('(') + any + QLatin1Char(')');
}

/// Empty if none of the senders is known any more.
QString anySource(const model::SessionView& view, const std::set<log::SenderId>& senders) {
    QStringList sources;
    for (const log::SenderId id : senders) {
        if (const model::Sender* sender = view.roster().find(id)) {
            sources += expression("source", sender->info.address);
        }
    }
    return anyOf(sources);
}

/// The filter that finds the packets of such an incident; null if no packet shows it.
const char* conditionOf(model::IncidentKind kind) {
    using enum model::IncidentKind;
    constexpr std::pair<model::IncidentKind, const char*> kConditions[] = {
        {Loss, "gap > 0"},      {Local, "drops > 0 || gap > 0"}, {Outage, "gap > 0"},
        {LossLimit, "gap > 0"}, {Reordered, "reordered"},        {Duplicates, "duplicate"},
        {Restart, "restart"},   {Malformed, "malformed"},        {Foreign, "foreign"}};
    const auto* found =
        std::ranges::find(kConditions, kind, &std::pair<model::IncidentKind, const char*>::first);
    return found == std::end(kConditions) ? nullptr : found->second;
}

/// A limit was exceeded in the window before; what is silent has no packets.
model::TimeRange rangeOf(model::SessionView& view, const model::Incident& event) {
    const auto window = log::durationOf(view.verdicts().thresholds().windowS);
    return {event.firstStamp - window,
            std::max(event.lastStamp, event.firstStamp + std::chrono::milliseconds(1))};
}

QString noteFilter(const model::PacketDigest& digest) {
    const std::pair<bool, const char*> truths[] = {{digest.kind == model::PacketKind::Malformed, "malformed"},
                                                   {isStrange(digest), "foreign"},
                                                   {digest.followsDrops, "drops > 0"},
                                                   {digest.gap != 0, "gap > 0"},
                                                   {digest.isDuplicate, "duplicate"},
                                                   {digest.isReordered, "reordered"},
                                                   {digest.isRestart, "restart"},
                                                   {digest.hasNotices, "notice"}};
    for (const auto& [isTrue, text] : truths) {
        if (isTrue) {
            return QLatin1String(text);
        }
    }
    return {};
}

/// The streams' own conditions: type, character and sources, as far as others have others.
QStringList conditionsOf(model::SessionView& view, const std::vector<log::StreamKey>& streams) {
    std::set<std::uint8_t> types;
    std::set<std::uint8_t> characters;
    std::set<log::SenderId> senders;
    for (const log::StreamKey& stream : streams) {
        types.insert(stream.type);
        characters.insert(stream.character);
        senders.insert(stream.sender);
    }
    const auto onlyOne = [](const std::set<std::uint8_t>& values) {
        return values.size() == 1 ? std::optional(*values.begin()) : std::nullopt;
    };
    QStringList conditions = conditionsOf(onlyOne(types), onlyOne(characters), nullptr);
    const QString sources = anySource(view, senders);
    if (senders.size() < view.roster().senders().size() && !sources.isEmpty()) {
        conditions += sources;
    }
    return conditions;
}

PacketsBehind behindOf(model::SessionView& view, const std::vector<log::StreamKey>& streams,
                       const QStringList& more) {
    PacketsBehind behind{(conditionsOf(view, streams) + more).join(QStringLiteral(" && "))};
    const auto isAlike = [&](auto member) {
        return !streams.empty() && std::ranges::all_of(streams, [&](const log::StreamKey& one) {
            return one.*member == streams.front().*member;
        });
    };
    if (isAlike(&log::StreamKey::type)) {
        behind.type = streams.front().type;
    }
    if (isAlike(&log::StreamKey::character)) {
        behind.character = streams.front().character;
    }
    return behind;
}

bool mayBe(const PacketsBehind& behind, const model::PacketDigest& digest) {
    return (!behind.type || digest.type == *behind.type) &&
           (!behind.character || digest.character == *behind.character) &&
           (!behind.isTrouble || digest.isProblem());
}

bool isMatch(model::SessionView& view, PacketMatcher& matcher, std::uint64_t number) {
    const auto packet = view.packet(number);
    const model::PacketDigest* digest = view.accounts().digests().find(number);
    return packet && digest != nullptr && matcher.matches(*packet, *digest);
}

/// The newest of those from one packet to before another.
std::optional<std::uint64_t> newestIn(model::SessionView& view, const PacketsBehind& behind,
                                      PacketMatcher& matcher, std::uint64_t from, std::uint64_t end) {
    const std::uint64_t oldest = std::max(view.accounts().digests().begin(), from);
    WalkBounds bounds;
    for (std::uint64_t number = end; number-- > oldest && bounds.look();) {
        const model::PacketDigest* digest = view.accounts().digests().find(number);
        if (digest != nullptr && mayBe(behind, *digest)) {
            if (!bounds.read()) {
                return std::nullopt;
            }
            if (isMatch(view, matcher, number)) {
                return number;
            }
        }
    }
    return std::nullopt;
}

/// The newest up to the cursor; where there is none, the newest there is.
std::optional<std::uint64_t> newestBehind(model::SessionView& view, const PacketsBehind& behind) {
    auto filter = filter::Filter::compile(behind.filter.toStdString());
    if (!filter || view.end() == 0) {
        return std::nullopt;
    }
    PacketMatcher matcher(view, *std::move(filter));
    const std::uint64_t visibleEnd = newestVisiblePacket(view) + 1;
    const auto before = newestIn(view, behind, matcher, 0, visibleEnd);
    return before ? before : newestIn(view, behind, matcher, visibleEnd, view.end());
}

} // namespace

QString rangeFilter(model::SessionView& view, const model::TimeRange& range) {
    // Exact, so that what is listed is what is counted.
    const auto seconds = [&](log::Stamp stamp) {
        constexpr qsizetype kLeast = 3; // decimals
        QString text = QString::number(log::secondsOf(stamp - view.firstStamp()), 'f', 9);
        while (text.endsWith(QLatin1Char('0')) && text.size() - text.indexOf(QLatin1Char('.')) > kLeast + 1) {
            text.chop(1);
        }
        return text;
    };
    return QStringLiteral("time >= %1 && time < %2").arg(seconds(range.from), seconds(range.to));
}

QString statisticsFilter(model::SessionView& view, const StatisticsModel& model, const QModelIndex& index) {
    const auto sender = model.sender(index);
    const auto character = model.character(index);
    const model::Stream* stream = model.stream(index);
    const bool needsSource = !character || view.roster().senders().size() > 1;
    QStringList conditions = conditionsOf(stream == nullptr ? std::nullopt : std::optional(stream->key.type),
                                          character ? std::optional(character->character) : std::nullopt,
                                          sender && needsSource ? view.roster().find(*sender) : nullptr);
    const auto figure = figureIn(index.column());
    if (const char* trouble = figure ? model::rowOf(*figure).condition : nullptr) {
        conditions += QLatin1String(trouble);
    }
    if (model.range()) {
        conditions += rangeFilter(view, *model.range());
    }
    return conditions.join(QStringLiteral(" && "));
}

PacketsBehind streamsBehind(model::SessionView& view, const std::vector<log::StreamKey>& streams,
                            const std::optional<model::TimeRange>& range) {
    return behindOf(view, streams, range ? QStringList{rangeFilter(view, *range)} : QStringList());
}

PacketsBehind lossesBehind(model::SessionView& view, const LossesSought& losses) {
    constexpr std::size_t kMostNamed = 200;
    const std::set<log::StreamKey> streams(losses.streams.begin(), losses.streams.end());
    std::vector<std::uint64_t> packets;
    bool mustName = false; // what is sought is not all that a condition can say
    const auto look = [&](const log::StreamKey& stream, log::Stamp stamp, model::LossCause cause,
                          std::uint64_t packet) {
        const bool isInside = !losses.range || (stamp >= losses.range->from && stamp < losses.range->to);
        if (!isInside || packet < view.begin() || !streams.contains(stream)) {
            return false;
        }
        const bool isSought = !losses.cause || cause == *losses.cause;
        if (isSought) {
            packets.push_back(packet);
        }
        mustName = mustName || !isSought;
        return isSought;
    };
    for (const model::Gap& gap : view.accounts().attribution().gaps()) {
        for (const model::LossCause cause : gap.lost != 0 ? gap.causes() : std::vector<model::LossCause>()) {
            look(gap.stream, gap.toStamp, cause, gap.toPacket);
        }
    }
    view.accounts().attribution().forEachPartialLoss(
        [&](const log::StreamKey& stream, log::Stamp stamp, model::LossCause cause, std::uint64_t packet) {
            mustName = look(stream, stamp, cause, packet) || mustName;
        });
    std::ranges::sort(packets);
    packets.erase(std::unique(packets.begin(), packets.end()), packets.end());
    const auto newest = packets.empty() ? std::nullopt : std::optional(packets.back());
    if (mustName) {
        QStringList numbers;
        const std::size_t named = std::min(packets.size(), kMostNamed);
        std::for_each(packets.end() - static_cast<std::ptrdiff_t>(named), packets.end(),
                      [&](std::uint64_t packet) { numbers += QString::number(packet); });
        return {QStringLiteral("number in {%1}").arg(numbers.join(QStringLiteral(", "))), newest};
    }
    QStringList conditions{QStringLiteral("gap > 0")};
    if (losses.range) {
        conditions += rangeFilter(view, *losses.range);
    }
    PacketsBehind behind = behindOf(view, losses.streams, conditions);
    behind.packet = newest;
    behind.isTrouble = true;
    return behind;
}

PacketsBehind packetsBehind(model::SessionView& view, const StatisticsModel& model,
                            const QModelIndex& index) {
    const auto figure = figureIn(index.column());
    const auto* cause =
        figure ? std::ranges::find(model::kFigureOfCause, *figure) : model::kFigureOfCause.end();
    if (cause != model::kFigureOfCause.end()) {
        std::vector<log::StreamKey> streams;
        std::ranges::transform(model.streamsOf(index), std::back_inserter(streams), &model::Stream::key);
        return lossesBehind(view, {std::move(streams),
                                   static_cast<model::LossCause>(cause - model::kFigureOfCause.begin()),
                                   model.range()});
    }
    PacketsBehind behind{statisticsFilter(view, model, index)};
    const model::Stream* stream = model.stream(index);
    const auto character = model.character(index);
    behind.type = stream == nullptr ? std::nullopt : std::optional(stream->key.type);
    behind.character = character ? std::optional(character->character) : std::nullopt;
    behind.isTrouble = figure && model::rowOf(*figure).condition != nullptr;
    return behind;
}

QString statisticsFilterTitle(int column) {
    const auto figure = figureIn(column);
    if (!figure) {
        return column == kNameColumn ? tr("All packets") : QString();
    }
    const char* title = model::rowOf(*figure).packets;
    return title == nullptr ? QString() : tr(title);
}

QString characterFilter(const model::SessionView& view, const model::CharacterKey& key) {
    std::set<log::SenderId> senders;
    QStringList ids;
    for (const model::Character* one : view.roster().lineage(key)) {
        senders.insert(one->key.sender);
        ids += expression("character", std::to_string(one->key.character));
    }
    ids.removeDuplicates();
    QStringList conditions{anyOf(ids)};
    const QString sources = anySource(view, senders);
    if (view.roster().senders().size() > 1 && !sources.isEmpty()) {
        conditions += sources;
    }
    return conditions.join(QStringLiteral(" && "));
}

std::optional<std::uint8_t> characterOf(const model::Incident& event) {
    const auto character = event.character();
    return character ? std::optional(character->character) : std::nullopt;
}

QString packetFilterOf(model::SessionView& view, const model::Incident& event) {
    const char* condition = conditionOf(event.kind);
    const bool isLimit = event.group() == model::IncidentGroup::Limit;
    if (condition == nullptr && !isLimit) {
        return {};
    }
    QStringList conditions =
        conditionsOf(event.type(), characterOf(event),
                     view.roster().senders().size() > 1 ? view.roster().find(event.sender) : nullptr);
    if (condition != nullptr) {
        const QString text = QLatin1String(condition);
        conditions.prepend(text.contains(QLatin1String("||")) ? QLatin1Char('(') + text + QLatin1Char(')')
                                                              : text);
    }
    const bool isSettled = event.lastPacket != 0;
    conditions +=
        isLimit ? rangeFilter(view, rangeOf(view, event))
        : !isSettled
            ? rangeFilter(view, {event.firstStamp, event.lastStamp + std::chrono::milliseconds(1)})
            : QStringLiteral("number >= %1 && number <= %2").arg(event.firstPacket).arg(event.lastPacket);
    return conditions.join(QStringLiteral(" && "));
}

QString packetCellFilter(model::SessionView& view, std::uint64_t number, int column) {
    const auto facts = packetFacts(view, number);
    if (!facts) {
        return {};
    }
    const auto seconds = [](const char* condition, double value) {
        return QLatin1String(condition) + QString::number(value, 'f', 6);
    };
    switch (column) {
    case PacketModel::kNumber:
        return expression("number", std::to_string(number));
    case PacketModel::kTime:
        return seconds("time >= ", log::secondsOf(std::chrono::floor<std::chrono::microseconds>(
                                       facts->stamp - view.firstStamp())));
    case PacketModel::kDelta: {
        const double delta = static_cast<double>(facts->digest.deltaS);
        return delta < 0 ? QString() : seconds("delta >= ", std::floor(1e6 * delta) / 1e6);
    }
    case PacketModel::kSender: {
        const auto sender = view.log().senders().find(facts->sender);
        return sender == nullptr ? QString() : expression("source", sender->address);
    }
    case PacketModel::kSize:
        return expression("size", std::to_string(facts->size));
    case PacketModel::kNote:
        return noteFilter(facts->digest);
    case PacketModel::kType:
        return facts->header              ? expression("type", wire::typeDigits(facts->header->type()))
               : isStrange(facts->digest) ? QStringLiteral("foreign")
                                          : QStringLiteral("malformed");
    default:
        break;
    }
    if (!facts->header) {
        return {};
    }
    return column == PacketModel::kCharacter
               ? expression("character", std::to_string(facts->header->character))
           : column == PacketModel::kSample
               ? expression("sample", std::to_string(facts->header->sampleCounter))
               : expression("datagram", std::to_string(facts->header->datagramIndex()));
}

QString joinedFilter(const QString& filter, const QString& condition, FilterJoin join) {
    const QString before = filter.trimmed();
    const QString negated = QStringLiteral("!(%1)").arg(condition);
    if (before.isEmpty() || join == FilterJoin::Replace) {
        return join == FilterJoin::AndNot ? negated : condition;
    }
    if (join == FilterJoin::Or) {
        return before + QStringLiteral(" || ") + condition;
    }
    static const QRegularExpression either(QStringLiteral(R"(\|\||\bor\b)")); // one in a text does no harm
    const bool isLoose = before.contains(either);
    const QString kept = isLoose ? QStringLiteral("(%1)").arg(before) : before;
    return kept + QStringLiteral(" && ") + (join == FilterJoin::AndNot ? negated : condition);
}

bool isListed(model::SessionView& view, const QString& filter, std::uint64_t packet) {
    auto compiled = filter::Filter::compile(filter.trimmed().toStdString());
    if (!compiled) {
        return true;
    }
    PacketMatcher matcher(view, *std::move(compiled));
    return isMatch(view, matcher, packet);
}

bool showPackets(model::SessionView& view, Commands& commands, const PacketsBehind& behind, PacketLook look) {
    const auto packet = behind.packet ? behind.packet : newestBehind(view, behind);
    if (!packet || !view.packet(*packet)) {
        return false;
    }
    QString filter = QString::fromStdString(view.choices().ownFilter());
    const QString alone =
        behind.filter.isEmpty() ? QStringLiteral("number == %1").arg(*packet) : behind.filter;
    if (look == PacketLook::Alone) {
        filter = alone;
    } else if (!isListed(view, filter, *packet)) {
        // Beside the packets that a limit or an outage is about lies the one to go to.
        filter = joinedFilter(
            filter, isListed(view, alone, *packet) ? alone : QStringLiteral("number == %1").arg(*packet),
            FilterJoin::Or);
    }
    commands.jump(*packet, filter);
    commands.showDock(QStringLiteral("packets"));
    return true;
}

QString noPacketsText() {
    return tr("None of these packets is in memory any more.");
}

} // namespace posewire::gui
