// SPDX-License-Identifier: MIT
#include "core/model/incidents/incident_follower.h"

#include <utility>

/// What is told of the spacing of sample counters.
namespace posewire::model {
namespace {

Occurrence stepOf(const log::StreamKey& stream, const Verdict& verdict) {
    Occurrence one = Occurrence::at(IncidentKind::Step, stream.sender, verdict.stamp, verdict.packet);
    one.character = stream.character;
    one.type = stream.type;
    return one;
}

} // namespace

/// The sender sends another share of its samples.
void IncidentFollower::noteStep(Stream& stream, const Verdict& verdict) {
    constexpr std::uint64_t kSettled = 128;
    const std::uint32_t step = stream.accounting.step();
    const std::uint64_t datagrams = stream.accounting.datagrams();
    const bool wasKnown = datagrams - stream.toldStepSince >= kSettled;
    if (step == 0 && stream.toldStep != 0 && !stream.isUneven) {
        if (wasKnown) {
            Occurrence one = stepOf(stream.key, verdict); // until it has another one
            one.detail = {words::Kind::StepIrregular, {{"before", std::uint64_t{stream.toldStep}}}};
            m_incidents.report(one);
        }
        stream.isUneven = wasKnown;
        stream.toldStep = wasKnown ? stream.toldStep : 0;
    }
    if (step == 0) {
        return;
    }
    if (std::exchange(stream.isUneven, false)) {
        stream.toldStepSince = datagrams;
    }
    if (step == stream.toldStep) {
        return;
    }
    const std::uint32_t before = std::exchange(stream.toldStep, step);
    stream.toldStepSince = datagrams;
    if (before == 0 || !wasKnown) {
        return; // nobody knew it before
    }
    Occurrence one = stepOf(stream.key, verdict);
    one.detail = {words::Kind::StepChanged,
                  {{"step", std::uint64_t{step}}, {"before", std::uint64_t{before}}}};
    m_incidents.report(one);
    excuse(stream.key, verdict.stamp);
    stream.usualHz = 0;
}

} // namespace posewire::model
