// SPDX-License-Identifier: MIT
#include "core/model/content/content_watch.h"

#include "core/model/body/null_pose_measures.h"
#include "core/model/body/pose_remark.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace posewire::model {
namespace {

constexpr log::Duration kLook = std::chrono::milliseconds(500);
/// A type that has not come for as long is not sent.
constexpr log::Duration kGone = std::chrono::seconds(1);
/// Fewer samples are no fault that goes on.
constexpr int kLeastFound = 2;
/// A sample with a fault weighs twice as much as one without. kMostWeight good samples end the longest fault.
constexpr int kBad = 2;
constexpr int kMostWeight = 30;

/// Looked at with each sample; the others have times of their own.
constexpr std::array kOfEachSample{ContentFault::Missing, ContentFault::Orientation, ContentFault::Number,
                                   ContentFault::ByteOrder, ContentFault::Ids};

Occurrence occurrenceOf(const CharacterKey& key, std::uint8_t type, ContentFault fault, log::Stamp stamp) {
    const bool isScale = fault == ContentFault::None;
    Occurrence one = Occurrence::at(isScale ? IncidentKind::Scale : IncidentKind::Content, key.sender, stamp);
    one.what = fault;
    one.character = key.character;
    if (!isScale) {
        one.type = type;
        one.cause = LossCause::Sender;
    }
    return one;
}

/// Farther from one sample to the next is a jump, if it is faster than kFast, too.
constexpr double kFar = 1.5;   // metres
constexpr double kFast = 30.0; // metres a second

/// A place that is the one before in another unit.
bool isInOtherUnit(const Eigen::Vector3d& place, const Eigen::Vector3d& before) {
    constexpr double kMoved = 0.06; // metres
    return std::ranges::any_of(std::array{100.0, 1000.0}, [&](double factor) {
        return (place - factor * before).norm() < factor * kMoved ||
               (factor * place - before).norm() < factor * kMoved;
    });
}

/// True if the first segment moved impossibly far since the previous sample, `counters` counts earlier.
bool isTooFar(double metres, const ContentWatch::Sample& sample, std::uint32_t counters) {
    const std::uint32_t step = sample.stream.accounting.step();
    return metres > kFar && step != 0 && counters <= 2 * step &&
           metres * sample.stream.statistics.rateHz() * step > kFast * counters;
}

} // namespace

void ContentWatch::note(const Sample& sample, const ContentFinding& finding, log::Stamp since,
                        IncidentFollower& incidents) {
    Run& run = runOf(finding.fault);
    if (run.weight == 0) {
        run = {.since = since, .type = sample.datagram.header.type()};
    }
    run.weight = std::min(run.weight + kBad, kMostWeight);
    ++run.found;
    run.last = sample.packet.stamp;
    const bool isOther = run.finding.says != finding.says || run.finding.looks != finding.looks;
    run.finding = finding;
    const bool counts = run.found >= kLeastFound && run.last - run.since >= factsOf(finding.fault).after;
    if (counts && (isOther || !run.isReported)) {
        run.isReported = true;
        Occurrence one = occurrenceOf(sample.key, run.type, finding.fault, run.since);
        one.to = run.last;
        one.detail = factOf(finding);
        incidents.takeCondition(one);
    }
}

void ContentWatch::clear(const Sample& sample, ContentFault fault, IncidentFollower& incidents) {
    Run& run = runOf(fault);
    if (run.weight == 0 || run.type != sample.datagram.header.type()) {
        return;
    }
    const bool isStrict = factsOf(fault).isStrict;
    run.weight = isStrict ? 0 : run.weight - 1;
    if (run.weight == 0 && run.isReported) {
        incidents.takeCondition(
            occurrenceOf(sample.key, run.type, fault, isStrict ? sample.packet.stamp : run.last));
    }
}

void ContentWatch::noteOrClear(const Sample& sample, const ContentFinding& finding, bool isFound,
                               log::Stamp since, IncidentFollower& incidents) {
    if (isFound) {
        note(sample, finding, since, incidents);
    } else {
        clear(sample, finding.fault, incidents);
    }
}

void ContentWatch::rest(const CharacterKey& key, log::Stamp stamp, IncidentFollower& incidents) {
    for (std::size_t i = 0; i < kContentFaults; ++i) {
        Run& run = m_runs[i];
        if (run.weight != 0 && stamp - run.last > kLook + kGone) {
            if (run.isReported) {
                incidents.takeCondition(occurrenceOf(key, run.type, static_cast<ContentFault>(i), run.last));
            }
            run.weight = 0;
        }
    }
}

/// No type that tells more is sent.
bool ContentWatch::isMostTelling(std::size_t place, log::Stamp stamp) const {
    return std::none_of(
        m_types.begin(), m_types.begin() + static_cast<std::ptrdiff_t>(place),
        [stamp](const OfType& one) { return one.seen != log::Stamp() && stamp - one.seen < kGone; });
}

