// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "app/net/input.h"
#include "core/log/kernel_counters.h"
#include "core/log/time.h"
#include "core/model/session/session_view.h"
#include "core/words/fact.h"

#include <QTcpServer>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace posewire::net {

/// A packet filter on this computer. Its rules are not read, which would need administrator rights.
struct Firewall {
    std::string name;    ///< "ufw", "firewalld", "nftables", "iptables", "Windows Firewall"
    std::string command; ///< opens a port; PORT/udp in it becomes the port; empty if there is none
};

/// The active packet filter of this computer, as far as any user may see it. Empty if none was found, which
/// is no proof that there is none.
[[nodiscard]] std::optional<Firewall> findFirewall();
/// Finds it by the files of Linux below a folder.
[[nodiscard]] std::optional<Firewall> findFirewall(const std::string& root);

struct FailedInput {
    InputKind kind = InputKind::Udp;
    Endpoint endpoint;
    NetError error;
};

/// Everything that can explain why no characters are visible.
struct ConnectionFacts {
    std::vector<InputStatus> inputs;
    std::vector<FailedInput> failed;
    std::uint64_t datagrams = 0;         ///< received in total, whatever they are
    log::Duration silence{};             ///< since the newest of them, or since the inputs were opened
    std::vector<words::Fact> foreign;    ///< see model::Sender::foreignFact()
    std::vector<LocalAddress> addresses; ///< see reachable()
    std::optional<Firewall> firewall;
    log::KernelCounters kernel; ///< since data last came, or the inputs were opened
    std::string knocker;        ///< who connected to the port by TCP, where it is listened on for UDP alone
    log::Stamp now{};
};

/// Advice for an operator who sees nothing, most certain first; empty if all is well. Silence counts after
/// two seconds.
[[nodiscard]] std::vector<words::Fact> connectionHelp(const ConnectionFacts& facts);

/// Gathers the facts again and again while a session follows what is received.
class ConnectionWatch {
public:
    /// The advice of now. The system is asked for what changes seldom every three seconds.
    [[nodiscard]] std::vector<words::Fact> look(const model::SessionView& session,
                                                std::vector<InputStatus> inputs,
                                                std::vector<FailedInput> failed,
                                                const log::KernelCounters& kernel, log::Stamp now);
    /// See reachable().
    [[nodiscard]] const std::vector<LocalAddress>& addresses() const { return m_addresses; }
    /// Before an input takes the port: see answerKnocks().
    void closeDoor() { m_door.close(); }

private:
    void answerKnocks(ConnectionFacts& facts);

    std::vector<InputId> m_open;
    log::Stamp m_opened{};
    log::Stamp m_asked{};
    std::vector<LocalAddress> m_addresses;
    std::optional<Firewall> m_firewall;
    log::KernelCounters m_kernel; ///< when data last came
    QTcpServer m_door;
    std::string m_knocker;
};

} // namespace posewire::net
