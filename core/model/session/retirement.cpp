// SPDX-License-Identifier: MIT
#include "core/model/session/roll.h"

#include <algorithm>
#include <unordered_set>

namespace posewire::model {
namespace {

/// Room is made for several at once, so that a flood of senders costs little for each.
constexpr std::size_t kAtOnce = 64;
/// Who has been silent for this long makes room for others.
constexpr log::Duration kSilent = std::chrono::seconds(10);
/// Who has sent this many datagrams is no passer-by.
constexpr std::uint64_t kEstablished = 8;
/// Retired senders of which it is remembered how much they have sent.
constexpr std::size_t kMostPassersBy = 65'536;

} // namespace

void SenderTotals::add(const Sender& sender) {
    ++senders;
    datagrams += sender.datagrams;
    bytes += sender.bytes;
    malformed += sender.malformed;
    foreign += sender.foreign;
    skippedBytes += sender.skippedBytes;
    kernelDrops += sender.kernelDrops;
    hasUncountedDrops |= sender.hasUncountedDrops;
}

void SenderTotals::add(const log::Packet& packet, PacketKind kind) {
    datagrams += kind == PacketKind::Skipped ? 0 : 1;
    bytes += packet.bytes.size();
    malformed += kind == PacketKind::Malformed ? 1 : 0;
    foreign += kind == PacketKind::Foreign ? 1 : 0;
    skippedBytes += kind == PacketKind::Skipped ? packet.bytes.size() : 0;
    kernelDrops += packet.droppedBefore();
    hasUncountedDrops |= packet.flags.dropsUncounted;
}

void RetiredTotals::retire(const Sender& sender) {
    add(sender);
    for (const Character* character : sender.characters) {
        for (const Stream* stream : character->streams) {
            const StreamCounts counts = stream->accounting.counts();
            ++streams;
            samples += counts.samples;
            lost += counts.lost;
            if (!countsSamples(stream->key.type)) {
                continue;
            }
            const StreamFigures figures = figuresOf(*stream);
            for (Worst& one : worst) {
                if (figures[one.figure] > one.value) {
                    one = {one.figure, figures[one.figure], stream->key};
                }
            }
        }
    }
}

/// What it is and how long it has been there decide who makes room for a sender: first those who have been
/// silent for long, then those who have said little.
void Roll::promote(const Sender& sender) {
    Place& place = m_recencies.at(sender.id);
    if (place.list == &m_performers) {
        return;
    }
    const auto before = m_passersBy.find(sender.id);
    const std::uint64_t heard = sender.datagrams + (before == m_passersBy.end() ? 0 : before->second);
    Recency& list = heard >= kEstablished ? m_performers : m_newcomers;
    if (place.list == &list) {
        return;
    }
    const bool isNew = place.list == &m_strangers;
    if (isNew && m_newcomers.size() + m_performers.size() >= kMostSenders && !retireSilent()) {
        retireOldest(m_newcomers.empty() ? m_performers : m_newcomers, m_newcomers.empty() ? 1 : kAtOnce);
    }
    list.splice(list.end(), *place.list, place.at);
    place.list = &list;
}

/// False where nobody has been silent for long.
bool Roll::retireSilent() {
    for (const Recency* list : {&m_performers, &m_newcomers}) {
        const auto silent = std::ranges::find_if(
            *list, [this](log::SenderId id) { return m_observed - m_senders.find(id)->lastStamp < kSilent; });
        if (const auto count = static_cast<std::size_t>(std::distance(list->begin(), silent)); count != 0) {
            retireOldest(*list, std::min(count, kAtOnce));
            return true;
        }
    }
    return false;
}

void Roll::retireOldest(const Recency& recency, std::size_t count) {
    std::unordered_set<log::SenderId> going;
    for (auto id = recency.begin(); id != recency.end() && going.size() < count; ++id) {
        going.insert(*id);
    }
    retire(going);
}

void Roll::retire(const std::unordered_set<log::SenderId>& going) {
    for (const log::SenderId id : going) {
        const Sender& sender = *m_senders.find(id);
        remember(sender);
        for (const Character* character : sender.characters) {
            bequeath(*character);
        }
        m_retired.retire(sender);
        forgetHostOf(sender);
        if (m_passersBy.size() >= kMostPassersBy) {
            m_passersBy.clear();
        }
        m_passersBy[id] += sender.datagrams;
        m_listener.goes(sender);
        m_unconfirmed.retire(id);
        const Place place = m_recencies.at(id);
        place.list->erase(place.at);
        m_recencies.erase(id);
    }
    m_streams.eraseIf([&](const Stream& stream) { return going.contains(stream.key.sender); });
    m_characters.eraseIf([&](const Character& character) { return going.contains(character.key.sender); });
    m_senders.eraseIf([&](const Sender& sender) { return going.contains(sender.id); });
    m_listener.haveGone();
}

/// So that what is told of its past can name it.
void Roll::remember(const Sender& sender) {
    if (!sender.isPerforming()) {
        return;
    }
    FormerSender former{sender.id, sender.info.place(), {}};
    for (const Character* character : sender.characters) {
        const MetadataTag* name = nullptr;
        for (const Character* one = character; one != nullptr && name == nullptr;
             one = one->before ? m_characters.find(*one->before) : nullptr) {
            name = one->metadata.find("name");
        }
        if (name != nullptr && former.names.size() < kMostFormerNames) {
            former.names.emplace_back(character->key.character, name->values.back().text);
        }
    }
    m_former.push_back(std::move(former));
    if (m_former.size() > kMostFormer) {
        m_former.pop_front();
    }
}

const FormerSender* Roll::former(log::SenderId id) const {
    const auto found = std::ranges::find(m_former, id, &FormerSender::id);
    return found == m_former.end() ? nullptr : &*found;
}

bool Roll::isForgettable(log::SenderId sender, log::Stamp now) const {
    const Sender* known = m_senders.find(sender);
    return known != nullptr && (hasEnded(*known) || now - known->lastStamp >= kForgettable);
}

bool Roll::forget(log::SenderId sender, log::Stamp now) {
    if (!isForgettable(sender, now)) {
        return false;
    }
    // With those that it took over from: nobody asked for them back.
    std::unordered_set<log::SenderId> going{sender};
    for (const Character* character : m_senders.find(sender)->characters) {
        const bool isLast = heirOf(*character) == nullptr;
        const Character* one = isLast ? character : nullptr;
        while (one != nullptr) {
            one = one->before ? m_characters.find(*one->before) : nullptr;
            if (one != nullptr && hasEnded(*m_senders.find(one->key.sender))) {
                going.insert(one->key.sender);
            }
        }
    }
    retire(going);
    return true;
}

bool Roll::hasEnded(const Sender& sender) const {
    return sender.isPerforming() && std::ranges::all_of(sender.characters, [this](const Character* one) {
               return heirOf(*one) != nullptr;
           });
}

const Character* Roll::heirOf(const Character& character) const {
    const Character* after = character.after ? m_characters.find(*character.after) : nullptr;
    return after != nullptr && after->firstPacket > character.lastPacket ? after : nullptr;
}

/// What is known of a character that goes stays with the one that has taken over: it is the same one.
void Roll::bequeath(const Character& character) {
    Character* before = character.before ? m_characters.find(*character.before) : nullptr;
    Character* heir = heirOf(character) != nullptr ? m_characters.find(*character.after) : nullptr;
    if (before != nullptr) {
        before->after = heir != nullptr ? std::optional(heir->key) : std::nullopt;
    }
    if (heir == nullptr) {
        if (before != nullptr) {
            m_listener.isAwaited(before->key);
        }
        return;
    }
    heir->before = character.before;
    heir->formerRestarts += character.formerRestarts + character.counterRestarts() + 1;
    if (before == nullptr) {
        heir->formerFirstPacket = character.formerFirstPacket.value_or(character.firstPacket);
    }
    if (heir->metadata.tags().empty()) {
        heir->metadata = character.metadata;
    }
    if (heir->nullPoses == nullptr) {
        heir->nullPoses = character.nullPoses;
    }
}

void Roll::forgetHostOf(const Sender& sender) {
    const auto host = sender.host();
    if (!host) {
        return;
    }
    if (const auto newest = m_newestOfHost.find(*host);
        newest != m_newestOfHost.end() && newest->second == sender.id) {
        m_newestOfHost.erase(newest);
    }
    for (const Character* character : sender.characters) {
        const auto namesakes = m_namesakes.find({*host, character->key.character});
        if (namesakes != m_namesakes.end()) {
            std::erase(namesakes->second, character->key);
            if (namesakes->second.empty()) {
                m_namesakes.erase(namesakes);
            }
        }
    }
}

} // namespace posewire::model
