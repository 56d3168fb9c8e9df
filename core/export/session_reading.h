// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/accounting/stream_figures.h"
#include "core/model/session/roster.h"
#include "core/model/session/session_view.h"

#include <cstdint>
#include <string>
#include <vector>

/// What reports and tables read from a session, in the form in which they write it.
namespace posewire::exporting {

/// The streams of a character by type, whichever came first.
[[nodiscard]] std::vector<const model::Stream*> streamsByType(const model::SessionView& session,
                                                              const model::CharacterKey& key);

/// A figure as people read it: "12,345", "2.50". What is not known is 0.
[[nodiscard]] std::string figureText(const model::StreamFigures& figures, model::Figure figure, int decimals);

/// False where all that came from a sender was something else.
[[nodiscard]] bool hasSentMxtp(const model::Sender& sender);

} // namespace posewire::exporting
