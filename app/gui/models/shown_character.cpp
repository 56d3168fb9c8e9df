// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/shown_character.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace posewire::gui {

namespace {

QString senderAmong(const model::SessionView& view, const model::CharacterKey& key,
                    const model::Roster::Namesakes& namesakes) {
    const QString address = shown(view.roster().addressOf(key.sender));
    const qsizetype port = std::max<qsizetype>(0, address.lastIndexOf(QLatin1Char(':'))); // with its colon
    return namesakes.ofSameId == 0                           ? QString()
           : namesakes.ofSameIdAndHost == namesakes.ofSameId ? address.mid(port)
                                                             : address;
}

/// Nothing before a stream is silent.
PropertyValue ageState(double age, double rateHz) {
    const double patience = patienceAt(rateHz);
    if (const QString stale = staleText(age, rateHz); !stale.isEmpty()) {
        return {stale, Health::Error};
    }
    if (age >= std::max(kSilentAge, patience)) {
        return {tr("silent %1").arg(duration(age)), Health::Warning};
    }
    return {};
}

} // namespace

std::optional<model::CharacterKey> shownCharacter(model::SessionView& view) {
    const model::Selection& selection = view.choices().selection;
    if (selection.character && view.roster().find(*selection.character) != nullptr) {
        return view.roster().current(*selection.character);
    }
    const auto characters = view.roster().listed();
    const auto first = std::ranges::find_if(characters, [&](const model::Character* character) {
        return !selection.sender || character->key.sender == *selection.sender;
    });
    return first == characters.end() ? std::nullopt : std::optional((*first)->key);
}

model::Selection selectionOf(model::SessionView& view, const model::CharacterKey& key,
                             std::optional<int> segment) {
    model::Selection selection = view.choices().selection;
    if (segment || selection.character != key) {
        selection.segment = segment.value_or(-1);
    }
    selection.sender = key.sender;
    selection.character = key;
    return selection;
}

QString characterName(const model::SessionView& view, const model::CharacterKey& key) {
    return shown(view.roster().displayName(key));
}

QString nameApart(const model::SessionView& view, const model::CharacterKey& key) {
    QString name = shown(view.roster().displayName(key));
    const auto namesakes = view.roster().namesakes(key);
    if (namesakes.all != 0) {
        name += QStringLiteral(" · %1").arg(key.character);
        const QString sender = senderAmong(view, key, namesakes);
        name += sender.isEmpty() ? QString() : QStringLiteral(" · ") + sender;
    }
    return name;
}

QString senderApart(const model::SessionView& view, const model::CharacterKey& key) {
    return senderAmong(view, key, view.roster().namesakes(key));
}

CharacterMark characterMark(const model::SessionView& view, const model::CharacterKey& key) {
    const model::Colour colour = view.roster().colour(key);
    return {QColor::fromRgbF(std::clamp(colour.red, 0.0F, 1.0F), std::clamp(colour.green, 0.0F, 1.0F),
                             std::clamp(colour.blue, 0.0F, 1.0F)),
            key.character};
}

std::uint64_t newestVisiblePacket(model::SessionView& view) {
    const std::uint64_t newest = view.end() == 0 ? 0 : view.end() - 1;
    return view.choices().cursor.mode == model::Cursor::Mode::Paused
               ? std::min(view.choices().cursor.packet, newest)
               : newest;
}

std::optional<model::TimeRange> wholeSpan(const model::SessionView& view) {
    if (view.end() == 0 || view.firstStamp() == log::Stamp()) {
        return std::nullopt;
    }
    const auto newest = view.isRecording() ? view.packet(view.end() - 1) : std::nullopt;
    const log::Stamp end = newest ? newest->stamp : view.now();
    return model::TimeRange{view.firstStamp(), std::max(end, view.firstStamp()) + log::Duration(1)};
}

QString spanText(const model::SessionView& view) {
    const auto whole = wholeSpan(view);
    if (!whole) {
        return {};
    }
    const auto range = view.range();
    if (!range) {
        return tr("all, %1").arg(duration(whole->seconds()));
    }
    const QString length = duration(range->seconds());
    if (view.choices().range.isSinceReset) {
        return tr("since reset, %1").arg(length);
    }
    if (!view.choices().range.fixed) {
        return tr("last %1").arg(length);
    }
    return tr("selection %1 + %2").arg(timeOfDay(view.wallOf(range->from)).chopped(2), length);
}

QString rangeText(model::SessionView& view, const model::TimeRange& range) {
    std::uint64_t samples = 0;
    const model::Character* character = nullptr;
    if (const auto key = shownCharacter(view)) {
        character = view.roster().find(*key);
    }
    for (const model::Stream* stream :
         character != nullptr ? character->streams : decltype(character->streams)()) {
        samples = std::max(samples, stream->accounting.counts(range).samples);
    }
    return tr("Selected: %1 to %2, %n sample(s)", nullptr, static_cast<int>(samples))
        .arg(timeOfDay(view.wallOf(range.from)), timeOfDay(view.wallOf(range.to - log::Duration(1))));
}

QString staleText(double ageSeconds, double rateHz) {
    const bool isStale = ageSeconds >= std::max(kStaleAge, patienceAt(rateHz));
    return isStale ? tr("stale %1").arg(duration(ageSeconds)) : QString();
}

Health healthOf(model::TakeVerdict::State state) {
    constexpr std::array kHealths{Health::Unknown, Health::Good, Health::Warning, Health::Error}; // by State
    return kHealths[static_cast<std::size_t>(state)];
}

PropertyValue verdictState(const model::TakeVerdict& verdict) {
    return {said(verdict.said, words::Form::Brief), healthOf(verdict.state),
            said(verdict.said, words::Form::Headline)};
}

PropertyValue streamState(model::SessionView& view, const model::Losses& losses,
                          const model::Stream& stream) {
    if (view.roster().isSuperseded({stream.key.sender, stream.key.character})) {
        return {tr("ended")}; // another sender has taken over: nothing is wrong, and nothing more will come
    }
    if (wire::isSampled(stream.key.type)) {
        const double age = std::max(0.0, log::secondsOf(view.cursorStamp() - stream.accounting.lastStamp()));
        const PropertyValue state = ageState(age, stream.statistics.rateHz());
        if (state.health != Health::Unknown) {
            return state;
        }
    }
    if (const std::uint64_t malformed = stream.accounting.malformed(); malformed != 0) {
        return {tr("%1 malformed").arg(grouped(malformed)), Health::Error};
    }
    const model::LossesByCause byCause = losses.of(stream).byCause;
    const std::uint64_t lost = std::accumulate(byCause.begin(), byCause.end(), std::uint64_t{0});
    return {grouped(lost), lost == 0 ? Health::Good : Health::Warning};
}

PropertyValue characterState(model::SessionView& view, const model::Character& character) {
    if (view.roster().isSuperseded(character.key)) {
        return {tr("ended")};
    }
    return verdictState(view.verdicts().of(character.key));
}

bool isLive(model::SessionView& view, const model::Character& character) {
    return view.messages().ageSeconds(character.key) < kStaleAge;
}

} // namespace posewire::gui
