// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/incidents/incident.h"

#include <algorithm>
#include <array>

/// What is to be known of each kind of incident: one row.
namespace posewire::model {

struct IncidentKindFacts {
    IncidentKind kind;
    std::string_view name;
    std::string_view word;
    IncidentSeverity severity;
    IncidentGroup group;
    bool lasts = false;         ///< until it is ended, else until it has been quiet
    bool isOfCharacter = false; ///< one for each character, else one for all of its sender
    bool sumsValue = false;     ///< else the worst value counts
};

inline constexpr std::array<IncidentKindFacts, kIncidentKinds> kIncidentKindTable = [] {
    using K = IncidentKind;
    using S = IncidentSeverity;
    using G = IncidentGroup;
    return std::array<IncidentKindFacts, kIncidentKinds>{{
        {K::SourceUp, "source up", "", S::Info, G::Sender},
        {K::Loss, "loss", "loss", S::Warning, G::Loss},
        {K::Local, "lost here", "local", S::Error, G::Loss, false, false, true},
        {K::Outage, "outage", "outage", S::Warning, G::Sender, true},
        {K::Reordered, "reordered", "reordered", S::Warning, G::Loss},
        {K::Duplicates, "duplicates", "duplicates", S::Warning, G::Loss},
        {K::Malformed, "malformed", "malformed", S::Warning, G::Content},
        {K::Foreign, "foreign", "foreign", S::Warning, G::Content},
        {K::Restart, "restart", "restart", S::Warning, G::Sender},
        {K::Step, "rate changed", "step", S::Warning, G::Sender},
        {K::TimeCode, "time code", "clock", S::Warning, G::Content},
        {K::Conflict, "two senders", "conflict", S::Error, G::Sender, false, true},
        {K::Scale, "contradiction", "scale", S::Warning, G::Content, true, true},
        {K::MetadataChange, "metadata change", "", S::Info, G::Content, false, true},
        {K::ScaleChange, "scale change", "", S::Info, G::Content, false, true},
        {K::Overtaken, "overtaken", "local", S::Error, G::Loss, false, false, true},
        {K::RelayLoop, "relay loop", "local", S::Error, G::Sender},
        {K::RecordingEnded, "recording", "local", S::Error, G::Sender},
        {K::ClockSet, "clock set", "clock", S::Warning, G::Sender},
        {K::LossLimit, "loss limit", "limit", S::Warning, G::Limit, true},
        {K::JitterLimit, "jitter limit", "limit", S::Warning, G::Limit, true},
        {K::GapLimit, "gap limit", "limit", S::Warning, G::Limit, true},
        {K::AgeLimit, "age limit", "limit", S::Error, G::Limit, true},
        {K::RateLimit, "rate limit", "limit", S::Warning, G::Limit, true},
    }};
}();

// Each once, in the order of the enum.
static_assert(std::ranges::adjacent_find(kIncidentKindTable, std::ranges::greater_equal(),
                                         &IncidentKindFacts::kind) == kIncidentKindTable.end());

inline const IncidentKindFacts& factsOf(IncidentKind kind) {
    return kIncidentKindTable[static_cast<std::size_t>(kind)];
}

} // namespace posewire::model
