// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/character.h"

#include "core/model/body/points.h"
#include "core/wire/messages.h"

#include <cstdint>
#include <vector>

/// From a character to the bodies of messages, in the wire's units and frames.
namespace posewire::performer {

/// What differs between revisions of the specification.
struct MessageDialect {
    model::PointIdCoding pointIds = model::PointIdCoding::By256;
    int firstPropId = 24;             ///< 25 in the tables of revisions E to K
    bool prefixesMetaData = true;     ///< length before the text of type 12
    bool prefixesTimeCode = true;     ///< length before the text of type 25
    bool sendsMassDerivatives = true; ///< type 24 in 36 bytes
    bool sendsRealTags = true;        ///< the tags of type 12 that are in no specification but on the wire
};

wire::PoseEuler poseEuler(const Character& character, const CharacterMoment& moment,
                          const MessageDialect& dialect);
wire::PoseQuaternion poseQuaternion(const Character& character, const CharacterMoment& moment,
                                    const MessageDialect& dialect);
/// The 64 markers.
wire::PointPositions pointPositions(const Character& character, const CharacterMoment& moment,
                                    const MessageDialect& dialect);
/// Two tags off the body: one carried across the floor, one lying still.
wire::TagPositions tagPositions(double seconds);
wire::PoseUnity poseUnity(const CharacterMoment& moment);
wire::JointAngles jointAngles(const CharacterMoment& moment);
wire::LinearKinematics linearKinematics(const Character& character, const CharacterMoment& moment,
                                        const MessageDialect& dialect);
wire::AngularKinematics angularKinematics(const Character& character, const CharacterMoment& moment,
                                          const MessageDialect& dialect);
wire::TrackerKinematics trackerKinematics(const CharacterMoment& moment);
wire::CentreOfMass centreOfMassMessage(const CharacterMoment& moment, const MessageDialect& dialect);
/// `timeOfDayMs` since midnight; wraps after a day.
wire::TimeCode timeCode(std::uint64_t timeOfDayMs, const MessageDialect& dialect);

/// How the body differs from the reference body (revision E).
wire::ScaleInformation scaleInformation(const Character& character);
wire::PropInformation propInformation(const Character& character, const MessageDialect& dialect);
wire::MetaData metaData(const Character& character, int characterCount, const MessageDialect& dialect);
/// All segments first, then the points in parts that fit an Ethernet frame each.
std::vector<wire::NullPose> nullPoseParts(const Character& character);

/// The wire's ID of the segment at a position of the layout.
std::uint32_t segmentId(const model::SegmentLayout& layout, int position, const MessageDialect& dialect);

} // namespace posewire::performer
