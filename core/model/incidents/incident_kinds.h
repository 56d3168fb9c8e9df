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
    words::Kind says; ///< Nothing if its detail says it
    IncidentSeverity severity;
    IncidentGroup group;
    bool lasts = false;         ///< until it is ended, else until it has been quiet
    bool isOfCharacter = false; ///< one for each character, else one for all of its sender
    bool sumsValue = false;     ///< else the worst value counts
    int decimals = 0;           ///< of the value, as it is said
};

inline constexpr std::array<IncidentKindFacts, kIncidentKinds> kIncidentKindTable = [] {
    using K = IncidentKind;
    using S = IncidentSeverity;
    using G = IncidentGroup;
    using W = words::Kind;
    return std::array<IncidentKindFacts, kIncidentKinds>{{
        {K::SourceUp, "source up", "", W::SenderStarted, S::Info, G::Sender},
        {K::Loss, "loss", "loss", W::Loss, S::Warning, G::Loss},
        {K::Local, "lost here", "local", W::LostHere, S::Error, G::Loss, false, false, true},
        {K::Outage, "outage", "outage", W::Outage, S::Warning, G::Sender, true},
        {K::Reordered, "reordered", "reordered", W::Reordered, S::Warning, G::Loss},
        {K::Duplicates, "duplicates", "duplicates", W::Duplicated, S::Warning, G::Loss},
        {K::Malformed, "malformed", "malformed", W::Malformed, S::Warning, G::Content},
        {K::Foreign, "foreign", "foreign", W::NotMxtp, S::Warning, G::Content},
        {K::Restart, "restart", "restart", W::Restarted, S::Warning, G::Sender},
        {K::Step, "rate changed", "step", W::Nothing, S::Warning, G::Sender},
        {K::TimeCode, "time code", "clock", W::Nothing, S::Warning, G::Content},
        {K::Conflict, "two senders", "conflict", W::Nothing, S::Error, G::Sender, false, true},
        {K::Scale, "contradiction", "scale", W::Nothing, S::Warning, G::Content, true, true},
        {K::MetadataChange, "metadata change", "", W::Nothing, S::Info, G::Content, false, true},
        {K::ScaleChange, "scale change", "", W::NullPoseChanged, S::Info, G::Content, false, true},
        {K::Overtaken, "overtaken", "local", W::Overtaken, S::Error, G::Loss, false, false, true},
        {K::RelayLoop, "relay loop", "local", W::Nothing, S::Error, G::Sender},
        {K::RecordingEnded, "recording", "local", W::Nothing, S::Error, G::Sender},
        {K::ClockSet, "clock set", "clock", W::ClockSet, S::Warning, G::Sender},
        {K::LossLimit, "loss limit", "limit", W::LossLimit, S::Warning, G::Limit, true, false, false, 2},
        {K::JitterLimit, "jitter limit", "limit", W::JitterLimit, S::Warning, G::Limit, true, false, false,
         1},
        {K::GapLimit, "gap limit", "limit", W::GapLimit, S::Warning, G::Limit, true},
        {K::AgeLimit, "age limit", "limit", W::AgeLimit, S::Error, G::Limit, true, false, false, 1},
        {K::RateLimit, "rate limit", "limit", W::RateLimit, S::Warning, G::Limit, true, false, false, 1},
    }};
}();

// Each once, in the order of the enum.
static_assert(std::ranges::adjacent_find(kIncidentKindTable, std::ranges::greater_equal(),
                                         &IncidentKindFacts::kind) == kIncidentKindTable.end());

inline const IncidentKindFacts& factsOf(IncidentKind kind) {
    return kIncidentKindTable[static_cast<std::size_t>(kind)];
}

} // namespace posewire::model
