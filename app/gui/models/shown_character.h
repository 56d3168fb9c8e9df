// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/column.h"
#include "app/gui/theme/character_mark.h"
#include "core/model/session/losses.h"
#include "core/model/session/session_view.h"
#include "core/model/session/verdict.h"

#include <QString>

#include <optional>

namespace posewire::gui {

/// The character that panels for one character show: the selected one, else the first that appeared (of the
/// selected sender, where a sender is selected). Nothing where there is none.
[[nodiscard]] std::optional<model::CharacterKey> shownCharacter(model::SessionView& view);

/// The selection with another character; the segment goes with the character, or is the one given.
[[nodiscard]] model::Selection selectionOf(model::SessionView& view, const model::CharacterKey& key,
                                           std::optional<int> segment = {});

/// The moment of the names beside figures of view.range(): figures of all there is have those of now.
[[nodiscard]] inline const model::SessionView& namesBeside(const model::SessionView& view) {
    return view.range() ? view : view.atNow();
}
[[nodiscard]] QString characterName(const model::SessionView& view, const model::CharacterKey& key);
/// Its name, and what tells it from others of now that have the same: its ID, "Mira · 2", or where they share
/// that too its sender, "Mira · 0 · :40002", by the port where they come from one host.
[[nodiscard]] QString nameApart(const model::SessionView& view, const model::CharacterKey& key);
/// The sender, as nameApart() says it; empty where name and ID are of nobody else.
[[nodiscard]] QString senderApart(const model::SessionView& view, const model::CharacterKey& key);
[[nodiscard]] CharacterMark characterMark(const model::SessionView& view, const model::CharacterKey& key);

/// The newest packet that the cursor lets through; 0 where there is none.
[[nodiscard]] std::uint64_t newestVisiblePacket(model::SessionView& view);

/// From the first packet to now, whatever the cursor; of a recording to its last packet. Nothing before
/// anything came.
[[nodiscard]] std::optional<model::TimeRange> wholeSpan(const model::SessionView& view);

/// What time figures are of, in the words that every dock has for it: "last 10 s", "since reset, 3.2 s",
/// "selection 10:42:17.5 + 2.1 s", "all, 12 min"; empty before anything came.
[[nodiscard]] QString spanText(const model::SessionView& view);

/// The selected range as a choice, with its samples of the shown character: "Selected: 10:42:17.508 to
/// 10:42:19.608, 126 samples".
[[nodiscard]] QString rangeText(model::SessionView& view, const model::TimeRange& range);

/// Without data for this long a stream is silent (seconds).
inline constexpr double kSilentAge = 0.25;
using model::kStaleAge;
using model::patienceAt;

/// "stale 3.2 s"; nothing while it is not.
[[nodiscard]] QString staleText(double ageSeconds, double rateHz = 0);

/// Whether a stream is well: age first, then malformed datagrams, then lost samples. Types that are sent now
/// and then (12, 13) never get stale. Of `losses` the range is that in which what was lost counts.
[[nodiscard]] PropertyValue streamState(model::SessionView& view, const model::Losses& losses,
                                        const model::Stream& stream);
[[nodiscard]] Health healthOf(model::TakeVerdict::State state);
/// A verdict in a few words; the tooltip has it in full.
[[nodiscard]] PropertyValue verdictState(const model::TakeVerdict& verdict);
/// The session's own verdict on a character (SessionView::verdicts).
[[nodiscard]] PropertyValue characterState(model::SessionView& view, const model::Character& character);

/// True while data keep coming: no older than kStaleAge.
[[nodiscard]] bool isLive(model::SessionView& view, const model::Character& character);

} // namespace posewire::gui
