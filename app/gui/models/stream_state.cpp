// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/stream_state.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace posewire::gui {

QString staleText(double ageSeconds, double rateHz) {
    const bool isStale = ageSeconds >= std::max(kStaleAge, patienceAt(rateHz));
    return isStale ? tr("stale %1").arg(duration(ageSeconds)) : QString();
}

namespace {

/// What the time without data says; nothing before a stream is silent.
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

PropertyValue malformedState(std::uint64_t count) {
    return {tr("%1 malformed").arg(grouped(count)), Health::Error};
}

/// Another sender has taken over: nothing is wrong, and nothing more will come.
PropertyValue ended() {
    return {tr("ended")};
}

/// Seconds; at least 0, also when the cursor lies before it.
double ageOf(model::SessionView& view, log::Stamp stamp) {
    return std::max(0.0, log::secondsOf(view.cursorStamp() - stamp));
}

} // namespace

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
        return ended();
    }
    if (wire::isSampled(stream.key.type)) {
        const double age = ageOf(view, stream.accounting.lastStamp());
        const PropertyValue state = ageState(age, stream.statistics.rateHz());
        if (state.health != Health::Unknown) {
            return state;
        }
    }
    if (const std::uint64_t malformed = stream.accounting.malformed(); malformed != 0) {
        return malformedState(malformed);
    }
    const model::LossesByCause byCause = losses.of(stream).byCause;
    const std::uint64_t lost = std::accumulate(byCause.begin(), byCause.end(), std::uint64_t{0});
    return {grouped(lost), lost == 0 ? Health::Good : Health::Warning};
}

PropertyValue characterState(model::SessionView& view, const model::Character& character) {
    if (view.roster().isSuperseded(character.key)) {
        return ended();
    }
    return verdictState(view.verdicts().of(character.key));
}

bool isLive(model::SessionView& view, const model::Character& character) {
    return view.messages().ageSeconds(character.key) < kStaleAge;
}

} // namespace posewire::gui
