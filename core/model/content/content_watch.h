// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/model/accounting/stream.h"
#include "core/model/body/pose_messages.h"
#include "core/model/content/conventions.h"
#include "core/model/content/pose_checks.h"
#include "core/model/incidents/incident_follower.h"
#include "core/model/keys.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace posewire::model {

struct CharacterPose;
struct NullPose;

/// Watches what a character is sent as: whether it can be used. What is wrong counts once it has gone on for
/// as long as its row in kContentFaultTable says. Allocates only where something is reported, and in the
/// looks that compare poses with the null pose, twice a second.
class ContentWatch {
public:
    struct Sample {
        const CharacterKey& key;
        const log::Packet& packet;
        const wire::Datagram& datagram;
        const Stream& stream;
        LengthUnit unit = LengthUnit::Metre; ///< of its positions
        UpAxis up = UpAxis::Z;               ///< as it was sent
    };
    /// The first datagram of each sample of a type that holds poses. `nullPose`: the newest that is whole and
    /// does not contradict itself, null if there is none.
    void take(const Sample& sample, const NullPose* nullPose, IncidentFollower& incidents);
    /// Type 25: it runs as the time code in its own header does.
    void takeTimeCode(const Sample& sample, const wire::TimeCode& message, IncidentFollower& incidents);
    /// Where the first segment was in the first pose and in the newest one, in metres; NaN before there was.
    [[nodiscard]] const Eigen::Vector3d& began() const { return m_began; }
    [[nodiscard]] const Eigen::Vector3d& newest() const { return m_newest; }
    /// Ends what is not sent any more.
    void rest(const CharacterKey& key, log::Stamp stamp, IncidentFollower& incidents);

private:
    /// A fault that goes on, whether it counts yet or not.
    struct Run {
        log::Stamp since{};
        log::Stamp last{};
        int weight = 0; ///< of samples that have it against those that do not; 0: there is none
        int found = 0;
        std::uint8_t type = 0; ///< of the stream that has it
        bool isReported = false;
        ContentFinding finding{};
    };
    inline static const Eigen::Vector3d kNowhere =
        Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    /// State of one message type.
    struct OfType {
        std::size_t hash = 0; ///< of its newest message
        std::uint32_t sample = 0;
        log::Stamp seen{};                ///< 0: none yet
        log::Stamp changed{};             ///< when this pose came first
        Eigen::Vector3d first = kNowhere; ///< where its first segment was, in metres
        bool isSteady = false;            ///< so was the sample before
        std::pair<LengthUnit, UpAxis> frame{};
        std::optional<Occurrence> jump{}; ///< from there, unless the next sample is back
        Eigen::Vector3d jumpedTo = kNowhere;
        std::uint8_t mostBodyItems = 0;
        std::optional<std::pair<log::Stamp, std::uint32_t>> clock{}; ///< time code of an earlier look at it
    };
    Run& runOf(ContentFault fault) { return m_runs[static_cast<std::size_t>(fault)]; }
    void note(const Sample& sample, const ContentFinding& finding, log::Stamp since,
              IncidentFollower& incidents);
    void clear(const Sample& sample, ContentFault fault, IncidentFollower& incidents);
    void noteOrClear(const Sample& sample, const ContentFinding& finding, bool isFound, log::Stamp since,
                     IncidentFollower& incidents);
    void checkFrozen(const Sample& sample, OfType& known, bool isUnusable, IncidentFollower& incidents);
    static void checkJump(const Sample& sample, OfType& known, const Eigen::Vector3d& place,
                          IncidentFollower& incidents);
    void checkTimeCode(const Sample& sample, OfType& known, IncidentFollower& incidents);
    void checkFloor(const Sample& sample, const CharacterPose& pose, IncidentFollower& incidents);
    void compare(const Sample& sample, const NullPose* nullPose, IncidentFollower& incidents);
    [[nodiscard]] bool isMostTelling(std::size_t place, log::Stamp stamp) const;

    struct {
        std::uint32_t header = 0;
        std::int32_t apart = 0; ///< ms, by which type 25 is ahead
        log::Stamp since{};     ///< it is another time apart; 0: it is not
    } m_drift;
    std::array<Run, kContentFaults> m_runs{}; ///< that of None is of the kind Scale
    std::array<OfType, kPoseTypes.size()> m_types{};
    Eigen::Vector3d m_began = kNowhere;
    Eigen::Vector3d m_newest = kNowhere;
    ConventionFit m_fit;
    std::uint64_t m_nullPose = 0; ///< one past the packet of the one that was compared with
    log::Stamp m_nextLook{};
};

} // namespace posewire::model