void ContentWatch::take(const Sample& sample, const NullPose* nullPose, IncidentFollower& incidents) {
    const std::uint8_t type = sample.datagram.header.type();
    const auto place = static_cast<std::size_t>(std::ranges::find(kPoseTypes, type) - kPoseTypes.begin());
    OfType& known = m_types[place];
    const log::Stamp stamp = sample.packet.stamp;
    const auto counters = static_cast<std::int32_t>(sample.datagram.header.sampleCounter - known.sample);
    const bool isUncounted = sample.stream.accounting.isUncounted();
    if (known.seen != log::Stamp() && !isUncounted && counters <= 0 && counters > -100) {
        return; // a duplicate, or late
    }
    const PoseChecks checks = checkPose(sample.datagram, known.mostBodyItems);
    for (const ContentFault fault : kOfEachSample) {
        const ContentFinding* found = checks.find(fault);
        noteOrClear(sample, found != nullptr ? *found : ContentFinding{fault}, found != nullptr, stamp,
                    incidents);
    }
    const bool isInMillimetres =
        sample.unit == LengthUnit::Millimetre && type != wire::AngularKinematics::kType && !checks.isUnusable;
    ContentFinding unit{ContentFault::Units, words::Kind::UnitLooks};
    unit.looks = words::Kind::Millimetres;
    unit.value = nullPose != nullptr ? 1 / metresPer(sample.unit) : 0;
    noteOrClear(sample, unit, isInMillimetres, stamp, incidents);
    const Framing& framing = sample.stream.accounting.framing();
    noteOrClear(
        sample,
        {ContentFault::Framing, framing.isShort() ? words::Kind::PartNeverSent : words::Kind::LastNeverSet},
        framing.isShort() || framing.isUnmarked(), stamp, incidents);
    noteOrClear(sample, {ContentFault::Counter, words::Kind::CounterStands}, isUncounted, stamp, incidents);
    if (!checks.isOfObjects && isMostTelling(place, stamp)) {
        checkTimeCode(sample, known, incidents);
        checkFrozen(sample, known, checks.isUnusable, incidents);
        const Eigen::Vector3d where =
            Eigen::Vector3f(checks.first.data()).cast<double>() * metresPer(sample.unit);
        m_newest = checks.isUnusable ? kNowhere : where;
        m_began = m_began.hasNaN() ? m_newest : m_began;
        checkJump(sample, known, m_newest, incidents);
        if (!checks.isUnusable && checks.isWhole && stamp >= m_nextLook) {
            compare(sample, nullPose, incidents);
        }
    }
    known.seen = stamp;
    known.sample = sample.datagram.header.sampleCounter;
    known.mostBodyItems = std::max(known.mostBodyItems, checks.bodyItems);
}

void ContentWatch::checkFrozen(const Sample& sample, OfType& known, bool isUnusable,
                               IncidentFollower& incidents) {
    const std::size_t hash = wire::hashOf(sample.packet.bytes.subspan(wire::kHeaderSize));
    const bool isSame = known.seen != log::Stamp() && hash == known.hash;
    known.changed = isSame ? known.changed : sample.packet.stamp;
    known.hash = hash;
    noteOrClear(sample, {ContentFault::Frozen, words::Kind::PoseFrozen}, isSame && !isUnusable, known.changed,
                incidents);
}

/// A silence, a jump and what was held up are seen by one look each. One that stands still is of the kind
/// Clock.
void ContentWatch::checkTimeCode(const Sample& sample, OfType& known, IncidentFollower& incidents) {
    constexpr double kSlowest = 0.4;
    constexpr double kFastest = 2.5;
    const log::Stamp stamp = sample.packet.stamp;
    const std::uint32_t timeCode = sample.datagram.header.timeCode;
    const std::pair from = known.clock.value_or(std::pair(stamp, timeCode));
    const std::int32_t ms = timeCodeStep(from.second, timeCode);
    if (known.clock && (stamp - from.first < kLook || ms == 0)) {
        return;
    }
    known.clock = std::pair(stamp, timeCode);
    ContentFinding finding{ContentFault::TimeCode, words::Kind::TimeCodeSpeed};
    finding.value = ms / std::max(log::millisecondsOf(stamp - from.first), 1.0);
    noteOrClear(sample, finding, ms > 0 && (finding.value < kSlowest || finding.value > kFastest), from.first,
                incidents);
}

void ContentWatch::takeTimeCode(const Sample& sample, const wire::TimeCode& message,
                                IncidentFollower& incidents) {
    constexpr std::int32_t kDriftedMs = 15;
    constexpr std::int32_t kJumpedMs = 400;
    constexpr log::Duration kLasting = std::chrono::milliseconds(300);
    const std::uint32_t header = sample.datagram.header.timeCode;
    const log::Stamp stamp = sample.packet.stamp;
    const std::int32_t apart = message.milliseconds() - static_cast<std::int32_t>(header);
    const std::int32_t moved = apart - m_drift.apart;
    const bool isStill = std::exchange(m_drift.header, header) == header;
    if (isStill || std::abs(moved) > kJumpedMs) { // of the kind Clock by itself
        m_drift = {header, apart, {}};
    } else if (std::abs(moved) <= kDriftedMs) {
        m_drift.since = {};
    } else if (m_drift.since == log::Stamp()) {
        m_drift.since = stamp;
    } else if (stamp - m_drift.since >= kLasting) {
        m_drift = {header, apart, {}};
        Occurrence one =
            Occurrence::at(IncidentKind::TimeCode, sample.key.sender, stamp, sample.packet.number);
        one.character = sample.key.character;
        one.detail = {words::Kind::TimeCodesDrift};
        incidents.report(one);
    }
}

