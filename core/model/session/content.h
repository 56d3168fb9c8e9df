// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/kernel_counters.h"
#include "core/model/keeping.h"
#include "core/model/session/roll.h"

#include <cstddef>

namespace posewire::model {

class IncidentFollower;

/// The third stage: reads metadata and bodies from datagrams, and looks for what contradicts itself.
class Content {
public:
    /// Of all characters together: the oldest goes if it would be more.
    static constexpr std::size_t kMetadataBudget = std::size_t{8} << 20;
    static constexpr std::size_t kNullPoseBudget = std::size_t{16} << 20;

    /// Both outlive this; neither is looked at here.
    Content(Roll& roll, IncidentFollower& incidents) : m_roll(roll), m_incidents(incidents) {}

    /// Each datagram that was decoded, of a stream that is followed.
    void take(const Observed& seen);
    /// Looks whether senders contradict themselves, and what is not sent any more, if it is time again.
    void lookForContradictions(log::Stamp stamp);
    /// What the kernel counted since this computer began to listen.
    void setKernel(const log::KernelCounters& counters) { m_kernel = counters; }
    [[nodiscard]] const log::KernelCounters& kernel() const { return m_kernel; }
    /// Makes it time.
    void lookAgain() { m_nextContradictions = {}; }

    /// Estimates what is kept of all characters.
    [[nodiscard]] std::size_t metadataBytes() const;
    [[nodiscard]] std::size_t nullPoseBytes() const;

private:
    void takeMetadata(const wire::MetaData& message, const Observed& seen);
    void takeNullPose(const wire::NullPose& part, const Observed& seen);
    void lookForFragments(const Sender& sender, log::Stamp stamp);
    void compareClocks(log::Stamp stamp);

    Roll& m_roll;
    IncidentFollower& m_incidents;
    Keeping m_metadataKeeping{kMetadataBudget};
    Keeping m_nullPoseKeeping{kNullPoseBudget};
    log::KernelCounters m_kernel;
    log::Stamp m_nextContradictions{};
};

} // namespace posewire::model
