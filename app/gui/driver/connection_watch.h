// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/receiving_state.h"
#include "core/log/time.h"
#include "core/model/session/session_view.h"

#include <cstdint>
#include <vector>

namespace posewire::gui {

/// Looks now and then at all that tells why no characters are seen. What it asks the system (addresses,
/// packet filter) it asks seldom.
class ConnectionWatch {
public:
    /// Writes the findings and the addresses of this computer into `state`, at most four times a second.
    void examine(const model::SessionView& session, log::Stamp now, ReceivingState& state);

private:
    void askSystem(log::Stamp now);
    void noteOpenings(log::Stamp now, const ReceivingState& state);

    std::vector<net::LocalAddress> m_addresses;
    std::optional<net::Firewall> m_firewall;
    std::vector<net::InputId> m_open;
    log::Stamp m_opened{}; ///< the inputs that are open now
    log::Stamp m_examined{};
    log::Stamp m_asked{};
};

/// The facts that the session and the inputs give; without those of the system.
[[nodiscard]] net::ConnectionFacts connectionFacts(const model::SessionView& session,
                                                   const ReceivingState& state, log::Stamp opened,
                                                   log::Stamp now);

} // namespace posewire::gui