/// A damaged datagram jumps there and back: one that jumped was in one place before, and stays where it is in
/// the next sample.
void ContentWatch::checkJump(const Sample& sample, OfType& known, const Eigen::Vector3d& place,
                             IncidentFollower& incidents) {
    const std::pair frame(sample.unit, sample.up);
    const bool isOtherFrame = std::exchange(known.frame, frame) != frame;
    known.first = isOtherFrame ? kNowhere : known.first; // they were recognised, nothing has moved
    const double metres = (place - known.first).norm();
    if (known.jump && (place - known.jumpedTo).norm() < kFar) {
        incidents.report(*known.jump);
    } else if (known.isSteady && !isInOtherUnit(place, known.first) &&
               isTooFar(metres, sample, sample.datagram.header.sampleCounter - known.sample)) {
        ContentFinding finding{ContentFault::Jump, words::Kind::PelvisJumped};
        finding.value = metres;
        known.jump =
            occurrenceOf(sample.key, sample.datagram.header.type(), ContentFault::Jump, sample.packet.stamp);
        known.jump->fromPacket = known.jump->toPacket = sample.packet.number;
        known.jump->detail = factOf(finding);
        known.jumpedTo = place;
        return; // until it is known to which of the two it goes on from
    }
    known.jump.reset();
    known.isSteady = metres < kFar;
    known.first = place;
}

/// Of somebody who stands or sits.
void ContentWatch::checkFloor(const Sample& sample, const CharacterPose& pose, IncidentFollower& incidents) {
    constexpr double kMostFromFloor = 0.5;
    constexpr double kLeastHeight = 0.8;
    const auto height = [](const SegmentPose& one) { return one.position.z(); };
    const auto [low, high] = std::ranges::minmax(std::span(pose.segments).first(kBodySegments), {}, height);
    const double lowest = height(low);
    const double highest = height(high);
    ContentFinding finding{ContentFault::Floor, words::Kind::FloorOff};
    finding.value = lowest;
    noteOrClear(sample, finding, std::abs(lowest) > kMostFromFloor && highest - lowest > kLeastHeight,
                sample.packet.stamp, incidents);
}

/// With the floor and the null pose: of types 02 and 01, whose positions and orientations are in the world.
void ContentWatch::compare(const Sample& sample, const NullPose* nullPose, IncidentFollower& incidents) {
    const std::uint8_t type = sample.datagram.header.type();
    if (type != wire::PoseQuaternion::kType && type != wire::PoseEuler::kType) {
        return;
    }
    m_nextLook = sample.packet.stamp + kLook;
    const std::uint64_t origin = nullPose != nullptr ? nullPose->packet + 1 : 0;
    if (std::exchange(m_nullPose, origin) != origin) {
        m_fit = {};
        if (nullPose == nullptr) {
            clear(sample, ContentFault::Convention, incidents);
            runOf(ContentFault::None) = {}; // its incident is that of the null pose now
        }
    }
    CharacterPose pose;
    if (!poseFromMessage(sample.datagram, referenceOrigins(), sample.unit, pose) ||
        pose.segments.size() < kBodySegments) {
        return;
    }
    checkFloor(sample, pose, incidents);
    const BodyOrigins body = nullPose != nullptr ? bodyOf(*nullPose) : BodyOrigins{};
    if (body.source != BodySource::NullPose) {
        return;
    }
    const double scale = scaleInPose(pose, body);
    ConventionFit fit;
    fit.add(pose.segments, body, scale);
    const bool isRight = fit.isRight();
    m_fit = isRight ? ConventionFit() : m_fit;
    if (!isRight) {
        m_fit.add(pose.segments, body, scale);
    }
    const words::Kind looks = isRight ? words::Kind::Nothing : m_fit.looks();
    noteOrClear(sample,
                {.fault = ContentFault::Convention,
                 .says = looks != words::Kind::Nothing ? words::Kind::ConventionLooks
                                                       : words::Kind::ConventionUnknown,
                 .looks = looks},
                !isRight, sample.packet.stamp, incidents);
    noteOrClear(sample,
                {.fault = ContentFault::None,
                 .says = words::Kind::Contradiction,
                 .looks = scale < 1 ? words::Kind::LongerThanScale : words::Kind::ShorterThanScale},
                isRight && scale != 1, sample.packet.stamp, incidents);
}

} // namespace posewire::model
