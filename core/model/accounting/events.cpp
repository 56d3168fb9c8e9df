// SPDX-License-Identifier: MIT
#include "core/model/accounting/events.h"

#include "core/model/text.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>

namespace posewire::model {
namespace {

struct KindFacts {
    EventKind kind;
    std::string_view name;
    EventSeverity severity;
    EventGroup group;
    bool lasts; ///< until it is ended, else until it has been quiet
};

constexpr std::array<KindFacts, kEventKinds> kKinds{{
    {EventKind::SenderUp, "source up", EventSeverity::Info, EventGroup::Sender, false},
    {EventKind::SenderDown, "source down", EventSeverity::Error, EventGroup::Sender, true},
    {EventKind::Gap, "gap", EventSeverity::Warning, EventGroup::Loss, false},
    {EventKind::Burst, "burst", EventSeverity::Error, EventGroup::Loss, false},
    {EventKind::Restart, "restart", EventSeverity::Info, EventGroup::Sender, false},
    {EventKind::Malformed, "malformed", EventSeverity::Error, EventGroup::Content, false},
    {EventKind::Foreign, "foreign", EventSeverity::Warning, EventGroup::Content, false},
    {EventKind::Dropped, "dropped here", EventSeverity::Error, EventGroup::Loss, false},
    {EventKind::MetadataChange, "metadata change", EventSeverity::Info, EventGroup::Content, false},
    {EventKind::ScaleChange, "scale change", EventSeverity::Info, EventGroup::Content, false},
    {EventKind::TimeCodeJump, "time code jump", EventSeverity::Warning, EventGroup::Content, false},
    {EventKind::CharacterConflict, "character conflict", EventSeverity::Error, EventGroup::Sender, false},
    {EventKind::Stale, "stale", EventSeverity::Warning, EventGroup::Sender, true},
    {EventKind::Overtaken, "overtaken", EventSeverity::Error, EventGroup::Loss, false},
    {EventKind::RelayLoop, "relay loop", EventSeverity::Error, EventGroup::Sender, false},
    {EventKind::ClockSet, "clock set", EventSeverity::Warning, EventGroup::Sender, false},
    {EventKind::LossLimit, "loss limit", EventSeverity::Warning, EventGroup::Limit, true},
    {EventKind::JitterLimit, "jitter limit", EventSeverity::Warning, EventGroup::Limit, true},
    {EventKind::GapLimit, "gap limit", EventSeverity::Warning, EventGroup::Limit, true},
    {EventKind::AgeLimit, "age limit", EventSeverity::Error, EventGroup::Limit, true},
    {EventKind::RateLimit, "rate limit", EventSeverity::Warning, EventGroup::Limit, true},
}};

// Each once, in the order of the enum.
static_assert(std::ranges::adjacent_find(kKinds, std::ranges::greater_equal(), &KindFacts::kind) ==
              kKinds.end());

const KindFacts& factsOf(EventKind kind) {
    return kKinds[static_cast<std::size_t>(kind)];
}

std::string fixed(double value, int decimals) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    return text.data();
}

std::string lossText(const Event& event) {
    std::string text = counted(event.samples, "sample") + " lost in " + counted(event.count, "gap");
    if (event.cause) {
        text += ", cause: " + std::string(nameOf(*event.cause)) + '.';
    }
    return event.detail.empty() ? text : text + ' ' + event.detail;
}

std::string limitText(const Event& event, const char* what, const char* unit, int decimals) {
    return std::string(what) + ' ' + fixed(event.value, decimals) + ' ' + unit + ", limit " +
           fixed(event.limit, decimals) + ' ' + unit;
}

} // namespace

EventSeverity Event::severity() const {
    return factsOf(kind).severity;
}

EventGroup Event::group() const {
    return factsOf(kind).group;
}

std::string_view nameOf(EventKind kind) {
    return factsOf(kind).name;
}

Event Event::of(EventKind kind, log::SenderId sender, log::Stamp stamp, std::uint64_t packet) {
    Event event;
    event.kind = kind;
    event.sender = sender;
    event.firstStamp = event.lastStamp = stamp;
    event.firstPacket = event.lastPacket = packet;
    return event;
}

std::string Event::text() const {
    switch (kind) {
    case EventKind::SenderUp:
        return "A sender started sending.";
    case EventKind::SenderDown:
        return "No data for 1 s.";
    case EventKind::Gap:
    case EventKind::Burst:
        return lossText(*this);
    case EventKind::Restart:
        return "The sample counter restarted.";
    case EventKind::Malformed:
        return counted(count, "datagram") + " could not be decoded.";
    case EventKind::Foreign:
        return counted(count, "datagram is", "datagrams are") + " not MXTP.";
    case EventKind::Dropped:
        return "This computer dropped " + counted(samples, "datagram") + '.';
    case EventKind::Overtaken:
        return "This computer did not look at " + counted(samples, "packet") + " in time.";
    case EventKind::MetadataChange:
    case EventKind::RelayLoop:
        return detail;
    case EventKind::ScaleChange:
        return "The null pose changed.";
    case EventKind::TimeCodeJump:
        return "The time code jumped by " + fixed(value, 0) + " ms.";
    case EventKind::CharacterConflict:
        return "Two sources send character " + std::to_string(character.value_or(0)) + " at the same time.";
    case EventKind::Stale:
        return "No pose for 1 s, though the source sends.";
    case EventKind::ClockSet:
        return std::string("The receiving computer's clock was set ") + (value < 0 ? "back" : "forward") +
               " by " + fixed(std::abs(value), 3) + " s.";
    case EventKind::LossLimit:
        return limitText(*this, "Loss", "%", 2);
    case EventKind::JitterLimit:
        return limitText(*this, "Jitter", "ms", 1);
    case EventKind::GapLimit:
        return limitText(*this, "Gap", "ms", 0);
    case EventKind::AgeLimit:
        return limitText(*this, "Age", "s", 1);
    case EventKind::RateLimit:
        return limitText(*this, "Rate off by", "%", 1);
    }
    return {};
}

