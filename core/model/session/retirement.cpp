// SPDX-License-Identifier: MIT
#include "core/model/accounting/attribution.h"
#include "core/model/incidents/incident_follower.h"
#include "core/model/session/ingest.h"

#include <algorithm>
#include <unordered_set>

/// How an ingest makes room for new senders.
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
    kernelDrops += sender.kernelDrops;
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
void Ingest::promote(const Sender& sender) {
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
bool Ingest::retireSilent() {
    for (const Recency* list : {&m_performers, &m_newcomers}) {
        const auto silent = std::ranges::find_if(
            *list, [this](log::SenderId id) { return m_observed - find(id)->lastStamp < kSilent; });
        if (const auto count = static_cast<std::size_t>(std::distance(list->begin(), silent)); count != 0) {
            retireOldest(*list, std::min(count, kAtOnce));
            return true;
        }
    }
    return false;
}

void Ingest::retireOldest(const Recency& recency, std::size_t count) {
    std::unordered_set<log::SenderId> going;
    for (auto id = recency.begin(); id != recency.end() && going.size() < count; ++id) {
        going.insert(*id);
    }
    retire(going);
}

void Ingest::retire(const std::unordered_set<log::SenderId>& going) {
    for (const log::SenderId id : going) {
        const Sender& sender = *find(id);
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
        m_attribution->retire(id);
        m_incidents->retire(id);
        m_unconfirmed.retire(id);
        const Place place = m_recencies.at(id);
        place.list->erase(place.at);
        m_recencies.erase(id);
    }
    std::erase_if(m_nullPoses, [&](const auto& entry) { return going.contains(entry.first.sender); });
    for (const Stream& stream : m_streams) {
        if (going.contains(stream.key.sender)) {
            m_index.forget(stream.key);
        }
    }
    m_streams.eraseIf([&](const Stream& stream) { return going.contains(stream.key.sender); });
    m_characters.eraseIf([&](const Character& character) { return going.contains(character.key.sender); });
    m_senders.eraseIf([&](const Sender& sender) { return going.contains(sender.id); });
    fitDepth();
}

/// So that what is told of its past can name it.
void Ingest::remember(const Sender& sender) {
    if (!sender.isPerforming()) {
        return;
    }
    FormerSender former{sender.id, sender.info.address, {}};
    for (const Character* character : sender.characters) {
        const MetadataTag* name = nullptr;
        for (const Character* one = character; one != nullptr && name == nullptr;
             one = one->before ? find(*one->before) : nullptr) {
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

const FormerSender* Ingest::former(log::SenderId id) const {
    const auto found = std::ranges::find(m_former, id, &FormerSender::id);
    return found == m_former.end() ? nullptr : &*found;
}

bool Ingest::isForgettable(log::SenderId sender) const {
    const Sender* known = find(sender);
    return known != nullptr && (hasEnded(*known) || m_now - known->lastStamp >= kForgettable);
}

bool Ingest::forget(log::SenderId sender) {
    if (!isForgettable(sender)) {
        return false;
    }
    // With those that it took over from: nobody asked for them back.
    std::unordered_set<log::SenderId> going{sender};
    for (const Character* character : find(sender)->characters) {
        const bool isLast = heirOf(*character) == nullptr;
        const Character* one = isLast ? character : nullptr;
        while (one != nullptr) {
            one = one->before ? find(*one->before) : nullptr;
            if (one != nullptr && hasEnded(*find(one->key.sender))) {
                going.insert(one->key.sender);
            }
        }
    }
    retire(going);
    return true;
}

bool Ingest::hasEnded(const Sender& sender) const {
    return sender.isPerforming() && std::ranges::all_of(sender.characters, [this](const Character* one) {
               const Character* after = one->after ? find(*one->after) : nullptr;
               return after != nullptr && after->firstPacket > one->lastPacket;
           });
}

/// Null where nobody has taken over.
Character* Ingest::heirOf(const Character& character) {
    Character* after = character.after ? m_characters.find(*character.after) : nullptr;
    return after != nullptr && after->firstPacket > character.lastPacket ? after : nullptr;
}

/// What is known of a character that goes stays with the one that has taken over: it is the same one.
void Ingest::bequeath(const Character& character) {
    Character* before = character.before ? m_characters.find(*character.before) : nullptr;
    Character* heir = heirOf(character);
    if (before != nullptr) {
        before->after = heir != nullptr ? std::optional(heir->key) : std::nullopt;
    }
    if (heir == nullptr) {
        if (before != nullptr) {
            m_incidents->expect(before->key);
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
    const auto poses = m_nullPoses.find(character.key);
    if (poses != m_nullPoses.end() && !m_nullPoses.contains(heir->key)) {
        m_nullPoses[heir->key] = poses->second;
    }
}

void Ingest::forgetHostOf(const Sender& sender) {
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
