// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/send.h"
#include "core/export/json_value.h"
#include "core/model/accounting/stream_figures.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace posewire::cli {
namespace {

using exporting::JsonValue;

/// What `monitor` has to count of a stream, in the order of its report.
std::array<std::pair<model::Figure, std::uint64_t>, 11> valuesOf(const performer::SentFigures& sent) {
    using enum model::Figure;
    return {{{Datagrams, sent.datagrams},
             {Samples, sent.samples},
             {Lost, sent.lost},
             {Duplicates, sent.duplicates},
             {Reordered, sent.reordered},
             {Late, sent.late},
             {Incomplete, sent.incomplete},
             {Restarts, sent.restarts},
             {Step, sent.step},
             {FirstSample, sent.firstSample},
             {LastSample, sent.lastSample}}};
}

JsonValue jsonOf(std::uint8_t type, const performer::SentFigures& sent) {
    JsonValue json{{"type", wire::typeDigits(type)}};
    for (const auto& [figure, value] : valuesOf(sent)) {
        const model::FigureRow& row = model::rowOf(figure);
        if (wire::isSampled(type) || row.scope == model::FigureScope::Messages) {
            json[row.key] = value;
        }
    }
    return json;
}

JsonValue jsonOf(const performer::FaultTally& tally) {
    return {{"offered", tally.offered},     {"dropped", tally.dropped},     {"duplicated", tally.duplicated},
            {"reordered", tally.reordered}, {"corrupted", tally.corrupted}, {"truncated", tally.truncated},
            {"withheld", tally.withheld}};
}

/// The streams of a truth are in the order of their characters.
JsonValue::List charactersOf(const performer::Truth& truth) {
    JsonValue::List characters;
    JsonValue::List streams;
    std::optional<std::uint8_t> character;
    const auto finish = [&] {
        if (character) {
            characters.push_back({{"id", *character}, {"streams", std::exchange(streams, {})}});
        }
    };
    for (const auto& [key, stream] : truth.streams()) {
        if (character != key.character) {
            finish();
            character = key.character;
        }
        streams.push_back(jsonOf(key.type, stream.figures()));
    }
    finish();
    return characters;
}

JsonValue jsonOf(const SendLine::Sender& sender, const performer::FaultTally& tally) {
    const performer::SenderFigures& figures = sender.truth().sender();
    return {{"address", sender.address},
            {"transport", sender.isTcp ? "tcp" : "udp"},
            {"datagrams", figures.datagrams},
            {"bytes", figures.bytes},
            {"malformed", figures.malformed},
            {"skippedBytes", sender.isTcp ? sender.streamed.skippedBytes() : 0},
            {"foreignDatagrams", figures.foreign},
            {"characters", charactersOf(sender.truth())},
            {"faults", jsonOf(tally)}};
}

} // namespace

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
        line.m_senders.push_back(
            {std::move(address), net::textOf(target.endpoint), isTcp, std::move(*sender), {}, {}});
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

void SendLine::tellRefusals(const Console& console) {
    for (Sender& sender : m_senders) {
        if (sender.sender.refused() != 0 && !std::exchange(sender.isRefusalTold, true)) {
            console.complain(sender.target + ": the network refuses to send there; check the address, and "
                                             "that the network is connected. Still trying");
        }
    }
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

tl::expected<void, std::string> writeTruth(const SendOptions& options, const std::vector<SendLine>& lines) {
    JsonValue::List senders;
    std::uint64_t foreign = 0;
    for (const SendLine& line : lines) {
        for (const SendLine::Sender& sender : line.senders()) {
            senders.push_back(jsonOf(sender, line.faults().tally()));
            foreign += sender.truth().sender().foreign;
        }
    }
    const JsonValue report{{"durationS", options.durationSeconds},
                           {"foreignDatagrams", foreign},
                           {"sources", std::move(senders)}};
    return Output::writeFile(options.truth, {options.replaces}, report.text(2) + "\n");
}

} // namespace posewire::cli
