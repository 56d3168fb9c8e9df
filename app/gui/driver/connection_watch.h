// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/receiving_state.h"
#include "core/model/session/session_view.h"

#include <cstdint>
#include <vector>

namespace posewire::gui {

/// Looks now and then at all that tells why no characters are seen. What it asks the system (addresses,
/// packet filter) it asks seldom.
class ConnectionWatch {
public:
    /// Writes the findings and the addresses of this computer into `state`, at most four times a second.
    void examine(const model::SessionView& session, std::int64_t nowNs, ReceivingState& state);

private:
    void askSystem(std::int64_t nowNs);
    void noteOpenings(std::int64_t nowNs, const ReceivingState& state);

    std::vector<net::LocalAddress> m_addresses;
    std::optional<net::Firewall> m_firewall;
    std::vector<net::InputId> m_open;
    std::int64_t m_openedNs = 0; ///< the inputs that are open now
    std::int64_t m_examinedNs = 0;
    std::int64_t m_askedNs = 0;
};

/// The facts that the session and the inputs give; without those of the system.
[[nodiscard]] net::ConnectionFacts connectionFacts(const model::SessionView& session,
                                                   const ReceivingState& state, std::int64_t openedNs,
                                                   std::int64_t nowNs);

} // namespace posewire::gui
