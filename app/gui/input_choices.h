// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/options.h"

#include <QJsonObject>

#include <cstdint>
#include <optional>
#include <vector>

namespace posewire::gui {

/// A host that is to get a copy of every datagram.
struct RelayChoice {
    QString host;
    std::uint16_t port = kDefaultPort;
    bool isOn = true;
    friend bool operator==(const RelayChoice&, const RelayChoice&) = default;
};

/// What the operator chose to hear and to forward: kept from one run to the next.
struct InputChoices {
    std::optional<std::vector<InputAddress>> inputs{}; ///< nothing where nobody has chosen yet
    std::vector<RelayChoice> relays{};
    friend bool operator==(const InputChoices&, const InputChoices&) = default;
};

[[nodiscard]] QJsonObject jsonOf(const InputChoices& choices);

/// Leaves out what makes no sense.
[[nodiscard]] InputChoices inputChoicesOf(const QJsonObject& object);

/// What to open at the start: what was asked for on the command line; where nothing was, what was open last,
/// else the port that MVN sends to.
[[nodiscard]] std::vector<InputAddress> inputsToOpen(const Options& options, const InputChoices& choices);

/// "studio:9763", "[::1]:9763".
[[nodiscard]] QString displayText(const RelayChoice& relay);

} // namespace posewire::gui
