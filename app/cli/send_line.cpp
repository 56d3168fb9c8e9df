// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/send.h"

#include <algorithm>

namespace posewire::cli {

net::NetResult<SendLine> SendLine::open(const std::vector<net::SendTarget>& targets,
                                        const performer::FaultSettings& faults, bool keepsTruth) {
    SendLine line(faults, keepsTruth);
    for (const net::SendTarget& target : targets) {
        auto sender = net::DatagramSender::connect(target);
        if (!sender) {
            return tl::unexpected(sender.error());
        }
        std::string address = sender->localAddress();
        const bool isTcp = target.transport == net::SendTarget::Transport::Tcp;
        line.m_senders.push_back({std::move(address), isTcp, std::move(*sender), {}, {}});
    }
    return line;
}

net::NetResult<void> SendLine::send(const performer::Sending& sending) {
    for (Sender& sender : m_senders) {
        const std::uint64_t before = sender.sender.sent();
        if (auto sent = sender.sender.send(sending.bytes); !sent) {
            return sent;
        }
        if (!m_keepsTruth || sender.sender.sent() == before) {
            continue; // what the system refused was not sent
        }
        if (sender.isTcp) {
            sender.streamed.add(sending);
        } else {
            sender.datagrams.add(sending);
        }
    }
    return {};
}

net::NetResult<void> SendLine::finish() {
    for (Sender& sender : m_senders) {
        sender.streamed.finish();
        if (auto flushed = sender.sender.flush(); !flushed) {
            return flushed;
        }
    }
    return {};
}

template <typename Take>
void SendRound::collect(const Take& take) {
    m_leaving.clear();
    for (std::size_t line = 0; line < m_lines.size(); ++line) {
        m_taken.clear();
        take(m_lines[line].faults());
        for (performer::Sending& sending : m_taken) {
            m_leaving.push_back({line, std::move(sending)});
        }
    }
    if (m_lines.size() > 1) {
        std::ranges::stable_sort(m_leaving, {}, [](const Leaving& leaving) { return leaving.sending.due; });
    }
}

net::NetResult<void> SendRound::sendCollected() {
    for (Leaving& leaving : m_leaving) {
        // A busy computer sends later than planned; lateness counts from when it was sent.
        leaving.sending.due += m_schedule.waitUntil(leaving.sending.due);
        if (auto sent = m_lines[leaving.line].send(leaving.sending); !sent) {
            return sent;
        }
    }
    return {};
}

net::NetResult<void> SendRound::sendUntil(log::Duration until) {
    collect([&](performer::Faults& faults) { faults.takeUntil(until, m_taken); });
    return sendCollected();
}

net::NetResult<void> SendRound::sendRest() {
    collect([&](performer::Faults& faults) { faults.takeRest(m_taken); });
    return sendCollected();
}

} // namespace posewire::cli