std::size_t Events::indexOf(std::uint64_t number) const {
    const auto found = std::ranges::lower_bound(m_events, number, {}, &Event::number);
    return static_cast<std::size_t>(found - m_events.begin());
}

std::vector<const Event*> Events::current() const {
    std::vector<const Event*> events;
    for (const auto& [episode, number] : m_current) {
        events.push_back(&at(number));
    }
    std::ranges::sort(events, {}, &Event::number);
    return events;
}

std::vector<const Event*> Events::currentOf(log::SenderId sender) const {
    std::vector<const Event*> events;
    for (auto current = m_current.lower_bound({sender});
         current != m_current.end() && current->first.sender == sender; ++current) {
        events.push_back(&at(current->second));
    }
    return events;
}

std::vector<const Event*> Events::currentAt(log::Stamp stamp) const {
    std::vector<const Event*> events;
    for (const Event& event : m_events) {
        const bool hasLasted = factsOf(event.kind).lasts ? event.isCurrent || event.lastStamp > stamp
                                                         : event.lastStamp + kQuiet > stamp;
        if (event.firstStamp <= stamp && hasLasted) {
            events.push_back(&event);
        }
    }
    return events;
}

std::size_t Events::memoryBytes() const {
    constexpr std::size_t kNode = 4 * sizeof(void*);
    std::size_t bytes =
        m_events.size() * sizeof(Event) + m_current.size() * (sizeof(*m_current.begin()) + kNode);
    for (const Event& event : m_events) {
        bytes += event.detail.capacity();
    }
    return bytes;
}

const Event* Events::find(std::uint64_t number) const {
    const std::size_t index = indexOf(number);
    return index < m_events.size() && m_events[index].number == number ? &m_events[index] : nullptr;
}

Events::Episode Events::episodeOf(const Event& event) {
    return {event.sender, event.kind, event.character, event.type, event.cause};
}

/// Its index.
std::optional<std::size_t> Events::findCurrent(const Event& like) const {
    const auto found = m_current.find(episodeOf(like));
    return found == m_current.end() ? std::nullopt : std::optional(indexOf(found->second));
}

void Events::report(Event event) {
    ++m_version;
    event.detail = clippedText(std::move(event.detail), kMostDetailBytes);
    if (const auto index = findCurrent(event)) {
        Event& known = m_events[*index];
        known.lastStamp = std::max(known.lastStamp, event.lastStamp);
        known.lastPacket = std::max(known.lastPacket, event.lastPacket);
        known.count += event.count;
        known.samples += event.samples;
        known.value = std::max(known.value, event.value);
        known.detail = std::move(event.detail);
        return;
    }
    m_current.emplace(episodeOf(event), m_next);
    m_events.push_back(std::move(event));
    m_events.back().number = m_next;
    ++m_next;
    forget();
}

void Events::end(const Event& like, log::Stamp stamp) {
    if (const auto index = findCurrent(like)) {
        Event& known = m_events[*index];
        known.isCurrent = false;
        known.lastStamp = std::max(known.lastStamp, stamp);
        m_current.erase(episodeOf(known));
        ++m_version;
    }
}

void Events::retire(log::SenderId sender) {
    const auto from = m_current.lower_bound({sender});
    auto to = from;
    for (; to != m_current.end() && to->first.sender == sender; ++to) {
        m_events[indexOf(to->second)].isCurrent = false;
        ++m_version;
    }
    m_current.erase(from, to);
}

void Events::advance(log::Stamp stamp) {
    std::erase_if(m_current, [&](const auto& current) {
        Event& event = m_events[indexOf(current.second)];
        const bool isOver = !factsOf(event.kind).lasts && stamp - event.lastStamp >= kQuiet;
        event.isCurrent = !isOver;
        m_version += isOver ? 1 : 0;
        return isOver;
    });
}

/// Makes room: the oldest that has ended goes, or the oldest of all where none has.
void Events::forget() {
    if (m_events.size() <= kMost) {
        return;
    }
    auto oldest = std::ranges::find(m_events, false, &Event::isCurrent);
    oldest = oldest == m_events.end() ? m_events.begin() : oldest;
    if (oldest->isCurrent) {
        m_current.erase(episodeOf(*oldest));
    }
    m_events.erase(oldest);
}

} // namespace posewire::model
