// SPDX-License-Identifier: MIT
#include "core/model/session/accounts.h"

#include "core/model/session/ingest.h"

#include <algorithm>

namespace posewire::model {

const RetiredTotals& Accounts::retired() const {
    return m_moment.ingest().roll().retired();
}

SenderTotals Accounts::allSenders() const {
    SenderTotals sums = retired();
    for (const Sender& sender : m_roster.senders()) {
        sums.add(sender);
    }
    sums.kernelDrops += dropsUnseen();
    return sums;
}

std::map<log::SenderId, SenderTotals> Accounts::eachSender(const std::optional<TimeRange>& range) const {
    std::map<log::SenderId, SenderTotals> each;
    for (const Sender& sender : m_roster.senders()) {
        SenderTotals& own = each[sender.id];
        if (!range) {
            own.add(sender);
        }
    }
    for (std::uint64_t number = digests().begin(); range && number < digests().end(); ++number) {
        const auto packet = m_moment.packet(number);
        const auto own = packet ? each.find(packet->sender) : each.end();
        if (own != each.end() && packet->stamp >= range->from && packet->stamp < range->to) {
            own->second.add(*packet, digests().at(number).kind);
        }
    }
    return each;
}

std::uint64_t Accounts::unfollowed() const {
    return m_moment.ingest().unfollowed();
}

std::uint64_t Accounts::overtaken() const {
    return m_moment.ingest().overtaken();
}

std::uint64_t Accounts::dropsUnseen() const {
    return m_moment.ingest().dropsUnseen();
}

const log::KernelCounters& Accounts::kernel() const {
    return m_moment.ingest().content().kernel();
}

Unproven Accounts::unproven() const {
    Unproven sums;
    for (const Character& character : m_roster.characters()) {
        if (!character.isConfirmed) {
            ++sums.characters;
            for (const Stream* stream : character.streams) {
                sums.datagrams += stream->accounting.datagrams();
            }
        }
    }
    return sums;
}

std::uint64_t Accounts::restartsOf(const CharacterKey& key) const {
    const auto line = m_roster.lineage(key);
    std::uint64_t restarts = line.empty() ? 0 : line.size() - 1;
    for (const Character* one : line) {
        restarts += one->formerRestarts + one->counterRestarts();
    }
    return restarts;
}

std::vector<const Sender*> Accounts::endedSenders() const {
    std::vector<const Sender*> ended;
    for (const Sender& sender : m_roster.senders()) {
        if (m_moment.ingest().roll().hasEnded(sender)) {
            ended.push_back(&sender);
        }
    }
    return ended;
}

bool Accounts::isForgettable(log::SenderId sender) const {
    return m_moment.ingest().roll().isForgettable(sender, m_moment.ingest().now());
}

StreamCounts Accounts::countsOf(const CharacterKey& key, const TimeRange& range) const {
    StreamCounts sum;
    if (const Character* character = m_roster.find(key)) {
        for (const Stream* stream : character->streams) {
            sum += stream->accounting.countsBetween(range.from, range.to);
        }
    }
    return sum;
}

const Attribution& Accounts::attribution() const {
    return m_moment.ingest().counting().attribution();
}

const PacketDigests& Accounts::digests() const {
    return m_moment.ingest().counting().digests();
}

std::uint64_t Accounts::settledEnd() const {
    constexpr log::Duration kLongest = std::chrono::seconds(1); // what stays open is not waited for
    const log::Stamp after = m_moment.ingest().now() - kLongest;
    const Counting& counting = m_moment.ingest().counting();
    std::uint64_t end = std::min(digests().end(), counting.attribution().firstPending(after));
    for (const Stream& stream : m_roster.streams()) {
        if (stream.accounting.lastStamp() > after) {
            end = std::min(end, stream.accounting.firstInDoubt());
        }
    }
    return std::max(end, digests().begin());
}

} // namespace posewire::model
