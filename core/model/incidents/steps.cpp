// SPDX-License-Identifier: MIT
#include "core/model/incidents/incident_follower.h"

#include <string>
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
    const std::uint64_t known = stream.accounting.datagrams() - stream.toldStepSince;
    if (step == 0 && stream.toldStep != 0 && known >= kSettled && !std::exchange(stream.isUneven, true)) {
        Occurrence one = stepOf(stream.key, verdict); // until it has another one
        one.detail =
            "The step of the sample counter is irregular; it was " + std::to_string(stream.toldStep) + '.';
        m_incidents.report(one);
    }
    if (step == 0) {
        return;
    }
    stream.isUneven = false;
    if (step == stream.toldStep) {
        return;
    }
    const std::uint32_t before = std::exchange(stream.toldStep, step);
    const std::uint64_t since = std::exchange(stream.toldStepSince, stream.accounting.datagrams());
    if (before == 0 || stream.accounting.datagrams() - since < kSettled) {
        return; // nobody knew it before
    }
    Occurrence one = stepOf(stream.key, verdict);
    one.detail = "The step of the sample counter is " + std::to_string(step) + " now; it was " +
                 std::to_string(before) + '.';
    m_incidents.report(one);
    excuse(stream.key, verdict.stamp);
    stream.usualHz = 0;
}

} // namespace posewire::model
