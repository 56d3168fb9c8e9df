// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/accounting/stream_figures.h"
#include "core/model/session/session_view.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// What reports and tables read from a session, in the form in which they write it.
namespace posewire::exporting {

/// Samples lost, by LossCause. In a range as far as its gaps are still known; the rest is unknown.
[[nodiscard]] std::array<std::uint64_t, model::kLossCauses>
lostByCause(const model::SessionView& session, const model::Stream& stream,
            const std::optional<model::TimeRange>& range = {});

/// With whose losses they were, also in a range.
[[nodiscard]] model::StreamFigures figuresOf(const model::SessionView& session, const model::Stream& stream,
                                             const std::optional<model::TimeRange>& range = {});

/// The streams of a character by type, whichever came first.
[[nodiscard]] std::vector<const model::Stream*> streamsByType(const model::SessionView& session,
                                                              const model::CharacterKey& key);

/// A figure as people read it: "12,345", "2.50". What is not known is 0.
[[nodiscard]] std::string figureText(const model::StreamFigures& figures, model::Figure figure, int decimals);

/// False where all that came from a sender was something else.
[[nodiscard]] bool hasSentMxtp(const model::Sender& sender);

} // namespace posewire::exporting
