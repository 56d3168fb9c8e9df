// SPDX-License-Identifier: MIT
#include "core/model/incidents/incidents.h"

#include <algorithm>
#include <utility>

namespace posewire::model {
namespace {

/// Beyond these, what an incident touched is only in its sums.
constexpr std::size_t kMostPartsOfOne = 1'024;

/// The newest, where it is over and was like this: a figure that hovers about its limit is one incident,
/// however often it comes back under it, and so are the silences between bursts.
Incident* hoveringBefore(std::deque<Incident>& incidents, const Occurrence& one) {
    constexpr std::ptrdiff_t kMostLooked = 256;
    constexpr log::Duration kBurst = std::chrono::milliseconds(150);
    const bool isSilence = one.kind == IncidentKind::Outage;
    if (factsOf(one.kind).group != IncidentGroup::Limit && !isSilence) {
        return nullptr;
    }
    const auto end =
        std::ssize(incidents) > kMostLooked ? incidents.rbegin() + kMostLooked : incidents.rend();
    const auto newest = std::find_if(incidents.rbegin(), end, [&](const Incident& incident) {
        return incident.kind == one.kind && incident.sender == one.sender;
    });
    const bool isLike =
        newest != end && one.from - newest->lastStamp < (isSilence ? kBurst : Incidents::kQuiet);
    return isLike && !(isSilence && newest->samples != 0) ? &*newest : nullptr;
}

void extend(Incident& incident, log::Stamp from, log::Stamp to, std::uint64_t fromPacket,
            std::uint64_t toPacket) {
    incident.firstStamp = std::min(incident.firstStamp, from);
    incident.firstPacket = std::min(incident.firstPacket, fromPacket);
    incident.lastStamp = std::max(incident.lastStamp, to);
    incident.lastPacket = std::max(incident.lastPacket, toPacket);
}

/// True if two spans are as close as those of one burst.
bool isOneTime(log::Stamp from, log::Stamp to, log::Stamp otherFrom, log::Stamp otherTo) {
    return from <= otherTo + Incident::kApart && otherFrom <= to + Incident::kApart;
}

} // namespace

Incidents::Episode Incidents::episodeOf(const Occurrence& one) {
    return {one.sender, one.kind, factsOf(one.kind).isOfCharacter ? one.character : std::nullopt, one.cause,
            one.what};
}

Incidents::Episode Incidents::episodeOf(const Incident& incident) {
    const auto character = factsOf(incident.kind).isOfCharacter ? incident.character() : std::nullopt;
    return {incident.sender, incident.kind, character ? std::optional(character->character) : std::nullopt,
            incident.cause, incident.what};
}

std::deque<Incident>::iterator Incidents::placeOf(std::uint64_t number) {
    return std::ranges::lower_bound(m_incidents, number, {}, &Incident::number);
}

const Incident* Incidents::find(std::uint64_t number) const {
    const auto joined = m_joined.find(number);
    number = joined == m_joined.end() ? number : joined->second;
    const auto place = std::ranges::lower_bound(m_incidents, number, {}, &Incident::number);
    return place != m_incidents.end() && place->number == number ? &*place : nullptr;
}

const Incident* Incidents::currentLike(const Occurrence& like) const {
    const auto found = m_current.find(episodeOf(like));
    return found == m_current.end() ? nullptr : find(found->second);
}

std::vector<const Incident*> Incidents::current() const {
    std::vector<const Incident*> incidents;
    for (const auto& [episode, number] : m_current) {
        incidents.push_back(find(number));
    }
    std::ranges::sort(incidents, {}, &Incident::number);
    return incidents;
}

std::vector<const Incident*> Incidents::currentOf(log::SenderId sender) const {
    std::vector<const Incident*> incidents;
    for (auto current = m_current.lower_bound({sender});
         current != m_current.end() && current->first.sender == sender; ++current) {
        incidents.push_back(find(current->second));
    }
    return incidents;
}

std::vector<const Incident*> Incidents::currentAt(log::Stamp stamp) const {
    std::vector<const Incident*> incidents;
    for (const Incident& incident : m_incidents) {
        const bool hasLasted = incident.lasts() ? incident.isCurrent || incident.lastStamp > stamp
                                                : incident.lastStamp + kQuiet > stamp;
        if (incident.firstStamp <= stamp && hasLasted) {
            incidents.push_back(&incident);
        }
    }
    return incidents;
}

std::size_t Incidents::memoryBytes() const {
    constexpr std::size_t kNode = 4 * sizeof(void*);
    std::size_t bytes =
        m_incidents.size() * sizeof(Incident) + m_current.size() * (sizeof(*m_current.begin()) + kNode);
    for (const Incident& incident : m_incidents) {
        bytes += words::memoryBytes(incident.detail) + incident.parts.capacity() * sizeof(Incident::Part);
    }
    return bytes;
}

std::uint64_t Incidents::report(Occurrence one) {
    const auto known = m_current.find(episodeOf(one));
    Incident& incident = known != m_current.end() ? *findOwn(known->second) : begin(one);
    const std::uint64_t number = incident.number;
    add(incident, one);
    forget();
    return number;
}

void Incidents::addTo(std::uint64_t number, const Occurrence& one) {
    if (Incident* incident = findOwn(number)) {
        add(*incident, one);
    }
}

Incident& Incidents::begin(const Occurrence& one) {
    if (Incident* again = hoveringBefore(m_incidents, one)) {
        again->isCurrent = true;
        std::ranges::for_each(again->parts, [](Incident::Part& part) { part.isCurrent = false; });
        m_current.emplace(episodeOf(one), again->number);
        return *again;
    }
    std::uint64_t number = 0;
    const auto reserved = one.kind == IncidentKind::Loss ? m_reserved.find(one.sender) : m_reserved.end();
    if (reserved != m_reserved.end()) {
        number = reserved->second;
        m_reserved.erase(reserved);
    } else {
        number = m_next++;
    }
    Incident incident;
    incident.number = number;
    incident.kind = one.kind;
    incident.what = one.what;
    incident.sender = one.sender;
    incident.cause = one.cause;
    incident.firstStamp = one.from;
    incident.firstPacket = one.fromPacket;
    m_current.emplace(episodeOf(one), number);
    return *m_incidents.insert(placeOf(number), std::move(incident));
}

void Incidents::add(Incident& incident, const Occurrence& one) {
    incident.times += one.from > incident.lastStamp + Incident::kApart && incident.count != 0 ? 1 : 0;
    extend(incident, one.from, one.to, one.fromPacket, one.toPacket);
    incident.count += one.count;
    incident.samples += one.samples;
    incident.value = factsOf(one.kind).sumsValue ? incident.value + one.value
                     : incident.count <= one.count || std::abs(one.value) > std::abs(incident.value)
                         ? one.value
                         : incident.value;
    incident.limit = std::max(incident.limit, one.limit);
    if (!one.detail.isNothing()) {
        incident.detail = one.detail;
        words::clip(incident.detail, kMostDetailBytes);
    }
    if (Incident::Part* part =
            partOf(incident, {one.sender, one.character, one.type, 0, 0, one.from, one.to})) {
        part->times += one.from > part->to + Incident::kApart ? 1 : 0;
        part->count += one.count;
        part->samples += one.samples;
        part->from = std::min(part->from, one.from);
        part->to = std::max(part->to, one.to);
        part->isCurrent = !one.isOver;
        if (one.samples >= Incident::kManySamples) {
            part->lastMany = std::max(part->lastMany.value_or(one.to), one.to);
        }
    }
    changed(incident);
}

/// Null where there are too many already.
Incident::Part* Incidents::partOf(Incident& incident, const Incident::Part& one) {
    const auto known = std::ranges::find_if(incident.parts, [&](const Incident::Part& part) {
        return part.sender == one.sender && part.character == one.character && part.type == one.type;
    });
    if (known != incident.parts.end()) {
        return &*known;
    }
    if (incident.parts.size() >= kMostPartsOfOne) {
        return nullptr;
    }
    ++m_parts;
    return &incident.parts.emplace_back(one);
}

void Incidents::takeBack(std::uint64_t number, const Incident::Part& part, std::uint64_t samples,
                         std::uint64_t gaps) {
    Incident* const incident = findOwn(number);
    if (incident == nullptr) {
        return;
    }
    const auto take = [](std::uint64_t& from, std::uint64_t less) { from -= std::min(from, less); };
    take(incident->samples, samples);
    take(incident->count, gaps);
    for (Incident::Part& own : incident->parts) {
        if (own.sender == part.sender && own.character == part.character && own.type == part.type) {
            take(own.samples, samples);
            take(own.count, gaps);
            own.lastMany = own.samples < Incident::kManySamples ? std::nullopt : own.lastMany;
        }
    }
    m_parts -= std::erase_if(incident->parts, [](const Incident::Part& own) {
        return own.samples == 0 && own.count == 0 && own.type.has_value();
    });
    changed(*incident);
    const bool isNothing = incident->kind == IncidentKind::Loss ||
                           (incident->kind == IncidentKind::Local && incident->value == 0);
    if (isNothing && incident->samples == 0) {
        erase(incident->number);
    }
}

void Incidents::noteShares(std::uint64_t number, const std::vector<double>& inWindow,
                           const std::vector<double>& recent, double limit, double hysteresis) {
    Incident* incident = findOwn(number);
    if (incident == nullptr || inWindow.size() != incident->parts.size()) {
        return;
    }
    bool isOther = false;
    for (std::size_t i = 0; i < inWindow.size(); ++i) {
        Incident::Part& part = incident->parts[i];
        const double percent = 100 * inWindow[i];
        const bool isInWindow = limit > 0 && percent > limit;
        const double enough = limit * (part.isAbove ? hysteresis : 1);
        const bool isAbove = limit > 0 && 100 * recent[i] > enough && (part.isAbove || isInWindow);
        isOther = isOther || isAbove != part.isAbove;
        part.isAbove = isAbove;
        if (isInWindow && percent > incident->value) {
            incident->value = percent;
            incident->limit = limit;
            isOther = true;
        }
    }
    if (isOther) {
        changed(*incident);
    }
}

void Incidents::takeBackPart(std::uint64_t number, const CharacterKey& character) {
    Incident* const incident = findOwn(number);
    if (incident == nullptr) {
        return;
    }
    std::vector<Incident::Part>& parts = incident->parts;
    const std::size_t gone =
        std::erase_if(parts, [&](const Incident::Part& part) { return part.whose() == character; });
    m_parts -= gone;
    incident->count -= std::min<std::uint64_t>(incident->count, gone);
    if (!parts.empty()) {
        incident->firstStamp = std::ranges::min(parts, {}, &Incident::Part::from).from;
        changed(*incident);
        return;
    }
    m_next = number + 1 == m_next ? number : m_next; // as if it had never been
    erase(number);
}

void Incidents::end(std::uint64_t number, log::Stamp stamp) {
    Incident* incident = findOwn(number);
    if (incident != nullptr && incident->isCurrent) {
        incident->isCurrent = false;
        incident->lastStamp = std::max(incident->lastStamp, stamp);
        std::erase_if(m_current, [number](const auto& current) { return current.second == number; });
        changed(*incident);
    }
}

void Incidents::endPart(std::uint64_t number, const CharacterKey& character, std::optional<std::uint8_t> type,
                        log::Stamp stamp) {
    Incident* incident = findOwn(number);
    if (incident == nullptr) {
        return;
    }
    for (Incident::Part& part : incident->parts) {
        if (part.whose() == character && part.type == type) {
            part.isCurrent = false;
            part.to = std::max(part.to, stamp);
        }
    }
    changed(*incident);
    if (std::ranges::none_of(incident->parts, &Incident::Part::isCurrent)) {
        end(number, stamp);
    }
}

void Incidents::endPartExactly(std::uint64_t number, const CharacterKey& character, log::Stamp stamp) {
    Incident* incident = findOwn(number);
    if (incident == nullptr) {
        return;
    }
    for (Incident::Part& part : incident->parts) {
        part.to = part.whose() == character ? stamp : part.to;
    }
    incident->lastStamp = std::ranges::max(incident->parts, {}, &Incident::Part::to).to;
    endPart(number, character, std::nullopt, stamp);
}

std::uint64_t Incidents::joinOutages(std::uint64_t number) {
    constexpr std::ptrdiff_t kMostLooked = 256;
    const Incident* const one = find(number);
    if (one == nullptr || one->isCurrent || one->detail.kind != words::Kind::HostsSilent) {
        return number;
    }
    std::vector<std::uint64_t> same;
    const auto looked = m_incidents.end() - std::min(std::ssize(m_incidents), kMostLooked);
    for (auto other = looked; other != m_incidents.end(); ++other) {
        if (other->kind == one->kind && !other->isCurrent && other->detail.kind == one->detail.kind &&
            other->firstStamp < one->lastStamp && one->firstStamp < other->lastStamp) {
            same.push_back(other->number);
        }
    }
    for (std::size_t i = 1; i < same.size(); ++i) {
        for (auto& [before, now] : m_joined) {
            now = now == same[i] ? same.front() : now;
        }
        join(same.front(), same[i]);
        m_joined.emplace(same[i], same.front());
    }
    return same.empty() ? number : same.front();
}

void Incidents::join(std::uint64_t to, std::uint64_t from) {
    Incident& all = *findOwn(to);
    const Incident& joining = *find(from);
    all.sender = all.sender == joining.sender ? all.sender : log::kNoSender;
    all.times += joining.times -
                 (isOneTime(joining.firstStamp, joining.lastStamp, all.firstStamp, all.lastStamp) ? 1 : 0);
    extend(all, joining.firstStamp, joining.lastStamp, joining.firstPacket, joining.lastPacket);
    all.count += joining.count;
    all.samples += joining.samples;
    all.value = std::max(all.value, joining.value);
    for (const Incident::Part& part : joining.parts) {
        const std::size_t before = all.parts.size();
        if (Incident::Part* own = partOf(all, part); own != nullptr && all.parts.size() == before) {
            own->count += part.count;
            own->times += part.times - (isOneTime(part.from, part.to, own->from, own->to) ? 1 : 0);
            own->samples += part.samples;
            own->from = std::min(own->from, part.from);
            own->to = std::max(own->to, part.to);
            own->lastMany = std::max(own->lastMany, part.lastMany);
        }
    }
    changed(all);
    erase(from);
}

void Incidents::setCause(std::uint64_t number, LossCause cause) {
    Incident* incident = findOwn(number);
    if (incident == nullptr || incident->cause == cause) {
        return;
    }
    std::erase_if(m_current, [number](const auto& current) { return current.second == number; });
    incident->cause = cause;
    if (incident->isCurrent) {
        m_current.insert_or_assign(episodeOf(*incident), number);
    }
    changed(*incident);
}

std::uint64_t Incidents::reserve(log::SenderId sender) {
    const auto [place, isNew] = m_reserved.try_emplace(sender, m_next);
    m_next += isNew ? 1 : 0;
    return place->second;
}

void Incidents::retire(log::SenderId sender) {
    const auto from = m_current.lower_bound({sender});
    auto to = from;
    for (; to != m_current.end() && to->first.sender == sender; ++to) {
        Incident& incident = *findOwn(to->second);
        incident.isCurrent = false;
        changed(incident);
    }
    m_current.erase(from, to);
    m_reserved.erase(sender);
}

void Incidents::advance(log::Stamp stamp) {
    std::erase_if(m_current, [&](const auto& current) {
        Incident& incident = *findOwn(current.second);
        const bool isOver = !incident.lasts() && stamp - incident.lastStamp >= kQuiet;
        if (isOver) {
            incident.isCurrent = false;
            changed(incident);
        }
        return isOver;
    });
}

void Incidents::erase(std::uint64_t number) {
    const auto place = placeOf(number);
    m_parts -= place->parts.size();
    std::erase_if(m_current, [&](const auto& current) { return current.second == number; });
    m_incidents.erase(place);
    std::erase_if(m_joined, [&](const auto& joined) { return joined.second == number; });
    ++m_version;
}

/// Makes room: of the oldest that have ended the first two of one kind become one. Where none are alike the
/// oldest goes, which has ended if any has.
void Incidents::forget() {
    constexpr std::size_t kMostLooked = 256;
    while (m_incidents.size() > kMost || m_parts > kMostParts) {
        std::map<Episode, std::uint64_t> ended;
        const std::size_t end = std::min(kMostLooked, m_incidents.size());
        const auto like =
            std::find_if(m_incidents.begin(), m_incidents.begin() + end, [&](const Incident& one) {
                return !one.isCurrent && one.parts.size() <= kMostLooked &&
                       !ended.try_emplace(episodeOf(one), one.number).second;
            });
        if (like != m_incidents.begin() + end) {
            join(like->number, ended.at(episodeOf(*like)));
            continue;
        }
        const auto oldest = std::ranges::find(m_incidents, false, &Incident::isCurrent);
        erase((oldest == m_incidents.end() ? m_incidents.front() : *oldest).number);
    }
}

} // namespace posewire::model
